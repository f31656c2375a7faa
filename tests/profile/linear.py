"""The farthest way in a given time as a linear program: shares nothing with the planner.

Time is cut into steps of constant jerk. While the velocity keeps its sign, every limit is a bound on a state at a
grid point, so the farthest lawful way with a given end velocity is a linear program (HiGHS). A way that reverses has
one grid point with v = 0 between a part with one sign and a part with the other; the best instant for it is searched.
A profile is optimal if no way in less time comes as far.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog  # type: ignore[import-untyped]
from scipy.sparse import csr_array  # type: ignore[import-untyped]

from motionlayer.profile import Limits

UNREACHABLE = -math.inf


class Start(NamedTuple):
    """A start state at p = 0, inside the limits."""

    v: float
    a: float


class Part(NamedTuple):
    """A time in steps with one sign of the velocity."""

    time: float
    steps: int
    sign: float


def farthest(start: Start, direction: float, end_velocity: float, parts: list[Part], limits: Limits) -> float:
    """Return the greatest direction·p at the end with velocity `end_velocity` and a = 0; -inf if there is no way."""
    times = np.concatenate([np.full(part.steps, part.time / part.steps) for part in parts])
    signs = np.concatenate([np.full(part.steps, part.sign) for part in parts])
    count = len(times)
    bounds = _bounds(signs, limits)
    for state, value in ((1, 0.0), (2, start.v), (3, start.a)):
        bounds[state] = (value, value)
    bounds[4 * count + 2] = (end_velocity, end_velocity)
    bounds[4 * count + 3] = (0.0, 0.0)
    price = np.zeros(4 * count + 4)
    price[4 * count + 1] = -direction
    found = linprog(price, A_eq=_steps(times), b_eq=np.zeros(3 * count), bounds=bounds, method="highs")
    return -float(found.fun) if found.status == 0 else UNREACHABLE


def _bounds(signs: NDArray[np.float64], limits: Limits) -> NDArray[np.float64]:
    """Return the bounds of jerk, p, v, a at every grid point; a point between two signs keeps those of both."""
    vel, acc, dec, jerk = limits
    bounds = np.tile([[-jerk, jerk], [-math.inf, math.inf], [-vel, vel], [-math.inf, math.inf]], (len(signs) + 1, 1))
    for k, sign in enumerate(signs):
        least, most = (-dec, acc) if sign > 0.0 else (-acc, dec)
        for point in (4 * k, 4 * k + 4):
            row = bounds[point + 2]
            bounds[point + 2] = (max(row[0], 0.0), row[1]) if sign > 0.0 else (row[0], min(row[1], 0.0))
            row = bounds[point + 3]
            bounds[point + 3] = (max(row[0], least), min(row[1], most))
    return bounds


def _steps(times: NDArray[np.float64]) -> csr_array:
    """Return the equations of motion from each grid point to the next."""
    ones, halves = np.ones_like(times), times * times / 2.0
    terms = (  # row of a step, column of its grid point, factors of all steps
        *((0, 1, ones), (0, 2, times), (0, 3, halves), (0, 0, times * times * times / 6.0), (0, 5, -ones)),
        *((1, 2, ones), (1, 3, times), (1, 0, halves), (1, 6, -ones)),
        *((2, 3, ones), (2, 0, times), (2, 7, -ones)),
    )
    step = np.arange(len(times))
    rows = np.concatenate([3 * step + row for row, _, _ in terms])
    columns = np.concatenate([4 * step + column for _, column, _ in terms])
    factors = np.concatenate([values for _, _, values in terms])
    return csr_array((factors, (rows, columns)), shape=(3 * len(times), 4 * len(times) + 4))


def farthest_in(
    start: Start, direction: float, end_velocity: float, time: float, limits: Limits, steps: int, enough: float
) -> float:
    """Return the greatest direction·p after `time`, over every instant of the reversal if there is one.

    The way may reverse at its begin or at its end, not at both. No better one than `enough` is looked for.
    """
    begins, ends = start.v * direction >= 0.0, end_velocity * direction >= 0.0
    if begins and ends:
        return farthest(start, direction, end_velocity, [Part(time, steps, direction)], limits)
    assert begins or ends
    half, first = steps // 2, direction if begins else -direction

    def turned_at(share: float) -> float:
        parts = [Part(share * time, half, first), Part(time - share * time, half, -first)]
        return farthest(start, direction, end_velocity, parts, limits)

    farther, share = max((turned_at(share), share) for share in (0.02 + 0.06 * k for k in range(17)))
    if farther == UNREACHABLE:
        return UNREACHABLE
    for width in (0.015, 0.00375, 0.001):
        if farther >= enough:
            break
        around = [share + width * k for k in (-3, -2, -1, 1, 2, 3) if 0.0 < share + width * k < 1.0]
        farther, share = max((farther, share), *((turned_at(other), other) for other in around))
    return farther


def can_meet(
    start: Start, direction: float, distance: float, w: float, u: float, time: float, limits: Limits, steps: int
) -> bool:
    """Tell whether some way meets at `time`, with velocity u, a point that was `distance` away and moves at w."""
    way = direction * (distance + w * time)
    return farthest_in(start, direction, u, time, limits, steps, way) >= way


def can_return(start: Start, velocity: float, time: float, limits: Limits, steps: int, pull: float) -> bool:
    """Tell whether a start outside can be at v <= `velocity` at `time`, braking with no more than `pull` then.

    Whatever full jerk leaves of the start's acceleration is allowed beside the limits.
    """
    _, acc, dec, jerk = limits
    h = time / steps
    bounds = np.tile(
        [[-jerk, jerk], [-math.inf, math.inf], [-math.inf, math.inf], [-math.inf, math.inf]], (steps + 1, 1)
    )
    for k in range(steps + 1):
        left = abs(start.a) - jerk * h * k
        bounds[4 * k + 3] = (-max(dec, left), max(acc, left))
    for state, value in ((1, 0.0), (2, start.v), (3, start.a)):
        bounds[state] = (value, value)
    bounds[4 * steps + 2] = (-math.inf, velocity)
    bounds[4 * steps + 3, 0] = max(bounds[4 * steps + 3, 0], -pull)
    no_price = np.zeros(4 * steps + 4)
    equations = _steps(np.full(steps, h))
    return bool(linprog(no_price, A_eq=equations, b_eq=np.zeros(3 * steps), bounds=bounds, method="highs").status == 0)
