"""What can be damaged in a valid trace so that `verify` must find it: one operator per kind of record.

Each draws a place and a change whose effect nobody could call legal. Left out is what is equally true: a state that
the axis could as well be in while it rests, a plan that says again what the one before it said, a command that moves
nothing and is never heard of again.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motionlayer.event import Event, Kind, Level
from motionlayer.record import Plan, Trace
from motionlayer.verify import tolerance

SIGNALS: Final = (
    "set_position", "set_velocity", "set_acceleration", "set_jerk", "actual_position", "max_velocity",
    "max_acceleration", "max_deceleration", "max_jerk", "software_limit_min", "software_limit_max",
)  # fmt: skip

LEAST, MOST = 1.0, 6.0
"""Decades of the change of a sample, in its tolerances; 10 itself is not promised."""

LIMITS: Final = ("velocity", "acceleration", "deceleration", "jerk")
STATES: Final = range(1, 9)
ERRORSTOP: Final = 3.0
SHARE: Final = 1e-3
"""Change of a number of a piece: share of what the limits of the axis do in a cycle."""


class Damage(NamedTuple):
    """A damaged trace.

    Attributes:
        text: what was done to it.
        trace: the result.
        axis: where it must be found.
        tick: at which tick it must be found; None for any.
    """

    text: str
    trace: Trace
    axis: str
    tick: int | None = None


def _changed(trace: Trace, name: str, row: int, value: float) -> Trace:
    values = trace[name].copy()
    values[row] = value
    return trace.replace({name: values})


def pick(rng: np.random.Generator, rows: Sequence[int] | NDArray[np.int64]) -> int | None:
    """Draw one of some numbers; None if there is none."""
    return int(rows[int(rng.integers(0, len(rows)))]) if len(rows) else None


def axes_of(trace: Trace) -> Mapping[str, Any]:
    """Return the axes of the machine of a trace."""
    axes: Mapping[str, Any] = trace.header["machine"]["axis"]
    return axes


def sample(rng: np.random.Generator, trace: Trace) -> Damage:
    """Change a sample by 10 to 1e6 of its tolerances; one in ten is the first or the last."""
    name = str(rng.choice([name for name in trace if _judged(trace, name)]))
    edge = rng.random() < 0.1
    row = (0, len(trace.ticks) - 1)[rng.integers(0, 2)] if edge else int(rng.integers(0, len(trace.ticks)))
    factor = float(1.001 * 10.0 ** rng.uniform(LEAST, MOST) * rng.choice([-1.0, 1.0]))
    return resample(trace, name, row, factor)


def resample(trace: Trace, name: str, row: int, factor: float) -> Damage:
    """Change a sample by `factor` of its tolerances."""
    value = float(trace[name][row] + factor * tolerance(trace, name)[row])
    text = f"{name} in row {row}: {factor:.6g} tolerances, from {trace[name][row]!r} to {value!r}"
    return Damage(text, _changed(trace, name, row, value), name.rpartition(".")[0], int(trace.ticks[row]))


def _judged(trace: Trace, name: str) -> bool:
    """Tell whether a signal has a tolerance: a drive that lags has its own actual position, no limit has no edge."""
    axis, _, signal = name.rpartition(".")
    if signal == "actual_position" and axes_of(trace)[axis]["drive"]["kind"] != "ideal":
        return False
    return signal in SIGNALS and bool(np.isfinite(trace[name]).all())


def state(rng: np.random.Generator, trace: Trace) -> Damage | None:
    """Give an axis that moves another state in one row."""
    axis = str(rng.choice(list(axes_of(trace))))
    name, v = f"{axis}.state", trace[f"{axis}.set_velocity"]
    row = pick(rng, np.flatnonzero((v[1:-1] != 0.0) & (v[2:] != 0.0)) + 1)
    if row is None:
        return None
    other = float(rng.choice([number for number in STATES if number != trace[name][row]]))
    text = f"{name} in row {row}: from {trace[name][row]:g} to {other:g}"
    return Damage(text, _changed(trace, name, row, other), axis)


def power(rng: np.random.Generator, trace: Trace) -> Damage | None:
    """Turn the request for power, or its answer, over in one row, away from errors and commands."""
    axis, signal = str(rng.choice(list(axes_of(trace)))), str(rng.choice(["enable", "ready"]))
    told = [event.tick for event in trace.events if event.source == axis]
    quiet = ~np.isin(trace.ticks, told) & (trace[f"{axis}.state"] != ERRORSTOP)
    row = pick(rng, np.flatnonzero(quiet[:-2] & quiet[1:-1] & quiet[2:]) + 1)
    if row is None:
        return None
    name = f"{axis}.{signal}"
    return Damage(f"{name} in row {row} turned over", _changed(trace, name, row, 1.0 - trace[name][row]), axis)


def override(rng: np.random.Generator, trace: Trace) -> Damage | None:
    """Change the override in one row while a motion that it scales is under way."""
    axis = str(rng.choice(list(axes_of(trace))))
    name, plans = f"{axis}.override", [plan for plan in trace.plans if plan.axis == axis]
    ends = {event.command: event.tick for event in trace.events if event.kind != Kind.ACCEPTED}
    last, spans = len(trace.ticks) - 1, []
    for plan, after in zip(plans, [*(plan.tick for plan in plans[1:]), last], strict=True):
        if plan.kind in ("position", "velocity") and plan.command:
            spans += list(range(plan.tick + 1, min(after, ends.get(plan.command, last), last)))
    row = pick(rng, spans)
    if row is None:
        return None
    other = float(rng.uniform(0.0, 1.0))
    return Damage(f"{name} in row {row}: {other!r}", _changed(trace, name, row, other), axis)


def copied(trace: Trace, **attributes: tuple[Any, ...]) -> Trace:
    """Return a trace with other plans or events."""
    other = trace.replace({})
    other.__dict__.update(attributes)
    return other


def plan_limit(rng: np.random.Generator, trace: Trace) -> Damage:
    """Change a limit of a plan by a share of 1e-12 to 1."""
    index, field = int(rng.integers(0, len(trace.plans))), str(rng.choice(LIMITS))
    factor = 1.0 + float(rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-12.0, -0.5))
    plan = trace.plans[index]
    return replanned(trace, index, f"{field} times {factor!r}", replace(plan, **{field: factor * getattr(plan, field)}))


def replanned(trace: Trace, index: int, text: str, plan: Plan) -> Damage:
    """Return the damage that another plan does in the place of one."""
    plans = (*trace.plans[:index], plan, *trace.plans[index + 1 :])
    return Damage(f"plan {index} of {plan.axis}, tick {plan.tick}: {text}", copied(trace, plans=plans), plan.axis)


def _moving(trace: Trace) -> list[int]:
    return [index for index, plan in enumerate(trace.plans) if len(plan.pieces) > 1]


def plan_piece(rng: np.random.Generator, trace: Trace) -> Damage | None:
    """Change a number of a piece that lasts: its time, p, v, a or jerk."""
    index = pick(rng, _moving(trace))
    if index is None:
        return None
    plan, dt = trace.plans[index], trace.base_cycle
    pieces, column = plan.pieces.copy(), int(rng.integers(0, 5))
    lasting = np.flatnonzero(np.append(np.diff(pieces[:, 0]), np.inf) > 1e-2 * dt)
    lasting = (
        lasting[(lasting == 0) | np.append(False, np.diff(pieces[:, 4]) != 0.0)[lasting]] if not column else lasting
    )
    row = pick(rng, lasting)
    if row is None:
        return None
    axis = axes_of(trace)[plan.axis]
    v, a, j = axis["max_velocity"], axis["max_acceleration"], axis["max_jerk"]
    step = float(rng.choice([-1.0, 1.0])) * SHARE * (dt, v * dt, min(v, a * dt), min(a, j * dt), j)[column]
    pieces[row, column] += step
    return replanned(trace, index, f"piece {row}, column {column}: {step:+.6g}", replace(plan, pieces=pieces))


def plan_place(rng: np.random.Generator, trace: Trace) -> Damage | None:
    """Move a plan that moves the axis by a tick, give it another target, or another command."""
    index = pick(rng, _moving(trace))
    if index is None:
        return None
    plan, sign = trace.plans[index], int(rng.choice([-1, 1]))
    what = str(rng.choice(["tick", "target", "command"]))
    if what == "tick":
        return replanned(trace, index, f"tick {sign:+d}", replace(plan, tick=plan.tick + sign))
    if what == "target" and plan.kind != "stop":
        target = plan.target + sign * SHARE * axes_of(trace)[plan.axis]["max_velocity"]
        return replanned(trace, index, f"target {target!r}", replace(plan, target=target))
    return replanned(trace, index, f"command {plan.command + 1000}", replace(plan, command=plan.command + 1000))


def plan_dropped(rng: np.random.Generator, trace: Trace) -> Damage | None:
    """Leave out the first plan of a command that moves the axis."""
    seen: set[int] = {0}
    first = []
    for index, plan in enumerate(trace.plans):
        if plan.command not in seen and len(plan.pieces) > 1:
            first.append(index)
        seen.add(plan.command)
    chosen = pick(rng, first)
    if chosen is None:
        return None
    plan = trace.plans[chosen]
    text = f"plan {chosen} of {plan.axis}, tick {plan.tick}: left out"
    return Damage(text, copied(trace, plans=(*trace.plans[:chosen], *trace.plans[chosen + 1 :])), plan.axis)


def event(rng: np.random.Generator, trace: Trace) -> Damage | None:
    """Leave out an event of a command that moves an axis, or of an error, or give the event another kind."""
    moving = {plan.command for plan in trace.plans if len(plan.pieces) > 1} - {0}
    index = pick(rng, [k for k in range(len(trace.events)) if _telling(trace, k, moving)])
    if index is None:
        return None
    told = trace.events[index]
    without = (*trace.events[:index], *trace.events[index + 1 :])
    if told.kind == Kind.MESSAGE or rng.random() < 0.5:
        return Damage(f"left out: {told}", copied(trace, events=without), told.source)
    unlike = [told.kind, Kind.MESSAGE]
    if told.kind == Kind.ERROR and trace[f"{told.source}.set_velocity"][told.tick] == 0.0:
        unlike.append(Kind.DONE)  # what rests may be done in the tick of an error
    kinds = [kind for kind in Kind if kind not in unlike]
    other = told._replace(kind=Kind(str(rng.choice(kinds))))
    events = (*trace.events[:index], other, *trace.events[index + 1 :])
    return Damage(f"{other.kind} instead of {told}", copied(trace, events=events), told.source)


def _telling(trace: Trace, index: int, moving: set[int]) -> bool:
    """Tell whether an event is the only one that tells what the samples show."""
    told: Event = trace.events[index]
    if told.source not in axes_of(trace) or told.tick >= trace.ticks[-1]:
        return False
    if told.kind == Kind.MESSAGE:
        if told.level != Level.ERROR or trace[f"{told.source}.state"][max(told.tick - 1, 0)] == ERRORSTOP:
            return False
        near = [one for one in trace.events if one.kind == Kind.MESSAGE and one.source == told.source]
        return sum(abs(one.tick - told.tick) <= 1 for one in near) == 1
    return told.command in moving


OPERATORS: Final[Mapping[Callable[[np.random.Generator, Trace], Damage | None], int]] = {
    sample: 6, state: 2, power: 1, override: 1, plan_limit: 2, plan_piece: 3, plan_place: 2, plan_dropped: 1, event: 2,
}  # fmt: skip
"""Operators, and how often they come; one that finds no place leaves it to `sample`."""
