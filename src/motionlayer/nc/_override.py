"""Override: what axes ask for is compared once per tick, and the motions it concerns are planned anew in one kernel.

A changed override costs no Python beyond the call that wrote it, so that it may change in every cycle on every axis.
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.profile import MAX_PIECES, plan
from motionlayer.store import JOB_OTHER, JOB_POSITION, Q, Store, take_over

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

STEPS: Final = 1_000_000
"""Steps of an override from 0 to 1, as `PlcToNc.Override` counts them."""

SET_P: Final = Q.SET_P
SET_V: Final = Q.SET_V
SET_A: Final = Q.SET_A
MAX_V: Final = Q.MAX_V
MAX_A: Final = Q.MAX_A
MAX_D: Final = Q.MAX_D
MAX_J: Final = Q.MAX_J
OVERRIDE: Final = Q.OVERRIDE
REQUEST: Final = Q.REQUEST
JOB_KIND: Final = Q.JOB_KIND
JOB_TARGET: Final = Q.JOB_TARGET
JOB_V: Final = Q.JOB_V


@kernel
def apply_overrides(
    table: Floats,
    pieces: Floats,
    counts: Integers,
    current: Integers,
    out: Floats,
    scratch: Floats,
    tick: float,
    planned: Integers,
) -> int:
    """Put requested overrides in force; return how many columns were planned anew.

    `planned` gets their numbers; -1 - column where the plan failed its check and the old one goes on.
    """
    count = 0
    for i in range(counts.shape[0]):
        factor = table[REQUEST, i]
        if factor == table[OVERRIDE, i]:
            continue
        table[OVERRIDE, i] = factor
        kind = table[JOB_KIND, i]
        if kind == JOB_OTHER:
            continue
        vel = table[JOB_V, i] * (factor if factor > 0.0 else 1.0)
        target = table[JOB_TARGET, i]
        to_position = factor > 0.0 and kind == JOB_POSITION
        if factor == 0.0:
            target = 0.0
        elif not to_position:
            target = math.copysign(vel, target)
        acc, dec, jerk = table[MAX_A, i], table[MAX_D, i], table[MAX_J, i]
        p, v, a = table[SET_P, i], table[SET_V, i], table[SET_A, i]
        length, _, _ = plan(out, scratch, p, v, a, target, to_position, vel, acc, dec, jerk)
        planned[count] = i
        if length < 0:
            planned[count] = -1 - i
        else:
            take_over(table, pieces, counts, current, i, out, length, tick, 0.0)
            table[MAX_V, i] = vel
        count += 1
    return count


class Overrides:
    """The override of all axes.

    Args:
        store: where they are requested and put in force.
    """

    def __init__(self, store: Store) -> None:
        self._store = store
        self._out = np.zeros((MAX_PIECES, 5))
        self._scratch = np.zeros((MAX_PIECES, 5))
        self._planned = np.zeros(store.generators, dtype=np.int64)

    def apply(self) -> list[int]:
        """Put what was requested in force; return the columns whose plan failed."""
        store = self._store
        tables = store.table, store.pieces, store.counts, store.current
        count = apply_overrides(*tables, self._out, self._scratch, float(store.tick), self._planned)
        if not count:
            return []
        columns = self._planned[:count].tolist()
        store.taken_over.update(dict.fromkeys(column for column in columns if column >= 0))
        return [-1 - column for column in columns if column < 0]
