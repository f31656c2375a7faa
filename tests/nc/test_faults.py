"""Faults of drives, and what axes do about them."""

from typing import Any

import numpy as np
import pytest

from motionlayer import AxisState, Fault, Simulation
from motionlayer.command import ErrorId
from motionlayer.drive import FAULTS, FaultKind
from motionlayer.event import Kind
from motionlayer.nc import Axis, BufferMode
from motionlayer.verify import assert_valid
from tests.machines import error_of, finish, one_axis, play, state_of
from tests.nc.servos import ready_servos, servo_machine

S = AxisState
ERRORS = {
    "drive_error": (ErrorId.DRIVE_NOT_READY, 0),
    "lost_enable": (ErrorId.NOT_ENABLED, 0),
    "lost_communication": (ErrorId.IO_DATA_INVALID, 3),
    "encoder_jump": (ErrorId.ENCODER, 0),
}


def fault(kind: str) -> Fault:
    if kind == "encoder_jump":
        return Fault(kind, 20.0)
    return Fault(kind, duration=0.05)


def error_in(x: Axis) -> ErrorId | None:
    """Return the error id of an axis; a type checker does not know that it changes between two lines."""
    return x.error.id if x.error is not None else None


def recover(run: Simulation, x: Axis) -> None:
    """Reset, enable, move: the axis goes on from where it stands."""

    async def program() -> None:
        await x.reset()
        assert state_of(x) is S.DISABLED
        await x.enable()
        assert (state_of(x), x.error) == (S.STANDSTILL, None)
        assert x.set_position == x.actual_position
        await x.move_absolute(10.0)

    play(run, program)
    run.step(500)
    assert x.actual_position == pytest.approx(10.0, abs=1e-6)


@pytest.mark.parametrize("kind", ERRORS)
@pytest.mark.parametrize("moving", [True, False])
def test_a_fault_at_an_exact_tick(kind: str, moving: bool) -> None:
    run, (x,) = ready_servos()
    move = x.move_velocity(100.0) if moving else None
    error, later = ERRORS[kind]
    run.inject("X", fault(kind), tick=300)
    run.step(300 + later - run.tick)
    assert error_in(x) is None
    run.step()
    assert state_of(x) is S.ERRORSTOP
    assert error_in(x) is error
    assert move is None or error_of(move) is error
    run.step()
    assert x.enabled == (kind == "lost_communication")  # what is seen of its drive is stale
    run.step(400)
    assert x.set_velocity == 0.0
    assert not x.enabled
    position = x.actual_position
    run.step(50)
    assert x.actual_position == position
    recover(run, x)
    assert_valid(run.trace)


def test_every_command_that_an_error_ends_is_named() -> None:
    run, (x,) = ready_servos()
    x.move_absolute(100.0)
    x.move_relative(50.0, buffer_mode=BufferMode.BUFFERED)
    run.inject("X", fault("lost_enable"), tick=300)
    run.step(400 - run.tick)
    ended = [event.text for event in run.trace.events if event.kind is Kind.ERROR]
    assert ended == [f"{name}: the axis is not enabled" for name in ("X.move_absolute", "X.move_relative")]


def test_the_setpoint_brakes_and_the_drive_brakes_by_itself() -> None:
    run, (x,) = ready_servos(drive={"velocity_feed_forward": 1.0, "dead_time": 0.0, "time_constant": 0.0})
    x.move_velocity(200.0)
    run.inject("X", Fault("drive_error"), tick=900)
    run.step(1200)
    trace = run.trace
    actual = trace["X.actual_position"]
    assert actual[-1] - actual[900] == pytest.approx(200.0**2 / (2.0 * 8000.0), abs=1e-9)
    assert np.abs(np.diff(trace["X.set_acceleration"])).max() <= 1e5 * 0.001 * (1.0 + 1e-9)
    assert_valid(trace)


def test_a_reset_waits_until_the_cause_is_over() -> None:
    run, (x,) = ready_servos()
    run.inject("X", Fault("drive_error", duration=0.1), tick=100)
    run.step(110 - run.tick)
    reset = x.reset()
    run.step(80)
    assert reset.busy
    finish(run, reset)
    assert 200 <= run.tick <= 203
    assert reset.done


def test_actual_values_are_stale_without_communication() -> None:
    run, (x,) = ready_servos(drive={"patience": 20})
    x.move_velocity(100.0)
    run.inject("X", Fault("lost_communication", duration=0.01), tick=300)
    run.step(300 - run.tick)
    before = x.actual_position
    for _ in range(10):
        run.step()
        assert x.actual_position == before
    run.step()
    assert x.actual_position == pytest.approx(before + 11 * 0.1, rel=1e-6)  # it went on with its last velocity
    run.step(100)
    assert x.error is None
    assert_valid(run.trace)


def test_a_small_encoder_jump_is_taken_for_lag() -> None:
    run, (x,) = ready_servos(monitor={"lag": 0.3})
    run.inject("X", Fault("encoder_jump", 0.5), tick=50)
    run.step(60)
    assert error_in(x) is ErrorId.LAG


def test_a_smaller_one_is_driven_out() -> None:
    run, (x,) = ready_servos(monitor={"lag": 1.0})
    run.inject("X", Fault("encoder_jump", 0.5), tick=50)
    run.step(60)
    assert 0.1 < abs(x.lag) < 0.5
    run.step(500)
    assert abs(x.lag) < 1e-6
    assert x.error is None


