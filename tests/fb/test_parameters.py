"""Parameters by number: every entry of the table reads, writes within its range, and holds at once."""

import math
from typing import Any

import numpy as np
import pytest

from motionlayer.bench.campaign._observer import Observer
from motionlayer.command import ErrorId
from motionlayer.event import Kind
from motionlayer.fb import (
    PARAMETERS,
    E_EncoderReferenceMode,
    E_ReadMode,
    MC_AxisParameter,
    MC_Home,
    MC_MoveAbsolute,
    MC_ReadBoolParameter,
    MC_ReadParameter,
    MC_WriteBoolParameter,
    MC_WriteParameter,
)
from motionlayer.verify import verify
from tests.machines import finish

from .rig import Rig

P = MC_AxisParameter
NUMBERS = [name for name, entry in PARAMETERS.items() if entry.kind is float]
FLAGS = [name for name, entry in PARAMETERS.items() if entry.kind is bool]
SWITCHES = [name for name in FLAGS if PARAMETERS[name].write is not None]
WRITABLE = [name for name in NUMBERS if PARAMETERS[name].write is not None]
POSITIONS = [name for name in WRITABLE if "Limit" in name.name or name is P.AxisEncoderHomingCalibValue]
MONITOR = {
    "lag": 5.0, "lag_time": 0.02, "range_window": 5.0, "target_window": 2.0, "target_time": 0.002,
    "target_timeout": 1.0, "motion_window": 1e-6, "motion_time": 0.2,
}  # fmt: skip


def read(rig: Rig, number: int) -> Any:
    block: Any = (MC_ReadBoolParameter if number in FLAGS else MC_ReadParameter)(rig.ref)
    rig.cycle(1, lambda: block(Enable=True, ParameterNumber=number))
    assert block.Valid, hex(block.ErrorID)
    return block.Value


def write(rig: Rig, number: int, value: Any) -> int:
    block: Any = (MC_WriteBoolParameter if number in FLAGS else MC_WriteParameter)(rig.ref)
    observer = Observer()
    rig.cycle(2, lambda: block(Execute=True, ParameterNumber=number, Value=value), lambda: observer.look(block))
    assert block.Done != block.Error
    return int(block.ErrorID)


def test_the_table_is_in_the_order_of_the_numbers() -> None:
    assert list(PARAMETERS) == sorted(PARAMETERS)


def test_numbers_are_those_of_the_compiled_interface() -> None:
    """Motion-layer 2.9; an older list of the same names lacks 1036 and counts on from there."""
    assert (P.AxisEnBacklashCompensation, P.AxisEncoderModuloValue, P.AxisMaximumDeceleration) == (1036, 1045, 1059)


@pytest.mark.parametrize("number", NUMBERS, ids=str)
def test_a_number_is_read_and_not_as_a_bool(number: int) -> None:
    rig = Rig(monitor=MONITOR)
    assert isinstance(read(rig, number), float)
    block = MC_ReadBoolParameter(rig.ref)
    rig.cycle(1, lambda: block(Enable=True, ParameterNumber=number))
    assert (block.Valid, block.ErrorID) == (False, 0x4B05)


@pytest.mark.parametrize("number", SWITCHES, ids=str)
def test_a_switch_is_read_and_not_as_a_number(number: int) -> None:
    rig = Rig(monitor=MONITOR)
    assert read(rig, number) is True
    block = MC_ReadParameter(rig.ref)
    rig.cycle(1, lambda: block(Enable=True, ParameterNumber=number))
    assert (block.Valid, block.ErrorID) == (False, 0x4B05)
    assert write(rig, number, False) == ErrorId.PARAMETER, "what the description has on stays on"


@pytest.mark.parametrize("number", WRITABLE, ids=str)
def test_a_number_inside_its_range_holds_and_bad_ones_change_nothing(number: int) -> None:
    rig = Rig(monitor=MONITOR)
    before = read(rig, number)
    new = before * 0.75 if before else 0.5
    if number in (P.AxisTargetPositionMonitoringTime, P.AxisMotionMonitoringWindow):
        new = before * 2.0
    assert write(rig, number, new) == 0
    assert read(rig, number) == new
    for bad in (math.nan, math.inf, -math.inf, *((-1.0,) if number not in POSITIONS else ())):
        assert write(rig, number, bad) == ErrorId.PARAMETER
    assert read(rig, number) == new
    rig.check()


@pytest.mark.parametrize(
    "number", [P.ActualVelocity, P.AxisCycleTime, P.AxisEncoderReferenceMode, 0, 77, 999, -1, 10**12]
)
def test_what_cannot_be_written_is_refused(number: int) -> None:
    assert write(Rig(), number, 1.0) == 0x4B05


HOMING = (
    P.AxisEncoderHomingInvDirCamSearch,
    P.AxisEncoderHomingInvDirSyncSearch,
    P.AxisEncoderHomingCalibValue,
    P.AxisEncoderReferenceMode,
)


