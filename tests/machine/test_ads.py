"""Runs that ADS clients reach, with pyads as the client: what is recorded, what is refused, what holds a run up."""

import socket
import threading
from collections.abc import Callable
from typing import Any

import pyads
import pytest
from pyads import PLCTYPE_LREAL, PLCTYPE_UINT
from tests.connect.ads_clients import Paced, connected, machine

from motionlayer import Machine, RealTime, Simulation, replay
from motionlayer.event import Level
from motionlayer.layer import AxisCommand, Progress
from motionlayer.machine import AdsDescription, MachineError, ServerFailed
from motionlayer.record import Trace
from motionlayer.verify import assert_valid

STOP, RUN, RESET, CONFIG, RECONFIG = 6, 5, 2, 15, 16
DONE = int(Progress.DONE)


def command(plc: pyads.Connection, axis: int, value: int, patience: int = 4000) -> int:
    """Write a command, and read the state until it has been carried out."""
    plc.write_by_name(f"GVL_AXIS.Ctrl[{axis}].eCmd", value, PLCTYPE_UINT)
    state = 0
    for _ in range(patience):
        state = plc.read_by_name(f"GVL_AXIS.State[{axis}].eState", PLCTYPE_UINT)
        if state in (value + DONE, value + Progress.ERROR):
            return int(state)
    return int(state)


def move(port: int, axis: int, position: float, found: dict[int, int]) -> None:
    with connected(port) as plc:
        while plc.read_by_name("MAIN_AXIS.eInit", PLCTYPE_UINT) != DONE:
            pass
        assert command(plc, axis, AxisCommand.ENABLE) == AxisCommand.ENABLE + DONE
        values = {"rSetPos": position, "rSetVelo": 400.0, "rOverride": 100.0}
        for name, value in values.items():
            plc.write_by_name(f"GVL_AXIS.Data[{axis}].{name}", value, PLCTYPE_LREAL)
        found[axis] = command(plc, axis, AxisCommand.MOVE_POS)


def together(*calls: Callable[[], None]) -> None:
    threads = [threading.Thread(target=call) for call in calls]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def test_three_clients_move_three_axes_and_the_run_can_be_replayed() -> None:
    found: dict[int, int] = {}
    with Simulation(machine()) as run:
        with Paced(run):
            port = run.ads.port
            together(*(lambda axis=axis: move(port, axis, 10.0 * axis, found) for axis in (1, 2, 3)))
        assert found == dict.fromkeys((1, 2, 3), AxisCommand.MOVE_POS + DONE)
        assert [round(axis.set_position, 6) for axis in run.axes.values()] == [10.0, 20.0, 30.0]
        trace = run.trace
    assert_valid(trace)
    repeated = replay(trace, programs=[])
    assert repeated.same, repeated.difference


def test_a_run_that_is_held_up_takes_writes_and_time_stands_still() -> None:
    with Simulation(machine()) as run, Paced(run), connected(run.ads.port) as plc:
        plc.write_control(STOP, 0, 0, PLCTYPE_UINT)
        assert run.paused
        assert plc.read_state() == (STOP, 0)
        tick = run.tick
        for value in (100.0, 200.0):
            plc.write_by_name("GVL_AXIS.Data[1].rSetVelo", value, PLCTYPE_LREAL)
            assert plc.read_by_name("GVL_AXIS.Data[1].rSetVelo", PLCTYPE_LREAL) == value
        assert run.tick == tick
        plc.write_control(RUN, 0, 0, PLCTYPE_UINT)
        assert plc.read_state() == (RUN, 0)


@pytest.mark.parametrize(("asked", "system"), [(STOP, RUN), (CONFIG, CONFIG), (RECONFIG, CONFIG)])
def test_the_system_service_holds_a_run_up(asked: int, system: int) -> None:
    with Simulation(machine()) as run, Paced(run), connected(run.ads.port, 10_000) as service:
        service.write_control(asked, 0, 0, PLCTYPE_UINT)
        assert run.paused
        assert service.read_state() == (system, 0)
        service.write_control(RUN, 0, 0, PLCTYPE_UINT)
        assert service.read_state() == (RUN, 0)


def restarts(port: int) -> int:
    with connected(port, 10_000) as service:
        status = service.read(0xF0, 0, pyads.PLCTYPE_USINT * 16)
    return int(status[4]) + 256 * int(status[5])


def test_a_restart_begins_anew_and_clients_see_that() -> None:
    with Simulation(machine()) as run, Paced(run):
        before = restarts(run.ads.port)
        with connected(run.ads.port) as plc:
            version = plc.read(0xF008, 0, pyads.PLCTYPE_USINT)
            handle = plc.get_handle("GVL_AXIS.Data[1].rSetVelo")
            plc.write_by_name("", 55.0, PLCTYPE_LREAL, handle=handle)
            plc.write_control(RESET, 0, 0, PLCTYPE_UINT)
            assert plc.read_by_name("", PLCTYPE_LREAL, handle=handle) == 0.0
            assert plc.read(0xF008, 0, pyads.PLCTYPE_USINT) == version + 1
        assert restarts(run.ads.port) == before + 1


