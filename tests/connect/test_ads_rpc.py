"""Methods of axis objects, called as pyads calls any handle: inputs packed, the return value and outputs packed."""

import contextlib
import ctypes
import struct
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import pyads
import pytest

from motionlayer import AxisState, Machine, Simulation, replay
from motionlayer.command import ErrorId
from motionlayer.verify import assert_valid
from tests.connect.ads_clients import Paced, connected, machine
from tests.effort import thinned
from tests.machines import LINEAR

VALUE_BY_HANDLE = 0xF005
ABORTING, BUFFERED, UNKNOWN_MODE = 0, 1, 7
POSITIVE = 1
PATIENCE = 20_000

Call = Callable[..., tuple[int, ...]]


class Shown(NamedTuple):
    """The members of an axis object behind its name."""

    command: int
    error_id: int
    busy: bool
    active: bool
    done: bool
    aborted: bool
    error: bool


class Object:
    """An axis object, as a client sees it."""

    def __init__(self, plc: pyads.Connection, index: int = 1) -> None:
        self.plc = plc
        self.path = f"GVL_MOTION.Axis[{index}]"

    def raw(self, method: str, data: bytes, length: int) -> bytes:
        """Call a method with bytes; return the bytes of its results."""
        handle = self.plc.get_handle(f"{self.path}#{method}")
        try:
            kind, sent = ctypes.c_ubyte * length, ctypes.c_ubyte * len(data)
            found = self.plc.read_write(VALUE_BY_HANDLE, handle, kind, sent(*data), sent, return_ctypes=True)
            return bytes(found)
        finally:
            self.plc.release_handle(handle)

    def call(self, method: str, inputs: str = "", *values: float) -> tuple[int, int]:
        """Call a method that gives a command; return its ErrorID and the number of the command."""
        error, command = struct.unpack("<II", self.raw(method, struct.pack(f"<{inputs}", *values), 8))
        return error, command

    def power(self, *, on: bool = True) -> int:
        (error,) = struct.unpack("<I", self.raw("Power", bytes((on, on, on)), 4))
        return int(error)

    def move(self, position: float, mode: int = ABORTING) -> tuple[int, int]:
        return self.call("MoveAbsolute", "5dh", position, 300.0, 0.0, 0.0, 0.0, mode)

    def shown(self) -> Shown:
        raw = bytes(self.plc.read_by_name(self.path, ctypes.c_ubyte * 48, return_ctypes=True))
        return Shown(*struct.unpack_from("<II5?", raw, 32))

    def ended(self, command: int) -> Shown:
        """Return what is shown when a command has ended."""
        for _ in range(PATIENCE):
            shown = self.shown()
            if shown.command != command or not shown.busy:
                return shown
        raise AssertionError(f"command {command} did not end")


@contextlib.contextmanager
def powered(run: Simulation) -> Iterator[Object]:
    """Let a run go on, and its first axis be on."""
    with Paced(run), connected(run.ads.port) as plc:
        axis = Object(plc)
        assert axis.power() == 0
        while run.axes["X"].state is not AxisState.STANDSTILL:
            axis.shown()
        yield axis


def bare() -> Machine:
    """Return a machine without a motion layer: methods are there with the axes."""
    return Machine.from_dict(
        {"format": 1, "name": "bare", "axis": dict.fromkeys("XY", LINEAR), "ads": {"port": 0}},
    )


@pytest.mark.parametrize("made", thinned([bare, machine]), ids=["without layer", "with layer"])
def test_an_axis_is_moved_by_methods_and_the_run_can_be_replayed(made: Callable[[], Machine]) -> None:
    with Simulation(made()) as run:
        with powered(run) as axis:
            error, command = axis.move(50.0)
            assert (error, command) == (0, 1)
            assert axis.ended(command) == (1, 0, False, False, True, False, False)
            assert run.axes["X"].set_position == 50.0
            error, command = axis.call("MoveRelative", "5dh", -20.0, 300.0, 0.0, 0.0, 0.0, ABORTING)
            assert (error, axis.ended(command).done) == (0, True)
            assert axis.power(on=False) == 0
        assert run.axes["X"].set_position == 30.0
        trace = run.trace
    assert_valid(trace)
    repeated = replay(trace, programs=[])
    assert repeated.same, repeated.difference


@pytest.mark.slow
def test_the_numbers_of_buffer_modes_are_those_of_the_interface() -> None:
    with Simulation(bare()) as run:
        with powered(run) as axis:
            _, first = axis.move(60.0)
            error, second = axis.move(10.0, BUFFERED)
            assert error == 0
            assert axis.ended(second).done
            assert axis.move(0.0, UNKNOWN_MODE) == (ErrorId.BUFFER_MODE, 0)
            assert axis.shown().command == second == first + 1
        (told,) = [event.text for event in run.events.ring if event.code == ErrorId.BUFFER_MODE]
        assert "BufferMode = 7, allowed: 0, 1, 18, 19, 20, 21" in told
        trace = run.trace
    assert trace["X.set_position"].max() == pytest.approx(60.0, abs=1e-4)
    assert_valid(trace)


