"""`motionlayer error`."""

import difflib
from typing import TYPE_CHECKING

import click

from motionlayer.cli._exit import say

if TYPE_CHECKING:
    from motionlayer.command import ErrorId


@click.command(short_help="Explain errors by their id or name.")
@click.argument("errors", nargs=-1, required=True, metavar="ID...")
def error(errors: tuple[str, ...]) -> None:
    """Explain what each ID means, what to do about it and what answers with it.

    An ID is hexadecimal (0x4225), decimal (16933) or a name (BUFFER_FULL).
    """
    known = [_known(text) for text in errors]
    say("\n\n".join(_explained(one) for one in known))


def _known(text: str) -> "ErrorId":
    """Return the error that a text names.

    Raises:
        click.BadParameter: there is none; names the nearest one.
    """
    from motionlayer.command import ERRORS, ErrorId  # noqa: PLC0415 - help does without it

    name = text.upper().replace("-", "_")
    if name in ErrorId.__members__:
        return ErrorId[name]
    try:
        number = int(text, 0)
    except ValueError:
        near = difflib.get_close_matches(name, ErrorId.__members__, n=1)
        hint = f"did you mean {near[0]}?" if near else "give 0x4225, 16933 or a name; docs/errors.md lists all"
        raise click.BadParameter(f"{text!r} is no error: {hint}") from None
    if number in ERRORS:
        return ErrorId(number)
    raise click.BadParameter(f"{text} is no error: did you mean {_nearest(text, number)}?")


def _nearest(text: str, number: int) -> str:
    """Return the error that was probably meant by a number: the same digits in hexadecimal, or the closest one."""
    from motionlayer.command import ERRORS, ErrorId  # noqa: PLC0415

    if text.isdecimal() and int(text, 16) in ERRORS:
        return f"0x{text}, {ErrorId(int(text, 16)).name}"
    near = min(ErrorId, key=lambda one: abs(one - number))
    return f"0x{near:04X}, {near.name}"


def _explained(one: "ErrorId") -> str:
    from motionlayer.command import ERRORS, range_of  # noqa: PLC0415

    text, advice, raised = ERRORS[one]
    kin = range_of(one)
    assert kin is not None
    lines = [
        f"0x{one:04X} ({one:d}) {one.name}: {text}",
        f"  what to do   {advice}",
        f"  answered by  {raised or 'nothing in this version; listed to explain other controllers'}",
        f"  range        {kin.title}, 0x{kin.first:04X} to 0x{kin.last:04X}",
    ]
    return "\n".join(lines)
