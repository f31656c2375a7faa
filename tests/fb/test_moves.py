"""Blocks that move an axis: what they command, and what they show of it."""

from typing import Any

import pytest

from motionlayer import AxisState
from motionlayer.command import ErrorId
from motionlayer.fb import (
    MC_Halt,
    MC_Jog,
    MC_MoveAbsolute,
    MC_MoveAdditive,
    MC_MoveContinuousAbsolute,
    MC_MoveContinuousRelative,
    MC_MoveModulo,
    MC_MoveRelative,
    MC_MoveVelocity,
    MC_Stop,
    ST_MoveOptions,
)
from motionlayer.nc import BufferMode, Direction, JogMode

from .rig import Rig

FAST = {"Velocity": 300.0}


def begun(rig: Rig, block: Any, **inputs: Any) -> Any:
    """Start a block in the next cycle, and watch it from then on."""
    for name, value in inputs.items():
        setattr(block, name, value)
    block.Execute = True
    rig.watch(block)
    rig.cycle()
    return block


@pytest.mark.parametrize(
    ("kind", "inputs", "end"),
    [
        (MC_MoveAbsolute, {"Position": 120.0}, 120.0),
        (MC_MoveRelative, {"Distance": 30.0}, 130.0),
        (MC_MoveAdditive, {"Distance": -20.0}, 80.0),
        (MC_MoveModulo, {"Position": 5.0, "Direction": Direction.NEGATIVE}, 5.0),
    ],
)
def test_a_positioning_is_done_at_its_target(kind: Any, inputs: dict[str, float], end: float) -> None:
    rig = Rig()
    first = begun(rig, MC_MoveAbsolute(rig.ref), Position=100.0, **FAST)
    rig.until(lambda: first.Done)
    move = begun(rig, kind(rig.ref), **FAST, **inputs)
    assert (move.Busy, move.Active, move.Done) == (True, True, False)
    assert rig.ref.axis.state is AxisState.DISCRETE_MOTION
    rig.until(lambda: move.Done)
    assert (move.Busy, move.Active, move.CommandAborted, move.Error) == (False, False, False, False)
    assert rig.ref.axis.set_position == end
    rig.cycle(3)
    assert move.Done
    move.Execute = False
    rig.cycle()
    assert not move.Done
    rig.check()


def test_a_second_block_takes_over_and_a_third_waits() -> None:
    rig = Rig()
    first, second, third = (MC_MoveAbsolute(rig.ref) for _ in range(3))
    begun(rig, first, Position=300.0, **FAST)
    rig.cycle(100)
    begun(rig, second, Position=350.0, **FAST)
    rig.cycle()
    assert first.CommandAborted
    begun(rig, third, Position=100.0, BufferMode=BufferMode.BUFFERED, **FAST)
    assert (third.Busy, third.Active) == (True, False)
    rig.cycle()
    assert rig.ref.NcToPlc.SafEntries == 2
    assert rig.ref.ReadStatus().CmdBuffered
    rig.until(lambda: second.Done)
    rig.cycle()
    assert third.Active
    rig.until(lambda: third.Done)
    assert rig.ref.axis.set_position == 100.0
    rig.check()


def test_a_blend_passes_the_first_target_without_rest() -> None:
    rig = Rig()
    first, second = MC_MoveAbsolute(rig.ref), MC_MoveAbsolute(rig.ref)
    begun(rig, first, Position=100.0, Velocity=300.0)
    begun(rig, second, Position=200.0, Velocity=200.0, BufferMode=BufferMode.BLENDING_LOW)
    rig.until(lambda: first.Done)
    assert rig.ref.axis.set_velocity == pytest.approx(200.0)
    rig.until(lambda: second.Done)
    rig.check()


def test_a_blending_position_hands_over_before_the_target() -> None:
    rig = Rig()
    first, second = MC_MoveAbsolute(rig.ref), MC_MoveAbsolute(rig.ref)
    begun(rig, first, Position=200.0, Velocity=300.0)
    options = ST_MoveOptions(EnableBlendingPosition=True, BlendingPosition=120.0)
    begun(rig, second, Position=300.0, Velocity=300.0, BufferMode=BufferMode.BLENDING_NEXT, Options=options)
    rig.until(lambda: first.Done)
    assert rig.ref.axis.set_position == pytest.approx(120.0, abs=1.0)
    rig.check()


def test_an_endless_move_stays_busy_until_another_one_takes_over() -> None:
    rig = Rig()
    move = begun(rig, MC_MoveVelocity(rig.ref), Velocity=100.0)
    assert rig.ref.axis.state is AxisState.CONTINUOUS_MOTION
    assert not move.InVelocity
    rig.until(lambda: move.InVelocity)
    rig.cycle(50)
    assert (move.Busy, move.Active, move.InVelocity, move.Done) == (True, True, True, False)
    halt = begun(rig, MC_Halt(rig.ref))
    rig.cycle()
    assert (move.Busy, move.InVelocity, move.CommandAborted) == (False, False, True)
    rig.until(lambda: halt.Done)
    assert rig.ref.axis.set_velocity == 0.0
    rig.check()


