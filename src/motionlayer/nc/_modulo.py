"""Modulo positioning: from an orientation to a position (function-blocks 2.9).

The modulo position is a view of the absolute one: with the period P, s = turns·P + m, 0 <= m < P. A commanded position
t = k·P + r asks for the orientation r, and for k turns more. Targets are computed as a whole number of periods plus r,
so that they are exact wherever the axis stands.
"""

import math

from motionlayer.command import ErrorId
from motionlayer.nc._config import Direction, ModuloConfig
from motionlayer.nc._motion import Refusal


def target_from_rest(
    config: ModuloConfig, start: float, position: float, direction: Direction, heading: float
) -> float | Refusal:
    """Return the absolute target of an axis that rests at `start`, or will.

    Inside the tolerance window the nearest way is taken, also against the direction.

    Args:
        config: period and tolerance window.
        start: set position, u.
        position: commanded modulo position, u.
        direction: see `Direction`.
        heading: of the last motion, +1 or -1; for CURRENT.
    """
    refusal = _refusal(config, position, direction)
    if refusal is not None:
        return refusal
    period = config.period
    turns = math.floor(position / period)
    rest = position - turns * period
    base = math.floor(start / period)
    off = rest - (start - base * period)
    nearest = base + (1 if off < -0.5 * period else -1 if off >= 0.5 * period else 0)
    deviation = off + (nearest - base) * period
    sign = _sign(direction, heading)
    if direction is Direction.SHORTEST_WAY:
        return nearest * period + rest
    if abs(deviation) <= config.tolerance:
        return (nearest + sign * turns) * period + rest
    if sign > 0:
        return (base + (off < 0.0) + turns) * period + rest
    return (base - (off > 0.0) - turns) * period + rest


def target_in_motion(
    config: ModuloConfig, start: float, stop: float, position: float, direction: Direction, heading: float
) -> float | Refusal:
    """Return the absolute target of a moving axis: the next orientation that it reaches without turning back.

    Args:
        config: period and tolerance window.
        start: set position, u.
        stop: where the axis would come to rest at once, u.
        position: commanded modulo position, u.
        direction: see `Direction`.
        heading: of the motion, +1 or -1.
    """
    refusal = _refusal(config, position, direction)
    if refusal is not None:
        return refusal
    period = config.period
    rest = position - math.floor(position / period) * period
    wanted = _sign(direction, heading)
    if direction is Direction.SHORTEST_WAY:
        deviation = (rest - start + 0.5 * period) % period - 0.5 * period
        wanted = -1 if deviation < 0.0 else 1
    if wanted * heading < 0.0:
        return Refusal(ErrorId.REVERSAL_NOT_PERMITTED, f"the axis moves in direction {heading:+.0f}")
    count = (stop - rest) / period
    return (math.ceil(count) if heading > 0.0 else math.floor(count)) * period + rest


def _sign(direction: Direction, heading: float) -> int:
    if direction is Direction.CURRENT:
        return -1 if heading < 0.0 else 1
    return -1 if direction is Direction.NEGATIVE else 1


def _refusal(config: ModuloConfig, position: float, direction: Direction) -> Refusal | None:
    if direction is Direction.UNDEFINED:
        return Refusal(ErrorId.MODE_INVALID, "direction = UNDEFINED")
    if not math.isfinite(position):
        return Refusal(ErrorId.TARGET_NOT_FINITE, f"position = {position}")
    if position < 0.0:
        return Refusal(ErrorId.MODULO_TARGET, f"position = {position}, allowed: 0 and above")
    if direction is Direction.SHORTEST_WAY and position >= config.period:
        return Refusal(ErrorId.MODULO_TARGET, f"position = {position}, allowed on the shortest way: < {config.period}")
    return None