@pytest.mark.parametrize(
    ("home", "shown"),
    [
        (
            {"mode": "direct", "direction": "positive", "position": 7.5},
            (False, True, 7.5, E_EncoderReferenceMode.DEFAULT),
        ),
        (
            {"mode": "cam", "direction": "negative", "switch": 50.0, "position": -3.0},
            (True, False, -3.0, E_EncoderReferenceMode.PLCCAM),
        ),
    ],
)
def test_the_homing_of_the_machine_file_is_read_by_number(home: dict[str, Any], shown: tuple[Any, ...]) -> None:
    rig = Rig(home=home)
    assert tuple(read(rig, number) for number in HOMING) == shown
    assert write(rig, P.AxisEncoderHomingInvDirCamSearch, True) == 0x4B05


def test_a_reference_position_that_is_written_is_that_of_the_next_homing() -> None:
    rig = Rig(home={"mode": "direct", "position": 7.5})
    assert write(rig, P.AxisEncoderHomingCalibValue, -12.25) == 0
    home = MC_Home(rig.ref)
    rig.until(lambda: home.Done, lambda: home(Execute=True))
    assert rig.ref.axis.set_position == -12.25
    rig.check()


@pytest.mark.parametrize(
    ("number", "beyond"),
    [
        (P.AxisMaxVelocity, 500.1),
        (P.AxisMaximumAcceleration, 5000.1),
        (P.AxisMaximumDeceleration, 6000.1),
        (P.MaxJerk, 1e5 + 1.0),
        (P.SWLimitPos, 400.1),
        (P.SWLimitPos, -100.0),
        (P.SWLimitNeg, -100.1),
        (P.SWLimitNeg, 400.0),
        (P.AxisMaxPosLagValue, 5.1),
        (P.AxisTargetPositionMonitoringTime, 0.001),
        (P.AxisModuloToleranceWindow, 361.0),
        (P.AxisMotionMonitoringWindow, 5e-7),
        (P.AxisMotionMonitoringTime, 0.21),
        (P.AxisCalibrationVelocityForward, 500.1),
    ],
)
def test_nothing_goes_beyond_the_machine_description(number: int, beyond: float) -> None:
    rig = Rig(monitor=MONITOR)
    before = read(rig, number)
    assert write(rig, number, beyond) == 0x4B06
    assert read(rig, number) == before


@pytest.mark.parametrize(
    ("number", "told"),
    [
        (P.AxisMaxVelocity, "(AxisMaxVelocity = 1000000.0, allowed: 0.0 < x <= 500.0 °/s)"),
        (P.MaxJerk, "(MaxJerk = 1000000.0, allowed: 0.0 < x <= 100000.0 °/s³)"),
        (P.AxisMaxPosLagFilterTime, "(AxisMaxPosLagFilterTime = 1000000.0, allowed: 0.0 <= x <= 0.02 s)"),
    ],
)
def test_a_refusal_names_value_and_range_in_the_unit_of_the_axis(number: int, told: str) -> None:
    rig = Rig(monitor=MONITOR, unit="°")
    assert write(rig, number, 1e6) == ErrorId.PARAMETER
    (refused,) = (event.text for event in rig.run.events.last() if event.kind is Kind.REFUSED)
    assert told in refused


@pytest.mark.parametrize(
    ("kind", "number", "told"),
    [
        (
            MC_ReadParameter,
            P.EnableLimitPos,
            "(ParameterNumber = 4, allowed: the number of a parameter that is an LREAL)",
        ),
        (MC_ReadBoolParameter, 9999, "(ParameterNumber = 9999, allowed: the number of a parameter that is a BOOL)"),
    ],
)
def test_a_parameter_that_cannot_be_read_is_told_once(kind: type[Any], number: int, told: str) -> None:
    rig = Rig()
    block = kind(rig.ref)
    rig.cycle(5, lambda: block(Enable=True, ParameterNumber=number))
    assert (block.Valid, block.ErrorID) == (False, 0x4B05)
    rig.check()
    refused = [event.text for event in rig.run.trace.events if event.kind is Kind.REFUSED]
    assert len(refused) == 1
    assert told in refused[0]


def test_a_lower_velocity_holds_for_the_next_command_and_takes_the_default_along() -> None:
    rig = Rig()
    assert write(rig, P.AxisMaxVelocity, 100.0) == 0
    move = MC_MoveAbsolute(rig.ref)
    rig.cycle(1, lambda: move(Execute=True, Position=50.0, Velocity=100.1))
    assert move.ErrorID == ErrorId.VELOCITY
    rig.cycle(1, lambda: move(Execute=False))
    finish(rig.run, rig.ref.axis.move_absolute(50.0))
    assert max(abs(rig.run.trace["X.set_velocity"])) == pytest.approx(100.0)


