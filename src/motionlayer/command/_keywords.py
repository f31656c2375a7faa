"""Keywords that a TypedDict declares once for several calls, which take them as `**keywords: Unpack[...]`.

So editors and type checkers know every one of them; Python itself would take any name.
"""

import difflib
from collections.abc import Mapping
from typing import Any


def only_known(called: str, declared: type, given: Mapping[str, Any]) -> None:
    """Take no keyword that a TypedDict does not declare.

    Args:
        called: for the message.
        declared: the TypedDict.
        given: what the caller wrote.

    Raises:
        TypeError: there is no such keyword.
    """
    known = declared.__annotations__
    for name in given:
        if name not in known:
            near = difflib.get_close_matches(name, known, n=1)
            hint = f"did you mean {near[0]}?" if near else f"it takes {', '.join(known)}"
            raise TypeError(f"{called}() takes no keyword {name}; {hint}")