def test_what_cannot_be_taken_back_is_not_restarted() -> None:
    async def program(run: Any) -> None:
        await run.sleep(1000.0)

    with Simulation(machine()) as run:
        run.start(program(run), "sleeper")
        with Paced(run), connected(run.ads.port) as plc:
            with pytest.raises(pyads.ADSError, match="1810"):
                plc.write_control(RESET, 0, 0, PLCTYPE_UINT)
            plc.write_by_name("GVL_AXIS.Data[1].rSetVelo", 1.0, PLCTYPE_LREAL)  # the log is a tick behind
        texts = [event.text for event in run.events.ring if event.level is Level.WARNING]
    assert any("cannot begin anew" in text and "sleeper" in text for text in texts)


def test_refusals_are_answered_and_logged() -> None:
    mapped = {"map": {"A": {"group": "axis", "objects": ["X"]}}}
    with Simulation(machine(layer=mapped)) as run:
        with Paced(run), connected(run.ads.port) as plc:
            for name in ("GVL_AXIS.State[2].eState", "GVL_AXIS.Ctrl[1].eCmd"):
                with pytest.raises(pyads.ADSError, match="1796"):
                    plc.write_by_name(name, 1, PLCTYPE_UINT)
            plc.write_by_name("GVL_AXIS.Ctrl[2].eCmd", 10, PLCTYPE_UINT)
        texts = [event.text for event in run.events.ring if event.level is Level.WARNING]
    assert any("GVL_AXIS.State[2].eState can only be read" in text for text in texts)
    assert any("GVL_AXIS.Ctrl[1] belongs to the image" in text and "127.0.0.1.1.1:3" in text for text in texts)


def test_two_clients_that_write_one_command_in_a_tick_are_named() -> None:
    with Simulation(machine()) as run:
        with Paced(run), connected(run.ads.port) as one, connected(run.ads.port) as two:
            one.write_control(STOP, 0, 0, PLCTYPE_UINT)
            one.write_by_name("GVL_AXIS.Ctrl[1].eCmd", 10, PLCTYPE_UINT)
            two.write_by_name("GVL_AXIS.Ctrl[1].eCmd", 20, PLCTYPE_UINT)
            one.write_control(RUN, 0, 0, PLCTYPE_UINT)
        (text,) = [event.text for event in run.events.ring if "in the same tick" in event.text]
    assert text.count("127.0.0.1.1.1:3") == 2


def test_an_address_that_is_taken_is_one_clear_error() -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        for kind in (Simulation, RealTime):
            with pytest.raises(ServerFailed, match=rf"127.0.0.1:{port}: Address already in use; .*port"):
                kind(machine(ads={"port": port}))


def test_a_run_without_a_server_says_so() -> None:
    with Simulation(machine(), ads=False) as run:
        assert not run.serves_ads
        with pytest.raises(ValueError, match=r"no ADS server: add \[ads\]"):
            _ = run.ads.port


def test_a_machine_without_a_motion_layer_is_served_too() -> None:
    plain = machine()
    described = Machine.from_dict({"format": 1, "name": "m", "axis": {"X": plain.description.axis["X"].model_dump()}})
    with Simulation(described, ads=AdsDescription(port=0)) as run, Paced(run), connected(run.ads.port) as plc:
        assert plc.read_state() == (RUN, 0)


def test_real_time_serves_from_a_process_of_its_own() -> None:
    found: dict[int, int] = {}
    run = RealTime(machine())

    def talk() -> None:
        move(run.ads.port, 1, 50.0, found)
        run.stop("done")

    client = threading.Thread(target=talk)
    with run:
        client.start()
        run.run(time=20.0)
        client.join()
        assert found == {1: AxisCommand.MOVE_POS + DONE}
        trace = run.trace
    _require_valid(trace)


def _require_valid(trace: Trace) -> None:
    assert_valid(trace)
    repeated = replay(trace, programs=[])
    assert repeated.same, repeated.difference


@pytest.mark.parametrize(
    ("table", "problem"),
    [
        ({"port": 70_000}, "65_535|65535"),
        ({"net_id": "1.2.3"}, "six numbers"),
        ({"hosts": ["here"]}, "IP address or a network"),
        ({"read_only": ["1.2.3.4.5.900"]}, "six numbers"),
        ({"limits": {"connections": 0}}, "connections"),
        ({"limits": {"silence": 0.0}}, "silence"),
    ],
)
def test_a_bad_table_is_refused(table: dict[str, Any], problem: str) -> None:
    with pytest.raises(MachineError, match=problem):
        machine(ads=table)
