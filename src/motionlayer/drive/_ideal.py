"""The ideal drive: it stands where it should, in the same tick; its lag is exactly zero.

All ideal drives of a machine are one kernel call. Ready follows the request with the next tick. A drive without power
stays where it is.
"""

import math
from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.drive._switch import ReferenceSwitch, changed_at, is_on
from motionlayer.store import Q, Store

SET_P: Final = Q.SET_P
SET_V: Final = Q.SET_V
ACTUAL_P: Final = Q.ACTUAL_P
SHIFT: Final = Q.SHIFT
ENABLE: Final = Q.ENABLE
READY: Final = Q.READY
HOME_INPUT: Final = Q.HOME_INPUT
HOME_LATCH: Final = Q.HOME_LATCH


@kernel
def _inputs(
    table: NDArray[np.float64],
    columns: NDArray[np.int64],
    edges: NDArray[np.float64],
    sides: NDArray[np.float64],
    widths: NDArray[np.float64],
    changed: NDArray[np.int64],
) -> int:
    count = 0
    for k in range(columns.shape[0]):
        i = columns[k]
        if table[READY, i] != 0.0:
            table[ACTUAL_P, i] = table[SET_P, i]
        new = 0
        if table[READY, i] != table[ENABLE, i]:
            table[READY, i] = table[ENABLE, i]
            new = 1
        d = sides[k] * (table[ACTUAL_P, i] - table[SHIFT, i] - edges[k])
        on = is_on(d, widths[k])
        if on != table[HOME_INPUT, i]:
            table[HOME_INPUT, i] = on
            table[HOME_LATCH, i] = edges[k] + sides[k] * changed_at(d, widths[k], sides[k] * table[SET_V, i])
            new = 1
        if new != 0:
            changed[count] = i
            count += 1
    return count


class IdealDrives:
    """All ideal drives of a machine.

    Args:
        store: setpoints are read and actual values written here.
        columns: the coordinates they move.
        switches: one per column, None without a switch.
    """

    def __init__(self, store: Store, columns: Sequence[int], switches: Sequence[ReferenceSwitch | None]) -> None:
        self._store = store
        self._columns = np.array(columns, dtype=np.int64)
        self._edges = np.array([math.inf if s is None else s.position for s in switches])
        self._sides = np.array([1.0 if s is None else s.side for s in switches])
        self._widths = np.array([math.inf if s is None else s.width for s in switches])
        self._changed = np.zeros(len(columns), dtype=np.int64)
        self._read()
        store.status_changed.clear()

    def inputs(self, _tick: int) -> None:
        """Write actual values, readiness and inputs of this tick."""
        self._read()

    def _read(self) -> None:
        switches = self._edges, self._sides, self._widths
        count = _inputs(self._store.table, self._columns, *switches, self._changed)
        if count:
            self._store.status_changed.extend(self._changed[:count].tolist())
