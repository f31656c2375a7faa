"""MC_Home and MC_SetPosition."""

import functools
import math
from typing import Any, Final, cast

import pytest

from motionlayer import AxisState
from motionlayer.command import ErrorId
from motionlayer.fb import (
    E_EncoderReferenceMode,
    MC_AxisParameter,
    MC_Home,
    MC_MoveAbsolute,
    MC_SetPosition,
    MC_WriteParameter,
    ST_HomingOptions,
    ST_SetPositionOptions,
)
from motionlayer.nc import Calibration, ControlDWord, Direction
from motionlayer.store import Q
from tests.effort import thinned
from tests.machines import SWITCH

from .rig import Rig


def test_a_homing_shows_its_phases_and_ends_homed() -> None:
    rig = Rig(home=SWITCH)
    home = MC_Home(rig.ref)
    rig.watch(home)
    home.Execute = True
    rig.cycle()
    assert (home.Busy, rig.ref.axis.state) == (True, AxisState.HOMING)
    rig.cycle(100)
    status = rig.ref.ReadStatus()
    assert (status.HomingBusy, status.Homed, rig.ref.NcToPlc.HomingState) == (True, False, 2)
    rig.until(lambda: home.Done)
    rig.cycle(2)
    status = rig.ref.ReadStatus()
    assert (status.HomingBusy, status.Homed, rig.ref.NcToPlc.HomingState) == (False, True, 0)
    rig.check()


def test_direct_homing_takes_the_place_and_forcing_only_says_so() -> None:
    rig = Rig(home=SWITCH)
    home = MC_Home(rig.ref)
    rig.cycle(2, lambda: home(Execute=True, Position=33.0, HomingMode=Calibration.DIRECT))
    assert (home.Done, rig.ref.axis.set_position, rig.ref.axis.homed) == (True, 33.0, True)
    for mode, homed in ((Calibration.RESET, False), (Calibration.FORCE, True)):
        rig.cycle(1, lambda: home(Execute=False))
        home.HomingMode = mode
        rig.cycle(2, lambda: home(Execute=True))
        assert (home.Done, rig.ref.axis.homed, rig.ref.axis.set_position) == (True, homed, 33.0)
    rig.check()


@pytest.mark.parametrize(
    ("inputs", "error"),
    [
        ({"HomingMode": 7}, ErrorId.MODE_INVALID),
        ({"Position": math.nan}, ErrorId.TARGET_NOT_FINITE),
        ({"Position": -math.inf}, ErrorId.TARGET_NOT_FINITE),
        ({"Position": 1e300}, ErrorId.SET_POSITION_RANGE),
        ({"Position": -1e300, "HomingMode": Calibration.DIRECT}, ErrorId.SET_POSITION_RANGE),
        ({"Options": ST_HomingOptions(SearchVelocity=math.nan)}, ErrorId.VELOCITY),
        ({"Options": ST_HomingOptions(SearchVelocity=-1.0)}, ErrorId.VELOCITY),
        ({"Options": ST_HomingOptions(SyncVelocity=501.0)}, ErrorId.VELOCITY),
        ({"Options": ST_HomingOptions(SyncVelocity=5e-324)}, ErrorId.VELOCITY),
        ({"Options": ST_HomingOptions(SearchDirection=Direction.SHORTEST_WAY)}, ErrorId.MODE_INVALID),
        ({"Options": ST_HomingOptions(SyncDirection=cast("Direction", 9))}, ErrorId.MODE_INVALID),
        ({"Options": ST_HomingOptions(ReferenceMode=E_EncoderReferenceMode.SOFTWARESYNC)}, ErrorId.REFERENCE_MODE),
    ],
)
def test_a_bad_homing_is_refused(inputs: dict[str, Any], error: ErrorId) -> None:
    rig = Rig(home=SWITCH)
    home = MC_Home(rig.ref)
    rig.cycle(1, lambda: home(Execute=True, **inputs))
    assert (home.Error, home.ErrorID, rig.ref.axis.state) == (True, error, AxisState.STANDSTILL)


CAM: Final = {"mode": "switch", "switch": -50.0, "velocity": 40.0, "position": 7.0}


def test_options_say_how_to_home_and_hold_for_this_homing_alone() -> None:
    """The switch of the machine is taken as a cam: searched fast, left slowly, its edge is the reference."""
    rig = Rig(home=CAM)
    home, axis = MC_Home(rig.ref), rig.ref.axis
    options = ST_HomingOptions(SearchVelocity=80.0, SyncVelocity=5.0, ReferenceMode=E_EncoderReferenceMode.PLCCAM)
    rig.watch(home)
    home.Options, home.Execute, velocities = options, True, []
    rig.until(lambda: home.Done, lambda: velocities.append(axis.set_velocity), ticks=8000)
    assert (min(velocities), max(velocities)) == pytest.approx((-80.0, 5.0))
    assert axis.homed
    assert axis.config.home.velocity == 40.0
    place = axis.set_position - 7.0 - 50.0  # of the drive
    assert -50.0 < place < -49.0
    rig.check()


