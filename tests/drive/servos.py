"""A servo drive alone in a store, and motions to feed it."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from motionlayer.drive import Servo, ServoDrives
from motionlayer.store import Q, Store

DT = 0.001
Motion = Callable[[float], tuple[float, float]]


def drives(*servos: Servo, start: float = 0.0, seed: int = 0) -> tuple[Store, ServoDrives]:
    """Return servo drives without power, at `start`."""
    store = Store(len(servos), dt=DT, max_pieces=4)
    store.table[[Q.SET_P, Q.ACTUAL_P]] = start
    return store, ServoDrives(store, range(len(servos)), servos, seed)


def run(store: Store, stage: ServoDrives, motion: Motion, ticks: Sequence[int]) -> NDArray[np.float64]:
    """Feed p, v of a motion at the time of each tick; return actual position, lag, readiness, status of every tick."""
    rows = []
    for tick in ticks:
        store.table[Q.SET_P], store.table[Q.SET_V] = motion(tick * DT)
        stage.inputs(tick)
        rows.append(store.table[[Q.ACTUAL_P, Q.LAG, Q.READY, Q.STATUS], 0])
    return np.array(rows)


def powered(servo: Servo, *, start: float = 0.0, seed: int = 0) -> tuple[Store, ServoDrives]:
    """Return a drive with power, after tick 1."""
    store, stage = drives(servo, start=start, seed=seed)
    store.table[Q.ENABLE] = 1.0
    run(store, stage, lambda _: (start, 0.0), range(2))
    assert store.table[Q.READY, 0] == 1.0
    return store, stage
