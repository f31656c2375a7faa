"""Our own, from 0xF000 on: what the NC has no id for."""

from typing import Final

from motionlayer.command._errors._id import ErrorId as E
from motionlayer.command._errors._text import ErrorText

OWN: Final = {
    E.PROGRAM_FAILED: ErrorText("a program failed", "see the exception that left it", "programs"),
    E.COMMAND_NOT_DONE: ErrorText(
        "a command of the motion layer has not come to DONE",
        "see its state in the message",
        "`state.done()`, where the state holds no number of this list",
    ),
}
