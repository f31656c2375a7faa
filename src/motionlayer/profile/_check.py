"""The check that every profile passes before it is used: continuity, limits, end state."""

import math
from typing import Final

from motionlayer._kernel import kernel
from motionlayer.profile._kernels import Floats
from motionlayer.profile._tolerances import TOLERANCES

POSITION: Final = TOLERANCES.position
VELOCITY: Final = TOLERANCES.velocity
ACCELERATION: Final = TOLERANCES.acceleration
CLOCK: Final = TOLERANCES.clock

FINE: Final = 0
NOT_FINITE: Final = -1
TIME_RUNS_BACK: Final = -2
JUMP: Final = -3
JERK_LIMIT: Final = -4
VELOCITY_LIMIT: Final = -5
ACCELERATION_LIMIT: Final = -6
END_STATE: Final = -7
BAD_LIMITS: Final = -8

REASONS: Final = {
    NOT_FINITE: "a piece is not finite",
    TIME_RUNS_BACK: "the pieces are not in order of time",
    JUMP: "position, velocity or acceleration jumps between two pieces",
    JERK_LIMIT: "the jerk limit is exceeded",
    VELOCITY_LIMIT: "the velocity limit is exceeded",
    ACCELERATION_LIMIT: "the acceleration or deceleration limit is exceeded",
    END_STATE: "the end state is missed",
    BAD_LIMITS: "a limit is not finite and above zero",
}


@kernel
def is_limit(value: float) -> bool:
    """Tell whether a limit is finite and above zero; a comparison with NaN would pass every later test."""
    return 0.0 < value < math.inf


@kernel
def strays(piece: Floats, p: float, v: float, a: float, vel: float, acc: float) -> bool:
    """Tell whether a plan of one piece begins elsewhere than the start: it has no joint that would show it."""
    return bool(
        abs(piece[1] - p) > POSITION * (abs(piece[1]) + abs(p))
        or abs(piece[2] - v) > VELOCITY * vel
        or abs(piece[3] - a) > ACCELERATION * acc
    )


@kernel
def highest_speed(v: float, a: float, j: float, duration: float) -> float:
    """Return the largest |velocity| inside a piece."""
    highest = max(abs(v), abs(v + duration * (a + duration * (0.5 * j))))
    if j != 0.0:
        s = -a / j
        if 0.0 < s < duration:
            highest = max(highest, abs(v + 0.5 * s * a))
    return highest


@kernel
def misfit(piece: Floats, following: Floats, jerk: float, vel: float, acc: float, path: float) -> int:
    """Judge one piece and its joint to the following one.

    After a long cruise the clock itself is coarse: a duration is known to a few ulp of the time, not of itself.
    """
    duration = following[0] - piece[0]
    blur = CLOCK * following[0]
    if not duration > 0.0:
        return TIME_RUNS_BACK
    p, v, a, j = piece[1], piece[2], piece[3], piece[4]
    if abs(j) > jerk:
        return JERK_LIMIT
    end_p = p + duration * (v + duration * (0.5 * a + duration * (j / 6.0)))
    end_v = v + duration * (a + duration * (0.5 * j))
    end_a = a + duration * j
    if (
        abs(end_p - following[1]) > POSITION * (abs(p) + abs(end_p) + path) + blur * vel
        or abs(end_v - following[2]) > VELOCITY * vel + blur * acc
        or abs(end_a - following[3]) > ACCELERATION * acc + blur * jerk
    ):
        return JUMP
    return FINE


@kernel
def over_acceleration(piece: Floats, duration: float, acc: float, dec: float, vel: float) -> bool:
    """Tell whether a piece brakes harder than `dec` or accelerates harder than `acc` anywhere.

    |a| is largest at an end of the piece; where v changes sign inside, the middle of each part says which limit
    holds there. Velocities within tolerance of zero belong to both sides.
    """
    v, a, j = piece[2], piece[3], piece[4]
    blur = CLOCK * (piece[0] + duration)
    cuts = (0.0, duration)
    under = a * a - 2.0 * j * v
    if under >= 0.0:
        below = -a - math.sqrt(under) if a > 0.0 else -a + math.sqrt(under)
        if below != 0.0 and 0.0 < 2.0 * v / below < duration:
            cuts = (2.0 * v / below, duration)
    first = 0.0
    for cut in cuts:
        middle = 0.5 * (first + cut)
        speed = v + middle * (a + middle * (0.5 * j))
        pull = a + middle * j
        limit = max(acc, dec) if abs(speed) <= VELOCITY * vel else (acc if speed * pull > 0.0 else dec)
        if max(abs(a + first * j), abs(a + cut * j)) > limit * (1.0 + ACCELERATION) + blur * abs(j):
            return True
        first = cut
    return False


@kernel
def check(
    out: Floats, count: int, target: float, to_position: bool, vel: float, acc: float, dec: float, jerk: float
) -> int:
    """Return FINE or the first reason to refuse a plan.

    A start outside the limits raises them to what it cannot avoid at full jerk.
    """
    for k in range(count):
        for field in range(5):
            if not math.isfinite(out[k, field]):
                return NOT_FINITE
    v, a = out[0, 2], out[0, 3]
    vel = max(vel, abs(v), abs(v + 0.5 * a * abs(a) / jerk))
    if a * v < 0.0:  # |v| falls; at v = 0 the acceleration is still at least the root of a² - 2J|v|
        dec = max(dec, abs(a))
        acc = max(acc, math.sqrt(max(a * a - 2.0 * jerk * abs(v), 0.0)))
    else:
        acc = max(acc, abs(a))
    if not (vel < math.inf and acc < math.inf):  # squares that overflow would allow everything
        return NOT_FINITE
    path = 0.0
    for k in range(count - 1):
        duration = out[k + 1, 0] - out[k, 0]
        speed = highest_speed(out[k, 2], out[k, 3], out[k, 4], duration)
        if speed > vel * (1.0 + VELOCITY):
            return VELOCITY_LIMIT
        path += speed * duration
        fault = misfit(out[k], out[k + 1], jerk, vel, max(acc, dec), path)
        if fault != FINE:
            return fault
        if over_acceleration(out[k], duration, acc, dec, vel):
            return ACCELERATION_LIMIT
    end = out[count - 1]
    missed = end[1] != target or end[2] != 0.0 if to_position else end[2] != target
    return END_STATE if missed or end[3] != 0.0 or end[4] != 0.0 else FINE
