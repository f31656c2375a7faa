"""What clients write, made safe before anything is done with it (motion-layer 5.2; D16)."""

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, Final

from motionlayer.event import Level, Subdevice

if TYPE_CHECKING:
    from motionlayer.iec import InputArray
    from motionlayer.layer._axis_job import AxisJob
    from motionlayer.layer.types import MotionOptions, MoveData

SET_VALUES: Final = ("position", "velocity", "override", "acceleration", "deceleration", "jerk")
"""Numbers of `MoveData` that must be finite."""

PERCENT: Final = 100.0


def overwrite(array: "InputArray[Any]", index: int | None, **values: object) -> None:
    """Let the layer itself write an element that belongs to a client; whoever owns it is not asked."""
    element = array.value if index is None else array[index]
    changed = type(element).from_bytes(bytes(element))
    for name, value in values.items():
        setattr(changed, name, value)
    array.accept(index, bytes(changed))


def check_data(array: "InputArray[MoveData]", index: int, job: "AxisJob") -> None:
    """Take up new move data: what is not finite becomes 0.0, where the client sees it; the override holds at once.

    A position of 0.0 that stands for another is no target: the next command that would move there is refused.
    """
    data = array[index]
    wrong = [name for name in SET_VALUES if not math.isfinite(getattr(data, name))]
    job.no_target = "position" in wrong or (job.no_target and data.position == 0.0)
    _check(array, index, wrong, job)
    asked = array[index].override
    allowed = min(max(asked, 0.0), PERCENT)
    if asked != allowed:
        text = f"rOverride = {asked} %, allowed: 0 to 100; {allowed} holds"
        job.tell(Level.WARNING, Subdevice.AxisControl, text)
    if job.axis.override != allowed / PERCENT:
        job.axis.set_override(allowed / PERCENT)


def check_options(array: "InputArray[MotionOptions]", index: int, job: "AxisJob") -> None:
    """Take up new options in the same way."""
    if not math.isfinite(array[index].distance):
        _check(array, index, ["distance"], job)


def _check(array: "InputArray[Any]", index: int, wrong: Sequence[str], job: "AxisJob") -> None:
    if not wrong:
        return
    element = array[index]
    names = ", ".join(f"{name} = {getattr(element, attribute)}" for attribute, name in _declared(element, wrong))
    job.tell(Level.WARNING, Subdevice.AxisControl, f"{array.name}[{index}]: {names} is not finite; 0.0 holds")
    overwrite(array, index, **dict.fromkeys(wrong, 0.0))


def _declared(element: Any, attributes: Sequence[str]) -> Iterator[tuple[str, str]]:  # noqa: ANN401 - a structure
    """Return the attributes with their names on the interface."""
    names = {member.attribute: member.name for member in element.type.fields}
    return ((attribute, names[attribute]) for attribute in attributes)
