"""Runs of machines with `[layer]`: images, symbols and programs together; recorded, replayed, taken back."""

import math
import struct
from typing import Any

import pytest
from tests.machines import LINEAR

from motionlayer import Machine, Simulation, replay
from motionlayer.event import Level
from motionlayer.layer import AxisCommand, MotionLayer, Progress
from motionlayer.layer.types import AxisCtrl, MoveData
from motionlayer.verify import assert_valid

DONE = int(Progress.DONE)


def machine(maps: dict[str, Any] | None = None, **changes: Any) -> Machine:
    layer = {"map": maps or {}, **changes}
    return Machine.from_dict({"format": 1, "name": "m", "axis": dict.fromkeys("XYZ", LINEAR), "layer": layer})


ALL = {"all": {"group": "axis"}}
SHARED = {"A": {"group": "axis", "objects": ["Z", 1]}}


def states(run: Simulation, image: str = "MAPPING_AXIS_out.AxisState") -> list[int]:
    return [state for state, _ in struct.iter_unpack("<HI", run.areas[image].read())]


class Controller:
    """Another machine: it writes images and reads images, and knows nothing else."""

    def __init__(self, run: Simulation, prefix: str, axes: int) -> None:
        self._run = run
        self._prefix = prefix
        self.ctrl = [AxisCtrl() for _ in range(axes)]
        self.data = [MoveData() for _ in range(axes)]

    def send(self) -> None:
        self._run.areas[f"{self._prefix}_in.AxisCtrl"].post(b"".join(map(bytes, self.ctrl)))
        self._run.areas[f"{self._prefix}_in.AxisMoveData"].post(b"".join(map(bytes, self.data)))

    def command(self, axis: int, command: AxisCommand, ticks: int = 3000) -> int:
        """Send a command; return the state of the axis when it has ended, or after so many ticks."""
        self.ctrl[axis].cmd = command
        self.send()
        for _ in range(ticks):
            self._run.step()
            state = states(self._run, f"{self._prefix}_out.AxisState")[axis]
            if state in {command + DONE, command + Progress.ERROR}:
                return state
        return state

    def move(self, axis: int, position: float, ticks: int = 3000) -> int:
        self.data[axis].position, self.data[axis].velocity = position, 200.0
        return self.command(axis, AxisCommand.MOVE_POS, ticks)


def started(described: Machine, prefix: str, axes: int) -> tuple[Simulation, Controller]:
    run = Simulation(described)
    while struct.unpack("<H", run.areas["MAIN_AXIS.eInit"].read()) != (DONE,):
        run.step()
    return run, Controller(run, prefix, axes)


def test_a_controller_moves_an_axis_by_images_alone() -> None:
    run, controller = started(machine(ALL), "MAPPING_AXIS", 3)
    with run:
        assert controller.command(1, AxisCommand.ENABLE) == AxisCommand.ENABLE + DONE
        assert controller.move(1, 50.0) == AxisCommand.MOVE_POS + DONE
        info = run.areas["MAPPING_AXIS_out.AxisInfo"].read()[38:76]
        assert struct.unpack("<BxI3d2I", info)[2] == pytest.approx(50.0)
        trace = run.trace
    assert_valid(trace)


def test_the_answer_is_in_the_image_of_the_cycle_in_which_the_command_came() -> None:
    run, controller = started(machine(ALL), "MAPPING_AXIS", 3)
    with run:
        controller.command(0, AxisCommand.ENABLE, ticks=1)
        assert states(run)[0] == AxisCommand.ENABLE + Progress.INIT


def test_a_controller_that_falls_silent_in_the_middle_of_a_move_changes_nothing() -> None:
    """What it has written last stays; the move goes on to its end, and so does an endless one."""
    run, controller = started(machine(ALL), "MAPPING_AXIS", 3)
    with run:
        controller.command(0, AxisCommand.ENABLE)
        controller.command(1, AxisCommand.ENABLE)
        controller.move(0, 100.0, ticks=50)
        controller.data[1].velocity = 100.0
        controller.data[1].direction = 1
        controller.command(1, AxisCommand.MOVE_VELO, ticks=50)
        assert states(run)[0] == AxisCommand.MOVE_POS + Progress.OCCUPIED
        run.step(1000)
        assert run.axes["X"].set_position == 100.0
        assert states(run)[0] == AxisCommand.MOVE_POS + DONE
        assert run.axes["Y"].set_velocity == pytest.approx(100.0)
        trace = run.trace
    assert_valid(trace)


def test_axes_of_a_map_and_axes_by_symbol_in_one_machine() -> None:
    run, controller = started(machine(SHARED), "A", 2)
    with run:
        controller.command(0, AxisCommand.ENABLE)  # axis Z, the first one of the map
        run.symbols.write("GVL_AXIS.Ctrl[2].eCmd", AxisCommand.ENABLE, "client")
        run.step(100)
        assert [axis.enabled for axis in run.axes.values()] == [False, True, True]
        with pytest.raises(PermissionError, match=r"GVL_AXIS.Ctrl\[3\] belongs to the image A_in.AxisCtrl: client"):
            run.symbols.write("GVL_AXIS.Ctrl[3].eCmd", AxisCommand.DISABLE, "client")
        with pytest.raises(PermissionError, match=r"A_in.AxisCtrl is an image: client can only read it"):
            run.symbols.write("A_in.AxisCtrl.Data[1].eCmd", AxisCommand.DISABLE, "client")
        run.step(10)
        assert run.axes["Z"].enabled
        trace = run.trace
    assert_valid(trace)


