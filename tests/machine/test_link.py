"""A control side whose images ADS carries: what does not fit, what is refused, a connection that breaks."""

import contextlib
import threading
import time
from collections.abc import Callable
from typing import Any

import pyads
import pytest
from examples.communications.ads_tcp import read_write_of
from tests.connect.ads_clients import Paced, connected, machine

from motionlayer import Machine, Simulation, replay
from motionlayer.event import Level
from motionlayer.layer import AxisCommand, Progress
from motionlayer.machine import AdsLink, LinkError, MachineRun, ReadWrite
from motionlayer.verify import assert_valid

RESET, SYSTEM = 2, 10_000

PAUSE = threading.Event()
"""Never set: who waits lets the other threads go on."""


def control(*axes: str) -> Machine:
    return Machine.from_dict({"format": 1, "name": "control", "control": {"axes": list(axes or "XYZ")}})


def wait(condition: Callable[[], bool], seconds: float = 60.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline
        PAUSE.wait(0.001)


def warnings(run: MachineRun) -> list[str]:
    return [event.text for event in tuple(run.events.ring) if event.level is Level.WARNING]


async def work(run: Any) -> None:
    await run.layer.started()
    axis = run.layer.axis["Y"]
    axis.ctrl.cmd = AxisCommand.ENABLE
    await axis.state.done(AxisCommand.ENABLE)
    axis.data.position, axis.data.velocity = 25.0, 400.0
    axis.ctrl.cmd = AxisCommand.MOVE_POS
    await axis.state.done(AxisCommand.MOVE_POS)
    assert axis.info.position == pytest.approx(25.0)


def test_a_program_commands_axes_at_the_other_end_and_both_can_be_replayed() -> None:
    with Simulation(machine()) as axes, Simulation(control()) as controller:
        with Paced(axes), connected(axes.ads.port) as plc:
            program = controller.start(work(controller))
            with Paced(controller), AdsLink(controller, read_write_of(plc)):
                wait(lambda: not program.busy)
        assert program.done, program.error
        assert axes.axes["Y"].set_position == 25.0
        traces = axes.trace, controller.trace
    assert_valid(traces[0])
    for trace, programs in zip(traces, ([], [work]), strict=True):
        again = replay(trace, programs)
        assert again.same, again.difference


def test_a_side_that_does_not_fit_is_told_when_the_link_begins() -> None:
    with Simulation(machine()) as axes, Paced(axes), connected(axes.ads.port) as plc:
        with (
            Simulation(control("X", "Y")) as controller,
            pytest.raises(LinkError, match=r"GVL_AXIS\.State: 18 bytes on the other side, 12 here; \[control\] must"),
        ):
            AdsLink(controller, read_write_of(plc)).__enter__()
        with pytest.raises(TypeError, match=r"m is no control side: its machine file needs \[control\]"):
            AdsLink(axes, read_write_of(plc))


def test_a_side_without_a_motion_layer_is_told() -> None:
    described = {"format": 1, "name": "m", "axis": machine().description.model_dump()["axis"], "ads": {"port": 0}}
    with (
        Simulation(Machine.from_dict(described)) as axes,
        Paced(axes),
        connected(axes.ads.port) as plc,
        Simulation(control()) as controller,
        pytest.raises(LinkError, match=r"no such symbol; it needs a motion layer, \[layer\]"),
    ):
        AdsLink(controller, read_write_of(plc)).__enter__()


def test_what_the_other_side_refuses_is_told_once() -> None:
    mapped = machine(layer={"map": {"all": {"group": "axis"}}})
    with Simulation(mapped) as axes, Simulation(control()) as controller:
        with Paced(axes), Paced(controller), connected(axes.ads.port) as plc, AdsLink(controller, read_write_of(plc)):
            wait(lambda: bool(warnings(controller)))
            tick = controller.tick
            wait(lambda: controller.tick > tick + 200)
        (told,) = warnings(controller)
    assert told == (
        "LinkError: GVL_AXIS.Ctrl: the other side refuses to have it written, ADS error 0x704; what a [layer.map] "
        "holds there is not written by symbol; trying again"
    )


def test_a_connection_that_breaks_is_told_and_goes_on_when_it_is_there_again() -> None:
    with Simulation(machine()) as axes, Simulation(control()) as controller, Paced(axes), Paced(controller):
        with connected(axes.ads.port) as plc:
            ask, broken = read_write_of(plc), False

            def read_write(group: int, offset: int, length: int, data: bytes) -> bytes:
                if broken:
                    raise TimeoutError("nobody answers")
                return ask(group, offset, length, data)

            with AdsLink(controller, read_write):
                wait(lambda: controller.layer.ready)
                broken = True
                wait(lambda: bool(warnings(controller)))
                controller.layer.axis["X"].ctrl.cmd = AxisCommand.ENABLE
                broken = False
                wait(lambda: controller.layer.axis["X"].state.split().command == AxisCommand.ENABLE)
        assert warnings(controller) == ["TimeoutError: nobody answers; trying again"]


@pytest.mark.slow
def test_a_motion_machine_that_is_there_anew_is_brought_up_and_then_given_everything() -> None:
    asks: list[ReadWrite] = []

    def read_write(group: int, offset: int, length: int, data: bytes) -> bytes:
        if not asks:
            raise TimeoutError("nobody answers")
        return asks[0](group, offset, length, data)

    with Simulation(control()) as controller, Paced(controller), contextlib.ExitStack() as stack:
        x = controller.layer.axis["X"]
        for _ in range(2):
            with Simulation(machine()) as axes, Paced(axes), connected(axes.ads.port) as plc:
                asks.append(read_write_of(plc))
                if x.ctrl.cmd != AxisCommand.ENABLE:
                    stack.enter_context(AdsLink(controller, read_write))
                    wait(lambda: controller.layer.ready)
                    x.data.velocity, x.ctrl.cmd = 70.0, AxisCommand.ENABLE
                wait(lambda: axes.layer.axis["X"].state.split() == (AxisCommand.ENABLE, Progress.DONE))
                assert axes.layer.axis["X"].data.velocity == 70.0
                asks.clear()
                wait(lambda: "TimeoutError" in "".join(warnings(controller)))
                told = [event.text for event in axes.events.ring if event.source == "GVL_AXIS.Ctrl[1]"]
            commands = [text for text in told if text.startswith("new command")]
            assert commands == ["new command: E_AXIS_CTRL.AXIS_INIT", "new command: E_AXIS_CTRL.AXIS_ENABLE"]


@pytest.mark.parametrize("ads_port", [851, SYSTEM])
def test_a_motion_machine_that_a_client_restarts_is_noticed_and_given_everything(ads_port: int) -> None:
    with Simulation(machine()) as axes, Simulation(control()) as controller, Paced(axes), Paced(controller):
        x, other = controller.layer.axis["X"], axes.layer.axis["X"]
        with connected(axes.ads.port) as plc, AdsLink(controller, read_write_of(plc)):
            wait(lambda: controller.layer.ready)
            x.data.velocity, x.ctrl.cmd = 70.0, AxisCommand.ENABLE
            wait(lambda: other.state.split() == (AxisCommand.ENABLE, Progress.DONE))
            with connected(axes.ads.port, ads_port) as service:
                service.write_control(RESET, 0, 0, pyads.PLCTYPE_UINT)
            wait(lambda: bool(warnings(controller)))
            wait(lambda: other.state.split() == (AxisCommand.ENABLE, Progress.DONE))
            assert other.data.velocity == 70.0
        assert warnings(controller) == [
            "the motion machine has begun anew; after its start-up everything is written again"
        ]
