"""A run with a layer goes back to any tick, and goes on as it did (docs/stepping.md)."""

from typing import Any

import pytest

from motionlayer.layer import AxisCommand, AxisObject
from tests.layer.rig import Rig

C = AxisCommand
SERVO: dict[str, Any] = {"drive": {"kind": "servo", "position_gain": 50.0, "noise": 0.001}}


LIFE: dict[int, list[tuple[str, int, str, Any]]] = {
    20: [("ctrl", 1, "cmd", C.IDLE), ("ctrl", 2, "cmd", C.ENABLE)],
    30: [("data", 1, "position", 80.0), ("data", 1, "velocity", 200.0)],
    31: [("ctrl", 1, "cmd", C.MOVE_BUFFER), ("ctrl", 2, "cmd", C.HOME)],
    60: [("data", 1, "position", 20.0)],
    90: [("data", 2, "velocity", 90.0), ("ctrl", 2, "cmd", C.MOVE_VELO)],
    120: [("data", 1, "override", 50.0)],
    150: [("ctrl", 2, "cmd", C.STOP)],
    200: [("nc_parameter_in", 1, "number", 1051), ("ctrl", 1, "cmd", C.PARAMETER_READ)],
    220: [("ctrl", 1, "cmd", 4711)],
}
"""What is written before which tick: structure, axis, field, value."""


def life(rig: Rig) -> list[tuple[Any, ...]]:
    """Let two axes do something of everything; return what they have shown in every cycle."""
    found = []
    for tick in range(300):
        for part, axis, name, value in LIFE.get(tick, ()):
            setattr(getattr(rig.layer.axis[axis], part), name, value)
        found += rig.seen(lambda: tuple(shown(one) for one in rig.layer.axis), 1)
    return found


def shown(one: AxisObject) -> tuple[int, bytes, bytes]:
    """Return what an axis shows."""
    return one.state.code, bytes(one.info), bytes(one.nc_parameter_out)


def test_reset_makes_the_same_run_again() -> None:
    rig = Rig(2, up=False, **SERVO)
    first = life(rig)
    assert len({state[0][0] for state in first}) > 10, "there is something to be compared"
    rig.run.reset()
    assert life(rig) == first
    rig.run.reset(seed=7)
    assert life(rig) != first, "another noise"
    rig.check()


@pytest.mark.parametrize("at", [3, 40, 100, 205])
def test_restore_goes_on_from_any_tick(at: int) -> None:
    rig = Rig(2, **SERVO)
    one = rig.x
    rig.do(C.ENABLE)
    one.data.position, one.data.velocity = 60.0, 100.0
    one.ctrl.cmd = C.MOVE_BUFFER
    rig.cycle(at)
    here = rig.run.snapshot()

    def on() -> list[tuple[int, bytes]]:
        one.data.position = -20.0
        return rig.seen(lambda: (one.state.code, bytes(one.info)), 150)

    first = on()
    rig.run.restore(here)
    assert on() == first
    rig.check()


def test_what_waits_for_a_state_is_put_back_with_it() -> None:
    rig = Rig().ready()
    rig.x.data.position, rig.x.data.velocity = 20.0, 100.0
    rig.x.ctrl.cmd = C.MOVE_POS
    wait = rig.x.state.done(C.MOVE_POS)
    here = rig.run.snapshot()
    for _ in range(2):
        assert wait.busy
        rig.until(lambda: not wait.busy)
        assert wait.result == 10012
        rig.run.restore(here)
