"""Accelerations so weak that their phases are far apart: taken or refused when they are commanded, never failing later.

A velocity is gained in V/A, an acceleration in A/J. Where they are farther apart than 1e12 the clock of a profile does
not resolve both. A first plan may do without one of them; a stop or another override then cannot be planned.
"""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer import Simulation
from motionlayer.command import ErrorId
from motionlayer.machine import Machine, MachineError
from motionlayer.nc import Axis, AxisCommand, BufferMode, Calibration
from motionlayer.profile import RANGES
from motionlayer.verify import assert_valid
from tests.effort import examples
from tests.machines import LINEAR, error_of, finish, ready

FREE = {"software_limit_min": None, "software_limit_max": None}
"""No software limits."""

NAMES = ["acceleration", "deceleration"]
MODES = [BufferMode.ABORTING, BufferMode.BUFFERED, BufferMode.BLENDING_HIGH]


def weakest(velocity: float, jerk: float = 1e5) -> float:
    """Return the weakest acceleration that is planned for certain, rounded up."""
    return math.sqrt(velocity * jerk / RANGES.phases) * (1.0 + 1e-12)


@pytest.mark.parametrize("factor", [1.0, 0.5, 0.0])
@pytest.mark.parametrize("value", [1e-9, 1e-50, 1e-60])
@pytest.mark.parametrize("name", NAMES)
def test_a_weak_acceleration_is_refused_when_it_is_commanded(name: str, value: float, factor: float) -> None:
    """It was taken once where its first plan came about, and the axis failed with an internal error at the next one."""
    run, x = ready(**FREE)
    x.set_override(factor)
    run.step()
    weak = {name: value}
    refused = [
        x.move_velocity(100.0, **weak),  # type: ignore[arg-type]
        x.move_absolute(100.0, velocity=100.0, **weak),  # type: ignore[arg-type]
        x.move_relative(1e-9, velocity=100.0, **weak),  # type: ignore[arg-type]
        x.move_continuous_absolute(50.0, 100.0, velocity=100.0, **weak),  # type: ignore[arg-type]
    ]
    for command in refused:
        assert command.error is not None
        assert command.error.id is ErrorId.ACCELERATION_TOO_SMALL
        assert f"{name} = {value}, allowed: from 0.00316228 mm/s² on" in command.error.detail
        assert "velocity = 100.0 and jerk = 100000.0" in command.error.detail
    run.step(20)
    assert x.set_position == 0.0
    assert_valid(run.trace)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("mode", MODES)
def test_the_weakest_is_the_published_one_also_from_a_faster_motion(name: str, mode: BufferMode) -> None:
    run, x = ready(**FREE)
    x.move_absolute(1e5, velocity=400.0)
    run.step(500)
    for factor, error in ((1.0, None), (0.999, ErrorId.ACCELERATION_TOO_SMALL)):
        weak = {name: factor * weakest(400.0)}
        follower = x.move_absolute(2e5, velocity=100.0, buffer_mode=mode, **weak)  # type: ignore[arg-type]
        assert error_of(follower) is error
        run.step(3)
        x.emergency_stop()
        run.step(400)
        x.move_absolute(1e5 + x.set_position, velocity=400.0)
        run.step(500)
    assert_valid(run.trace)


def begun(run: Simulation, x: Axis, endless: bool, speed: float, weak: dict[str, float], ticks: int) -> AxisCommand:
    """Begin a motion of weak dynamics, and go on with it for some ticks."""
    move = x.move_velocity(speed, **weak) if endless else x.move_absolute(300.0, velocity=speed, **weak)  # type: ignore[arg-type]
    run.step(ticks)
    return move


@settings(max_examples=examples(60), deadline=None)
@given(
    endless=st.booleans(),
    speed=st.floats(-12.0, math.log10(500.0)).map(lambda e: 10.0**e),
    jerk=st.floats(-9.0, 5.0).map(lambda e: 10.0**e),
    shares=st.tuples(st.floats(0.0, 7.0), st.floats(0.0, 7.0)),
    ticks=st.integers(0, 400),
    factor=st.sampled_from([0.0, 1e-6, 0.5, 1.0]),
    end=st.sampled_from(["stop", "halt", "emergency_stop", "hard stop", "disable"]),
)
def test_any_motion_that_is_taken_can_be_slowed_down_and_stopped(
    endless: bool, speed: float, jerk: float, shares: tuple[float, float], ticks: int, factor: float, end: str
) -> None:
    run, x = ready()
    acceleration, deceleration = (min(weakest(speed, jerk) * 10.0**share, 5000.0) for share in shares)
    weak = {"acceleration": acceleration, "deceleration": deceleration, "jerk": jerk}
    move = begun(run, x, endless, speed, weak, ticks)
    if error_of(move) is ErrorId.POSITIONING_TOO_LONG:
        return
    assert error_of(move) is None
    x.set_override(factor)
    run.step(3)
    brake = x.stop(jerk=1e5) if end == "hard stop" else getattr(x, end.removeprefix("hard "))()
    run.step(50)
    assert brake.error is None
    assert x.error is None
    assert_valid(run.trace)


def test_a_homing_with_too_weak_defaults_is_refused() -> None:
    run, x = ready(home={"mode": "switch", "switch": -50.0, "velocity": 40.0})
    weak = x.config.default._replace(acceleration=1e-9)
    x.configure(x.config._replace(default=weak), "acceleration=1e-9")
    assert error_of(x.home()) is ErrorId.ACCELERATION_TOO_SMALL
    assert error_of(x.home(mode=Calibration.DIRECT)) is None
    run.step(3)
    assert_valid(run.trace)


@pytest.mark.parametrize("name", ["max_acceleration", "max_deceleration", "acceleration", "deceleration"])
def test_a_machine_with_too_weak_an_acceleration_is_refused_with_the_jerk_that_would_do(name: str) -> None:
    def described(value: float) -> Machine:
        return Machine.from_dict({"format": 1, "name": "weak", "axis": {"X": LINEAR | {name: value}}})

    edge = weakest(500.0)
    assert described(edge) is not None
    with pytest.raises(MachineError, match=r"jerk.*at most .* beside max_velocity = 500\.0"):
        described(0.99 * edge)


def test_a_buffered_motion_beside_a_faster_one_is_asked_for_both() -> None:
    run, x = ready()
    first = x.move_absolute(100.0, velocity=400.0, acceleration=weakest(400.0, 1.0), jerk=1.0)
    assert error_of(first) is None
    lively = x.move_absolute(200.0, velocity=500.0, buffer_mode=BufferMode.BLENDING_HIGH)
    assert error_of(lively) is ErrorId.ACCELERATION_TOO_SMALL
    stop = x.stop()
    finish(run, stop)
    run.step(2)
    assert_valid(run.trace)
