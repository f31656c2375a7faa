"""What an axis follows, as the record that a trace keeps of it."""

import math
from typing import TYPE_CHECKING

import numpy as np

from motionlayer.nc import Axis
from motionlayer.profile import Limits
from motionlayer.record import Plan
from motionlayer.store import JOB_BRAKE, JOB_OTHER, Q, Store

if TYPE_CHECKING:
    from motionlayer.record._records import PlanKind


def redefinition(axis: Axis, tick: int, position: float) -> Plan:
    """Return the record of a position that was redefined."""
    pieces = np.array([[0.0, position, 0.0, 0.0, 0.0]])
    return Plan(axis.name, tick, 0.0, 0, "set", position, *axis.config.maximum, pieces)


def shift(axis: Axis, column: int, tick: int, store: Store) -> Plan:
    """Return the record of a position that was redefined in motion: the setpoint of this tick."""
    p, v, a = store.table[Q.SET_P : Q.SET_A + 1, column].tolist()
    pieces = np.array([[0.0, p, v, a, 0.0]])
    limits = Limits(*store.table[Q.MAX_V : Q.MAX_J + 1, column].tolist())
    return Plan(axis.name, tick, 0.0, int(store.table[Q.COMMAND, column]), "shift", p, *limits, pieces)


def followed(axis: Axis, column: int, store: Store) -> Plan:
    """Return the record of the profile that an axis follows.

    Where it leads is read off its end: an endless motion ends at a position where a software limit is ahead, and at
    rest anywhere where the override holds it; what goes on with an appended profile passes its end.
    """
    table, end = store.table, store.end_of(column)
    kind: PlanKind = "position" if end[2] == 0.0 else "passing" if store.appended[column] else "velocity"
    target = float(end[2] if kind == "velocity" else end[1])
    if table[Q.JOB_KIND, column] in (JOB_OTHER, JOB_BRAKE) or table[Q.OVERRIDE, column] == 0.0:
        kind, target = "stop", math.nan
    return Plan(
        axis=axis.name,
        tick=int(table[Q.TICK, column]),
        offset=float(table[Q.OFFSET, column]),
        command=int(table[Q.COMMAND, column]),
        kind=kind,
        target=target,
        velocity=float(table[Q.MAX_V, column]),
        acceleration=float(table[Q.MAX_A, column]),
        deceleration=float(table[Q.MAX_D, column]),
        jerk=float(table[Q.MAX_J, column]),
        pieces=store.pieces[column, : store.counts[column]],
    )
