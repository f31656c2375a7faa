"""Info of an axis means what it is meant to mean (motion-layer 6, D13)."""

from typing import Any

import numpy as np
import pytest

from motionlayer.command import ErrorId
from motionlayer.drive import Fault
from motionlayer.event import Subdevice
from motionlayer.layer import AxisCommand, Progress
from tests.layer.rig import Rig

C, P = AxisCommand, Progress
SERVO: dict[str, Any] = {"drive": {"kind": "servo", "position_gain": 50.0}}


def bits(rig: Rig) -> set[str]:
    """Return the bits of Info that are set."""
    info = rig.x.info
    names = ("enabled", "referenced", "ready", "busy", "error", "timeout", "in_target", "standstill")
    return {name for name in names if getattr(info, name)}


def test_the_example_of_the_specification() -> None:
    """Enabled, ready, in target, standstill: C5."""
    rig = Rig().ready()
    assert rig.layer.globals.axis.info.memory[0] == 0xC5


def test_d13_an_axis_is_busy_while_a_function_is_requested_or_active() -> None:
    rig = Rig().ready()
    rig.x.data.velocity = 100.0
    rig.x.data.position = 100.0
    assert "busy" not in bits(rig)
    rig.drop(C.MOVE_POS)
    assert "busy" in bits(rig)
    assert "ready" not in bits(rig)
    rig.cycle(20)
    assert "busy" in bits(rig)
    assert "standstill" not in bits(rig)
    rig.drop(C.NULL)
    assert "busy" in bits(rig), "the motion goes on"
    rig.until(lambda: rig.run.axes["X"].command is None)
    rig.cycle(2)
    assert bits(rig) >= {"ready", "standstill"}
    assert "busy" not in bits(rig)
    rig.check()


def test_d13_an_axis_is_referenced_when_it_is_homed() -> None:
    rig = Rig().ready()
    assert "referenced" not in bits(rig)
    rig.do(C.HOME)
    assert "referenced" in bits(rig)
    rig.check()


def test_d13_in_target_is_the_window_of_the_axis() -> None:
    rig = Rig(monitor={"target_window": 0.5, "target_time": 0.02}, **SERVO).ready()
    rig.x.data.position, rig.x.data.velocity = 100.0, 200.0
    rig.drop(C.MOVE_POS)
    inside = rig.seen(lambda: (rig.x.info.in_target, rig.x.info.position), 1000)
    assert rig.x.state.code == 10012
    moving = [position for seen, position in inside[5:] if not seen]
    assert max(moving) > 99.5, "for a time inside the window, not at once"
    assert rig.x.info.in_target
    rig.check()


def test_d13_errors_outside_of_a_command_are_shown() -> None:
    rig = Rig(**SERVO).ready()
    rig.run.inject("X", Fault("drive_error"), rig.run.tick + 1)
    rig.cycle(5)
    assert rig.x.state.code == 10003
    assert (rig.x.info.error, rig.x.info.ready, rig.x.info.standstill) == (True, False, False)
    assert rig.x.info.error_id == ErrorId.DRIVE_NOT_READY
    rig.cycle(50)
    own = [one for one in rig.messages if one.source == "GVL_AXIS.Ctrl[1]" and one.subdevice == Subdevice.AxisCycle]
    assert [(one.text, one.code) for one in own] == [(" : PROGRESS_ERROR", ErrorId.DRIVE_NOT_READY)]
    assert rig.do(C.RESET)[-1] == P.DONE
    rig.cycle(2)
    assert (rig.x.info.error, rig.x.info.error_id) == (False, 0)
    rig.check()


def test_positions_are_those_of_the_axis_in_every_cycle() -> None:
    rig = Rig(2, **SERVO).ready()
    rig.layer.axis[2].data.position, rig.layer.axis[2].data.velocity = 50.0, 200.0
    rig.drop(C.MOVE_POS, 2)
    info, ref = rig.layer.axis[2].info, list(rig.run.axis_refs.values())[1]
    lags = []
    for _ in range(200):
        rig.cycle()
        image = ref.NcToPlc
        assert (info.position, info.velocity, info.lag) == (image.ActPos, image.ActVelo, image.PosDiff)
        lags.append(info.lag)
    assert max(lags) > 0.1
    assert (info.nc_axis_id, info.couple_state) == (2, 0)
    rig.check()


@pytest.mark.parametrize("count", [1, 2, 7])
def test_the_image_is_that_of_the_declaration(count: int) -> None:
    rig = Rig(count)
    shown = np.frombuffer(rig.layer.globals.axis.info.memory, rig.layer.globals.axis.info.array.dtype)
    assert shown["nNcAxisId"].tolist() == list(range(1, count + 1))
