"""MC_Power, MC_Reset and MC_SetOverride."""

import math
from functools import partial

import pytest

from motionlayer import AxisState
from motionlayer.command import ErrorId
from motionlayer.drive import Fault
from motionlayer.event import Kind
from motionlayer.fb import MC_MoveAbsolute, MC_MoveVelocity, MC_Power, MC_Reset, MC_SetOverride, MC_Stop
from motionlayer.nc import BufferMode, Direction
from tests.nc.servos import SERVO

from .rig import Rig

FAST = {"Velocity": 300.0}


def test_power_makes_the_axis_ready_and_takes_it_away() -> None:
    rig = Rig(power=False)
    power = MC_Power(rig.ref)
    rig.cycle(1, power)
    assert (power.Busy, power.Status, power.Error) == (False, False, False)
    rig.cycle(3, lambda: power(Enable=True, Enable_Positive=True, Enable_Negative=True))
    assert (power.Busy, power.Active, power.Status) == (True, True, True)
    assert rig.ref.PlcToNc.ControlDWord == 0b111
    rig.cycle(3, lambda: power(Enable=False))
    assert (power.Busy, power.Status, rig.ref.axis.state) == (False, False, AxisState.DISABLED)
    assert rig.ref.PlcToNc.ControlDWord == 0
    rig.check()


def test_without_feed_enable_a_direction_is_refused_until_it_is_released() -> None:
    rig = Rig(power=False)
    power, move = MC_Power(rig.ref), MC_MoveAbsolute(rig.ref)
    rig.cycle(3, lambda: power(Enable=True, Enable_Positive=True))
    rig.cycle(1, lambda: move(Execute=True, Position=-80.0, **FAST))
    assert move.ErrorID == ErrorId.FEED_NOT_ENABLED
    rig.cycle(1, lambda: move(Execute=False))
    rig.cycle(1, lambda: power(Enable_Negative=True), lambda: move(Execute=True))
    assert move.Busy
    rig.cycle(80, power, move)
    rig.cycle(300, lambda: power(Enable_Negative=False), move)
    assert (move.CommandAborted, rig.ref.axis.set_velocity) == (True, 0.0)
    assert rig.ref.axis.set_position > -80.0
    rig.check()


def test_the_end_of_enable_waits_for_the_job_where_it_shall() -> None:
    rig = Rig()
    power, move = rig.power[0], MC_MoveAbsolute(rig.ref)
    rig.cycle(1, lambda: move(Execute=True, Position=50.0, **FAST))
    rig.cycle(2, lambda: power(Enable=False, BufferMode=BufferMode.BUFFERED), move)
    assert move.Busy
    rig.until(lambda: move.Done, power, move)
    rig.cycle(3, power)
    assert rig.ref.axis.state is AxisState.DISABLED
    rig.check()


def test_power_that_is_asked_for_while_the_axis_brakes_comes_back_without_an_error() -> None:
    rig = Rig()
    power, move, errors = rig.power[0], MC_MoveVelocity(rig.ref), []
    rig.cycle(100, lambda: move(Execute=True, **FAST))
    rig.cycle(2, lambda: power(Enable=False), move)
    assert (rig.ref.axis.state, move.CommandAborted) == (AxisState.STOPPING, True)

    def again() -> None:
        power(Enable=True)
        errors.append(power.Error)

    rig.cycle(2, again)
    assert (rig.ref.axis.state, power.Status) == (AxisState.STOPPING, True)  # it brakes to the end, with power
    rig.until(lambda: rig.ref.axis.state is not AxisState.STOPPING, again)
    rig.cycle(5, again)
    assert (rig.ref.axis.state, power.Status, any(errors)) == (AxisState.STANDSTILL, True, False)
    rig.check()


def test_a_direction_released_during_a_stop_is_free_after_it() -> None:
    rig = Rig(power=False)
    power, stop, move = MC_Power(rig.ref), MC_Stop(rig.ref), MC_MoveVelocity(rig.ref)
    rig.cycle(3, lambda: power(Enable=True, Enable_Positive=True))
    rig.cycle(100, power, lambda: move(Execute=True, **FAST))
    rig.cycle(2, power, lambda: move(Execute=False), lambda: stop(Execute=True))
    rig.until(lambda: stop.Done, lambda: power(Enable_Negative=True), stop)
    assert (power.Error, rig.ref.axis.state) == (False, AxisState.STOPPING)
    rig.cycle(3, lambda: stop(Execute=False), power)
    rig.cycle(1, lambda: move(Execute=True, Direction=Direction.NEGATIVE), power)
    assert move.Busy
    rig.cycle(20, power, move)
    assert rig.ref.axis.set_velocity < 0.0
    rig.check()


