"""MC_Home and MC_SetPosition."""

import functools
import math
from typing import Any, Final

import pytest

from motionlayer import AxisState
from motionlayer.command import ErrorId
from motionlayer.fb import MC_Home, MC_MoveAbsolute, MC_SetPosition, ST_SetPositionOptions
from motionlayer.nc import Calibration
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
    ],
)
def test_a_bad_homing_is_refused(inputs: dict[str, float], error: ErrorId) -> None:
    rig = Rig(home=SWITCH)
    home = MC_Home(rig.ref)
    rig.cycle(1, lambda: home(Execute=True, **inputs))
    assert (home.Error, home.ErrorID) == (True, error)


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
