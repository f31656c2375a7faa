"""AXIS_HOME and its calibration signal (motion-layer 5.7)."""

from typing import Any

import pytest

from motionlayer.command import ErrorId
from motionlayer.fb import E_EncoderReferenceMode
from motionlayer.layer import AxisCommand, Progress
from motionlayer.layer.types import HomingMode
from tests.layer.rig import FAILED, SIMPLE, Rig, aim, place
from tests.machines import SWITCH

C, P = AxisCommand, Progress


def homing(rig: Rig, **flags: bool) -> None:
    """Ask for a homing by a cam that the client reads."""
    params = rig.x.home.parameters
    params.position, params.mode = 5.0, HomingMode.DEFAULT
    params.options.reference_mode = E_EncoderReferenceMode.PLCCAM
    for name, value in flags.items():
        setattr(params, name, value)


CAM: dict[str, Any] = {"home": {"mode": "direct", "velocity": 40.0, "sync_velocity": 5.0, "direction": "negative"}}


@pytest.mark.parametrize(
    ("flags", "switch", "inverted"),
    [
        ({}, "calibrate", False),
        ({"invert_sensor": True}, "calibrate", True),
        ({"home_on_limit_min": True}, "minimum", False),
        ({"home_on_limit_min": True, "invert_limit_min": True}, "minimum", True),
        ({"home_on_limit_max": True}, "maximum", False),
        ({"home_on_limit_max": True, "invert_limit_max": True}, "maximum", True),
        ({"home_on_limit_max": True, "invert_sensor": True}, "maximum", False),
    ],
    ids=str,
)
def test_d09_d10_the_signal_is_told_in_every_cycle_from_its_source_with_its_own_flag(
    flags: dict[str, bool], switch: str, inverted: bool
) -> None:
    rig = Rig(**CAM)
    setattr(rig.x.limit_switches, switch, inverted)
    rig.ready()
    homing(rig, **flags)
    axis = rig.run.axes["X"]

    def cam() -> bool:
        setattr(rig.x.limit_switches, switch, (axis.actual_position < -20.0) is not inverted)
        return rig.x.state.code in (9011, 10011)

    rig.drop(C.HOME)
    rig.until(cam)
    assert rig.x.state.code == 10011
    assert rig.x.info.referenced
    rig.check()


def test_a_simulated_signal_follows_the_phase_of_the_homing() -> None:
    rig = Rig(**CAM).ready()
    homing(rig, simulate_sensor=True)
    assert rig.do(C.HOME) == SIMPLE
    assert rig.x.info.referenced
    rig.check()


def test_the_switch_of_a_drive_is_a_signal_as_well() -> None:
    rig = Rig(home=SWITCH).ready()
    assert rig.do(C.HOME) == SIMPLE
    assert rig.x.info.referenced
    rig.check()


def test_a_homed_axis_is_homed_again() -> None:
    rig = Rig().ready(home=True)
    rig.do(C.NULL)
    assert rig.x.info.referenced
    rig.x.home.parameters.position = 12.0
    assert rig.do(C.HOME) == [P.INIT, P.STARTUP, P.OCCUPIED, P.DONE]
    assert place(rig) == 12.0
    rig.check()


def test_d07_home_ends_in_error_when_it_cannot_begin() -> None:
    rig = Rig().ready(home=True)
    aim(rig, 0.0, 50.0)
    rig.do(C.MOVE_VELO)
    assert rig.do(C.HOME)[-1] == P.ERROR
    assert rig.x.info.error_id == ErrorId.CANNOT_START
    rig.do(C.STOP)
    rig.check()


@pytest.mark.parametrize("mode", [HomingMode.BLOCK, HomingMode.ABSOLUTE, 77])
def test_a_homing_mode_that_there_is_not_is_refused(mode: int) -> None:
    rig = Rig().ready()
    rig.x.home.parameters.mode = mode
    assert rig.do(C.HOME) == FAILED
    assert rig.x.info.error_id == ErrorId.MODE_INVALID
    assert not rig.x.info.referenced


def test_the_switch_of_a_drive_is_shown_as_calibration_cam_unless_a_client_writes_it() -> None:
    rig = Rig(2, home=SWITCH).ready()
    one, two = rig.layer.axis
    two.limit_switches.calibrate = False
    for each in (one, two):
        each.data.position, each.data.velocity = -60.0, 200.0
        each.ctrl.cmd = C.MOVE_POS
    rig.until(lambda: two.state.code == 10012)
    assert (one.limit_switches.calibrate, two.limit_switches.calibrate) == (True, False)
    one.data.position = 0.0
    rig.do(C.NULL)
    rig.do(C.MOVE_POS)
    assert not one.limit_switches.calibrate
    rig.check()


def homed_at(rig: Rig) -> float:
    """Home by the layer, and return where the axis then is."""
    assert rig.do(C.HOME)[-1] == P.DONE
    rig.check()
    return place(rig)


def test_the_reference_has_the_position_of_the_machine_file_until_a_client_gives_another() -> None:
    by_method, by_layer, by_client = (Rig(home=SWITCH | {"position": -7.5}).ready() for _ in range(3))
    command = by_method.run.axes["X"].home()
    by_method.until(lambda: command.done)
    by_method.check()
    assert homed_at(by_layer) == pytest.approx(place(by_method), abs=1e-9)
    by_client.x.home.parameters.position = 2.5
    assert homed_at(by_client) == pytest.approx(place(by_method) + 10.0, abs=1e-9)


def test_a_reset_gives_the_reference_its_position_back() -> None:
    rig = Rig(home=SWITCH | {"position": -7.5})
    rig.x.home.parameters.position = 2.5
    rig.cycle(3)
    rig.run.reset()
    assert rig.x.home.parameters.position == -7.5
