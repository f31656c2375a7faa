"""Override: what axes ask for is compared once per tick, and the motions it concerns are planned anew in one kernel.

A changed override costs no Python beyond the call that wrote it, so that it may change in every cycle on every axis.
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.profile import MAX_PIECES, plan
from motionlayer.store import JOB_COMPOUND, JOB_OTHER, JOB_POSITION, Q, Store, take_over

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

PLANNED: Final = 0
FAILED: Final = 1
"""The plan failed its check, and the old one goes on."""
COMPOUND: Final = 2
"""Its axis has to plan it."""


@kernel
def apply_overrides(
    table: Floats,
    pieces: Floats,
    counts: Integers,
    current: Integers,
    appended: Integers,
    out: Floats,
    scratch: Floats,
    tick: float,
    concerned: Integers,
) -> int:
    """Put requested overrides in force; return how many columns it concerns.

    `concerned` gets their numbers, and PLANNED, FAILED or COMPOUND.
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
        concerned[count, 0] = i
        if kind >= JOB_COMPOUND:
            concerned[count, 1] = COMPOUND
            count += 1
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
        concerned[count, 1] = FAILED
        if length > 0:
            concerned[count, 1] = PLANNED
            take_over(table, pieces, counts, current, appended, i, out, length, tick, 0.0)
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
        self._concerned = np.zeros((store.generators, 2), dtype=np.int64)

    def apply(self) -> list[tuple[int, bool]]:
        """Put what was requested in force; return the columns not planned here, and whether a plan of theirs failed."""
        store = self._store
        tables = store.table, store.pieces, store.counts, store.current, store.appended
        count = apply_overrides(*tables, self._out, self._scratch, float(store.tick), self._concerned)
        if not count:
            return []
        concerned = self._concerned[:count].tolist()
        store.taken_over.update(dict.fromkeys(column for column, how in concerned if how == PLANNED))
        return [(column, how == FAILED) for column, how in concerned if how != PLANNED]
