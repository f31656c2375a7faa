"""`Problem`: a finding before file and line are known, and how keys and values are written in messages."""

import json
import re
from dataclasses import dataclass
from typing import TypeAlias

KeyPath: TypeAlias = tuple[str | int, ...]
"""Where a value stands: keys of tables and indices of arrays, from the top; `()` is the whole description."""

_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
_VALUE_WIDTH = 60
_HUGE = 10**_VALUE_WIDTH


@dataclass(frozen=True, slots=True)
class Problem:
    """A finding by its key path; the attributes are those of `Finding`."""

    path: KeyPath
    value: str | None = None
    allowed: str = ""
    hint: str = ""
    problem: str = ""


def field_text(path: KeyPath) -> str:
    """Write a key path as TOML does, indices in brackets: `trace.signals[0]`."""
    text = ""
    for key in path:
        if isinstance(key, int):
            text += f"[{key}]"
        else:
            text += f".{_key_text(key)}" if text else _key_text(key)
    return text


def value_text(value: object) -> str:
    """Write a value as TOML does, on one line and cut to a readable length."""
    if isinstance(value, bool):
        text = "true" if value else "false"
    elif isinstance(value, str):
        text = _quoted(value)
    elif isinstance(value, list | tuple):
        # Cut before writing: a client may hand over an array of any length.
        text = "[" + ", ".join(value_text(item) for item in value[:_VALUE_WIDTH]) + "]"
    elif isinstance(value, dict):
        text = "{…}" if value else "{}"
    elif isinstance(value, int) and not -_HUGE < value < _HUGE:
        # Python refuses to write integers of more than some thousand digits.
        text = "a huge integer"
    else:
        text = str(value) if isinstance(value, int | float) else ascii(value)
    return text if len(text) <= _VALUE_WIDTH else text[: _VALUE_WIDTH - 1] + "…"


def _key_text(key: str) -> str:
    return key if _BARE_KEY.fullmatch(key) else _quoted(key)


def _quoted(text: str) -> str:
    # Control characters must not reach a terminal.
    return json.dumps(text, ensure_ascii=not text.isprintable())
