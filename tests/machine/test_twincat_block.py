"""`FB_MotionLayerAds` as exported, run by a small controller, against the server of a machine that moves."""

from collections.abc import Callable
from typing import Any

import pyads
import pytest
from examples.communications.ads_tcp import read_write_of
from tests.connect.ads_clients import Paced, connected, machine
from tests.iec.plc import Block, area
from tests.iec.plc_memory import Memory, Place, Types
from tests.machine.test_link import RESET, wait

from motionlayer import Machine, Simulation
from motionlayer.iec.export import Declarations, structured_text
from motionlayer.iec.export._st import st_objects
from motionlayer.iec.export._st_parts import carried
from motionlayer.layer import AxisCommand, Progress
from motionlayer.layer.types import AxisCtrl, AxisInfo, AxisState, MoveData
from motionlayer.machine import ReadWrite, interface
from motionlayer.verify import assert_valid

SYMBOL_BY_NAME, SUM_READ, SUM_WRITE = 0xF007, 0xF080, 0xF081
NO_ANSWER = 0x745

pytestmark = pytest.mark.slow  # the parser takes its time


class Request:
    """ADSRDWRTEX: one ReadWrite, begun by a rising edge, over when it is called again."""

    def __init__(self, memory: Memory, ask: ReadWrite) -> None:
        self.memory, self.ask = memory, ask
        self.inputs: dict[str, Any] = {"WRTRD": False}
        self.BUSY = self.ERR = False
        self.ERRID = self.COUNT_R = 0
        self.sent: list[tuple[int, int, int, bytes]] = []

    def __call__(self, **inputs: Any) -> None:
        rising = inputs.get("WRTRD", False) and not self.inputs["WRTRD"]
        self.inputs |= inputs
        if rising:
            self.BUSY, self.ERR, self.ERRID, self.COUNT_R = True, False, 0, 0
        elif self.BUSY:
            self._carry_out()

    def _carry_out(self) -> None:
        given, self.BUSY = self.inputs, False
        source = given["SRCADDR"]
        data = bytes(self.memory.data[source : source + given["WRITELEN"]])
        order = given["IDXGRP"], given["IDXOFFS"], given["READLEN"], data
        self.sent.append(order)
        try:
            answer = self.ask(*order)
        except pyads.ADSError as error:
            self.ERR, self.ERRID = True, int(error.err_code)
        except TimeoutError:
            self.ERR, self.ERRID = True, NO_ANSWER
        else:
            target, self.COUNT_R = given["DESTADDR"], len(answer)
            self.memory.data[target : target + len(answer)] = answer


class Timer:
    """TON in calls: it takes three of them."""

    def __init__(self) -> None:
        self.Q, self.calls = False, 0

    def __call__(self, IN: bool, PT: int = 0) -> None:  # noqa: ARG002, N803 - inputs of the block
        self.calls = self.calls + 1 if IN else 0
        self.Q = self.calls >= 3


class Controller:
    """A controller with the exported project, whose program is the test.

    Args:
        told: what was exported.
        ask: reaches the motion side.
    """

    def __init__(self, told: Declarations, ask: ReadWrite) -> None:
        self.memory, types = Memory(60_000), Types()
        self.request = Request(self.memory, ask)
        outside: dict[str, Any] = {"ADSRDWRTEX": None, "TON": None, "fbRequest": self.request, "fbRetry": Timer()}
        objects = {one.name: one for one in st_objects(told)}
        for name in ("E_PROGRESS", "E_MOTION_LAYER_ADS", "ST_MOTION_LAYER_PLACE", "ST_MOTION_LAYER_IMAGE"):
            types.declare(objects[name].declaration)
        self.places: dict[str, Place] = {}
        for name, one in carried(told):
            kind = types.known["UINT"] if name == told.start else area(one.type.size)
            self.places[name] = outside[name] = self.memory.room(kind)
        self.block = Block(objects["FB_MotionLayerAds"].text, types, self.memory, outside)
        self.set("GVL_AXIS.Data", 1, MoveData(position=30.0, velocity=400.0))
        self.block["sNetId"] = "127.0.0.1.1.1"
        self.block["bEnable"] = True

    def get(self, name: str, kind: Any, index: int) -> Any:
        at = self.places[name].at + kind.type.size * (index - 1)
        return kind.type.unpack_from(self.memory.data, at)

    def set(self, name: str, index: int, value: Any) -> None:
        at = self.places[name].at + value.type.size * (index - 1)
        self.memory.data[at : at + value.type.size] = bytes(value)

    def until(self, condition: Callable[[], bool]) -> None:
        """Run cycles until something is so."""

        def cycle() -> bool:
            self.block()
            return condition()

        wait(cycle)

    def state(self, index: int = 1) -> int:
        return int(self.get("GVL_AXIS.State", AxisState, index).state)

    def command(self, command: AxisCommand) -> None:
        """Drop a command, and run cycles until it is done."""
        self.set("GVL_AXIS.Ctrl", 1, AxisCtrl(cmd=command))
        self.until(lambda: self.state() == command + Progress.DONE)


