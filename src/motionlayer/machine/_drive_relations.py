"""What spans several tables about drives: the loop against the base cycle, groups and faults against the axes.

Like `_relations`, the checks read the data as it came.
"""

import difflib
import math
from collections.abc import Iterable, Iterator, Mapping

from motionlayer.machine._data import number, table
from motionlayer.machine._drive_description import MOST_CYCLES, DriveDescription
from motionlayer.machine._problem import KeyPath, Problem, value_text

ONE_BY_ONE = 1e-6
"""Largest distance of a time from whole base cycles, in cycles, that is taken for a rounding error."""


def drive_problems(data: object) -> Iterator[Problem]:
    """Yield what is wrong between drives, groups, faults and the rest."""
    axes = table(data, "axis")
    cycle = number(data, "base_cycle_ns")
    dt = (1_000_000.0 if cycle is None else cycle) * 1e-9
    for name, axis in axes.items():
        yield from _loop_problems(("axis", name, "drive"), table(axis, "drive"), dt)
    for name, group in table(data, "group").items():
        members = group.get("axes") if isinstance(group, dict) else None
        for index, member in enumerate(members if isinstance(members, list | tuple) else []):
            yield from _axis_problems(("group", name, "axes", index), member, axes)
    faults = data.get("fault") if isinstance(data, dict) else None
    for index, fault in enumerate(faults if isinstance(faults, list | tuple) else []):
        if isinstance(fault, dict):
            yield from _fault_problems(("fault", index), fault, axes)


def highest_gain(dt: float, time_constant: float) -> float:
    """Return the gain of a servo's position loop at which it does not settle any more, 1/s.

    Of the loop with e = exp(-dt/T) the determinant is e - Kv (e dt - T (1 - e)) and the trace
    1 + e - Kv (dt - T (1 - e)); it settles while |determinant| < 1 and 1 + trace + determinant > 0.
    """
    e = math.exp(-dt / time_constant) if time_constant > 0.0 else 0.0
    rise = -math.expm1(-dt / time_constant) if time_constant > 0.0 else 1.0
    swings = time_constant * rise - e * dt
    flips = (1.0 + e) * dt - 2.0 * time_constant * rise
    return min(rise / swings if swings > 0.0 else math.inf, 2.0 * (1.0 + e) / flips if flips > 0.0 else math.inf)


def _loop_problems(path: KeyPath, drive: dict[str, object], dt: float) -> Iterator[Problem]:
    if drive.get("kind", "ideal") == "ideal":
        for key in drive:
            if key != "kind" and key in DriveDescription.model_fields:
                yield Problem((*path, key), problem="an ideal drive has no such thing", hint='set kind = "servo"')
        return
    dead, gain, constant = (number(drive, key) for key in ("dead_time", "position_gain", "time_constant"))
    for key in ("dead_time", "ready_delay"):
        time = number(drive, key)
        if time is not None and time > MOST_CYCLES * dt * (1.0 + ONE_BY_ONE):
            yield Problem(
                (*path, key), value_text(time), f"at most {MOST_CYCLES} base cycles = {MOST_CYCLES * dt:g} (s)"
            )
            return
    if dead is not None and dead > 0.0 and abs(dead / dt - round(dead / dt)) > ONE_BY_ONE:
        allowed = f"a whole number of base cycles of {dt:g} s (s)"
        yield Problem((*path, "dead_time"), value_text(dead), allowed)
    highest = highest_gain(dt, max(constant or 0.0, 0.0)) if dt > 0.0 else math.inf
    if gain is not None and gain >= highest:
        allowed = (
            f"less than {highest:.4g}, where the loop becomes unstable with this time constant and base cycle (1/s)"
        )
        yield Problem((*path, "position_gain"), value_text(gain), allowed)


def _axis_problems(path: KeyPath, name: object, axes: Iterable[str]) -> Iterator[Problem]:
    names = list(axes)
    if isinstance(name, str) and name not in names:
        near = difflib.get_close_matches(name, names, n=1)
        hint = f"did you mean {near[0]}?" if near else f"axes: {', '.join(names)}"
        yield Problem(path, value_text(name), problem="no such axis", hint=hint)


def _fault_problems(path: KeyPath, fault: Mapping[str, object], axes: Mapping[str, object]) -> Iterator[Problem]:
    name, kind = fault.get("axis"), fault.get("kind")
    yield from _axis_problems((*path, "axis"), name, axes)
    if isinstance(name, str) and name in axes and table(axes[name], "drive").get("kind", "ideal") == "ideal":
        problem = "its drive is ideal, and never has a fault"
        yield Problem((*path, "axis"), value_text(name), problem=problem, hint='set kind = "servo" there')
    if ("tick" in fault) == ("time" in fault):
        yield Problem(
            path, problem="one of tick and time says when it begins" if "tick" in fault else "no tick or time"
        )
    jump = kind == "encoder_jump"
    if jump and "value" not in fault:
        yield Problem((*path, "value"), problem="missing", hint="how far the encoder jumps")
    if not jump and "value" in fault:
        yield Problem((*path, "value"), problem="only an encoder_jump takes one")
    if jump and "duration" in fault:
        yield Problem((*path, "duration"), problem="an encoder_jump takes none, it stays")
