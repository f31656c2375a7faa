"""Units in messages: models say u, a person reads the unit of the axis that is meant."""

import re
from dataclasses import replace
from typing import Final

from motionlayer.machine._axis_description import AxisDescription
from motionlayer.machine._data import table
from motionlayer.machine._problem import KeyPath, Problem

_U: Final = re.compile(r"(?<=\()u(?=[/)])")
"""The u of `(u)` and `(u/s)`."""


def in_units(problem: Problem, data: object) -> Problem:
    """Return a problem in the unit of its axis, where that is known.

    Args:
        problem: one of a flat description.
        data: that description, not yet checked.
    """
    unit = _unit(problem.path, data)
    if unit is None:
        return problem
    allowed, hint, text = (_U.sub(lambda _: unit, one) for one in (problem.allowed, problem.hint, problem.problem))
    return replace(problem, allowed=allowed, hint=hint, problem=text)


def _unit(path: KeyPath, data: object) -> str | None:
    """Return the unit of what stands at a path; None if it belongs to no axis, or to one with a wrong unit."""
    axes = table(data, "axis")
    match path:
        case ("axis", str(name), *_) if name in axes:
            axis = axes[name]
        case ("fault", int(index), *_):
            faults = data.get("fault") if isinstance(data, dict) else None
            fault = faults[index] if isinstance(faults, list | tuple) and index < len(faults) else None
            axis = axes.get(fault["axis"]) if isinstance(fault, dict) and isinstance(fault.get("axis"), str) else None
        case _:
            return None
    if not isinstance(axis, dict):
        return None
    unit = axis.get("unit", AxisDescription.model_fields["unit"].default)
    return unit if isinstance(unit, str) and unit.isprintable() and unit else None
