"""`Finding`, `MachineError`, `OldName`: what is wrong with a machine description, in words for a person."""

import textwrap
from collections.abc import Iterable
from dataclasses import dataclass

_LINE_WIDTH = 110
_SHORT_HINT = 60
_INDENT = "    "


@dataclass(frozen=True, slots=True)
class Finding:
    """One problem of a machine description.

    `str()` gives one line, with a long hint on lines below:
    `machine.toml:12: axis.X.max_velocity = -5.0: must be greater than 0 (u/s)`.

    Attributes:
        file: the file as it was named by the caller; None for data that came from no file.
        line: line in the file, from 1; None without a file or where no line is meant.
        field: key path as TOML writes it (`axis.X.max_velocity`); empty for the file as a whole.
        value: the value found, as TOML writes it, shortened if long; None where there is none.
        allowed: what is allowed, going on from "must be"; may be empty.
        hint: how to mend it; may be empty.
        problem: what is wrong where `allowed` alone does not say it ("missing", "unknown key"); may be empty.
        included: of a module, the places that include it, each like `cell.toml:12 as "S1_"`; empty for the machine
            file itself.
    """

    file: str | None
    line: int | None
    field: str
    value: str | None
    allowed: str
    hint: str = ""
    problem: str = ""
    included: tuple[str, ...] = ()

    def __str__(self) -> str:
        place = [] if self.file is None else [self.file if self.line is None else f"{self.file}:{self.line}"]
        subject = [f"{self.field} = {self.value}" if self.value is not None else self.field] if self.field else []
        verdict = "; ".join(part for part in (self.problem, self.allowed and f"must be {self.allowed}") if part)
        text = ": ".join([*place, *subject, verdict])
        places = [f"{_INDENT}included at {one}" for one in self.included]
        # Not by the length of the line: the same finding reads the same, however long the path of the file.
        if len(self.hint) <= _SHORT_HINT:
            return "\n".join([f"{text}; {self.hint}" if self.hint else text, *places])
        lines = textwrap.wrap(
            self.hint, _LINE_WIDTH, initial_indent=_INDENT, subsequent_indent=_INDENT, break_long_words=False
        )
        return "\n".join([text, *lines, *places])


class MachineError(ValueError):
    """A machine description cannot be used; `str()` names every problem, one block each.

    Attributes:
        findings: all problems, in the order of the file; never empty.
    """

    def __init__(self, findings: Iterable[Finding]) -> None:
        self.findings = tuple(findings)
        super().__init__(self.findings)

    def __str__(self) -> str:
        return "\n".join(str(finding) for finding in self.findings)


class OldName(FutureWarning):
    """A machine file uses a name that the next version does not read; the text says where, and the new name."""
