"""Where an orientation is: the positions that a modulo move may lead to (function-blocks 2.9)."""

import math
from collections.abc import Mapping
from typing import Final

from motionlayer.verify._requests import Request

FULL_TURN: Final = {"period": 360.0, "tolerance": 0.0}
"""The modulo view of an axis whose description has none."""


def ahead(rest: float, asked: Request, modulo: Mapping[str, float]) -> list[float]:
    """Return the first places at or behind `rest` with the orientation asked for, in the directions it allows."""
    period, direction = modulo["period"], asked.values.get("direction", "")
    orientation = asked.number("position") - math.floor(asked.number("position") / period) * period
    count = (rest - orientation) / period
    blur = 1e-9 * (1.0 + abs(count))
    up = {math.ceil(count - blur), math.ceil(count + blur)} if direction != "NEGATIVE" else set()
    down = {math.floor(count - blur), math.floor(count + blur)} if direction != "POSITIVE" else set()
    return [one * period + orientation for one in sorted(up | down)]


def orientations(here: float, asked: Request, modulo: Mapping[str, float]) -> list[float]:
    """Return the places near `here` with the orientation asked for that its direction allows to go to."""
    period, position, direction = modulo["period"], asked.number("position"), asked.values.get("direction", "")
    turns = math.floor(position / period)
    rest = position - turns * period
    nearest = math.floor((here - rest) / period + 0.5)
    signs = {"POSITIVE": (1,), "NEGATIVE": (-1,), "SHORTEST_WAY": (0,)}.get(direction, (1, -1))
    counts = (nearest + sign * turns + one for sign in signs for one in (-1, 0, 1))
    places = [count * period + rest for count in counts]
    return [place for place in places if _in_reach(place - here, direction, turns * period, modulo)]


def _in_reach(way: float, direction: str, turns: float, modulo: Mapping[str, float]) -> bool:
    """Tell whether the way of a modulo move from rest is one that its direction allows."""
    period, window = modulo["period"], modulo["tolerance"]
    blur = 1e-9 * (period + abs(way))
    if direction == "SHORTEST_WAY":
        return abs(way) <= 0.5 * period + blur
    forward = -window - blur <= way - turns <= period + blur
    backward = -window - blur <= -way - turns <= period + blur
    return (forward and direction != "NEGATIVE") or (backward and direction != "POSITIVE")
