"""`Axes`: what a run has of each axis, by name."""

import difflib
from typing import NoReturn, TypeVar

V = TypeVar("V")


class Axes(dict[str, V]):
    """The axes of a machine, or their interfaces, by name."""

    def __missing__(self, name: str) -> NoReturn:
        near = difflib.get_close_matches(name, self, n=1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise KeyError(f"no axis {name!r}; this machine has {', '.join(self) or 'none'}{hint}")
