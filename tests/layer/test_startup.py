"""The start-up brings the axes up one after the other (motion-layer 1.6)."""

from typing import Any

import pytest

from motionlayer.drive import Fault
from motionlayer.event import Level, Subdevice
from motionlayer.layer import AxisCommand, Progress
from motionlayer.layer.types import AxisEncoderType
from tests.layer.rig import Rig, shown

C, P = AxisCommand, Progress
SERVO: dict[str, Any] = {"drive": {"kind": "servo", "position_gain": 100.0}}


def steps(rig: Rig, ticks: int) -> list[int]:
    """Run cycles, and return what `MAIN_AXIS.eInit` has shown."""
    seen = []
    for _ in range(ticks):
        rig.cycle()
        seen.append(int(rig.layer.globals.program.axis.value))
    return list(shown(seen))


def test_one_axis_after_the_other_shows_its_steps() -> None:
    rig = Rig(2, up=False)
    assert steps(rig, 40) == [1000, 2000, *[3000, 4000, 5000] * 2, 6000, 10000]
    assert rig.layer.ready
    assert [one.state.code for one in rig.layer.axis] == [10001, 10001]
    assert [one.ctrl.cmd for one in rig.layer.axis] == [C.INIT, C.INIT]


def test_the_layer_writes_over_what_a_client_has_dropped() -> None:
    rig = Rig(up=False)
    rig.x.ctrl.cmd = C.ENABLE
    rig.until(lambda: rig.layer.ready)
    assert rig.x.state.code == 10001
    assert not rig.x.info.enabled
    rig.check()


@pytest.mark.parametrize("ticks", range(9))
def test_a_command_that_the_start_up_takes_away_is_told_once_with_the_way_out(ticks: int) -> None:
    rig = Rig(up=False)
    rig.cycle(ticks)
    rig.x.ctrl.cmd = C.ENABLE
    rig.until(lambda: rig.layer.ready)
    rig.until(lambda: rig.x.state.split().progress in (P.DONE, P.ERROR))
    lost = [text for text in rig.texts(Subdevice.MainInit) if "AXIS_ENABLE" in text]
    if rig.x.ctrl.cmd == C.ENABLE:  # the start-up had done with the axis
        assert rig.x.state.code == C.ENABLE + P.DONE
        assert not lost
    else:
        assert rig.x.state.code == C.INIT + P.DONE
        (text,) = lost
        assert text.startswith("GVL_AXIS.Ctrl[1]: AXIS_ENABLE comes before the start-up has ended, and is overwritten")
        assert text.endswith("wait for MAIN_AXIS.eInit = 10000 before the first command")
    rig.check()


def test_it_says_what_it_does() -> None:
    rig = Rig(2)
    main = [(event.level, event.text, event.code) for event in rig.messages if event.subdevice == Subdevice.MainInit]
    assert main == [
        (Level.INFO, "MAIN_AXIS.eInit: PROGRESS_INIT", 2),
        (Level.VERBOSE, "AxisInit Index: 1", 1),
        (Level.VERBOSE, "AxisInit Index: 2", 2),
        (Level.INFO, "MAIN_AXIS.eInit: PROGRESS_DONE", 2),
    ]
    assert rig.texts(Subdevice.AxisStartUp)[:4] == [
        "StartUp NcAxisId: 1",
        "Encoder Type: Simulation_Encoder",
        "Axis Name: X",
        "Axis Init: NO NAME : PROGRESS_DONE",
    ]


def test_a_drive_behind_an_encoder_is_asked_for_its_name() -> None:
    rig = Rig(**SERVO)
    assert list(shown(rig.codes[0])) == [9000, 1001, 4001, 3001, 5001, 6001, 10001]
    assert rig.x.state.view.encoder == AxisEncoderType.TCom_Encoder_SoftDrive


def test_d63_an_axis_that_fails_stops_no_other_and_a_new_init_lets_the_start_up_go_on() -> None:
    rig = Rig(2, up=False, options={"timeout": 0.05}, **SERVO)
    rig.run.inject("Y", Fault("drive_error", duration=0.5), 1)
    main = rig.layer.globals.program.axis
    rig.until(lambda: main.value == P.ERROR)
    assert rig.layer.axis[2].state.code == 9001
    assert any(text == "MAIN_AXIS.eInit ERROR at Index: 2" for text in rig.texts(Subdevice.MainInit))
    assert rig.do(C.ENABLE)[-1] == P.DONE, "the other axis works"
    assert rig.layer.axis[2].state.code == 9001
    rig.cycle(500)
    rig.do(C.NULL, 2)
    assert rig.do(C.INIT, 2)[-1] == P.DONE
    rig.cycle(5)
    assert main.value == P.DONE
    rig.check()


def test_programs_that_are_not_built_in_wait_for_the_axes_and_say_so() -> None:
    rig = Rig(up=False)
    programs = rig.layer.globals.program
    others = [programs.functions, programs.nci, programs.cam, programs.saw]
    rig.cycle(5)
    assert {int(one.value) for one in others} == {P.INVALID}
    rig.until(lambda: rig.layer.ready)
    rig.cycle()
    assert {int(one.value) for one in others} == {P.NOT_EXIST}


def test_what_is_not_built_in_answers_not_exist() -> None:
    rig = Rig()
    rig.cycle(2)
    cam, saw, nci = rig.layer.globals.cam, rig.layer.globals.saw, rig.layer.globals.nci
    cam.ctrl[1].cmd, saw.ctrl[1].cmd, nci.ctrl[1].cmd = C.CAM_IN, C.FLY_GEAR_IN_POS, 4
    rig.cycle()
    assert (cam.state[1].state, saw.state[1].state, nci.state[1].state) == (161, 170, 104)
    assert cam.state[1].error
    cam.ctrl[1].cmd = C.NULL
    rig.cycle()
    assert (cam.state[1].state, cam.state[1].error) == (0, False)
