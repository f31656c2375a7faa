"""From columns of a trace to what is told of it: axes, runs of states, key figures, plane, where it opens."""

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motionlayer.record._trace import Trace
from motionlayer.record.plot._reduce import Floats, Indices

STATES: Final = {
    1: "Disabled",
    2: "StandStill",
    3: "ErrorStop",
    4: "Stopping",
    5: "Homing",
    6: "DiscreteMotion",
    7: "ContinuousMotion",
    8: "SynchronizedMotion",
}
ERROR_STOP: Final = 3
HOMING: Final = 5
SHORT: Final = 15.0
"""A run up to so long is shown as a whole at first, s."""

OPENING_MOVES: Final = 8
"""Moves per axis in the stretch on which the charts open."""

REST_SPEED: Final = 1e-6
"""Share of the top speed below which a mover is taken to rest."""

REDEFINING: Final = ("set", "shift")
"""Kinds of plans that give a place another coordinate; nothing moves by them."""

MOVES: Final = ("position", "velocity")
"""Kinds of plans that lead somewhere."""

PLANES: Final = (("X", "Y"), ("X1", "Y1"))
"""Names of axes that span a plane; other names do not say how axes lie to one another."""

PLACE_SIZE: Final = 2e-3
"""Share of the extent of a path within which places of rest are counted as one."""


def axes_of(trace: Trace) -> dict[str, str]:
    """Return the axes of a trace in its order, with their unit of position ("" where not known)."""
    described = (trace.header.get("machine") or {}).get("axis", {})
    units: dict[str, str] = {}
    for signal in trace.signals:
        axis, _, kind = signal.name.rpartition(".")
        if axis:
            units.setdefault(axis, str(described.get(axis, {}).get("unit", "")))
        if kind == "set_position":
            units[axis] = signal.unit
    return units


def column(trace: Trace, axis: str, kind: str) -> Floats | None:
    """Return a signal of an axis, None if it was not recorded."""
    return trace.get(f"{axis}.{kind}")


class Run(NamedTuple):
    """A state that held from one time to another, s."""

    state: int
    start: float
    end: float


def state_runs(trace: Trace, axis: str, most: int) -> list[Run]:
    """Return the states of an axis in order; of more than `most`, states at so many equal distances."""
    states = column(trace, axis, "state")
    if states is None or not len(states):
        return []
    rows = np.concatenate([[0], np.union1d(np.flatnonzero(np.diff(states)), trace.jumps) + 1])
    if len(rows) > most:
        rows = np.unique(np.linspace(0, len(states) - 1, most).astype(np.intp))
    times = trace.time[rows]
    ends = trace.time[np.append(rows[1:] - 1, -1)] + trace.base_cycle
    return [Run(int(state), *span) for state, *span in zip(states[rows], times, ends, strict=True)]


def opening(trace: Trace) -> tuple[float, float]:
    """Return from when to when the charts show a trace at first, s: a few moves after homing, or all of a short run."""
    first, last = int(trace.ticks[0]), int(trace.ticks[-1])
    if (last - first) * trace.base_cycle <= SHORT:
        return first * trace.base_cycle, last * trace.base_cycle
    homed = max((_homed(trace, axis) for axis in axes_of(trace)), default=first)
    moves = sorted(plan.tick for plan in trace.plans if plan.kind in MOVES and plan.tick >= homed)
    count = OPENING_MOVES * len(axes_of(trace))
    if len(moves) > count and moves[count] - moves[0] < (last - first) / 2:
        margin = 0.01 * (moves[count] - moves[0])
        first, last = max(first, int(moves[0] - margin)), int(moves[count] + margin)
    return first * trace.base_cycle, last * trace.base_cycle


def _homed(trace: Trace, axis: str) -> int:
    """Return the tick at which an axis first left the state Homing, the first tick if it was never in it."""
    states = column(trace, axis, "state")
    left = np.empty(0) if states is None else np.flatnonzero((states[:-1] == HOMING) & (states[1:] != HOMING))
    return int(trace.ticks[left[0] + 1 if len(left) else 0])


class Peak(NamedTuple):
    """Greatest magnitude of a quantity, and its share of the limit it was made under (nan if unknown)."""

    value: float
    share: float


