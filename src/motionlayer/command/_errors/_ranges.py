"""The ranges of error ids: what they concern, and what to do where an error has no advice of its own."""

from typing import Final, NamedTuple

from motionlayer.command._errors._axis import AXIS
from motionlayer.command._errors._blocks import BLOCKS
from motionlayer.command._errors._channel import CHANNEL
from motionlayer.command._errors._devices import DEVICES
from motionlayer.command._errors._extended import EXTENDED
from motionlayer.command._errors._general import GENERAL
from motionlayer.command._errors._group import GROUP
from motionlayer.command._errors._id import ErrorId
from motionlayer.command._errors._own import OWN
from motionlayer.command._errors._tables import TABLES
from motionlayer.command._errors._text import ErrorText


class ErrorRange(NamedTuple):
    """Neighbouring error ids that concern the same.

    Attributes:
        first: its lowest id.
        last: its highest id.
        title: what its errors concern.
        advice: of its errors that have none of their own.
    """

    first: int
    last: int
    title: str
    advice: str


RANGES: Final = (
    ErrorRange(0x4000, 0x40FF, "general", "see what the request names, and the ids in it"),
    ErrorRange(0x4100, 0x41FF, "channel and interpreter", "see the NC program, and the state of its channel"),
    ErrorRange(
        0x4200, 0x42FF, "group and set-point generation", "see the inputs of the command and what the axis does"
    ),
    ErrorRange(0x4300, 0x43FF, "axis", "see the parameters of the axis"),
    ErrorRange(0x4400, 0x44FF, "encoder", "see the parameters of the encoder; mend what it reports, then reset"),
    ErrorRange(0x4500, 0x45FF, "controller", "see the parameters of the position controller"),
    ErrorRange(0x4600, 0x46FF, "drive", "see the parameters of the drive; mend what it reports, then reset"),
    ErrorRange(0x4A00, 0x4AFF, "tables of cams", "see the table and the range of its master"),
    ErrorRange(0x4B00, 0x4BFF, "function blocks", "see the inputs of the block"),
    ErrorRange(0x4C00, 0x4CFF, "kinematics", "see the parameters of the transformation and the working space"),
    ErrorRange(0x8100, 0x811F, "Bode plot", "see the state of the axis that is measured"),
    ErrorRange(
        0x8120, 0x81FF, "groups, planar motion, tracks", "see the inputs of the command and the state of the object"
    ),
    ErrorRange(0xF000, 0xFFFF, "of motionlayer itself", "see the message"),
)
"""In ascending order, without overlap; every `ErrorId` lies in one."""


def range_of(error: int) -> ErrorRange | None:
    """Return the range that an error id lies in, None outside of all."""
    return next((one for one in RANGES if one.first <= error <= one.last), None)


def _advised() -> dict[ErrorId, ErrorText]:
    """Return all texts by id, each with advice."""
    texts = GENERAL | CHANNEL | GROUP | AXIS | DEVICES | TABLES | BLOCKS | EXTENDED | OWN
    advice = {error: one.advice for error in texts if (one := range_of(error)) is not None}
    return {error: text if text.advice else text._replace(advice=advice[error]) for error, text in texts.items()}


ERRORS: Final = _advised()
"""Text, advice and origin of every error, by id in ascending order."""
