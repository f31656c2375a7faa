"""What a homing may ask for: keywords of the call, beside what the machine description says."""

from typing import Any

import pytest

from motionlayer.command import ErrorId
from motionlayer.nc import Direction, HomingMode
from motionlayer.verify import assert_valid
from tests.machines import SWITCH, error_of, finish, ready


@pytest.mark.parametrize(
    ("keywords", "match"),
    [
        ({"serch_velocity": 5.0}, "home.. takes no keyword serch_velocity; did you mean search_velocity"),
        ({"search_velocity": "fast"}, "search_velocity is 'fast', a str; it must be a number"),
        ({"sync_direction": 3}, "sync_direction is 3; it must be one of Direction.POSITIVE"),
        ({"method": "cam"}, "method is 'cam'; it must be one of HomingMode.DIRECT"),
    ],
)
def test_wrong_types_and_names_raise_and_move_nothing(keywords: dict[str, Any], match: str) -> None:
    run, x = ready(home=SWITCH)
    with pytest.raises(TypeError, match=match):
        x.home(**keywords)
    run.step(10)
    assert (x.set_velocity, x.command) == (0.0, None)


@pytest.mark.parametrize("velocity", [0.0, -1.0, 500.1, 1e-61, float("nan"), float("inf")])
@pytest.mark.parametrize("leg", ["search_velocity", "sync_velocity"])
def test_velocities_are_those_of_a_move(leg: str, velocity: float) -> None:
    _, x = ready(home=SWITCH)
    keywords: dict[str, Any] = {leg: velocity}
    assert error_of(x.home(**keywords)) is ErrorId.VELOCITY


def test_the_message_tells_what_is_not_as_described() -> None:
    run, x = ready(home=SWITCH)
    home = x.home(1.0, search_velocity=60.0, search_direction=Direction.NEGATIVE, method=HomingMode.CAM)
    finish(run, home)
    run.step(2)
    texts = [event.text for event in run.trace.events]
    assert "home(position=1.0, method=CAM, search_velocity=60.0)" in texts
    assert_valid(run.trace)


def test_a_cam_means_nothing_after_the_end() -> None:
    run, x = ready()
    home = x.home()
    run.step()
    assert home.done
    home.cam(on=True)
    run.step(10)
    assert x.set_velocity == 0.0
    assert_valid(run.trace)
