"""A file → its text → its tables; every way in which that fails, in one finding."""

import re
import tomllib
from pathlib import Path
from typing import Any, Final, NoReturn

from motionlayer.machine._errors import Finding, MachineError
from motionlayer.machine._locate import statement_start

_POSITION = re.compile(r"(?P<message>.*?) \(at (?:line (?P<line>\d+), column \d+|end of document)\)", re.DOTALL)
_COMMA = re.compile(r"[^#\"']*=\s*[-+]?\d+,\d")
DECIMAL_COMMA: Final = "numbers have a decimal point, and no separator but _"

_TWICE = ("Cannot declare", "Cannot overwrite", "Cannot mutate", "Duplicate inline table key")


def read_text(file: str) -> str:
    """Return the text of a machine file.

    Raises:
        MachineError: it cannot be read, or is not UTF-8.
    """
    try:
        content = Path(file).read_bytes()
    except FileNotFoundError:
        _refuse(file, "no such file")
    except IsADirectoryError:
        _refuse(file, "a folder, not a machine file")
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else None
        _refuse(file, f"cannot be read: {(reason or str(error)).lower()}")
    try:
        return content.decode("utf-8-sig")  # editors on Windows like to put a mark first
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        _refuse(file, "not UTF-8 text, as TOML must be", line, "save the file as UTF-8")


def parse(text: str, file: str) -> dict[str, Any]:
    """Return the top table of a TOML text.

    Raises:
        MachineError: it is not TOML; with the line.
    """
    try:
        return tomllib.loads(text)
    except RecursionError:
        _refuse(file, "not valid TOML: nested too deeply")
    except ValueError as error:  # TOMLDecodeError, and from int() for too many digits
        found = _POSITION.fullmatch(str(error))
        message = found["message"] if found else str(error)
        known = int(found["line"]) if found and found["line"] else None
        if message.startswith(_TWICE):
            line = statement_start(text, known or 1)
            _refuse(file, "this key or table is already defined above", line)
        # At the end of the text only the begin of what was never closed tells where to look.
        line = known or statement_start(text, text.count("\n") + 1)
        hint = DECIMAL_COMMA if _COMMA.match(_line(text, line)) else ""
        _refuse(file, f"not valid TOML: {message[:1].lower()}{message[1:]}", line, hint)


def _line(text: str, number: int) -> str:
    """Return a line of a text, from 1; "" where there is none."""
    return next(iter(text.splitlines()[number - 1 : number]), "")


def _refuse(file: str, problem: str, line: int | None = None, hint: str = "") -> NoReturn:
    raise MachineError([Finding(file, line, "", None, "", hint, problem)]) from None
