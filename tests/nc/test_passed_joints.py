"""Joints that are too near for anything but to take the acceleration back: seen again from any instant of the way."""

import math

from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from motionlayer.nc._through import Point, through
from motionlayer.profile import Limits

LIMITS = Limits(500.0, 5000.0, 3000.0, 1e5)


@settings(deadline=None)
@given(
    st.floats(-1e6, 1e6),
    st.floats(30.0, 450.0),
    st.floats(-5000.0, 4000.0),
    st.floats(0.0, 0.9),
    st.floats(1.0, 500.0),
    st.sampled_from([1.0, -1.0]),
)
@example(8279.0, 400.0, -2000.0, 0.37, 500.0, -1.0)
def test_what_is_left_of_a_way_that_takes_the_acceleration_back_is_found(
    origin: float, velocity: float, acceleration: float, share: float, asked: float, heading: float
) -> None:
    """Whatever the rounding of the state in its midst; it is no faster there than what is left."""
    settled = velocity + 0.5 * acceleration * abs(acceleration) / LIMITS.jerk
    assume(20.0 < settled <= LIMITS.velocity and abs(acceleration) > 50.0)
    jerk, time = -math.copysign(LIMITS.jerk, acceleration), abs(acceleration) / LIMITS.jerk
    place, _, _ = _after(time, origin, heading * velocity, heading * acceleration, heading * jerk)
    here = Point(*_after(share * time, origin, heading * velocity, heading * acceleration, heading * jerk))
    way = through(here, place, heading, asked, LIMITS)
    assert way is not None
    assert way.profile.pieces[-1, 1] == place
    assert 0.0 <= heading * way.end.v <= settled * (1.0 + 1e-6)
    assert way.end.a == 0.0


def _after(t: float, p: float, v: float, a: float, j: float) -> tuple[float, float, float]:
    """Return position, velocity and acceleration after t seconds of constant jerk."""
    return p + t * (v + t * (a / 2 + t * j / 6)), v + t * (a + t * j / 2), a + t * j
