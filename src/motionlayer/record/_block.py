"""`Block`: rows of consecutive ticks as the cycle fills them, with all that came between."""

from typing import TYPE_CHECKING, Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.record._records import Gap

if TYPE_CHECKING:
    from motionlayer.event import Event, Input
    from motionlayer.record._records import Plan

Floats = NDArray[np.float64]
T = TypeVar("T")

MOST_RECORDS: Final = 1 << 16
"""Plans, events and inputs, of each so many, that a block of a recorder that must not wait holds at most."""


@kernel
def gather(flat: Floats, index: NDArray[np.int64], values: Floats, hashed: Floats, row: int) -> None:
    """Copy the selected values of a table into a row of `values`, and its first ones into a row of `hashed`."""
    for k in range(index.shape[0]):
        values[row, k] = flat[index[k]]
    for k in range(hashed.shape[1]):
        hashed[row, k] = flat[k]


class Block:
    """Rows of consecutive ticks, and the records that came since the block before.

    Args:
        ticks: rows there is room for.
        signals: values of a row that are written.
        hashed: values of a row that the hash is over; apart, so that each is hashed and written where it lies.
        most_records: plans, events and inputs, of each so many, that are kept; more are counted.

    Attributes:
        values: shape (ticks, signals).
        hashed: shape (ticks, hashed).
        first: tick of the first row.
        count: rows that are filled.
        plans: profiles that were taken over.
        events: what happened.
        inputs: what came from outside.
        since: tick of the first row that is missing before `first`, if one is.
        missing: number of these rows.
        lost: number of records that were not kept.
    """

    __slots__ = (
        "_most", "count", "events", "first", "hashed", "inputs", "lost", "missing", "plans", "since", "values",
    )  # fmt: skip

    def __init__(self, ticks: int, signals: int, hashed: int, most_records: int) -> None:
        # Filled, not only reserved: the pages are there before the first cycle needs them.
        self.values = np.full((ticks, signals), 0.0)
        self.hashed = np.full((ticks, hashed), 0.0)
        self._most = most_records
        self.clear()

    def clear(self) -> None:
        """Become empty."""
        self.first = 0
        self.count = 0
        self.plans: list[Plan] = []
        self.events: list[Event] = []
        self.inputs: list[Input] = []
        self.since = 0
        self.missing = 0
        self.lost = 0

    @property
    def gap(self) -> Gap | None:
        """What is missing before the first row, None if nothing is."""
        if not self.missing and not self.lost:
            return None
        return Gap(self.since if self.missing else self.first, self.missing, self.lost)

    def keep(self, records: list[T], record: T) -> None:
        """Append a record to one of the lists of this block, or count it as lost."""
        if len(records) < self._most:
            records.append(record)
        else:
            self.lost += 1

    def drop(self, tick: int) -> None:
        """Count the row of a tick as lost."""
        if not self.missing:
            self.since = tick
        self.missing += 1

    def take_over(self, other: "Block") -> None:
        """Move the records of another block, and what it has lost, into this empty one."""
        self.plans, self.events, self.inputs = other.plans, other.events, other.inputs
        self.since, self.missing, self.lost = other.since, other.missing, other.lost
        other.clear()
