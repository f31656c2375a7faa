"""The check that every profile passes before it is used: continuity, limits, end state."""

import math
from typing import Final

from motionlayer._kernel import kernel
from motionlayer.profile._kernels import Floats, turns
from motionlayer.profile._meet import OUT_OF_REACH
from motionlayer.profile._tolerances import RANGES, TOLERANCES

POSITION: Final = TOLERANCES.position
VELOCITY: Final = TOLERANCES.velocity
ACCELERATION: Final = TOLERANCES.acceleration
ROUNDING: Final = TOLERANCES.rounding
CLOCK: Final = TOLERANCES.clock
LONGEST: Final = RANGES.duration
FINENESS: Final = RANGES.fineness

FINE: Final = 0
NOT_FINITE: Final = -1
TIME_RUNS_BACK: Final = -2
JUMP: Final = -3
JERK_LIMIT: Final = -4
VELOCITY_LIMIT: Final = -5
ACCELERATION_LIMIT: Final = -6
END_STATE: Final = -7
BAD_LIMITS: Final = -8
TOO_EARLY: Final = -10

REASONS: Final = {
    NOT_FINITE: "a piece is not finite",
    TIME_RUNS_BACK: "the pieces are not in order of time",
    JUMP: "position, velocity or acceleration jumps between two pieces",
    JERK_LIMIT: "the jerk limit is exceeded",
    VELOCITY_LIMIT: "the velocity limit is exceeded",
    ACCELERATION_LIMIT: "the acceleration or deceleration limit is exceeded",
    END_STATE: "the end state is missed",
    BAD_LIMITS: "a limit is not finite and above zero",
    OUT_OF_REACH: "the target is as fast as the velocity limit and stays out of reach",
    TOO_EARLY: "the target cannot be met as early",
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
def sizes(out: Floats, count: int) -> tuple[float, float, float]:
    """Return what the joints of a plan are measured by: its path, its largest |velocity| and |acceleration|.

    The path is the sum over its pieces of the largest |velocity| times the duration.
    """
    path, peak, pull = 0.0, abs(out[count - 1, 2]), abs(out[count - 1, 3])
    for k in range(count - 1):
        duration = out[k + 1, 0] - out[k, 0]
        highest = highest_speed(out[k, 2], out[k, 3], out[k, 4], duration)
        path += highest * duration
        peak, pull = max(peak, highest), max(pull, abs(out[k, 3]))
    return path, peak, pull


@kernel
def misfit(piece: Floats, following: Floats, jerk: float, path: float, peak: float, pull: float, blur: float) -> int:
    """Judge one piece and its joint to the following one, by the `sizes` of the plan.

    After a long cruise the clock itself is coarse: a duration is known to a few ulp of the time, not of itself.
    """
    duration = following[0] - piece[0]
    if not duration > 0.0:
        return TIME_RUNS_BACK
    p, v, a, j = piece[1], piece[2], piece[3], piece[4]
    if abs(j) > jerk:
        return JERK_LIMIT
    end_p = p + duration * (v + duration * (0.5 * a + duration * (j / 6.0)))
    end_v = v + duration * (a + duration * (0.5 * j))
    end_a = a + duration * j
    far = max(abs(p), abs(end_p))
    if (
        abs(end_p - following[1]) > POSITION * path + ROUNDING * far + blur * peak
        or abs(end_v - following[2]) > VELOCITY * peak + blur * pull
        or abs(end_a - following[3]) > ACCELERATION * pull + blur * abs(j)
    ):
        return JUMP
    return FINE


@kernel
def time_back(v: float, a: float, vel: float, dec: float, jerk: float) -> float:
    """Return how long |v| stays above `vel` on the fastest way to `vel` with a = 0; 0 for a start inside.

    A start is outside as well if its acceleration, brought to zero at full jerk, carries it outside.
    """
    reached = v + 0.5 * a * abs(a) / jerk
    if abs(reached) <= vel:
        return abs(a) / jerk if abs(v) > vel else 0.0
    s = 1.0 if reached > 0.0 else -1.0
    pull = -s * a
    time = 0.0
    excess = s * v - vel
    if pull < 0.0:
        time = -pull / jerk
        excess = s * reached - vel
        pull = 0.0
    peak = max(min(math.sqrt(jerk * excess + 0.5 * pull * pull), dec), 0.0)
    time += abs(peak - pull) / jerk + peak / jerk
    lost = 0.5 * (abs(peak - pull) * (peak + pull) + peak * peak) / jerk
    return time + (max(excess - lost, 0.0) / peak if peak == dec else 0.0)


@kernel
def over_velocity(piece: Floats, duration: float, back: float, vel: float, raised: float, slack: float) -> bool:
    """Tell whether a piece is faster than `vel`, or before the time `back` than `raised`."""
    t, v, a, j = piece[0], piece[2], piece[3], piece[4]
    if highest_speed(v, a, j, duration) > raised * (1.0 + VELOCITY):
        return True
    skip = max(back - t, 0.0)
    if skip >= duration:
        return False
    v += skip * (a + skip * (0.5 * j))
    a += skip * j
    return highest_speed(v, a, j, duration - skip) > vel + VELOCITY * raised + (slack if back > 0.0 else 0.0)


@kernel
def over_acceleration(
    piece: Floats, duration: float, first: float, acc: float, dec: float, vel: float, jerk: float, blur: float
) -> bool:
    """Tell whether a piece brakes harder than `dec` or accelerates harder than `acc` anywhere.

    `first` is |a| at the start of the profile; what the jerk limit leaves of it at the time is allowed. |a| - limit is
    largest at an end of the piece, or where that allowance ends; where v changes sign inside, the middle of each part
    says which limit holds there. Velocities within tolerance of zero belong to both sides.
    """
    t, v, a, j = piece[0], piece[2], piece[3], piece[4]
    most = max(acc, dec)
    slack = ACCELERATION * max(most, first) + blur * abs(j)
    first_turn, last_turn = turns(v, a, j, duration)
    begin = 0.0
    for cut in (first_turn, last_turn, duration):
        if not cut > begin:
            continue
        middle = 0.5 * (begin + cut)
        speed = v + middle * (a + middle * (0.5 * j))
        pull = a + middle * j
        limit = most if abs(speed) <= VELOCITY * vel else (acc if speed * pull > 0.0 else dec)
        corner = min(max((first - limit) / jerk - t, begin), cut)
        for s in (begin, corner, cut):
            if abs(a + s * j) > max(limit, first - jerk * (t + s)) + slack:
                return True
        begin = cut
    return False


@kernel
def blur_at(time: float, shortest: float) -> float:
    """Return what an instant may miss: a few ulp of the time, but never a visible part of the shortest phase."""
    return CLOCK * min(time, max(LONGEST, FINENESS * shortest))


@kernel
def check_way(out: Floats, count: int, vel: float, acc: float, dec: float, jerk: float) -> int:
    """Return FINE or the first reason to refuse the way of a plan, whatever its end.

    A start outside the limits raises them while it comes back and no longer: the acceleration to what full jerk
    leaves of it, the velocity until `time_back`.
    """
    for k in range(count):
        for field in range(5):
            if not math.isfinite(out[k, field]):
                return NOT_FINITE
    v, a = out[0, 2], out[0, 3]
    raised = max(vel, abs(v), abs(v + 0.5 * a * abs(a) / jerk))
    most = max(acc, dec, abs(a))
    back = time_back(v, a, vel, dec, jerk)
    if not (raised < math.inf and most < math.inf and back < math.inf):  # overflow would allow everything
        return NOT_FINITE
    shortest = min(acc / jerk, dec / jerk, math.sqrt(vel / jerk))
    path, peak, pull = sizes(out, count)
    for k in range(count - 1):
        duration = out[k + 1, 0] - out[k, 0]
        blur = blur_at(out[k + 1, 0], shortest)
        if over_velocity(out[k], duration, back, vel, raised, blur * most):
            return VELOCITY_LIMIT
        fault = misfit(out[k], out[k + 1], jerk, path, peak, pull, blur)
        if fault != FINE:
            return fault
        if over_acceleration(out[k], duration, abs(a), acc, dec, raised, jerk, blur):
            return ACCELERATION_LIMIT
    return FINE


@kernel
def ends(out: Floats, count: int, u: float, pull: float) -> bool:
    """Tell whether the last piece begins with velocity u and keeps the acceleration `pull`."""
    end = out[count - 1]
    return bool(end[2] == u and end[3] == pull and end[4] == 0.0)


@kernel
def check_velocity(out: Floats, count: int, u: float, vel: float, acc: float, dec: float, jerk: float) -> int:
    """Return FINE or the first reason to refuse a plan to the velocity u."""
    fault = check_way(out, count, vel, acc, dec, jerk)
    return END_STATE if fault == FINE and not ends(out, count, u, 0.0) else fault


@kernel
def check_meeting(
    out: Floats, count: int, target: float, w: float, u: float, vel: float, acc: float, dec: float, jerk: float
) -> int:
    """Return FINE or the first reason to refuse a plan that ends at the point target + w·t with the velocity u."""
    fault = check_velocity(out, count, u, vel, acc, dec, jerk)
    end = out[count - 1]
    return END_STATE if fault == FINE and end[1] != target + w * end[0] else fault


@kernel
def check_arrival(
    out: Floats, count: int, time: float, target: float, u: float, pull: float,
    vel: float, acc: float, dec: float, jerk: float,
) -> int:  # fmt: skip
    """Return FINE or the first reason to refuse a plan that is at `target` with (u, pull) at `time`."""
    fault = check_way(out, count, vel, acc, dec, jerk)
    there = out[count - 1, 0] == time and out[count - 1, 1] == target and ends(out, count, u, pull)
    return END_STATE if fault == FINE and not there else fault
