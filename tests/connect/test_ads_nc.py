"""The ports of the NC, as pyads reaches them: axes by index group and offset."""

import ctypes
import queue
import struct
from collections.abc import Iterator
from typing import Any

import pyads
import pytest

from motionlayer import AxisState, Machine, Simulation
from motionlayer.command import ErrorId
from motionlayer.nc import Axis, BufferMode, StateDWord
from motionlayer.verify import assert_valid
from tests.connect.ads_clients import Paced, connected
from tests.effort import thinned
from tests.machines import LINEAR

PARAMETERS, STATE, FUNCTIONS, CYCLIC = 0x4000, 0x4100, 0x4200, 0x4300
ENCODER_PARAMETERS, CONTROLLER_PARAMETERS, ENCODER_STATE, CONTROLLER_STATE = 0x5000, 0x6000, 0x5100, 0x6100
PORTS = 500, 501

RESET, STOP, CLEAR, EMERGENCY_STOP, HALT, ORIENTED_STOP = 0x01, 0x02, 0x03, 0x04, 0x05, 0x09
HOME, END_POSITION = 0x10, 0x11
CONTROL, ENABLE, FEED_PLUS, FEED_MINUS, HOMING_CAM, OVERRIDE = 0x01, 0x02, 0x03, 0x04, 0x07, 0x21
CYCLES, SET_POSITION, SET_VELOCITY = 0x09, 0x0A, 0x0E
ABSOLUTE, RELATIVE = 1, 2

LONGEST = 20_000
"""Ticks that no motion here takes."""

NOT_PERMITTED, INVALID_SIZE, INVALID_OFFSET = 0x704, 0x705, 0x703

MACHINE = {
    "format": 1,
    "name": "nc",
    "axis": {"X": LINEAR | {"home": {"mode": "direct", "position": 12.5}}, "Y": {**LINEAR, "unit": "deg"}},
    "ads": {"port": 0},
}


class Nc:
    """A run, and pyads on one of its NC ports."""

    def __init__(self, run: Simulation, plc: pyads.Connection) -> None:
        self.run = run
        self.plc = plc

    @property
    def axis(self) -> Axis:
        return self.run.axes["X"]

    def read(self, group: int, offset: int, size: int, axis: int = 1) -> bytes:
        kind = ctypes.c_ubyte * size
        return bytes(self.plc.read(group + axis, offset, kind, return_ctypes=True, check_length=False))

    def value(self, group: int, offset: int, kind: str, axis: int = 1) -> Any:
        shape = struct.Struct(f"<{kind}")
        (value,) = shape.unpack(self.read(group, offset, shape.size, axis))
        return value

    def write(self, group: int, offset: int, kind: str = "", *values: float, axis: int = 1) -> int:
        """Write packed values; return the ADS error."""
        data = struct.pack(f"<{kind}", *values)
        try:
            self.plc.write(group + axis, offset, list(data), ctypes.c_ubyte * len(data))
        except pyads.ADSError as error:
            return int(error.err_code)
        return 0

    def on(self) -> None:
        """Switch the axis on by its control word, and wait until it is."""
        assert self.write(CYCLIC, CONTROL, "I", 0b111) == 0
        self.until(AxisState.STANDSTILL)

    def until(self, state: AxisState) -> None:
        """Wait for a state, and until clients read the values of a tick that began in it.

        The bound is one of ticks: how many requests a tick takes depends on the machine.
        """
        last = self.run.tick + LONGEST
        while self.axis.state is not state:
            assert self.run.tick < last, f"{self.axis.state}, not {state}"
            self.value(STATE, SET_POSITION, "d")
        tick = self.run.tick
        while self.value(STATE, CYCLES, "I") <= tick:
            pass


@pytest.fixture(params=[pytest.param(PORTS[0], marks=pytest.mark.slow), PORTS[1]])
def nc(request: pytest.FixtureRequest) -> Iterator[Nc]:
    """Serve a run; what it has moved is judged in the end."""
    with Simulation(Machine.from_dict(MACHINE)) as run:
        with Paced(run), connected(run.ads.port, request.param) as plc:
            yield Nc(run, plc)
        trace = run.trace
    assert_valid(trace)


