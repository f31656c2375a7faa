"""Where an exception left a program, in words for its author."""

import sysconfig
import traceback
from pathlib import Path
from typing import Final

from motionlayer.runtime import Issuer, said

PACKAGE: Final = Path(__file__).resolve().parent.parent
STANDARD_LIBRARY: Final = sysconfig.get_path("stdlib")


def program_failure(program: Issuer) -> str:
    """Return what left a program, and from which line of its file."""
    failure = program.failure
    assert failure is not None
    text = said(failure)
    if isinstance(failure, SystemExit):
        text = f"sys.exit({failure.code}) was called; return instead"
    elif isinstance(failure, BrokenPipeError):
        text = "nobody reads what it writes any more, as behind `| head`"
    elif isinstance(failure, RuntimeError) and "no running event loop" in str(failure):
        text += "; asyncio does not work in a program: await run.sleep(seconds), run.until(predicate) or a command"
    return f"program {program.name}: {text}{place(failure)}"


def place(failure: BaseException | None) -> str:
    """Return ` (FILE:LINE in FUNCTION)` of the last line of the program; empty if there is none.

    Of code installed beside motionlayer only the first line counts: the program may be installed itself.
    """
    frames = traceback.extract_tb(failure.__traceback__) if failure is not None else []
    foreign = [frame for frame in frames if not _known(frame.filename)]
    own = [frame for frame in foreign if not _installed(frame.filename)]
    line = own[-1] if own else foreign[0] if foreign else None
    return f" ({line.filename}:{line.lineno} in {line.name})" if line is not None else ""


def _known(filename: str) -> bool:
    """Tell a line of motionlayer or of Python itself."""
    path = Path(filename)
    ours = filename.startswith("<") or path.is_relative_to(PACKAGE)
    return ours or (path.is_relative_to(STANDARD_LIBRARY) and not _installed(filename))


def _installed(filename: str) -> bool:
    return "site-packages" in Path(filename).parts
