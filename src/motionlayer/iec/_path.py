"""Names of variables and their parts, as they are written: `GVL_AXIS.Ctrl[2].eCmd`, `Table[1, 0]`."""

import re
from typing import Final, TypeAlias

Step: TypeAlias = str | tuple[int, ...]
"""A name, or the indices of an element."""

_STEP: Final = re.compile(
    r"""\s*(?: (?P<dot>\.?)\s* (?P<name>[A-Za-z_]\w*) | \[ (?P<indices> \s*[-+]?\d+\s* (?: ,\s*[-+]?\d+\s* )* ) \] )""",
    re.ASCII | re.VERBOSE,
)


def split(text: str) -> list[Step]:
    """Return the steps of a name.

    Raises:
        ValueError: it is not written as one; the message says where.
    """
    steps: list[Step] = []
    at, end = 0, len(text.rstrip())
    while at < end or not steps:
        found = _STEP.match(text, at)
        if found is None or found["dot"] not in ({None, "."} if steps else {""}):
            raise ValueError(f"name {text!r}: cannot be read from {text[at:]!r} on; it is written as A.B[1].C")
        if found["name"] is not None:
            steps.append(found["name"])
        else:
            steps.append(tuple(int(one) for one in found["indices"].split(",")))
        at = found.end()
    return steps
