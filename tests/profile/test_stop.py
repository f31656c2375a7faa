"""Stop position in closed form: it is where the stop's pieces end, and convex where followers rely on it."""

import math

import numpy as np
import pytest
from hypothesis import example, given
from numpy.typing import NDArray

from motionlayer._kernel import MODE, kernel
from motionlayer.profile import Limits, PlanError, stop_at, stop_displacement, stop_position
from motionlayer.profile._kernels import to_velocity

from .cases import Problem, anything, many, some

Floats = NDArray[np.float64]


@some(400)
@given(anything)
@example(Problem(0.0, 4.0, -4.0, 0.0, Limits(6.0, 1.0, 1.0, 2.0)))  # a = 0 and v = 0 at once
@example(Problem(0.0, 1.0, -6.0, 0.0, Limits(6.0, 1.0, 1.0, 1.0)))  # passes v = 0 and comes back
def test_it_is_where_the_stop_ends(problem: Problem) -> None:
    p, v, a, _, limits = problem
    stop = problem.stop().pieces
    if len(stop) > 1:
        assert stop_at(p, v, a, limits) == stop[-1, 1]
    out = np.zeros((20, 5))
    out[0, 2:4] = v, a
    pieces = out[: to_velocity(out, 0.0, limits.acceleration, limits.deceleration, limits.jerk)]
    path = np.abs(pieces[:, 2]).max() * pieces[-1, 0]
    assert stop_displacement(v, a, limits.deceleration, limits.jerk) == pytest.approx(pieces[-1, 1], abs=1e-14 * path)


@some(200)
@given(anything)
def test_its_mirror_image_is_the_same_bit_for_bit(problem: Problem) -> None:
    p, v, a, _, limits = problem
    assert stop_at(p, v, a, limits) == -stop_at(-p, -v, -a, limits)


def test_a_kernel_can_call_it() -> None:
    @kernel
    def twice(v: float, a: float) -> float:
        return stop_position(1.0, v, a, 2.0, 4.0) + stop_displacement(v, a, 2.0, 4.0)

    if MODE == "plain":
        assert twice(1.0, 0.0) == 1.0 + 2.0 * stop_displacement(1.0, 0.0, 2.0, 4.0)
    else:
        assert twice.py_func(1.0, 0.0) == twice(1.0, 0.0)  # type: ignore[attr-defined]


@pytest.mark.parametrize("value", [math.nan, math.inf, 0.0, -1.0])
@pytest.mark.parametrize("name", ["deceleration", "jerk"])
def test_a_limit_that_is_none_is_refused(name: str, value: float) -> None:
    with pytest.raises(PlanError, match="stop_at"):
        stop_at(0.0, 1.0, 1.0, Limits(1.0, 1.0, 1.0, 1.0)._replace(**{name: value}))


@pytest.mark.parametrize("state", [(math.nan, 0.0, 0.0), (0.0, math.inf, 0.0), (0.0, 0.0, math.nan), (0.0, 1.0, 1e300)])
def test_a_state_that_leads_nowhere_is_refused(state: tuple[float, float, float]) -> None:
    with pytest.raises(PlanError, match="stop_at"), np.errstate(all="ignore"):
        stop_at(*state, Limits(1.0, 1.0, 1.0, 1.0))


@kernel
def stopping_at(out: Floats, time: float, v: float, a: float, dec: float, jerk: float) -> float:
    """Return how far the stop from (v, a) has come after a time."""
    out[0, 0] = 0.0
    out[0, 1] = 0.0
    out[0, 2] = v
    out[0, 3] = a
    count = to_velocity(out, 0.0, dec, dec, jerk)
    k = 0
    while k + 1 < count and out[k + 1, 0] <= time:
        k += 1
    s = time - out[k, 0]
    return float(out[k, 1] + s * (out[k, 2] + s * (0.5 * out[k, 3] + s * (out[k, 4] / 6.0))))


def admissible(source: np.random.Generator, dec: float, jerk: float, fastest: float) -> tuple[float, float]:
    """Draw a state with v >= 0, a >= -D, from which bringing a to zero does not reverse: v >= a²/2J for a < 0."""
    most = min(dec, math.sqrt(2.0 * jerk * fastest))
    a = float(source.uniform(-most, 3.0 * dec))
    least = a * a / (2.0 * jerk) if a < 0.0 else 0.0
    return least + (fastest - least) * float(source.uniform()) ** 3, a


def test_stop_position_is_convex_at_every_instant() -> None:
    # `planar` 10: pairs of admissible states, their mix, and the stop of all three at an instant.
    source = np.random.default_rng(10)
    out = np.zeros((20, 5))
    for _ in range(many(150_000)):
        dec, jerk = (float(10.0**exponent) for exponent in source.uniform(-1.5, 1.5, 2))
        fastest = float(10.0 ** source.uniform(-1.5, 1.5))
        one, two = admissible(source, dec, jerk, fastest), admissible(source, dec, jerk, fastest)
        share = float(source.uniform())
        mix = ((1.0 - share) * one[0] + share * two[0], (1.0 - share) * one[1] + share * two[1])
        slowest = max(fastest / dec, 1.0) + 4.0 * dec / jerk
        time = slowest * float(source.uniform()) ** 2
        first, second, middle = (stopping_at(out, time, *state, dec, jerk) for state in (one, two, mix))
        bound = (1.0 - share) * first + share * second
        assert middle <= bound + 1e-12 * (abs(first) + abs(second)), (one, two, share, time, dec, jerk)
        ends = [stop_displacement(*state, dec, jerk) for state in (one, two, mix)]
        assert ends[2] <= (1.0 - share) * ends[0] + share * ends[1] + 1e-12 * (ends[0] + ends[1])


def test_stop_distance_is_least_where_a_state_brakes_hardest() -> None:
    # Mix 0 of `planar` 10: one instant along the stop against one instant along any other jerk.
    source = np.random.default_rng(11)
    for _ in range(many(20_000)):
        dec, jerk = (float(10.0**exponent) for exponent in source.uniform(-1.0, 1.0, 2))
        v, a = admissible(source, dec, jerk, 10.0)
        h = 1e-3 * min(dec / jerk, 1.0)
        if v < 2.0 * h * (abs(a) + dec) or a < -dec + h * jerk:
            continue

        def after(j: float, v: float = v, a: float = a, h: float = h, dec: float = dec, jerk: float = jerk) -> float:
            way = h * (v + h * (a / 2.0 + h * j / 6.0))
            return way + stop_displacement(v + h * (a + h * j / 2.0), a + h * j, dec, jerk)

        brake, other = after(-jerk), after(jerk * float(source.uniform(-1.0, 1.0)))
        assert brake <= other + 1e-12 * other
