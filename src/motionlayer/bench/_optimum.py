"""The shortest durations that plans are held against: in closed form, and by a linear program."""

from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motionlayer.profile import Limits, plan_position, plan_stop

Floats = NDArray[np.float64]
Wide = NDArray[np.floating[Any]]
"""In extended precision."""

HALVINGS: Final = 80
"""Of the peak velocity's bracket, in extended precision."""


def rest_to_rest(distance: Floats, vel: Floats, acc: Floats, dec: Floats, jerk: Floats) -> Wide:
    """Return the shortest durations from rest to rest in extended precision; all arrays of one shape.

    From rest to v takes v/A + A/J if A is reached, else 2 √(v/J), at half of v in the mean. Where the velocity limit is
    not reached, the peak velocity solves v (up + down)/2 = distance, whose left side grows with v.
    """
    d, v_max, a, b, j = (values.astype(np.longdouble) for values in (distance, vel, acc, dec, jerk))

    def ramps(v: Wide) -> Wide:
        root = 2 * np.sqrt(v / j)
        up = np.where(v >= a * a / j, v / a + a / j, root)
        return np.asarray(up + np.where(v >= b * b / j, v / b + b / j, root))

    low, high = 0 * v_max, v_max
    for _ in range(HALVINGS):
        peak = (low + high) / 2
        beyond = peak * ramps(peak) / 2 > d
        low, high = np.where(beyond, low, peak), np.where(beyond, peak, high)
    full = v_max * ramps(v_max) / 2
    return np.asarray(np.where(d >= full, (d - full) / v_max + ramps(v_max), ramps(high)))


class Case(NamedTuple):
    """A motion to rest in positive direction, in units of the limits' V, A and V/A.

    Attributes:
        turn: when the planned motion turns round; 0 if it starts in the direction of its target.
        guess: duration of the planned motion.
    """

    v: float
    a: float
    distance: float
    deceleration: float
    jerk: float
    turn: float
    guess: float


def asymmetric_cases(count: int, seed: int = 1) -> list[Case]:
    """Return random cases with deceleration apart from acceleration by up to ten: at rest, moving, moving away."""
    rng = np.random.default_rng(seed)
    return [_case(rng, ("rest", "moving", "away")[number % 3]) for number in range(count)]


def _case(rng: np.random.Generator, start: str) -> Case:
    dec, jerk = 10.0 ** rng.uniform(-1.0, 1.0), 10.0 ** rng.uniform(-1.0, 1.5)
    limits = Limits(1.0, 1.0, dec, jerk)
    v = 0.0 if start == "rest" else rng.uniform(0.05, 0.95)
    # As much as brings the velocity neither beyond its limit nor through zero when it is taken back.
    a = 0.0 if start == "rest" else rng.uniform(-min(dec, (2 * jerk * v) ** 0.5), min(1.0, (2 * jerk * (1 - v)) ** 0.5))
    if start == "away":
        v, a = -v, -a
    stop = float(plan_stop(0.0, v, a, limits).pieces[-1, 1])
    full = 0.5 * (1.0 + 1.0 / jerk + 1.0 / dec + dec / jerk)
    distance = max(stop, 0.0) + full * 10.0 ** rng.uniform(-2.0, 0.5)
    plan = plan_position(0.0, v, a, distance, limits)
    return Case(v, a, distance, dec, jerk, _turn(plan.pieces) if start == "away" else 0.0, plan.duration)


def _turn(pieces: Floats) -> float:
    """Return when the velocity passes zero upwards, to a thousandth of the duration."""
    times = np.linspace(0.0, pieces[-1, 0], 4001)
    row = np.searchsorted(pieces[:, 0], times, side="right") - 1
    s = times - pieces[row, 0]
    v = pieces[row, 2] + s * (pieces[row, 3] + s * pieces[row, 4] / 2)
    return float(times[int(np.argmax(v >= 0.0))])
