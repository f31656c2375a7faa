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


@pytest.mark.parametrize(
    ("search", "sync", "text"),
    [
        (Direction.POSITIVE, Direction.UNDEFINED, "search_direction=POSITIVE)"),
        (Direction.POSITIVE, Direction.NEGATIVE, "search_direction=POSITIVE)"),
        (Direction.POSITIVE, Direction.POSITIVE, "search_direction=POSITIVE, sync_direction=POSITIVE)"),
        (Direction.NEGATIVE, Direction.POSITIVE, "home(position=7.0)"),
        (Direction.UNDEFINED, Direction.NEGATIVE, "home(position=7.0, sync_direction=NEGATIVE)"),
    ],
)
def test_the_direction_off_the_cam_is_told_where_the_search_does_not_tell_it(
    search: Direction, sync: Direction, text: str
) -> None:
    """From the cam, so that the way off it is all that there is; `verify` holds it against the message."""
    run, x = ready(home=SWITCH | {"mode": "cam", "switch_width": 5.0}, start_position=-52.0)
    finish(run, x.home(search_direction=search, sync_direction=sync))
    run.step(2)
    assert any(event.text.endswith(text) for event in run.trace.events)
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