@pytest.mark.parametrize("continuous", [False, True])
def test_an_axis_that_override_0_holds_is_not_in_velocity(continuous: bool) -> None:
    """At 0 % the setpoint rests: the commanded velocity is not reached, although 0 is its share."""
    rig = Rig()
    if continuous:
        move = begun(rig, MC_MoveContinuousAbsolute(rig.ref), Position=20.0, EndVelocity=60.0, Velocity=100.0)
        goal = "InEndVelocity"
    else:
        move = begun(rig, MC_MoveVelocity(rig.ref), Velocity=100.0)
        goal = "InVelocity"
    rig.until(lambda: bool(getattr(move, goal)))
    rig.power[0].Override = 0.0
    rig.cycle(100, rig.power[0])
    assert rig.ref.axis.set_velocity == 0.0
    assert (move.Busy, move.Active, getattr(move, goal)) == (True, True, False)
    rig.power[0].Override = 100.0
    rig.cycle(1, rig.power[0])
    rig.until(lambda: bool(getattr(move, goal)))
    rig.check()


def test_a_changed_override_takes_in_velocity_back_until_it_is_reached_again() -> None:
    rig = Rig()
    move = begun(rig, MC_MoveVelocity(rig.ref), Velocity=100.0)
    rig.until(lambda: move.InVelocity)
    rig.power[0].Override = 50.0
    rig.cycle(2, rig.power[0])
    assert (move.Busy, move.InVelocity) == (True, False)
    rig.until(lambda: move.InVelocity)
    assert rig.ref.axis.set_velocity == 50.0
    assert rig.ref.PlcToNc.Override == 500_000
    rig.check()


@pytest.mark.parametrize(
    ("kind", "inputs"),
    [(MC_MoveContinuousAbsolute, {"Position": 80.0}), (MC_MoveContinuousRelative, {"Distance": 80.0})],
)
def test_a_continuous_move_passes_its_position_and_goes_on(kind: Any, inputs: dict[str, float]) -> None:
    rig = Rig()
    move = begun(rig, kind(rig.ref), EndVelocity=40.0, **FAST, **inputs)
    rig.until(lambda: move.InEndVelocity)
    assert rig.ref.axis.set_velocity == pytest.approx(40.0)
    assert 80.0 <= rig.ref.axis.set_position < 80.2
    rig.cycle(20)
    assert (move.Busy, move.Active, move.InEndVelocity) == (True, True, True)
    rig.check()


def test_a_stop_locks_the_axis_as_long_as_execute_is_true() -> None:
    rig = Rig()
    move, late = begun(rig, MC_MoveAbsolute(rig.ref), Position=300.0, **FAST), MC_MoveAbsolute(rig.ref)
    rig.cycle(100)
    stop = begun(rig, MC_Stop(rig.ref))
    rig.cycle()
    assert move.CommandAborted
    rig.until(lambda: stop.Done)
    assert (stop.Busy, stop.Active, stop.Done) == (True, True, True)
    begun(rig, late, Position=0.0, **FAST)
    assert (late.Error, late.ErrorID) == (True, ErrorId.LOCKED_BY_STOP)
    assert rig.ref.ReadStatus().MotionCommandsLocked
    assert rig.ref.Status.MotionState is AxisState.STOPPING
    stop.Execute = False
    rig.until(lambda: not stop.Busy, ticks=5)
    rig.cycle(2)
    assert rig.ref.axis.state is AxisState.STANDSTILL
    assert not rig.ref.ReadStatus().MotionCommandsLocked
    late.Execute = False
    rig.cycle()
    late.Execute = True
    rig.cycle()
    assert late.Busy
    rig.check()


def test_a_second_stop_is_refused() -> None:
    rig = Rig()
    begun(rig, MC_MoveVelocity(rig.ref), Velocity=100.0)
    rig.cycle(100)
    begun(rig, MC_Stop(rig.ref))
    assert begun(rig, MC_Stop(rig.ref)).ErrorID == ErrorId.STOP_ACTIVE
    rig.check()


@pytest.mark.parametrize("forward", [True, False])
@pytest.mark.parametrize(
    ("mode", "velocity"),
    [(JogMode.STANDARD_SLOW, 25.0), (JogMode.STANDARD_FAST, 150.0), (JogMode.CONTINUOUS, 60.0)],
)
def test_a_key_moves_the_axis_while_it_is_held(forward: bool, mode: JogMode, velocity: float) -> None:
    rig = Rig()
    jog = MC_Jog(rig.ref)
    key = {"JogForward": True} if forward else {"JogBackwards": True}
    rig.cycle(100, lambda: jog(Mode=mode, Velocity=60.0, **key))
    assert (jog.Busy, jog.Active) == (True, True)
    assert rig.ref.axis.set_velocity == (velocity if forward else -velocity)
    rig.until(lambda: jog.Done, lambda: jog(JogForward=False, JogBackwards=False))
    assert not jog.Busy
    rig.cycle(1, jog)
    assert not jog.Done
    assert rig.ref.axis.set_velocity == 0.0
    rig.check()