SIGNALS: Final = CAM | {"pulse": 1.25, "pulse_period": 10.0, "turn": 8.0, "latch": -45.0, "latch_width": 0.5}
REFERENCES: Final = {
    E_EncoderReferenceMode.DEFAULT: -50.0,
    E_EncoderReferenceMode.PLCCAM: -50.0,
    E_EncoderReferenceMode.HARDWARESYNC: -48.75,
    E_EncoderReferenceMode.HARDWARELATCHPOS: -45.0,
    E_EncoderReferenceMode.HARDWARELATCHNEG: -44.5,
    E_EncoderReferenceMode.SOFTWARESYNC: -48.0,
    E_EncoderReferenceMode.SOFTDRIVELATCHPOS: -45.0,
    E_EncoderReferenceMode.SOFTDRIVELATCHNEG: -44.5,
}
"""Drive positions of the references behind the edge at -50; a program is up to 0.04 late to see one."""


@pytest.mark.parametrize("mode", thinned(list(E_EncoderReferenceMode), 2))
def test_every_reference_mode_finds_its_reference(mode: E_EncoderReferenceMode) -> None:
    rig = Rig(home=SIGNALS)
    home = MC_Home(rig.ref)
    rig.watch(home)
    home.Options.ReferenceMode, home.Execute, phases = mode, True, [0]
    rig.until(lambda: home.Done, lambda: phases.append(rig.ref.NcToPlc.HomingState))
    late = 7.0 - float(rig.ref.axis._store.table[Q.SHIFT, 0]) - REFERENCES[mode]
    assert -1e-12 < late <= (0.04 if "SOFTDRIVE" in mode.name else 1e-12)
    assert (5 in phases) == (mode > E_EncoderReferenceMode.PLCCAM)
    rig.check()


def test_a_search_the_other_way_round_turns_the_way_off_the_cam_with_it() -> None:
    rig = Rig(home=CAM | {"mode": "cam", "direction": "positive", "switch": 30.0})
    home = MC_Home(rig.ref)
    rig.watch(home)
    home.Options, home.Execute = ST_HomingOptions(SearchDirection=Direction.NEGATIVE), True
    signal, velocities = home, []

    def place() -> None:
        """A cam of the program at -20 and below."""
        velocities.append(rig.ref.axis.set_velocity)
        signal.bCalibrationCam = rig.ref.axis.actual_position <= -20.0

    rig.until(lambda: home.Done, place)
    assert min(velocities) == -40.0
    assert max(velocities) == 40.0
    assert rig.ref.axis.homed
    rig.check()


def test_a_cam_that_the_program_reads_is_the_reference_where_it_falls() -> None:
    rig = Rig(home={"mode": "direct", "velocity": 40.0, "sync_velocity": 5.0, "position": 7.0})
    home, axis, falling = MC_Home(rig.ref), rig.ref.axis, []
    home.Options.ReferenceMode = E_EncoderReferenceMode.PLCCAM
    rig.watch(home)
    home.Execute = True

    def cam() -> None:
        on = axis.actual_position <= -30.0
        if home.bCalibrationCam and not on:
            falling.append(axis.actual_position)
        home.bCalibrationCam = on

    phases: list[int] = []
    rig.until(lambda: home.Done, cam, lambda: phases.append(rig.ref.NcToPlc.HomingState))
    assert list(dict.fromkeys(phases)) == [0, 2, 3, 4, 6]
    assert (axis.homed, len(falling)) == (True, 1)
    bits = ControlDWord.Enable | ControlDWord.FeedEnablePlus | ControlDWord.FeedEnableMinus
    assert rig.ref.PlcToNc.ControlDWord == bits
    shift = float(axis._store.table[Q.SHIFT, 0])  # the drive counts on as before
    assert falling[0] + shift == pytest.approx(7.0, abs=1e-12)
    assert -30.0 < falling[0] <= -30.0 + 5.0 * 0.001
    rig.check()


def test_an_axis_without_a_cam_drops_the_signal_when_it_is_asked_to_leave() -> None:
    rig = Rig(home={"mode": "direct", "velocity": 40.0, "position": 7.0})
    home = MC_Home(rig.ref)
    home.Options.ReferenceMode, home.bCalibrationCam = E_EncoderReferenceMode.PLCCAM, True
    rig.watch(home)
    home.Execute = True

    def drop() -> None:
        home.bCalibrationCam = rig.ref.NcToPlc.HomingState < 4

    rig.until(lambda: home.Done, drop)
    assert rig.ref.axis.homed
    rig.check()


