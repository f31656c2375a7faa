"""Reading a description that has not been checked yet."""

import math


def table(data: object, key: str) -> dict[str, object]:
    """Return a table of a table, without what is wrong in it; an empty one where there is none."""
    value = data.get(key) if isinstance(data, dict) else None
    if not isinstance(value, dict):
        return {}
    return {name: item for name, item in value.items() if isinstance(name, str)}


def number(data: object, key: str) -> float | None:
    """Return a number the models accept as one, or None."""
    value = data.get(key) if isinstance(data, dict) else None
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    try:
        number = float(value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None
