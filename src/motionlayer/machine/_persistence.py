"""Parameters that outlive a run: the file that `persistent_file` of the machine file names.

MC_WriteParameterPersistent and its like add to it; the next run writes them again, in the order in which they were
written, before its first program. They reach the run as an input, so that the trace holds them and a replay uses what
was recorded, whatever the file says by then. Who wants the machine file alone again deletes the file.

Writing is done in the call, in one piece (a new file takes the place of the old one). That may take milliseconds:
a block for putting into service, not for every cycle.
"""

import os
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Final, NamedTuple

from motionlayer.fb import AXIS_REF, PARAMETERS, MC_AxisParameter
from motionlayer.machine._errors import Finding, MachineError
from motionlayer.machine._problem import value_text
from motionlayer.runtime import Mailbox

CHANNEL: Final = "persistent_parameters"
"""The channel of the file's text."""

HEAD: Final = "# Written by MC_WriteParameterPersistent; delete the file to go back to the machine file.\n"


class Kept(NamedTuple):
    """What was in the file when the run was made.

    Attributes:
        file: which file.
        text: of the file.
        values: per axis and parameter.
    """

    file: Path
    text: str
    values: dict[str, dict[str, float]]


def load_kept(file: Path, names: Iterable[str]) -> Kept:
    """Read the file; there is nothing in one that does not exist.

    Raises:
        MachineError: it cannot be read, or holds something else than parameters of the axes with these names.
    """
    text = _read(file)
    return Kept(file, text, _checked(file, text, list(names)))


class Persistence:
    """The persistent parameters of a run.

    Args:
        kept: what the file holds.
        refs: returns the axes.
        mailbox: by which they reach the run.
    """

    def __init__(self, kept: Kept, refs: Callable[[], Mapping[str, AXIS_REF]], mailbox: Mailbox) -> None:
        self._file = kept.file
        self._values = kept.values
        self._refs = refs
        self._mailbox = mailbox
        mailbox.register(CHANNEL, self._apply)
        if kept.values:
            mailbox.post(CHANNEL, kept.text.encode())

    def keep(self, axis: str, name: str, value: float) -> str:
        """Add a parameter to the file; return why that was not possible, "" if it was."""
        if self._mailbox.deaf:  # a replay changes nothing outside
            return ""
        values = self._values.setdefault(axis, {})
        values.pop(name, None)  # of two numbers that mean the same, the one written last counts
        values[name] = value
        try:
            fresh = self._file.with_name(self._file.name + ".new")
            fresh.write_text(_text(self._values), encoding="utf-8")
            os.replace(fresh, self._file)  # noqa: PTH105 - the one that is atomic on every system
        except OSError as error:
            return f"{self._file.name} cannot be written: {error.strerror}"
        return ""

    def _apply(self, payload: bytes) -> None:
        """Write what the file says; what no longer fits the machine file is refused by the axis, with a message."""
        for axis, values in tomllib.loads(payload.decode()).items():
            ref = self._refs()[axis]
            for name, value in values.items():
                write = PARAMETERS[MC_AxisParameter[name]].write
                assert write is not None
                write(ref, name, value)


def _read(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8")
    except FileNotFoundError:
        return ""
    except (OSError, UnicodeDecodeError) as error:
        raise MachineError([_finding(file, "", None, "a readable text file", str(error))]) from error


def _checked(file: Path, text: str, names: Sequence[str]) -> dict[str, dict[str, float]]:
    """Return the values of a file.

    Raises:
        MachineError: one is none; names all of them.
    """
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise MachineError([_finding(file, "", None, "TOML", str(error))]) from error
    findings = [one for axis, values in data.items() for one in _problems(file, axis, values, names)]
    if findings:
        raise MachineError(findings)
    return data


def _problems(file: Path, axis: str, values: object, names: Sequence[str]) -> list[Finding]:
    if axis not in names or not isinstance(values, dict):
        return [_finding(file, axis, None, f"the table of an axis: {', '.join(names)}")]
    found = []
    for name, value in values.items():
        entry = PARAMETERS.get(MC_AxisParameter.__members__.get(name, 0))  # type: ignore[call-overload]
        if entry is None or entry.write is None:
            found.append(_finding(file, f"{axis}.{name}", None, "a parameter that can be written"))
        elif type(value) is not entry.kind:
            kind = "true or false" if entry.kind is bool else "a number with a decimal point"
            found.append(_finding(file, f"{axis}.{name}", value_text(value), kind))
    return found


def _finding(file: Path, field: str, value: str | None, allowed: str, hint: str = "") -> Finding:
    return Finding(str(file), None, field, value, allowed, hint)


def _text(values: Mapping[str, Mapping[str, float]]) -> str:
    lines = [HEAD]
    for axis, own in values.items():
        lines += [f"\n[{axis}]\n", *(f"{name} = {value_text(value)}\n" for name, value in own.items())]
    return "".join(lines)