def test_forward_wins_where_both_keys_come_together_and_no_other_edge_counts_in_motion() -> None:
    rig = Rig()
    jog = MC_Jog(rig.ref)
    rig.cycle(50, lambda: jog(JogForward=True, JogBackwards=True))
    assert rig.ref.axis.set_velocity > 0.0
    rig.until(lambda: not jog.Busy, lambda: jog(JogForward=False))
    rig.cycle(50, jog)
    assert rig.ref.axis.set_velocity == 0.0, "a key that is still held is no edge"
    rig.check()


def test_inching_goes_one_step_per_edge_and_to_multiples() -> None:
    rig = Rig()
    jog = MC_Jog(rig.ref)
    inputs = {"Mode": JogMode.INCHING, "Velocity": 50.0, "Position": 2.3}
    rig.until(lambda: jog.Done, lambda: jog(JogForward=True, **inputs))
    assert rig.ref.axis.set_position == 2.3
    rig.cycle(20, jog)
    assert (jog.Done, rig.ref.axis.set_position) == (True, 2.3)
    rig.cycle(2, lambda: jog(JogForward=False))
    jog.Position = 1.0
    rig.until(lambda: jog.Done, lambda: jog(JogBackwards=True, Mode=JogMode.INCHING_MODULO))
    assert rig.ref.axis.set_position == 2.0
    rig.check()


def test_the_axis_may_come_with_the_call() -> None:
    rig = Rig(2)
    move = MC_MoveAbsolute()
    with pytest.raises(TypeError, match="MC_MoveAbsolute: Axis is None; give an AXIS_REF"):
        move(Execute=True)
    rig.cycle(1, lambda: move(Axis=rig.refs[1], Execute=True, Position=10.0, Velocity=50.0))
    assert [ref.axis.command is not None for ref in rig.refs] == [False, True]


def hash_of(calls: int) -> str:
    """Return the hash of a move whose block is called so many times per cycle."""
    rig = Rig()
    move = MC_MoveAbsolute(rig.ref)
    rig.cycle(600, *[lambda: move(Execute=True, Position=100.0, **FAST)] * calls)
    assert move.Done
    return rig.run.trace.hash


def test_calling_a_block_more_often_changes_nothing() -> None:
    assert hash_of(1) == hash_of(3)


def test_a_block_that_was_not_called_while_another_took_over_says_so() -> None:
    rig = Rig()
    move, other = MC_MoveAbsolute(rig.ref), MC_MoveAbsolute(rig.ref)
    rig.cycle(1, lambda: move(Execute=True, Position=300.0, **FAST))
    rig.cycle(5, lambda: other(Execute=True, Position=200.0, **FAST))
    rig.cycle(1, move)
    assert (move.Error, move.ErrorID) == (True, ErrorId.NOT_CALLED_CYCLICALLY)


def test_a_block_of_a_slow_task_is_called_often_enough() -> None:
    rig = Rig(top={"task": {"slow": {"every": 10, "phase": 0}}})
    move, other = MC_MoveAbsolute(rig.ref), MC_MoveAbsolute(rig.ref)
    rig.run.cyclic(lambda _run: move(Execute=True, Position=300.0, **FAST), task="slow")
    rig.cycle(45)
    rig.cycle(1, lambda: other(Execute=True, Position=200.0, **FAST))
    rig.cycle(10)
    assert (move.CommandAborted, move.Error) == (True, False)


@pytest.mark.parametrize(
    ("number", "mode"),
    [
        (18, BufferMode.BLENDING_LOW),
        (19, BufferMode.BLENDING_PREVIOUS),
        (20, BufferMode.BLENDING_NEXT),
        (21, BufferMode.BLENDING_HIGH),
    ],
)
def test_numbers_of_buffer_modes_are_also_those_of_the_interface(number: int, mode: BufferMode) -> None:
    """The same two moves with either number take the same way."""
    ways = []
    for given in (number, mode):
        rig = Rig()
        begun(rig, MC_MoveAbsolute(rig.ref), Position=50.0, Velocity=200.0)
        second = begun(rig, MC_MoveAbsolute(rig.ref), Position=100.0, Velocity=80.0, BufferMode=given)
        rig.cycle(2000)
        assert second.Done
        rig.check()
        ways.append(rig.run.trace.hash)
    assert ways[0] == ways[1]


@pytest.mark.parametrize("number", [-1, 6, 17, 22])
def test_a_number_that_is_no_buffer_mode_is_refused(number: int) -> None:
    rig = Rig()
    move = begun(rig, MC_MoveAbsolute(rig.ref), Position=50.0, BufferMode=number, **FAST)
    assert (move.Error, move.ErrorID) == (True, ErrorId.BUFFER_MODE)
    rig.check()