@dataclass(frozen=True)
class KeyFigures:
    """What an axis did; None where a signal was not recorded.

    Attributes:
        moves: commands that gave it a profile to a position or a velocity.
        travel: sum of the ways, u.
        span: least and greatest set position, u.
    """

    moves: int
    travel: float | None
    span: tuple[float, float] | None
    velocity: Peak | None
    acceleration: Peak | None
    deceleration: Peak | None
    jerk: Peak | None


def key_figures(trace: Trace, axis: str) -> KeyFigures:
    """Return the key figures of an axis of a trace that has rows."""
    p, v = column(trace, axis, "set_position"), column(trace, axis, "set_velocity")
    a = column(trace, axis, "set_acceleration")
    braking = None if a is None or v is None else v * a < 0.0
    moves = {plan.command for plan in trace.plans if plan.axis == axis and plan.kind in MOVES}
    return KeyFigures(
        moves=len(moves - {0}),
        travel=None if p is None else travel(trace, axis, p),
        span=None if p is None else (float(p.min()), float(p.max())),
        velocity=_peak(v, column(trace, axis, "max_velocity")),
        acceleration=_peak(_where(a, braking, wanted=False), column(trace, axis, "max_acceleration")),
        deceleration=_peak(_where(a, braking, wanted=True), column(trace, axis, "max_deceleration")),
        jerk=_peak(column(trace, axis, "set_jerk"), column(trace, axis, "max_jerk")),
    )


def _where(values: Floats | None, mask: NDArray[np.bool_] | None, *, wanted: bool) -> Floats | None:
    return None if values is None or mask is None else np.where(mask == wanted, values, 0.0)


def _peak(values: Floats | None, limit: Floats | None) -> Peak | None:
    if values is None:
        return None
    size = np.abs(values)
    row = int(size.argmax())
    # Values of a row come from the profile of the row before; a limit may have been lowered since.
    allowed = np.nan if limit is None else float(limit[max(row - 1, 0)])
    return Peak(float(size[row]), float(size[row]) / allowed if allowed > 0.0 else np.nan)


def plane_of(trace: Trace) -> tuple[str, str] | None:
    """Return the two axes of the plane: of equal unit, and with names that say so (`PLANES`); None without."""
    units = {axis: unit for axis, unit in axes_of(trace).items() if f"{axis}.set_position" in trace}
    pairs = ((x, y) for x, y in PLANES if x in units and y in units and units[x] == units[y])
    return next(pairs, None)


def redefined(trace: Trace, *axes: str) -> Indices:
    """Return the rows in which positions of one of the axes are in another coordinate than in the row before."""
    ticks = [plan.tick for plan in trace.plans if plan.axis in axes and plan.kind in REDEFINING]
    rows = np.flatnonzero(np.isin(trace.ticks, ticks))
    return rows[rows > 0]


def travel(trace: Trace, axis: str, p: Floats) -> float:
    """Return the sum of the ways of an axis, u; homing and the like move nothing."""
    ways = np.abs(np.diff(p))
    ways[redefined(trace, axis) - 1] = 0.0
    return float(ways.sum())


def moves(trace: Trace, axis: str) -> bool:
    """Tell whether an axis, whose set position was recorded, ever moves."""
    p = column(trace, axis, "set_position")
    return p is not None and travel(trace, axis, p) > 0.0


def speed_along(x: Floats, y: Floats, dt: float, jumps: Indices) -> Floats:
    """Return the speed of every row from the way to the row before, u/s; as before in the rows `jumps`."""
    if len(x) < 2:
        return np.zeros(len(x))
    way = np.sqrt(np.diff(x) ** 2 + np.diff(y) ** 2)
    way[jumps - 1] = way[np.maximum(jumps - 2, 0)]
    return np.append(way[0], way) / dt


def places_of_rest(x: Floats, y: Floats, speed: Floats) -> tuple[Floats, NDArray[np.int64]]:
    """Return where a path came to rest, shape (k, 2), and how often."""
    resting = speed <= REST_SPEED * speed.max(initial=0.0)
    begins = np.flatnonzero(resting & ~np.append(False, resting[:-1]))
    extent = max(np.ptp(x), np.ptp(y)) or 1.0
    points = np.column_stack([x, y])[begins]
    grid = np.rint(points / (extent * PLACE_SIZE)).astype(np.int64)
    _, first, counts = np.unique(grid, axis=0, return_index=True, return_counts=True)
    return points[first], counts.astype(np.int64)