def test_an_unknown_buffer_mode_of_power_is_told_once() -> None:
    rig = Rig()
    power = rig.power[0]
    rig.cycle(20, lambda: power(Enable=False, BufferMode=9))
    assert (power.Error, power.ErrorID, power.Status) == (True, ErrorId.BUFFER_MODE, True)
    assert [event.code for event in rig.run.trace.events if event.kind is Kind.REFUSED] == [ErrorId.BUFFER_MODE]


def test_power_that_an_error_took_away_comes_back_after_a_reset() -> None:
    rig = Rig(drive=SERVO)
    power, reset, move = rig.power[0], MC_Reset(rig.ref), MC_MoveAbsolute(rig.ref)
    rig.cycle(1, lambda: move(Execute=True, Position=50.0, **FAST))
    rig.run.inject("X", Fault("drive_error"))
    rig.cycle(200, power, move)
    assert (move.Error, move.ErrorID) == (True, ErrorId.DRIVE_NOT_READY)
    assert (power.Error, power.ErrorID) == (True, ErrorId.DRIVE_NOT_READY)
    assert rig.ref.ReadStatus().Error
    assert rig.ref.NcToPlc.ErrorCode == ErrorId.DRIVE_NOT_READY
    rig.until(lambda: reset.Done, power, lambda: reset(Execute=True))
    rig.until(lambda: power.Status, power, ticks=20)
    assert (power.Error, rig.ref.axis.state) == (False, AxisState.STANDSTILL)
    assert rig.ref.NcToPlc.ErrorCode == 0
    refused = [event for event in rig.run.trace.events if event.kind is Kind.REFUSED]
    assert len(refused) <= 1, "in the same state nothing is asked again"


@pytest.mark.parametrize("value", [-1.0, 100.1, math.nan, math.inf])
def test_a_bad_override_changes_nothing(value: float) -> None:
    rig = Rig()
    rig.cycle(1, lambda: rig.power[0](Override=value))
    assert (rig.power[0].ErrorID, rig.ref.axis.override) == (ErrorId.PARAMETER, 1.0)
    override = MC_SetOverride(rig.ref)
    rig.cycle(1, lambda: override(Enable=True, VelFactor=value))
    assert (override.Enabled, override.ErrorID) == (False, ErrorId.PARAMETER) if value != 1.0 else True
    rig.cycle(1, lambda: rig.power[0](Override=50.0))
    assert (rig.power[0].Error, rig.ref.axis.override) == (False, 0.5)


def test_a_bad_override_is_told_once_and_again_after_a_good_one() -> None:
    rig = Rig()
    override = MC_SetOverride(rig.ref)
    for value in (1.5, 0.5, 1.5):
        rig.cycle(5, partial(rig.power[0], Override=100.0 * value))
    rig.cycle(1, lambda: rig.power[0](Override=50.0))
    for value in (-0.5, 0.5, -0.5):
        rig.cycle(5, partial(override, Enable=True, VelFactor=value))
    rig.check()
    refused = [event for event in rig.run.trace.events if event.kind is Kind.REFUSED]
    assert [event.code for event in refused] == [ErrorId.PARAMETER] * 4
    assert "(Override = 150.0, allowed: 0 to 100 %)" in refused[0].text
    assert "(VelFactor = -0.5, allowed: 0 to 1)" in refused[2].text


def test_the_override_scales_velocity_and_holds_at_zero() -> None:
    rig = Rig()
    override, move = MC_SetOverride(rig.ref), MC_MoveVelocity(rig.ref)
    rig.watch(move)
    move.Execute, move.Velocity = True, 100.0
    rig.cycle(300, lambda: override(Enable=True, VelFactor=0.5))
    assert (override.Enabled, move.InVelocity, rig.ref.axis.set_velocity) == (True, True, 50.0)
    rig.cycle(300, lambda: override(VelFactor=0.0))
    assert (rig.ref.NcToPlc.AxisState, move.Busy, rig.ref.axis.set_velocity) == (2, True, 0.0)
    rig.cycle(1, lambda: override(Enable=False))
    assert not override.Enabled
    rig.check()
