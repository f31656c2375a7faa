"""What ADS clients do to a run is recorded with its tick: it is repeated without them, to the same hash."""

import queue
import threading
from collections.abc import Callable
from contextlib import ExitStack

import pyads
import pytest
from pyads import PLCTYPE_UINT
from tests.connect.ads_clients import Paced, connected, machine
from tests.effort import thinned

from motionlayer import MachineRun, RealTime, Simulation, Trace, replay
from motionlayer.layer import AxisCommand, Progress
from motionlayer.verify import assert_valid

STOP, RUN, RESET, SYSTEM = 6, 5, 2, 10_000
DONE = int(Progress.DONE)
AXES = (1, 2, 3)
PATIENCE = 120.0

Client = Callable[[pyads.Connection, int], None]
"""What a client does with its axis."""


def started(plc: pyads.Connection) -> None:
    while plc.read_by_name("MAIN_AXIS.eInit", PLCTYPE_UINT) != DONE:
        pass


def ended(plc: pyads.Connection, axis: int, command: int) -> None:
    """Wait until a command that was written is done."""
    while (state := plc.read_by_name(f"GVL_AXIS.State[{axis}].eState", PLCTYPE_UINT)) != command + DONE:
        assert state != command + Progress.ERROR


def carried_out(plc: pyads.Connection, axis: int, command: int) -> None:
    plc.write_by_name(f"GVL_AXIS.Ctrl[{axis}].eCmd", command, PLCTYPE_UINT)
    ended(plc, axis, command)


def target(plc: pyads.Connection, axis: int, position: float) -> None:
    """Write the data of a move in one tick."""
    data = f"GVL_AXIS.Data[{axis}]"
    plc.write_list_by_name({f"{data}.rSetPos": position, f"{data}.rSetVelo": 400.0})


def moved(plc: pyads.Connection, axis: int, position: float) -> None:
    target(plc, axis, position)
    carried_out(plc, axis, AxisCommand.NULL)
    carried_out(plc, axis, AxisCommand.MOVE_POS)


def each(port: int, work: Client) -> None:
    """Let three clients work at the same time, each with its axis; what one of them raises is raised."""
    failed: queue.SimpleQueue[BaseException] = queue.SimpleQueue()

    def client(axis: int) -> None:
        try:
            with connected(port) as plc:
                work(plc, axis)
        except BaseException as error:  # noqa: BLE001 - told to the test
            failed.put(error)

    threads = [threading.Thread(target=client, args=(axis,)) for axis in AXES]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(PATIENCE)
        assert not thread.is_alive()
    if not failed.empty():
        raise failed.get()


def control(port: int, state: int, ads_port: int = 851) -> None:
    with connected(port, ads_port) as plc:
        plc.write_control(state, 0, 0, PLCTYPE_UINT)


def require_repeatable(trace: Trace) -> None:
    assert_valid(trace)
    repeated = replay(trace, programs=[])
    assert repeated.same, repeated.difference


def positions(run: MachineRun) -> list[float]:
    return [round(axis.set_position, 6) for axis in run.axes.values()]


def test_three_clients_that_write_while_the_run_is_held_up() -> None:
    """Commands that are written while time stands still begin together, at the tick in which it goes on."""
    with Simulation(machine()) as run:
        with Paced(run):
            port = run.ads.port
            each(port, _enabled)
            control(port, STOP)
            for _ in range(2):  # the first may still come into a tick that was under way
                each(port, lambda plc, axis: target(plc, axis, 99.0))
            tick = run.tick
            each(port, _written)
            assert run.tick == tick
            control(port, RUN)
            each(port, lambda plc, axis: ended(plc, axis, AxisCommand.MOVE_POS))
        assert positions(run) == [10.0, 20.0, 30.0]
        trace = run.trace
    begun = [event.tick for event in trace.events if event.text == "new command: E_AXIS_CTRL.AXIS_MOVE_POS"]
    assert begun == [tick] * 3
    require_repeatable(trace)


def _enabled(plc: pyads.Connection, axis: int) -> None:
    started(plc)
    carried_out(plc, axis, AxisCommand.ENABLE)


def _written(plc: pyads.Connection, axis: int) -> None:
    """Write a move, another one, and the first again: the last one counts."""
    for position in (10.0 * axis, 15.0, 10.0 * axis):
        target(plc, axis, position)
    plc.write_by_name(f"GVL_AXIS.Ctrl[{axis}].eCmd", AxisCommand.MOVE_POS, PLCTYPE_UINT)


@pytest.mark.parametrize("held_up", thinned([False, True], 2))
def test_three_clients_before_and_after_a_restart(held_up: bool) -> None:
    """The trace is that of the run since the restart; it knows nothing of what was before."""
    with Simulation(machine()) as run:
        with Paced(run):
            port = run.ads.port
            each(port, lambda plc, axis: _brought_to(plc, axis, 5.0))
            if held_up:
                control(port, STOP)
                each(port, lambda plc, axis: target(plc, axis, 99.0))
            control(port, RESET, SYSTEM)
            each(port, lambda plc, axis: _brought_to(plc, axis, 10.0 * axis))
        assert positions(run) == [10.0, 20.0, 30.0]
        trace = run.trace
    assert trace["X.set_position"][0] == 0.0
    assert sum(event.text == "new command: E_AXIS_CTRL.AXIS_MOVE_POS" for event in trace.events) == 3
    require_repeatable(trace)


def _brought_to(plc: pyads.Connection, axis: int, position: float) -> None:
    _enabled(plc, axis)
    moved(plc, axis, position)


@pytest.mark.slow
def test_three_clients_in_real_time_with_a_pause_and_a_restart() -> None:
    failed: list[BaseException] = []
    run = RealTime(machine())

    def clients() -> None:
        try:
            port = run.ads.port
            each(port, lambda plc, axis: _brought_to(plc, axis, 5.0))
            control(port, RESET, SYSTEM)
            each(port, _enabled)
            control(port, STOP)
            each(port, _written)
            control(port, RUN)
            each(port, lambda plc, axis: ended(plc, axis, AxisCommand.MOVE_POS))
        except BaseException as error:  # noqa: BLE001 - raised below
            failed.append(error)
        finally:
            run.stop("the clients are done")

    with ExitStack() as stack:
        stack.enter_context(run)
        thread = threading.Thread(target=clients)
        thread.start()
        run.run(time=60.0)
        thread.join()
        assert not failed, failed
        assert positions(run) == [10.0, 20.0, 30.0]
        trace = run.trace
    require_repeatable(trace)
