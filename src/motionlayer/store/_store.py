"""`Store`: the tables of a run and the calls of its cycle."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motionlayer.store._kernels import Floats, add_up, passing_time, sample, take_over
from motionlayer.store._layout import PIECE_FIELDS, Q


class Ended(NamedTuple):
    """A profile that came to its last piece.

    Attributes:
        column: the coordinate.
        early: seconds before the sampled tick at which it happened, 0 <= early.
    """

    column: int
    early: float


class Watch(NamedTuple):
    """Somebody who wants to know when a setpoint passes a position.

    Attributes:
        column: a generator.
        position: u.
        tell: called once, with the seconds before the sampled tick at which it happened.
    """

    column: int
    position: float
    tell: Callable[[float], None]


class Snapshot(NamedTuple):
    """Copies of all tables of a store."""

    tick: int
    table: Floats
    pieces: Floats
    counts: NDArray[np.int64]
    current: NDArray[np.int64]


class Store:
    """All coordinates of a run.

    Args:
        generators: number of columns that follow a profile.
        dt: base cycle in seconds.
        max_pieces: most pieces of one profile.
        sums: pairs of columns; each becomes a further column that is the sum of the two. An operand must stand
            before the sum, so evaluating in order is evaluating by level, and a ring cannot be written.

    Raises:
        ValueError: a sum names a column that does not stand before it.
    """

    __slots__ = (
        "_ended", "_left", "_right", "_watches", "counts", "current", "dt",
        "generators", "pieces", "placed", "status_changed", "table", "taken_over", "tick",
    )  # fmt: skip

    def __init__(self, generators: int, *, dt: float, max_pieces: int, sums: Sequence[tuple[int, int]] = ()) -> None:
        for column, operands in enumerate(sums, generators):
            if not all(0 <= operand < column for operand in operands):
                raise ValueError(f"column {column} is the sum of {operands}: both must stand before it")
        self.generators = generators
        self.dt = dt
        self.table: Floats = np.zeros((Q.COUNT, generators + len(sums)))
        self.pieces: Floats = np.zeros((generators, max_pieces, PIECE_FIELDS))
        self.counts = np.ones(generators, dtype=np.int64)
        self.current = np.zeros(generators, dtype=np.int64)
        self.tick = 0
        """The tick at which the setpoints in the table are valid."""
        self.taken_over: dict[int, None] = {}
        """Columns that follow another profile since the dictionary was last cleared, in order."""
        self.placed: list[tuple[int, int, float]] = []
        """Column, tick and position of every `place` since the list was last cleared."""
        self.status_changed: list[int] = []
        """Columns whose drive status or inputs changed; the drives append, the axes take."""
        self._ended = np.zeros(max(generators, 1), dtype=np.int64)
        self._left = np.array([left for left, _ in sums], dtype=np.int64)
        self._watches: list[Watch] = []
        self._right = np.array([right for _, right in sums], dtype=np.int64)
        self.table[Q.END_TIME] = np.inf

    def adopt(self, column: int, pieces: Floats, *, offset: float = 0.0) -> None:
        """Let a column follow a profile from the present setpoint on; it is first sampled for the tick after.

        Args:
            column: a generator.
            pieces: shape (k, 5), as `Store.pieces`; the last piece goes on for ever.
            offset: seconds of the profile that have passed at the present tick.

        Raises:
            ValueError: too many pieces.
        """
        if len(pieces) > self.pieces.shape[1]:
            raise ValueError(f"a profile of {len(pieces)} pieces; at most {self.pieces.shape[1]} are possible")
        tables = self.table, self.pieces, self.counts, self.current
        take_over(*tables, column, pieces, len(pieces), float(self.tick), offset)
        self.taken_over[column] = None

    def place(self, column: int, position: float) -> None:
        """Redefine where a resting column stands: its setpoint changes at once and stays there."""
        table = self.table
        table[Q.SET_P, column] = position
        table[Q.SET_V : Q.SET_A + 1, column] = 0.0
        self.adopt(column, np.array([[0.0, position, 0.0, 0.0, 0.0]]))
        del self.taken_over[column]  # what was taken over in this tick before was never followed
        self.placed.append((column, self.tick, position))
        table[Q.END_TIME, column] = np.inf

    def sample(self, tick: int) -> list[Ended]:
        """Evaluate all coordinates at `tick` and report the profiles that came to their last piece."""
        before = [float(self.table[Q.SET_P, watch.column]) for watch in self._watches]
        count = sample(
            self.table,
            self.pieces,
            self.counts,
            self.current,
            self.generators,
            float(tick),
            self.dt,
            self._ended,
        )
        self.tick = tick
        if len(self._left):
            add_up(self.table, self.generators, self._left, self._right)
        if before:
            self._look(before, tick)
        if not count:
            return []
        table = self.table
        return [
            Ended(
                column,
                (tick - table[Q.TICK, column]) * self.dt + table[Q.OFFSET, column] - table[Q.PIECE_TIME, column],
            )
            for column in self._ended[:count].tolist()
        ]

    def watch(self, watch: Watch) -> None:
        """Tell somebody, once, when the setpoint of a column passes a position or comes to it."""
        self._watches.append(watch)

    def _look(self, before: list[float], tick: int) -> None:
        """Find the watches that were passed in the cycle that ends at `tick`."""
        table = self.table
        waiting, passed = [], []
        for watch, start in zip(self._watches, before, strict=True):
            column, position = watch.column, watch.position
            end = table[Q.SET_P, column]
            if not (start < position <= end or start > position >= end):
                waiting.append(watch)
                continue
            last = (tick - table[Q.TICK, column]) * self.dt + table[Q.OFFSET, column]
            time = passing_time(self.pieces, self.counts, column, last - self.dt, last, position)
            passed.append((watch, float(last - time)))
        self._watches = waiting
        for watch, early in passed:
            watch.tell(early)

    def forget_plans(self) -> None:
        """Clear what `taken_over` and `placed` have noted."""
        if self.taken_over or self.placed:
            self.taken_over.clear()
            self.placed.clear()

    def end_of(self, column: int) -> Floats:
        """Return the last piece of the profile that a column follows."""
        end: Floats = self.pieces[column, self.counts[column] - 1]
        return end

    def snapshot(self) -> "Snapshot":
        """Return copies of all tables."""
        return Snapshot(self.tick, self.table.copy(), self.pieces.copy(), self.counts.copy(), self.current.copy())

    def restore(self, snapshot: "Snapshot") -> None:
        """Put copies taken by `snapshot` back in place."""
        self.tick = snapshot.tick
        self.table[...] = snapshot.table
        self.pieces[...] = snapshot.pieces
        self.counts[...] = snapshot.counts
        self.current[...] = snapshot.current
        self.status_changed.clear()
        self.taken_over.clear()
        self.placed.clear()
        self._watches.clear()
