"""Wrong types raise at the call, wrong values give a refused command; neither changes anything."""

import math
from collections.abc import Callable
from decimal import Decimal
from typing import Any

import numpy as np
import pytest

from motionlayer.command import ErrorId
from motionlayer.event import Kind
from motionlayer.nc import Axis, AxisCommand, BufferMode, Direction
from tests.machines import LINEAR, error_of, finish, ready
from tests.nc.test_states import everything

TOO_MUCH = {
    "velocity": LINEAR["max_velocity"],
    "acceleration": LINEAR["max_acceleration"],
    "deceleration": LINEAR["max_deceleration"],
    "jerk": LINEAR["max_jerk"],
}
ERROR = {
    "velocity": ErrorId.VELOCITY,
    "acceleration": ErrorId.ACCELERATION,
    "deceleration": ErrorId.DECELERATION,
    "jerk": ErrorId.JERK,
}
BRAKES = ("deceleration", "jerk")
Call = Callable[..., AxisCommand]

CALLS: dict[str, tuple[Callable[[Axis], Call], tuple[str, ...]]] = {
    "absolute": (lambda x: lambda **k: x.move_absolute(100.0, **k), tuple(ERROR)),
    "relative": (lambda x: lambda **k: x.move_relative(10.0, **k), tuple(ERROR)),
    "velocity": (lambda x: lambda **k: x.move_velocity(k.pop("velocity", 50.0), **k), tuple(ERROR)),
    "halt": (lambda x: x.halt, BRAKES),
    "stop": (lambda x: x.stop, BRAKES),
}
ARGUMENTS = [(call, name) for call, (_, names) in CALLS.items() for name in names]
TARGETS: dict[str, Callable[[Axis, Any], AxisCommand]] = {
    "absolute": lambda x, value: x.move_absolute(value),
    "relative": lambda x, value: x.move_relative(value),
    "home": lambda x, value: x.home(value),
    "passes": lambda x, value: x.passes(value),
}
HUGE = 10**400
WRONG_TYPES: list[Any] = ["1", True, [1.0], 1j, Decimal(1), np.array([1.0]), object()]


def refused(x: Axis, call: Callable[[], AxisCommand], error: ErrorId) -> None:
    """Check that a call is refused with this error, tells it in one event and changes nothing."""
    before, count = everything(x), len(x._events.last())
    command = call()
    assert error_of(command) is error
    assert not command.active
    assert everything(x) == before
    (event,) = x._events.last()[count:]
    assert (event.kind, event.code, event.command) == (Kind.REFUSED, error, command.number)


@pytest.mark.parametrize("moving", [False, True])
@pytest.mark.parametrize(("call", "name"), ARGUMENTS)
def test_dynamics_out_of_range(call: str, name: str, moving: bool) -> None:
    run, x = ready()
    if moving:
        x.move_absolute(200.0)
        run.step(50)
    most = TOO_MUCH[name]
    function = CALLS[call][0](x)
    for value in (math.nan, math.inf, -math.inf, 0.0, -0.0, -1.0, math.nextafter(most, math.inf), 1e308, HUGE, -HUGE):
        refused(x, lambda value=value: function(**{name: value}), ERROR[name])  # type: ignore[misc]
    assert function(**{name: most}).error is None
    assert function(**{name: int(most)}).error is None or call == "stop"


@pytest.mark.parametrize("moving", [False, True])
@pytest.mark.parametrize("call", TARGETS)
def test_targets_that_are_no_numbers(call: str, moving: bool) -> None:
    run, x = ready()
    if moving:
        x.move_absolute(200.0)
        run.step(50)
    for value in (math.nan, math.inf, -math.inf, HUGE, -HUGE):
        refused(x, lambda value=value: TARGETS[call](x, value), ErrorId.TARGET_NOT_FINITE)  # type: ignore[misc]


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, -5e-324, 1.0000000000000002, 2.0, HUGE])
def test_override_out_of_range(value: float) -> None:
    _, x = ready()
    with pytest.raises(ValueError, match="X: override"):
        x.set_override(value)
    assert x.override == 1.0