def text(raw: bytes) -> str:
    return raw.partition(b"\0")[0].decode("cp1252")


def test_both_ports_are_those_of_the_nc() -> None:
    with Simulation(Machine.from_dict(MACHINE)) as run, Paced(run):
        for port in PORTS:
            with connected(run.ads.port, port) as plc:
                nc = Nc(run, plc)
                nc.on()
                assert (nc.value(PARAMETERS, 0x01, "I", 2), nc.axis.state) == (2, AxisState.STANDSTILL)


def test_parameters_are_those_of_the_machine_file(nc: Nc) -> None:
    assert [nc.value(PARAMETERS, 0x01, "I", axis) for axis in (1, 2)] == [1, 2]
    assert [text(nc.read(PARAMETERS, 0x02, 31, axis)) for axis in (1, 2)] == ["X", "Y"]
    assert [text(nc.read(PARAMETERS, 0x05, 11, axis)) for axis in (1, 2)] == ["mm", "deg"]
    assert nc.value(PARAMETERS, 0x04, "I") == 1000
    assert nc.value(PARAMETERS, 0x10003, "I") == nc.value(ENCODER_PARAMETERS, 0x03, "I") == 1
    limits = [nc.value(PARAMETERS, offset, "d") for offset in (0x27, 0x101, 0x102, 0x103, 0x1000D, 0x1000E)]
    assert limits == [500.0, 5000.0, 6000.0, 1e5, -100.0, 400.0]
    assert [nc.value(PARAMETERS, offset, "H") for offset in (0x1000B, 0x1000C)] == [1, 1]


def test_parts_of_an_axis_have_groups_of_their_own(nc: Nc) -> None:
    for part, own, base in (
        (0x1000D, 0x0D, ENCODER_PARAMETERS),
        (0x20012, 0x12, CONTROLLER_PARAMETERS),
    ):
        assert nc.value(base, own, "d") == nc.value(PARAMETERS, part, "d")
    nc.on()
    assert nc.write(FUNCTIONS, END_POSITION, "2Id", ABSOLUTE, 0, 30.0) == 0
    nc.until(AxisState.STANDSTILL)
    assert nc.value(ENCODER_STATE, 0x02, "d") == nc.value(STATE, 0x10002, "d") == nc.axis.actual_position
    assert nc.value(CONTROLLER_STATE, 0x0F, "d") == nc.value(STATE, 0x2000F, "d")
    assert nc.write(ENCODER_PARAMETERS, 0x0D, "d", -50.0) == 0
    assert nc.value(PARAMETERS, 0x1000D, "d") == -50.0
    with pytest.raises(pyads.ADSError, match="1795"):
        nc.value(ENCODER_PARAMETERS, 0x27, "d")


def test_a_parameter_is_written_and_holds_within_what_the_machine_file_allows(nc: Nc) -> None:
    nc.on()
    assert nc.write(PARAMETERS, 0x1000E, "d", 40.0) == 0
    assert nc.value(PARAMETERS, 0x1000E, "d") == 40.0
    assert nc.write(FUNCTIONS, END_POSITION, "2Id", ABSOLUTE, 0, 50.0) >= 0x4000
    assert nc.write(PARAMETERS, 0x1000C, "H", 0) == ErrorId.PARAMETER
    assert nc.write(PARAMETERS, 0x1000E, "d", 400.0) == 0
    assert nc.write(FUNCTIONS, END_POSITION, "2Id", ABSOLUTE, 0, 50.0) == 0
    nc.until(AxisState.STANDSTILL)
    assert nc.write(PARAMETERS, 0x27, "d", 501.0) == ErrorId.PARAMETER
    assert nc.value(PARAMETERS, 0x27, "d") == 500.0