def test_symbols_of_the_mapping_programs_and_their_names_on_the_slides() -> None:
    with Simulation(machine(SHARED)) as run:
        run.step(30)
        read = run.symbols.read
        assert read("MAPPING_AXIS_in.sMappingCheck") == read("MAPPING_in.sMappingCheck") == "NO_MAPPING_ACTIVE"
        assert read("A_in.sMappingCheck") == read("A_out.sMappingCheck") == "CHECK_DONE"
        assert [read(f"A_in.bBypassMapping{one}") for one in ("Axis", "Cam")] == [False, True]
        assert list(read("A_in.szAxisCtrl")) == [8, 8]
        assert read("A_out.AxisState.Data[1].eState") == AxisCommand.INIT + DONE
        assert [read(f"A_out.AxisState.byState[1][{at}]") for at in (1, 2)] == [0x11, 0x27]
        run.symbols.write("A_in.bMappingBlocked", value=True, by="client")
        run.areas["A_in.AxisCtrl"].post(b"\3\0" * 4)
        run.step(2)
        assert read("GVL_AXIS.Ctrl[3].eCmd") == AxisCommand.INIT


def test_without_a_layer_the_run_says_how_to_get_one() -> None:
    described = Machine.from_dict({"format": 1, "name": "plain", "axis": {"X": LINEAR}})
    with Simulation(described) as run:
        for name in ("layer", "symbols", "mapping"):
            with pytest.raises(ValueError, match=r"plain has no .*: add \[layer\] to the machine file, or \[control\]"):
                getattr(run, name)
        assert list(run.areas) == []


def test_what_controllers_have_written_is_recorded_and_replayed() -> None:
    """Posted images and images of a bus alike."""
    run, controller = started(machine(SHARED), "A", 2)
    with run:
        bus = bytearray(8)
        run.mapping.attach("A_in.AxisCtrl", bus)
        bus[:] = bytes(AxisCtrl(cmd=AxisCommand.ENABLE)) * 2
        run.step(50)
        controller.data[1].position, controller.data[1].velocity = 30.0, 100.0
        run.areas["A_in.AxisMoveData"].post(b"".join(map(bytes, controller.data)))
        bus[4:6] = struct.pack("<H", AxisCommand.MOVE_POS)
        run.step(1500)
        assert run.axes["X"].set_position == 30.0
        trace = run.trace
    assert_valid(trace)
    again = replay(trace, [])
    assert again.same, again.difference


def test_a_reset_run_does_the_same_again() -> None:
    hashes, shown = [], []
    with Simulation(machine(ALL)) as run:
        for _ in range(2):
            run.step(40)
            controller = Controller(run, "MAPPING_AXIS", 3)
            controller.command(0, AxisCommand.ENABLE)
            controller.move(0, 20.0)
            shown.append(states(run))
            hashes.append(run.axes["X"].set_position)
            last = run.snapshot()
            run.reset()
            assert states(run) == [0, 0, 0]
            assert isinstance(run.layer, MotionLayer)
            assert not run.layer.ready
        run.restore(last)
        assert states(run) == shown[0]
        trace = run.trace
    assert shown[0] == shown[1]
    assert hashes[0] == hashes[1] == 20.0
    assert_valid(trace)
    again = replay(trace, [])
    assert again.same, again.difference


def test_what_is_no_number_in_an_image_is_zero_in_the_structure_with_one_warning() -> None:
    """In the original all bytes come back in every cycle, and with them the NaN; here the image has not changed."""
    run, controller = started(machine(ALL), "MAPPING_AXIS", 3)
    with run:
        controller.command(0, AxisCommand.ENABLE)
        controller.data[0].position = math.nan
        controller.send()
        run.step(20)
        assert run.layer.axis[1].data.position == 0.0
        warnings = [one.text for one in run.events.last(Level.WARNING)]
        assert len(warnings) == 1
        assert "GVL_AXIS.Data[1]" in warnings[0]
        assert run.axes["X"].set_position == 0.0
        trace = run.trace
    assert_valid(trace)


def test_namespaces_run_at_their_divisor_and_phase() -> None:
    described = machine(ALL, divisor={"axis": 4}, phase={"axis": 1})
    run, controller = started(described, "MAPPING_AXIS", 3)
    with run:
        while run.tick % 4 != 2:
            run.step()
        seen = []
        controller.ctrl[0].cmd = AxisCommand.ENABLE
        controller.send()
        for _ in range(4):
            run.step()
            seen.append(states(run)[0])
        assert seen == [AxisCommand.INIT + DONE] * 3 + [AxisCommand.ENABLE + Progress.INIT]
