"""Numbers that are no error of an axis, but that a client sees where it looks for one: ADS codes and states."""

from typing import Final

LEAST_STATE: Final = 100
"""Below it a number is a command without progress, which nobody takes for an error."""


def ads_code(number: int) -> str:
    """Return what an ADS return code means; "" if it is none."""
    from motionlayer.connect.ads import MEANINGS  # noqa: PLC0415 - help does without it

    meaning = MEANINGS.get(number)
    if meaning is None:
        return ""
    return f"0x{number:04X} ({number}) ADS return code: {meaning.text}\n  what to do   {meaning.advice}"


def state(number: int) -> str:
    """Return what a number means as the state of an axis; "" if it is none."""
    from motionlayer.layer import Progress, split  # noqa: PLC0415 - help does without it
    from motionlayer.layer.types import E_AXIS_CTRL, AxisCommand  # noqa: PLC0415

    command, progress = split(number)
    if number < LEAST_STATE or not isinstance(command, AxisCommand) or not isinstance(progress, Progress):
        return ""
    name = E_AXIS_CTRL.iec_name(command)
    ends = {
        Progress.ERROR: (f"{name} failed", "read nErrorId, and explain that number"),
        Progress.NOT_EXIST: (f"{name} is not built", "see docs/layer.md for the commands that are"),
        Progress.DONE: (f"{name} is done", "nothing"),
    }
    text, advice = ends.get(
        progress, (f"{name} is under way", "wait; docs/layer-states.md has the steps of each command")
    )
    return f"{number} is a state and no error: {name} + PROGRESS_{progress.name}: {text}\n  what to do   {advice}"