def test_an_endless_motion_is_halted_and_the_object_tells_of_the_last_command() -> None:
    with Simulation(bare()) as run:
        with powered(run) as axis:
            _, moving = axis.call("MoveVelocity", "h4dh", POSITIVE, 50.0, 0.0, 0.0, 0.0, ABORTING)
            while run.axes["X"].set_velocity < 50.0:
                assert axis.shown().command == moving
            error, halt = axis.call("Halt", "2dh", 0.0, 0.0, ABORTING)
            assert (error, axis.ended(halt).done) == (0, True)
            assert run.axes["X"].set_velocity == 0.0
        trace = run.trace
    assert_valid(trace)


def test_stop_leaves_the_axis_free_for_the_next_client() -> None:
    with Simulation(bare()) as run:
        with powered(run) as axis:
            axis.move(300.0)
            error, stop = axis.call("Stop", "2d", 0.0, 0.0)
            assert (error, axis.ended(stop).done) == (0, True)
            error, command = axis.move(0.0)
            assert (error, axis.ended(command).done) == (0, True)
        trace = run.trace
    assert_valid(trace)


def test_a_command_that_another_takes_the_place_of_is_not_shown_any_more() -> None:
    with Simulation(bare()) as run:
        with powered(run) as axis:
            _, first = axis.move(300.0)
            _, second = axis.move(20.0)
            assert axis.ended(first).command == second == first + 1
            assert axis.ended(second).done
        trace = run.trace
    assert_valid(trace)


def test_a_refused_call_returns_the_error_and_changes_nothing() -> None:
    with Simulation(bare()) as run:
        with Paced(run), connected(run.ads.port) as plc:
            axis = Object(plc, 2)
            before = axis.shown()
            error, command = axis.move(10.0)
            assert (error, command) == (ErrorId.NOT_ENABLED, 0)
            assert axis.shown() == before
            (factor,) = struct.unpack("<I", axis.raw("SetOverride", struct.pack("<d", 0.5), 4))
            assert factor == 0
        assert run.axes["Y"].override == 0.5
        assert run.axes["Y"].set_position == 0.0
        trace = run.trace
    assert_valid(trace)


@pytest.mark.parametrize(
    ("path", "code"),
    [
        ("GVL_MOTION.Axis[1]#Fly", 1808),
        ("GVL_MOTION.Axis[3]#Halt", 1825),
        ("GVL_MOTION.Axis#Halt", 1808),
        ("GVL_MOTION.Axis[1].Name#Halt", 1808),
    ],
)
def test_methods_that_do_not_exist(path: str, code: int) -> None:
    with (
        Simulation(bare()) as run,
        Paced(run),
        connected(run.ads.port) as plc,
        pytest.raises(pyads.ADSError, match=str(code)),
    ):
        plc.get_handle(path)


@pytest.mark.parametrize(("sent", "length"), [(41, 8), (43, 8), (0, 8), (42, 7)])
def test_inputs_and_results_of_a_wrong_size_are_refused(sent: int, length: int) -> None:
    with Simulation(bare()) as run:
        with powered(run) as axis, pytest.raises(pyads.ADSError, match="1797"):
            axis.raw("MoveAbsolute", bytes(sent), length)
        assert run.axes["X"].set_position == 0.0


def test_a_handle_of_a_method_cannot_be_read_written_or_called_as_a_variable() -> None:
    with Simulation(bare()) as run, Paced(run), connected(run.ads.port) as plc:
        method, variable = plc.get_handle("GVL_MOTION.Axis[1]#Reset"), plc.get_handle("GVL_MOTION.Axis[1]")
        tries: list[Callable[[], Any]] = [
            lambda: plc.read(VALUE_BY_HANDLE, method, pyads.PLCTYPE_UDINT),
            lambda: plc.write(VALUE_BY_HANDLE, method, 1, pyads.PLCTYPE_UDINT),
            lambda: plc.write(VALUE_BY_HANDLE, variable, 1, pyads.PLCTYPE_UDINT),
        ]
        for one in tries:
            with pytest.raises(pyads.ADSError):
                one()


def test_a_read_only_client_calls_nothing() -> None:
    description = {"format": 1, "name": "bare", "axis": {"X": LINEAR}}
    everybody = {"port": 0, "read_only": ["127.0.0.1.1.1"]}
    with Simulation(Machine.from_dict({**description, "ads": everybody})) as run:
        with Paced(run), connected(run.ads.port) as plc, pytest.raises(pyads.ADSError, match=r"1796|1827"):
            Object(plc).power()
        assert not run.axes["X"].enabled