def test_a_written_velocity_of_the_search_is_that_of_the_next_homing() -> None:
    rig = Rig(home=SWITCH)
    write, home, axis = MC_WriteParameter(rig.ref), MC_Home(rig.ref), rig.ref.axis
    number = MC_AxisParameter.AxisCalibrationVelocityForward
    rig.cycle(2, lambda: write(Execute=True, ParameterNumber=number, Value=25.0))
    rig.watch(home)
    home.Execute, velocities = True, []
    rig.until(lambda: home.Done, lambda: velocities.append(axis.set_velocity))
    assert min(velocities) == -25.0
    rig.check()


@pytest.mark.parametrize("inputs", [{"Position": 1e300}, {"Position": -1e61}, {"Position": 1e300, "Mode": True}])
def test_a_position_beyond_what_can_be_planned_is_not_set(inputs: dict[str, Any]) -> None:
    rig = Rig()
    block = MC_SetPosition(rig.ref)
    rig.cycle(1, lambda: block(Execute=True, **inputs))
    assert (block.ErrorID, rig.ref.axis.set_position) == (ErrorId.SET_POSITION_RANGE, 0.0)


def test_shifts_do_not_add_up_beyond_it() -> None:
    rig = Rig()
    block = MC_SetPosition(rig.ref)
    for error in (0, ErrorId.SET_POSITION_RANGE):
        rig.cycle(2, lambda: block(Execute=True, Position=9e59, Mode=True))
        assert block.ErrorID == error
        rig.cycle(1, lambda: block(Execute=False))


@pytest.mark.parametrize("one", ["Velocity", "Acceleration", "Deceleration", "Jerk"])
def test_a_size_that_cannot_be_planned_is_refused_and_says_so(one: str) -> None:
    """5e-324 is positive, and no profile can be made of it."""
    rig = Rig()
    move = MC_MoveAbsolute(rig.ref)
    inputs = {"Position": 10.0, "Velocity": 10.0} | {one: 5e-324}
    rig.cycle(1, lambda: move(Execute=True, **inputs))
    errors = {
        "Velocity": ErrorId.VELOCITY,
        "Acceleration": ErrorId.ACCELERATION,
        "Deceleration": ErrorId.DECELERATION,
        "Jerk": ErrorId.JERK,
    }
    assert move.ErrorID == errors[one]
    assert any("allowed: 1e-60 <=" in event.text for event in rig.run.trace.events)


@pytest.mark.parametrize(("index", "error"), [(0, 0), (1, ErrorId.ENCODER_ID), (-1, ErrorId.ENCODER_ID)])
def test_an_axis_has_one_encoder_to_choose(index: int, error: int) -> None:
    rig = Rig()
    block = MC_SetPosition(rig.ref)
    block.Options = ST_SetPositionOptions(SelectEncoderIndex=True, EncoderIndex=index)
    rig.cycle(1, lambda: block(Execute=True, Position=5.0))
    assert block.ErrorID == error
    assert rig.ref.axis.set_position == (0.0 if error else 5.0)
    rig.check()


def test_an_encoder_that_is_not_selected_does_not_matter() -> None:
    rig = Rig()
    block = MC_SetPosition(rig.ref)
    block.Options.EncoderIndex = 9
    rig.cycle(2, lambda: block(Execute=True, Position=5.0))
    assert block.Done
    rig.check()


def test_a_position_that_is_ignored_may_be_any() -> None:
    rig = Rig()
    block = MC_SetPosition(rig.ref)
    block.Options.ClearPositionOffset = True
    rig.cycle(2, lambda: block(Execute=True, Position=math.nan))
    assert (block.Done, rig.ref.axis.set_position) == (True, 0.0)
    rig.check()


SHIFTS: Final[tuple[tuple[dict[str, Any], float], ...]] = (
    ({"Position": 50.0}, 50.0),
    ({"Position": -20.0, "Mode": True}, 30.0),
    ({"Options": ST_SetPositionOptions(ClearPositionOffset=True)}, 0.0),
)


def test_a_position_is_set_shifted_and_taken_back() -> None:
    rig = Rig()
    block = MC_SetPosition(rig.ref)
    for inputs, expected in SHIFTS:
        rig.cycle(2, functools.partial(block, Execute=True, **inputs))
        assert (block.Done, rig.ref.axis.set_position) == (True, expected)
        rig.cycle(1, lambda: block(Execute=False))
    rig.check()


def test_a_position_is_not_set_in_motion() -> None:
    rig = Rig()
    move, block = MC_MoveAbsolute(rig.ref), MC_SetPosition(rig.ref)
    rig.cycle(50, lambda: move(Execute=True, Position=100.0, Velocity=100.0))
    rig.cycle(1, lambda: block(Execute=True, Position=0.0))
    assert block.ErrorID == ErrorId.GROUP_BUSY