def test_what_a_motion_was_planned_with_changes_at_rest_only() -> None:
    rig = Rig()
    move = MC_MoveAbsolute(rig.ref)
    rig.cycle(20, lambda: move(Execute=True, Position=100.0, Velocity=100.0))
    assert write(rig, P.AxisMaxVelocity, 100.0) == ErrorId.GROUP_BUSY
    assert write(rig, P.SWLimitPos, 90.0) == ErrorId.GROUP_BUSY
    assert write(rig, P.AxisAcc, 100.0) == 0
    rig.check()


def test_a_software_limit_can_be_added_and_taken_away() -> None:
    rig = Rig(software_limit_min=None, software_limit_max=None)
    assert read(rig, P.EnableLimitPos) is False
    assert write(rig, P.SWLimitPos, 30.0) == 0
    assert read(rig, P.SWLimitPos) == 30.0
    move = MC_MoveAbsolute(rig.ref)
    assert write(rig, P.EnableLimitPos, True) == 0
    rig.cycle(1, lambda: move(Execute=True, Position=31.0, Velocity=100.0))
    assert move.ErrorID == ErrorId.TARGET_OUTSIDE_LIMITS
    status = rig.ref.ReadStatus()
    assert (status.SoftLimitMinMonitoring, status.SoftLimitMaxMonitoring) == (False, True)
    assert write(rig, P.EnableLimitPos, False) == 0
    rig.cycle(1, lambda: move(Execute=False))
    rig.cycle(400, lambda: move(Execute=True))
    assert move.Done


def test_a_monitor_can_be_added_and_holds_at_once() -> None:
    rig = Rig(drive={"kind": "servo", "position_gain": 20.0})
    assert write(rig, P.EnablePosLagMonitoring, True) == ErrorId.PARAMETER, "there is no window yet"
    assert write(rig, P.MaxPositionLag, 0.5) == 0
    assert write(rig, P.EnablePosLagMonitoring, True) == 0
    move = MC_MoveAbsolute(rig.ref)
    rig.cycle(300, lambda: move(Execute=True, Position=100.0, Velocity=200.0))
    assert (move.Error, move.ErrorID) == (True, ErrorId.LAG)


def ticks_of_a_move(window: float | None) -> int:
    """Return how long a move takes until it is done, with a target window that is added."""
    rig = Rig(drive={"kind": "servo", "position_gain": 20.0})
    if window is not None:
        assert write(rig, P.AxisTargetPositionWindow, window) == 0
        assert write(rig, P.AxisEnTargetPositionMonitoring, True) == 0
    move = MC_MoveAbsolute(rig.ref)
    return rig.until(lambda: move.Done, lambda: move(Execute=True, Position=50.0, Velocity=200.0))


def test_a_target_window_that_is_added_makes_done_wait() -> None:
    assert ticks_of_a_move(0.05) > ticks_of_a_move(None) + 50


def test_reading_once_and_in_every_call() -> None:
    rig = Rig()
    once, cyclic = MC_ReadParameter(rig.ref), MC_ReadParameter(rig.ref)
    move = MC_MoveAbsolute(rig.ref)

    def calls() -> None:
        once(Enable=True, ParameterNumber=P.CommandedPosition)
        cyclic(Enable=True, ParameterNumber=P.CommandedPosition, ReadMode=E_ReadMode.READMODE_CYCLIC)
        move(Execute=True, Position=50.0, Velocity=200.0)

    rig.cycle(600, calls)
    assert (once.Value, cyclic.Value) == (0.0, 50.0)
    rig.cycle(1, lambda: once(Enable=False))
    assert (once.Valid, once.Value) == (False, 0.0)
    rig.cycle(1, lambda: once(Enable=True))
    assert once.Value == 50.0
    rig.cycle(1, lambda: cyclic(ReadMode=3))
    assert (cyclic.Valid, cyclic.ErrorID) == (False, ErrorId.PARAMETER)


def test_verify_takes_written_limits_and_no_others() -> None:
    """In a trace with a written limit: the limit may change in that tick alone, inside the described one, and holds."""
    rig = Rig()
    assert write(rig, P.SWLimitPos, 60.0) == 0
    rig.cycle(5)
    finish(rig.run, rig.ref.axis.move_absolute(50.0))
    rig.run.step(2)
    trace = rig.run.trace
    limit = trace["X.software_limit_max"]
    written = int(np.argmax(limit < 400.0))
    assert verify(trace).ok

    def found(values: Any, signal: str = "software_limit_max") -> set[str]:
        return {one.rule for one in verify(trace.replace({f"X.{signal}": values})).findings}

    early, late, beyond = limit.copy(), limit.copy(), limit.copy()
    early[written - 1] = 60.0
    late[written + 3 :] = 70.0
    beyond[written:] = 401.0
    assert found(early) == found(late) == {"limit signal"}
    assert "limit signal" in found(beyond)
    lower = limit.copy()
    lower[written:] = 40.0
    assert "software limit" in found(lower), "positions beyond it are judged by the limit that the trace shows"
