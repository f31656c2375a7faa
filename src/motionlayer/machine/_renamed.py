"""Keys of the machine file that have got another name.

An old name is read for one version more, with a warning; then its row goes. A rename does not need a new `format`:
that number changes when the meaning of a file does.
"""

import copy
from collections.abc import Iterator, Sequence
from typing import Any, Final, NamedTuple

from motionlayer.machine._errors import Finding
from motionlayer.machine._fragment import Flat, Fragment, Origin, Report
from motionlayer.machine._problem import KeyPath, Problem, field_text


class Rename(NamedTuple):
    """A key that moved.

    Attributes:
        old: its path before; "*" stands for any name, or any place in a list.
        new: its path now, with as many "*", filled in order.
        since: version that brought the new name; the one after it does not read the old one any more.
    """

    old: KeyPath
    new: KeyPath
    since: str


RENAMED: Final[Sequence[Rename]] = ()


def modern(fragment: Fragment, report: Report) -> Flat:
    """Return the tables of a file with today's names."""
    flat = Flat(fragment.data, {(): Origin(fragment, ())})
    for rename in RENAMED:
        for old in list(_matches(flat.data, rename.old)):
            if flat.data is fragment.data:
                flat.data = copy.deepcopy(fragment.data)
            new, origin = _filled(rename, old), Origin(fragment, old)
            if _moved(flat.data, old, new):
                flat.origins[new] = origin
                report.warnings.append(warning(origin, new, rename))
            else:
                problem = f"called {field_text(new)} since {rename.since}, which is there too"
                report.findings.append(origin.finding(Problem(old, problem=problem, hint="leave this one out")))
    return flat


def modern_path(path: KeyPath) -> tuple[KeyPath, Rename | None]:
    """Return the path that a key, or a table around it, has today, and the rename if there was one."""
    for rename in RENAMED:
        end = len(rename.old)
        if len(path) >= end and all(a in ("*", b) for a, b in zip(rename.old, path, strict=False)):
            return (*_filled(rename, path[:end]), *path[end:]), rename
    return path, None


def warning(origin: Origin, new: KeyPath, rename: Rename) -> Finding:
    """Return what is said about an old name."""
    problem = f"called {field_text(new)} since {rename.since}"
    return origin.finding(Problem(origin.path, problem=problem, hint="the next version does not read the old name"))


def _matches(node: Any, pattern: KeyPath, path: KeyPath = ()) -> Iterator[KeyPath]:  # noqa: ANN401 - unchecked
    """Yield every path in unchecked tables that a pattern means."""
    if not pattern:
        yield path
        return
    items: list[tuple[Any, Any]] = []
    if isinstance(node, dict):
        items = [(key, value) for key, value in node.items() if pattern[0] in ("*", key)]
    elif isinstance(node, list | tuple) and pattern[0] == "*":
        items = list(enumerate(node))
    for key, value in items:
        yield from _matches(value, pattern[1:], (*path, key))


def _filled(rename: Rename, old: KeyPath) -> KeyPath:
    """Return the new path, with what the stars of the old one stand for."""
    stars = (key for key, wanted in zip(old, rename.old, strict=True) if wanted == "*")
    return tuple(next(stars) if key == "*" else key for key in rename.new)


def _moved(data: dict[str, Any], old: KeyPath, new: KeyPath) -> bool:
    """Move a value; return False, with nothing but the old one taken out, if the new place is taken."""
    source: Any = data
    for key in old[:-1]:
        source = source[key]
    value = source.pop(old[-1])
    target: Any = data
    for key in new[:-1]:
        target = target.setdefault(key, {}) if isinstance(target, dict) else target[key]
    if not isinstance(target, dict) or new[-1] in target:
        return False
    target[new[-1]] = value
    return True