def no_answer(_group: int, _offset: int, _length: int, _data: bytes) -> bytes:
    raise TimeoutError("nobody answers")


@pytest.fixture(scope="module", autouse=True)
def parsed_once() -> None:
    """Parse the block before a server waits for its client."""
    with Simulation(machine()) as axes:
        Controller(interface(axes), no_answer)


def test_the_block_moves_an_axis() -> None:
    with Simulation(machine()) as axes:
        with Paced(axes), connected(axes.ads.port) as plc:
            controller = Controller(interface(axes), read_write_of(plc))
            controller.until(lambda: controller.block["bReady"])
            controller.command(AxisCommand.ENABLE)
            controller.command(AxisCommand.MOVE_POS)
        assert axes.axes["X"].set_position == 30.0
        assert controller.get("GVL_AXIS.Info", AxisInfo, 1).position == pytest.approx(30.0)
        assert not controller.block["bError"]
        trace = axes.trace
    assert_valid(trace)


def test_what_the_block_sends() -> None:
    """Places are looked for once; then all states in one request, and what has changed in another."""
    with Simulation(machine()) as axes, Paced(axes), connected(axes.ads.port) as plc:
        told = interface(axes)
        controller = Controller(told, read_write_of(plc))
        controller.until(lambda: controller.block["bReady"])
        names = [name for name, _ in carried(told)]
        sent = controller.request.sent
        found, rest = sent[: len(names)], sent[len(names) :]
        assert [(group, offset, most) for group, offset, most, _ in found] == [(SYMBOL_BY_NAME, 0, 12)] * len(names)
        assert [data for *_, data in found] == [name.encode() + b"\0" for name in names]
        reads = [one for _, one in carried(told) if not one.written]
        size = 5 + sum(4 + one.type.size for one in reads)
        assert {order[:3] for order in rest} == {(SUM_READ, len(reads) + 1, size)}
        controller.until(lambda: sent[-1][0] == SUM_WRITE)
        out = [one for _, one in carried(told) if one.written]
        assert sent[-1][:3] == (SUM_WRITE, len(out), 4 * len(out))
        assert len(sent[-1][3]) == sum(12 + one.type.size for one in out)
        controller.set("GVL_AXIS.Ctrl", 2, AxisCtrl(cmd=AxisCommand.ENABLE))
        before = len(sent)
        controller.until(lambda: controller.state(2) == AxisCommand.ENABLE + Progress.DONE)
        (write,) = [order for order in sent[before:] if order[0] == SUM_WRITE]
        assert write[:3] == (SUM_WRITE, 1, 4)
        assert write[3][12:] == b"".join(bytes(controller.get("GVL_AXIS.Ctrl", AxisCtrl, one)) for one in (1, 2, 3))


def test_a_connection_that_breaks_is_told_and_made_again() -> None:
    with Simulation(machine()) as axes, Paced(axes), connected(axes.ads.port) as plc:
        ask, broken = read_write_of(plc), False

        def read_write(group: int, offset: int, length: int, data: bytes) -> bytes:
            if broken:
                raise TimeoutError("nobody answers")
            return ask(group, offset, length, data)

        controller = Controller(interface(axes), read_write)
        controller.until(lambda: controller.block["bReady"])
        broken = True
        controller.until(lambda: controller.block["bError"])
        assert controller.block["nErrorId"] == NO_ANSWER
        assert not controller.block["bReady"]
        broken = False
        controller.command(AxisCommand.ENABLE)
        assert controller.block["bReady"]
        assert not controller.block["bError"]