def test_a_blocked_axis_does_not_move_and_lags() -> None:
    run, (x,) = ready_servos(monitor={"lag": 12.0})
    move = x.move_absolute(300.0)
    run.inject("X", Fault("blocked", duration=1.0), tick=200)
    run.step(200 - run.tick)
    position = x.actual_position
    while move.busy:
        run.step()
        assert x.actual_position == position
    assert error_of(move) is ErrorId.LAG


def test_enabling_fails_with_the_error_of_the_drive() -> None:
    run = Simulation(servo_machine())
    x = run.axes["X"]
    run.inject("X", Fault("drive_error"), tick=0)
    enable = x.enable()
    finish(run, enable)
    assert error_of(enable) is ErrorId.DRIVE_NOT_READY
    finish(run, x.reset())
    finish(run, x.enable())
    assert state_of(x) is S.STANDSTILL


def test_enabling_waits_for_an_open_enable_input() -> None:
    run = Simulation(servo_machine())
    x = run.axes["X"]
    run.inject("X", Fault("lost_enable", duration=0.05), tick=0)
    enable = x.enable()
    assert finish(run, enable) == 51
    assert enable.done


def test_faults_of_the_machine_file() -> None:
    faults = [
        {"axis": "Y", "kind": "blocked", "tick": 7, "duration": 0.01},
        {"axis": "X", "kind": "drive_error", "time": 0.0201},
    ]
    run = Simulation(servo_machine("XY", top={"fault": faults}))
    for axis in run.axes.values():
        axis.enable()
    run.step(21)
    assert error_in(run.axes["X"]) is None
    run.step()
    assert error_in(run.axes["X"]) is ErrorId.DRIVE_NOT_READY
    assert run.axes["Y"].error is None


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (("broken",), "possible are drive_error, encoder_jump"),
        (("encoder_jump",), "must be a finite number"),
        (("encoder_jump", float("nan")), "must be a finite number"),
        (("encoder_jump", 1.0, 2.0), "takes no duration"),
        (("blocked", 1.0), "takes no value"),
        (("blocked", None, 0.0), "must be greater than 0"),
        (("blocked", None, float("nan")), "must be greater than 0"),
    ],
)
def test_a_fault_that_makes_no_sense(arguments: Any, text: str) -> None:
    with pytest.raises(ValueError, match=text):
        Fault(*arguments)


def test_a_fault_where_none_can_be() -> None:
    run, _ = one_axis()
    with pytest.raises(ValueError, match='set kind = "servo"'):
        run.inject("X", Fault("blocked"))
    with pytest.raises(KeyError, match="no axis"):
        run.inject("Q", Fault("blocked"))
    run, _ = ready_servos()
    with pytest.raises(ValueError, match="tick 2 is the next"):
        run.inject("X", Fault("blocked"), tick=1)


def test_a_program_injects_into_the_next_tick() -> None:
    run, (x,) = ready_servos()

    async def program() -> None:
        run.inject("X", Fault("lost_enable"))
        await run.sleep(0.001)
        assert x.error is not None

    play(run, program)


def test_every_kind_is_in_the_table() -> None:
    assert set(FAULTS) == set(FaultKind)


@pytest.mark.parametrize("reaction", ["none", "halt", "stop"])
def test_an_error_concerns_the_axes_of_its_group(reaction: str) -> None:
    groups = {"pair": {"axes": ["X", "Y"], "reaction": reaction}}
    run, (x, y, z) = ready_servos("XYZ", top={"group": groups})
    moves = [axis.move_velocity(100.0, deceleration=500.0) for axis in (x, y, z)]
    run.inject("X", Fault("drive_error"), tick=300)
    run.step(301 - run.tick)
    assert moves[0].error is not None
    run.step()
    expected = {"none": S.CONTINUOUS_MOTION, "halt": S.DISCRETE_MOTION, "stop": S.STOPPING}[reaction]
    assert state_of(y) is expected
    assert moves[1].busy == (reaction == "none")
    assert state_of(z) is S.CONTINUOUS_MOTION
    assert moves[2].busy
    run.step(500)
    assert (y.set_velocity == 0.0) == (reaction != "none")
    assert y.error is None
    assert_valid(run.trace)


def test_a_group_stops_with_the_maximum_dynamics_and_halts_with_those_of_the_motion() -> None:
    ways = []
    for reaction in ("halt", "stop"):
        groups = {"all": {"axes": ["X", "Y"], "reaction": reaction}}
        run, (x, y) = ready_servos("XY", top={"group": groups})
        y.move_velocity(100.0, deceleration=500.0, jerk=5000.0)
        run.step(600)
        begin = y.set_position
        x.fault(ErrorId.INTERNAL)
        run.step(800)
        ways.append(y.set_position - begin)
    assert ways[0] > 3.0 * ways[1]


def test_emergency_stop_stops_everything_that_moves() -> None:
    run, (x, y, z) = ready_servos("XYZ")
    x.move_velocity(300.0, deceleration=500.0)
    y.move_absolute(300.0)
    run.step(200)
    weak = x.stop(deceleration=500.0)
    run.step()
    emergency = run.emergency_stop()
    assert weak.aborted
    assert (state_of(x), state_of(y), state_of(z)) == (S.STOPPING, S.STOPPING, S.STANDSTILL)
    assert error_of(x.move_absolute(0.0)) is ErrorId.LOCKED_BY_STOP
    ticks = 0
    while emergency.busy:
        run.step()
        ticks += 1
    assert ticks == 144  # 500 / 6000 + 6000 / 1e5 s, of Y
    assert (x.set_velocity, y.set_velocity) == (0.0, 0.0)
    assert run.emergency_stop().done
    assert_valid(run.trace)
