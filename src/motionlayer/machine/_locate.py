"""Where a key stands in a TOML text. tomllib gives values without lines.

A TOML statement (a table header, or a key with its value) ends with a line, and no beginning of a statement
that spans several lines is itself valid: its string or array is still open. So the text falls into statements
by letting a group of lines grow until tomllib accepts it, and tomllib itself tells the keys of each. That is
slower than a parser, but knows all of TOML, and it only runs when there is something to complain about.
"""

import tomllib
from collections.abc import Iterator, Mapping

from motionlayer.machine._problem import KeyPath


def locate(text: str) -> dict[KeyPath, int]:
    """Map every key path of a valid TOML text to the line (from 1) of the statement that defines it.

    A table that has a header is found at its header, any other where one of its keys is first seen.
    """
    lines: dict[KeyPath, int] = {(): 1}
    lengths: dict[KeyPath, int] = {}
    table: KeyPath = ()
    for line, statement in _statements(text):
        content = tomllib.loads(statement)
        if statement.lstrip().startswith("["):
            table = _entered(content, lengths)
            for end in range(1, len(table)):
                lines.setdefault(table[:end], line)
            lines[table] = line
        else:
            for path in _paths(content, table):
                lines.setdefault(path, line)
    return lines


def line_of(path: KeyPath, lines: Mapping[KeyPath, int]) -> int | None:
    """Return the line of a key, or of the innermost table around it that is in the text."""
    for end in range(len(path), -1, -1):
        if path[:end] in lines:
            return lines[path[:end]]
    return None


def statement_start(text: str, line: int) -> int:
    """Return the first line of the statement that covers `line`; the text need not be valid TOML."""
    return max(start for start, _ in _statements(text) if start <= line)


def _statements(text: str) -> Iterator[tuple[int, str]]:
    """Yield first line and text of each statement; what never becomes valid comes last, in one piece."""
    group, start = "", 1
    # Not splitlines(): it also splits at characters that are no line ends in TOML.
    for number, line in enumerate(text.split("\n"), start=1):
        group += line + "\n"
        if _is_valid(group):
            yield start, group
            group, start = "", number + 1
    if group:
        yield start, group


def _is_valid(text: str) -> bool:
    try:
        tomllib.loads(text)
    except (ValueError, RecursionError):
        return False
    return True


def _entered(header: dict[str, object], lengths: dict[KeyPath, int]) -> KeyPath:
    """Return the path of the table a header opens; `lengths` counts the arrays of tables seen so far."""
    path: KeyPath = ()
    node: object = header
    while isinstance(node, dict) and node:
        ((key, node),) = node.items()
        path = (*path, key)
        if isinstance(node, list):
            lengths[path] = lengths.get(path, 0) + 1
        if path in lengths:
            path = (*path, lengths[path] - 1)
    return path


def _paths(node: object, path: KeyPath) -> Iterator[KeyPath]:
    """Yield the paths of everything inside a value that stands at `path`."""
    items: Iterator[tuple[str | int, object]] = iter(())
    if isinstance(node, dict):
        items = iter(node.items())
    elif isinstance(node, list):
        items = enumerate(node)
    for key, value in items:
        yield (*path, key)
        yield from _paths(value, (*path, key))