@pytest.mark.parametrize("wrong", WRONG_TYPES, ids=[type(value).__name__ for value in WRONG_TYPES])
def test_wrong_types_raise_at_the_call_and_change_nothing(wrong: Any) -> None:
    run, x = ready()
    x.move_absolute(200.0)
    run.step(50)
    before, events = everything(x), x._events.last()
    calls: dict[str, Callable[[], object]] = {
        f"{call}({name})": lambda call=call, name=name: CALLS[call][0](x)(**{name: wrong})  # type: ignore[misc]
        for call, name in ARGUMENTS
    }
    calls |= {call: lambda call=call: TARGETS[call](x, wrong) for call in TARGETS}  # type: ignore[misc]
    calls["set_override"] = lambda: x.set_override(wrong)
    calls["direction"] = lambda: x.move_velocity(10.0, wrong)
    for call in calls:
        with pytest.raises(TypeError):
            calls[call]()
        assert everything(x) == before, call
    assert x._events.last() == events


@pytest.mark.parametrize("call", ["absolute", "relative", "passes"])
def test_a_target_must_be_given(call: str) -> None:
    _, x = ready()
    with pytest.raises(TypeError, match="None"):
        TARGETS[call](x, None)


@pytest.mark.parametrize("wrong", [1, 3, 2, "POSITIVE", None])
def test_a_direction_is_a_direction(wrong: Any) -> None:
    _, x = ready()
    with pytest.raises(TypeError, match=r"direction.*POSITIVE"):
        x.move_velocity(10.0, wrong)


@pytest.mark.parametrize("value", [5, np.float64(5.0), 5.0])
def test_every_kind_of_number_is_taken(value: Any) -> None:
    run, x = ready()
    finish(run, x.move_absolute(value, velocity=value))
    assert x.set_position == 5.0
    assert type(x.set_position) is float


@pytest.mark.parametrize("name", ERROR)
def test_the_message_names_value_range_and_unit(name: str) -> None:
    _, x = ready()
    dynamics: dict[str, Any] = {name: 1e9}
    command = x.move_absolute(10.0, **dynamics)
    for part in ("X", name, "1000000000.0", str(TOO_MUCH[name]), "mm/s"):
        assert part in str(command.error)


@pytest.mark.parametrize("name", ERROR)
@pytest.mark.parametrize("value", [5e-324, 1e-300, 1e-30])
def test_dynamics_near_zero_are_refused_or_obeyed_but_never_harm(name: str, value: Any) -> None:
    run, x = ready()
    move = x.move_absolute(100.0, **{name: value})
    run.step(200)
    assert math.isfinite(x.set_position)
    assert abs(x.set_position) <= 100.0
    if move.error is None:
        assert move.busy
        assert abs(x.set_velocity) <= 500.0
    else:
        assert x.set_position == 0.0


@pytest.mark.parametrize("position", [1e12, 1e100, 1e308, -1e308])
def test_targets_at_the_end_of_the_world(position: float) -> None:
    run, x = ready(software_limit_min=None, software_limit_max=None)
    move = x.move_absolute(position)
    run.step(1000)
    assert math.isfinite(x.set_position)
    if move.error is None:
        assert abs(x.set_velocity) == 500.0
        finish(run, x.stop())
    assert (x.set_velocity, x.error) == (0.0, None)


def test_current_with_a_bad_velocity() -> None:
    _, x = ready()
    refused(x, lambda: x.move_velocity(-10.0, Direction.CURRENT), ErrorId.VELOCITY)


@pytest.mark.parametrize(
    ("name", "arguments", "keywords", "hint"),
    [
        ("move_absolute", (1.0,), {"velocty": 1.0}, "did you mean velocity"),
        ("move_absolute", (1.0,), {"color": 1.0}, "it takes"),
        ("move_velocity", (1.0,), {"position_monitoring": True}, "it takes|did you mean"),
        ("jog", (Direction.POSITIVE,), {"buffer_mode": BufferMode.BUFFERED}, "it takes"),
        ("stop", (), {"buffer_mode": BufferMode.BUFFERED}, "it takes"),
        ("halt", (), {"velocity": 1.0}, "did you mean|it takes"),
    ],
)
def test_a_keyword_that_a_command_does_not_take(
    name: str, arguments: tuple[Any, ...], keywords: dict[str, Any], hint: str
) -> None:
    run, x = ready()
    with pytest.raises(TypeError, match=rf"{name}\(\) takes no keyword {next(iter(keywords))}; ({hint})"):
        getattr(x, name)(*arguments, **keywords)
    assert x.command is None
    run.step()


@pytest.mark.parametrize("value", [1, 0.0, "yes"])
def test_position_monitoring_is_a_bool(value: Any) -> None:
    _, x = ready()
    with pytest.raises(TypeError, match=r"position_monitoring is .*; it must be True or False"):
        x.move_absolute(1.0, position_monitoring=value)
