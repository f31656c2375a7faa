"""What left a program, in words."""

import difflib
import traceback
from pathlib import Path
from typing import Final

from motionlayer.command import CommandAborted, CommandError

PACKAGE: Final = str(Path(__file__).parent.parent)


def said(failure: BaseException) -> str:
    """Return what an exception says, with the attribute that was meant where there is none of that name."""
    if isinstance(failure, CommandError | CommandAborted):
        return str(failure)
    near = _near(failure) if isinstance(failure, AttributeError) else ""
    return f"{type(failure).__name__}: {failure}" + (f"; did you mean {near}?" if near else "")


def describe(failure: BaseException) -> str:
    """Return an exception in one line, with the way through the program to the place where it left."""
    frames = traceback.extract_tb(failure.__traceback__)
    own = [frame for frame in frames if not frame.filename.startswith(PACKAGE)]
    # The name alone: the text reaches the hash of the run, which must not depend on where a file lies.
    way = " > ".join(f"{Path(frame.filename).name}:{frame.lineno} in {frame.name}" for frame in own[-3:])
    return said(failure) + (f" ({way})" if way else "")


def _near(failure: AttributeError) -> str:
    """Return the public attribute nearest to one that was asked for; "" where none is near."""
    if not failure.name or failure.obj is None:
        return ""
    try:
        known = [name for name in dir(failure.obj) if not name.startswith("_")]
    except Exception:  # noqa: BLE001 - the user's own class may have any `__dir__`
        return ""
    return next(iter(difflib.get_close_matches(failure.name, known, n=1)), "")