@pytest.mark.slow
def test_the_state_of_an_axis_in_motion_is_that_of_one_tick(nc: Nc) -> None:
    nc.on()
    assert nc.write(FUNCTIONS, END_POSITION, "2Id", ABSOLUTE, 0, 390.0) == 0
    before = -1.0
    while nc.axis.state is AxisState.DISCRETE_MOTION:
        raw = nc.read(STATE, 0, 256)
        (position,), (velocity,) = struct.unpack_from("<d", raw, 24), struct.unpack_from("<d", raw, 48)
        state, control = struct.unpack_from("<II", raw, 104)
        assert position >= before
        assert bool(state & StateDWord.PositiveDirection) == (velocity > 0.0)
        assert control == 0b111
        before = position
    nc.until(AxisState.STANDSTILL)
    raw = nc.read(STATE, 0, 256)
    assert struct.unpack_from("<4d", raw, 8) == (390.0, 30.0, 390.0, 30.0)
    assert struct.unpack_from("<I", raw, 56) == (1_000_000,)
    assert struct.unpack_from("<I", raw, 104)[0] & StateDWord.NotMoving
    assert raw[176:] == bytes(80)
    assert nc.value(STATE, 0x0D, "d") == 0.0


def test_the_cyclic_images_are_as_long_as_the_vendors(nc: Nc) -> None:
    nc.on()
    assert nc.write(FUNCTIONS, HOME) == 0
    while not nc.axis.homed:
        nc.value(STATE, SET_POSITION, "d")
    to_nc, to_plc = nc.read(CYCLIC, 0x00, 128), nc.read(CYCLIC, 0x80, 256)
    assert struct.unpack_from("<I", to_nc) == (0b111,)
    assert struct.unpack_from("<d", to_plc, 40) == struct.unpack_from("<d", to_plc, 80) == (12.5,)
    assert struct.unpack_from("<I", to_plc)[0] == nc.value(CYCLIC, 0x81, "I")
    assert struct.unpack_from("<I", to_plc, 32) == (1,)


def test_an_axis_is_switched_on_and_off_bit_by_bit(nc: Nc) -> None:
    for offset in (FEED_PLUS, FEED_MINUS, ENABLE):
        assert nc.write(CYCLIC, offset, "H", 1) == 0
    nc.until(AxisState.STANDSTILL)
    assert nc.value(CYCLIC, CONTROL, "I") == 0b111
    assert nc.write(CYCLIC, FEED_PLUS, "H", 0) == 0
    assert [nc.value(CYCLIC, offset, "H") for offset in (ENABLE, FEED_PLUS, FEED_MINUS)] == [1, 0, 1]
    assert nc.write(FUNCTIONS, END_POSITION, "2Id", RELATIVE, 0, 5.0) == ErrorId.FEED_NOT_ENABLED
    assert nc.write(FUNCTIONS, END_POSITION, "2Id", RELATIVE, 0, -5.0) == 0
    nc.until(AxisState.STANDSTILL)
    assert nc.axis.set_position == -5.0
    assert nc.write(CYCLIC, ENABLE, "H", 0) == 0
    nc.until(AxisState.DISABLED)


def test_the_override_slows_a_motion_down(nc: Nc) -> None:
    nc.on()
    assert nc.write(CYCLIC, OVERRIDE, "I", 100_000) == 0
    assert nc.value(CYCLIC, OVERRIDE, "I") == 100_000
    assert nc.write(FUNCTIONS, END_POSITION, "2Id", ABSOLUTE, 0, 20.0) == 0
    fastest = 0.0
    while nc.axis.state is AxisState.DISCRETE_MOTION:
        fastest = max(fastest, nc.value(STATE, SET_VELOCITY, "d"))
    assert 0.0 < fastest <= 50.0 + 1e-9