def test_a_motion_side_that_begins_anew_is_given_everything() -> None:
    with Simulation(machine()) as axes, Paced(axes), connected(axes.ads.port) as plc:
        controller = Controller(interface(axes), read_write_of(plc))
        controller.until(lambda: controller.block["bReady"])
        controller.command(AxisCommand.ENABLE)
        with connected(axes.ads.port) as service:
            service.write_control(RESET, 0, 0, pyads.PLCTYPE_UINT)
        controller.until(lambda: controller.block["nRestarts"] == 1)
        assert not controller.block["bReady"]
        controller.until(lambda: controller.block["bReady"] and controller.state() == 10003)
        assert axes.layer.axis["X"].data.velocity == 400.0


def test_a_motion_side_of_another_size_is_told_with_the_variable() -> None:
    described = machine().description.model_dump(exclude_unset=True)
    del described["axis"]["Z"]
    with Simulation(machine()) as axes:
        told = interface(axes)
    with Simulation(Machine.from_dict(described)) as axes, Paced(axes), connected(axes.ads.port) as plc:
        controller = Controller(told, read_write_of(plc))
        controller.until(lambda: controller.block["bError"])
        assert controller.block["nErrorId"] == 0x705
        assert controller.block["sErrorSymbol"] == "GVL_AXIS.Ctrl"


def test_a_motion_side_that_refuses_is_told_with_the_variable() -> None:
    mapped = machine(layer={"map": {"all": {"group": "axis"}}})
    with Simulation(mapped) as axes, Paced(axes), connected(axes.ads.port) as plc:
        controller = Controller(interface(axes), read_write_of(plc))
        controller.until(lambda: controller.block["bError"])
        assert controller.block["nErrorId"] == 0x704
        assert controller.block["sErrorSymbol"] == "GVL_AXIS.Ctrl"


def test_a_variable_that_a_motion_side_may_lack_is_left_out() -> None:
    with Simulation(machine()) as axes, Paced(axes), connected(axes.ads.port) as plc:
        ask = read_write_of(plc)

        def read_write(group: int, offset: int, length: int, data: bytes) -> bytes:
            if data == b"GVL_SIMULATION.DriveFault\0":
                raise pyads.ADSError(0x710)
            return ask(group, offset, length, data)

        controller = Controller(interface(axes), read_write)
        controller.until(lambda: controller.block["bReady"])
        controller.command(AxisCommand.ENABLE)


def test_disabled_it_sends_nothing() -> None:
    with Simulation(machine()) as axes, Paced(axes), connected(axes.ads.port) as plc:
        controller = Controller(interface(axes), read_write_of(plc))
        controller.until(lambda: controller.block["bReady"])
        controller.block["bEnable"] = False
        controller.block()
        assert not controller.block["bReady"]
        controller.block()
        before = len(controller.request.sent)
        for _ in range(5):
            controller.block()
        assert len(controller.request.sent) == before
        controller.block["bEnable"] = True
        controller.until(lambda: controller.block["bReady"])


@pytest.mark.parametrize(
    ("state", "command", "progress"),
    [(0, 0, 0), (10012, 12, 10000), (9000, 0, 9000), (112, 12, 100), (1009, 9, 1000), (7031, 31, 7000)],
)
def test_functions_split_a_state(state: int, command: int, progress: int) -> None:
    with Simulation(machine()) as axes:
        objects = {one.name: one for one in st_objects(interface(axes))}
    for name, expected in (("F_StateCommand", command), ("F_StateProgress", progress)):
        assert Block(objects[name].text, Types(), Memory(1000), {})(nState=state) == expected


def test_the_block_is_part_of_the_text() -> None:
    with Simulation(machine()) as axes:
        assert "FUNCTION_BLOCK FB_MotionLayerAds" in structured_text(interface(axes))["motion_layer.st"]
