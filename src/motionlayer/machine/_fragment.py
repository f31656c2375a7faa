"""`Fragment`: one file as it was read. `Flat`: tables put together from several, and where each was written."""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from motionlayer.machine._errors import Finding
from motionlayer.machine._locate import line_of, locate
from motionlayer.machine._problem import KeyPath, Problem, field_text, value_text


@dataclass(frozen=True)
class Fragment:
    """A machine file or a module of one, as it was read.

    Attributes:
        file: as messages name it; None for data that came from no file.
        data: its top table.
        text: what the lines are found in; empty for data.
        included: the places that led to it, the nearest first, each like `cell.toml:12 as "S1_"`; empty for the
            machine file itself.
        prefix: what names that it defines begin with in the machine.
    """

    file: str | None
    data: dict[str, Any]
    text: str = ""
    included: tuple[str, ...] = ()
    prefix: str = ""

    @property
    def chain(self) -> tuple[str, ...]:
        """The places that led to it in one text, as `Finding.included` holds it."""
        return (" from ".join(self.included),) if self.included else ()

    @property
    def folder(self) -> Path:
        """What paths in it start from."""
        return Path(self.file or "").parent

    @cached_property
    def lines(self) -> dict[KeyPath, int]:
        """Line of every key; found when something is to be said about one."""
        return locate(self.text) if self.text else {}


class Origin(NamedTuple):
    """Where something was written."""

    fragment: Fragment
    path: KeyPath

    @property
    def place(self) -> str:
        """The place as messages name it: `station.toml:12`, or the key where there is no file."""
        line = line_of(self.path, self.fragment.lines)
        if self.fragment.file is None:
            return field_text(self.path)
        return self.fragment.file if line is None else f"{self.fragment.file}:{line}"

    def finding(self, problem: Problem) -> Finding:
        """Return what is wrong here, in the words of the file that it was written in."""
        value = problem.value
        if value is not None and self.fragment.included:
            value = _written(self, value)
        return Finding(
            file=self.fragment.file,
            line=line_of(self.path, self.fragment.lines),
            field=field_text(self.path),
            value=value,
            allowed=problem.allowed,
            hint=problem.hint.replace(f"did you mean {self.fragment.prefix}", "did you mean "),
            problem=problem.problem,
            included=self.fragment.chain,
        )


def _written(origin: Origin, value: str) -> str:
    """Return a value as the module has it: names in it have no prefix there."""
    node: Any = origin.fragment.data
    for key in origin.path:
        try:
            node = node[key]
        except (KeyError, IndexError, TypeError):  # a default
            return value
    return value_text(node)


@dataclass
class Flat:
    """Tables whose modules have been put in.

    Attributes:
        data: the top table.
        origins: where a part of it was written, by its path; what lies below a path was written below its origin.
    """

    data: dict[str, Any]
    origins: dict[KeyPath, Origin]

    def origin(self, path: KeyPath) -> Origin:
        """Return where the value at a path was written, or would have been."""
        for end in range(len(path), -1, -1):
            if path[:end] in self.origins:
                fragment, base = self.origins[path[:end]]
                return Origin(fragment, (*base, *path[end:]))
        raise AssertionError("the root has an origin")


@dataclass
class Report:
    """What has been found so far.

    Attributes:
        findings: problems.
        warnings: what is accepted for now.
        unread: a module, or a section of one, could not be read; what follows from its absence is not worth a word.
    """

    findings: list[Finding] = field(default_factory=list)
    warnings: list[Finding] = field(default_factory=list)
    unread: bool = False


def in_order(findings: Iterable[Finding], first: str | None) -> list[Finding]:
    """Return findings by file and line, the file `first` before modules; one for all inclusions of a module."""
    files: dict[str | None, int] = {first: 0}
    once: dict[Finding, tuple[str, ...]] = {}
    for one in findings:
        files.setdefault(one.file, len(files))
        bare = replace(one, included=())
        once[bare] = tuple(dict.fromkeys((*once.get(bare, ()), *one.included)))
    merged = [replace(one, included=included) for one, included in once.items()]
    return sorted(merged, key=lambda one: (files[one.file], one.line or 0))