@pytest.mark.parametrize(
    ("offset", "kind", "values"),
    thinned(
        [
            (STOP, "", ()),
            (CLEAR, "", ()),
            (HALT, "2d", (3000.0, 5e4)),
            (EMERGENCY_STOP, "2d", (0.0, 0.0)),
            (EMERGENCY_STOP, "2d", (6000.0, 1e5)),
        ],
        2,
    ),
)
def test_a_motion_is_stopped(nc: Nc, offset: int, kind: str, values: tuple[float, ...]) -> None:
    nc.on()
    assert nc.write(FUNCTIONS, END_POSITION, "2Id", ABSOLUTE, 0, 390.0) == 0
    while nc.axis.set_velocity < 100.0:
        nc.value(STATE, SET_VELOCITY, "d")
    assert nc.write(FUNCTIONS, offset, kind, *values) == 0
    nc.until(AxisState.STANDSTILL)
    assert 0.0 < nc.axis.set_position < 390.0


def test_clear_task_drops_what_waits() -> None:
    async def program(run: Simulation) -> None:
        axis = run.axes["X"]
        await axis.enable()
        moves = axis.move_absolute(300.0), axis.move_absolute(350.0, buffer_mode=BufferMode.BUFFERED)
        for move in moves:
            await move.settled()
        assert all(move.aborted for move in moves)

    with Simulation(Machine.from_dict(MACHINE)) as run:
        moves = run.start(program(run))
        with Paced(run), connected(run.ads.port, 501) as plc:
            nc = Nc(run, plc)
            while nc.value(STATE, SET_VELOCITY, "d") < 100.0:
                pass
            assert nc.write(FUNCTIONS, CLEAR) == 0
            nc.until(AxisState.STANDSTILL)
        assert moves.done, moves.error
        assert nc.axis.set_position < 300.0
        trace = run.trace
    assert_valid(trace)


@pytest.mark.slow
def test_an_oriented_stop_ends_in_its_orientation(nc: Nc) -> None:
    nc.on()
    assert nc.write(FUNCTIONS, END_POSITION, "2Id", ABSOLUTE, 0, 390.0) == 0
    while nc.axis.set_velocity < 200.0:
        nc.value(STATE, SET_VELOCITY, "d")
    assert nc.write(FUNCTIONS, ORIENTED_STOP, "3d", 300.0, 5000.0, 0.0) == 0
    nc.until(AxisState.STANDSTILL)
    assert nc.axis.set_position == 300.0


def test_an_oriented_stop_that_means_nothing_is_refused_and_one_at_rest_stays(nc: Nc) -> None:
    nc.on()
    for orientation in (-1.0, 360.0, float("nan")):
        assert nc.write(FUNCTIONS, ORIENTED_STOP, "3d", orientation, 0.0, 0.0) == ErrorId.ORIENTED_STOP_TARGET
    assert nc.write(FUNCTIONS, ORIENTED_STOP, "3d", 90.0, 0.0, 0.0) == 0
    assert nc.axis.set_position == 0.0
    assert nc.write(FUNCTIONS, END_POSITION, "2Id", ABSOLUTE, 0, 390.0) == 0
    while nc.axis.set_velocity < 50.0:
        nc.value(STATE, SET_VELOCITY, "d")
    assert nc.write(FUNCTIONS, ORIENTED_STOP, "3d", 90.0, -1.0, 0.0) >= 0x4000
    assert nc.write(FUNCTIONS, STOP) == 0
    nc.until(AxisState.STANDSTILL)


def test_a_homing_cam_that_the_client_writes_ends_the_search() -> None:
    home = {"mode": "cam", "switch": -90.0, "velocity": 40.0, "sync_velocity": 10.0, "position": 7.0}
    with Simulation(Machine.from_dict({**MACHINE, "axis": {"X": {**LINEAR, "home": home}}})) as run:
        with Paced(run), connected(run.ads.port, 501) as plc:
            nc = Nc(run, plc)
            nc.on()
            assert nc.write(FUNCTIONS, HOME) == 0
            while nc.axis.set_position > -5.0:
                nc.value(STATE, SET_POSITION, "d")
            assert nc.write(CYCLIC, HOMING_CAM, "H", 1) == 0
            assert (nc.value(CYCLIC, HOMING_CAM, "H"), nc.value(CYCLIC, CONTROL, "I")) == (1, 0b100111)
            while nc.axis.set_velocity <= 0.0:
                nc.value(STATE, SET_VELOCITY, "d")
            assert nc.write(CYCLIC, HOMING_CAM, "H", 0) == 0
            while not nc.axis.homed:
                nc.value(STATE, SET_POSITION, "d")
        trace = run.trace
    assert_valid(trace)


