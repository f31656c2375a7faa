"""`motionlayer error`."""

import difflib
from typing import TYPE_CHECKING, Final

import click

from motionlayer.cli._exit import say
from motionlayer.cli._numbers import ads_code, state

if TYPE_CHECKING:
    from motionlayer.command import ErrorId

NEAR: Final = 8
"""Numbers that are no further apart may have been mistaken for one another."""

WAY_OUT: Final = "give 0x4225, 16933 or a name; docs/errors.md lists all"


@click.command(short_help="Explain errors, ADS return codes and states.")
@click.argument("errors", nargs=-1, required=True, metavar="ID...")
def error(errors: tuple[str, ...]) -> None:
    """Explain what each ID means, what to do about it and what answers with it.

    An ID is hexadecimal (0x4225), decimal (16933) or a name (BUFFER_FULL). ADS return codes (0x745) and states of the
    motion layer (9012) are explained, too.
    """
    say("\n\n".join([_explanation(text) for text in errors]))


def _explanation(text: str) -> str:
    """Return what an error, an ADS return code or a state means.

    Raises:
        click.BadParameter: there is none; names the nearest one.
    """
    from motionlayer.command import ERRORS, ErrorId  # noqa: PLC0415 - help does without it

    name = text.upper().replace("-", "_")
    if name in ErrorId.__members__:
        return _explained(ErrorId[name])
    try:
        number = int(text, 0)
    except ValueError:
        near = difflib.get_close_matches(name, ErrorId.__members__, n=1)
        hint = f"did you mean {near[0]}?" if near else WAY_OUT
        raise click.BadParameter(f"{text!r} is no error: {hint}") from None
    if number in ERRORS:
        return _explained(ErrorId(number))
    told = ads_code(number) or state(number)
    if not told:
        raise click.BadParameter(f"{text} is no error: {_meant(text, number)}")
    return told


def _meant(text: str, number: int) -> str:
    """Return which error was probably meant by a number: the same digits in hexadecimal, or one close by."""
    from motionlayer.command import ERRORS, ErrorId  # noqa: PLC0415

    if text.isdecimal() and int(text, 16) in ERRORS:
        return f"did you mean 0x{text}, {ErrorId(int(text, 16)).name}?"
    near = min(ErrorId, key=lambda one: abs(one - number))
    return f"did you mean 0x{near:04X}, {near.name}?" if abs(near - number) <= NEAR else WAY_OUT


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
