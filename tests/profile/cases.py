"""Inputs of the planner: families of random problems, and how many of them a test takes."""

from typing import NamedTuple

from hypothesis import settings
from hypothesis import strategies as st

from motionlayer._kernel import MODE
from motionlayer.profile import Limits, Profile, plan_position, plan_stop, plan_velocity
from tests.effort import examples


class Problem(NamedTuple):
    """A start state, a target position and limits. `repr` is pasteable."""

    p: float
    v: float
    a: float
    target: float
    limits: Limits

    def position(self) -> Profile:
        return plan_position(self.p, self.v, self.a, self.target, self.limits)

    def stop(self) -> Profile:
        return plan_stop(self.p, self.v, self.a, self.limits)

    def velocity(self, target: float) -> Profile:
        return plan_velocity(self.p, self.v, self.a, target, self.limits)

    def scaled(self, factor: float) -> "Problem":
        """Return the same problem in another unit of length."""
        limits = Limits(*(value * factor for value in self.limits))
        return Problem(self.p * factor, self.v * factor, self.a * factor, self.target * factor, limits)


def some(count: int) -> settings:
    """Take `count` examples, as far as the suite wants them, or a few of them where the kernels are plain Python."""
    return settings(max_examples=max(count // 20, 5) if MODE == "plain" else examples(count), deadline=None)


def many(count: int) -> int:
    """Return the length of a loop, as far as the suite wants it, or a fraction where the kernels are plain Python."""
    return count // 50 if MODE == "plain" else examples(count)


def calm(v: float, a: float, limits: Limits) -> bool:
    """Tell whether a start is inside the limits, also once its acceleration has been taken back."""
    rule = limits.acceleration if v * a > 0.0 else limits.deceleration
    return abs(v) <= limits.velocity and abs(a) <= rule and abs(v + 0.5 * a * abs(a) / limits.jerk) <= limits.velocity


def logarithmic(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high).map(lambda exponent: 10.0**exponent)


# A share with six digits: a distance of 1e-138 is a case of its own (see the tests of bad input).
signed = st.integers(-1000000, 1000000).map(lambda share: share / 1e6)


@st.composite
def integers(draw: st.DrawFn, *, symmetric: bool = False) -> Problem:
    """Draw small integers: full of degenerate cases, starts outside the limits among them."""
    small = st.integers(-6, 6).map(float)
    limit = st.integers(1, 6).map(float)
    vel, acc, dec, jerk = draw(st.tuples(limit, limit, limit, limit))
    limits = Limits(vel, acc, acc if symmetric else dec, jerk)
    return Problem(draw(small), draw(small), draw(small), draw(st.integers(-40, 40).map(float)), limits)


@st.composite
def inside(draw: st.DrawFn, *, symmetric: bool = False, spread: float = 1.0) -> Problem:
    """Draw a machine of any size and a start inside its limits; `spread` is in decades."""
    length = draw(logarithmic(-3.0 * spread, 3.0 * spread))
    time = draw(logarithmic(-1.5 * spread, 1.0 * spread))
    vel = length / time
    acc = vel / time * draw(logarithmic(-spread, spread))
    dec = acc if symmetric else acc * draw(logarithmic(-spread, spread))
    jerk = acc / time * draw(logarithmic(-spread, spread))
    p = 100.0 * length * draw(signed)
    v = vel * draw(signed)
    a = draw(signed)
    a *= acc if v * a > 0.0 else dec
    target = p + length * draw(signed) * draw(logarithmic(-3.0, 3.0))
    return Problem(p, v, a, target, Limits(vel, acc, dec, jerk))


@st.composite
def outside(draw: st.DrawFn) -> Problem:
    """Draw a start up to ten times outside the limits."""
    p, v, a, target, limits = draw(inside())
    return Problem(p, v * draw(st.floats(1.0, 10.0)), a * draw(st.floats(1.0, 10.0)), target, limits)


anything = st.one_of(integers(), inside(), inside(spread=2.0), outside())