def test_an_error_is_shown_and_reset(nc: Nc) -> None:
    assert nc.write(FUNCTIONS, END_POSITION, "2Id", ABSOLUTE, 0, 1.0) == ErrorId.NOT_ENABLED
    assert nc.write(FUNCTIONS, END_POSITION, "2Id", 7, 0, 1.0) == ErrorId.MODE_INVALID
    assert nc.write(FUNCTIONS, RESET) == 0
    assert nc.value(STATE, 0x01, "I") == 0


@pytest.mark.parametrize(
    ("group", "offset", "axis", "code"),
    [
        (PARAMETERS, 0xBEEF, 1, INVALID_OFFSET),
        (STATE, 0xBEEF, 1, INVALID_OFFSET),
        (CYCLIC, 0x0C, 1, INVALID_OFFSET),
        (FUNCTIONS, RESET, 1, NOT_PERMITTED),
        (FUNCTIONS, 0x20, 1, 0x701),
        (STATE, 0x01, 3, 0x70C),
        (STATE, 0x01, 0, 0x70C),
        (0x2000, 0x01, 1, 0x702),
    ],
)
def test_what_cannot_be_read_is_answered_with_its_code(nc: Nc, group: int, offset: int, axis: int, code: int) -> None:
    with pytest.raises(pyads.ADSError, match=str(code)):
        nc.read(group, offset, 8, axis)


@pytest.mark.parametrize(
    ("group", "offset", "kind", "code"),
    [
        (STATE, SET_POSITION, "d", NOT_PERMITTED),
        (PARAMETERS, 0x01, "I", NOT_PERMITTED),
        (PARAMETERS, 0x27, "f", INVALID_SIZE),
        (FUNCTIONS, END_POSITION, "d", INVALID_SIZE),
        (FUNCTIONS, 0x03, "d", INVALID_SIZE),
        (FUNCTIONS, 0x12, "", 0x701),
        (CYCLIC, 0x25, "d", INVALID_OFFSET),
    ],
)
def test_what_cannot_be_written_is_answered_with_its_code(
    nc: Nc, group: int, offset: int, kind: str, code: int
) -> None:
    assert nc.write(group, offset, kind, *([1] * len(kind))) == code


def test_notifications_of_the_state_come_tick_by_tick(nc: Nc) -> None:
    nc.on()
    seen: queue.SimpleQueue[float] = queue.SimpleQueue()

    @nc.plc.notification(pyads.PLCTYPE_LREAL)  # type: ignore[untyped-decorator]
    def told(_handle: int, _name: object, _when: object, value: float) -> None:
        seen.put(value)

    attributes = pyads.NotificationAttrib(8, trans_mode=pyads.ADSTRANS_SERVERONCHA, max_delay=0, cycle_time=0)
    handles = nc.plc.add_device_notification((STATE + 1, SET_POSITION), attributes, told)
    values = [seen.get(timeout=60)]
    assert nc.write(FUNCTIONS, END_POSITION, "2Id", ABSOLUTE, 0, 3.0) == 0
    while values[-1] != 3.0:
        values.append(seen.get(timeout=60))
    nc.plc.del_device_notification(*handles)
    assert values[0] == 0.0
    assert values == sorted(set(values))


def test_the_port_has_a_name_and_a_state(nc: Nc) -> None:
    assert nc.plc.read_state()[0] == 5
    assert nc.plc.read_device_info()[0]
