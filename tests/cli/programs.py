"""Programs that the tests run; most of them are wrong in some way."""

import asyncio
import json
import os
import signal
import sys
import time
from types import SimpleNamespace

from motionlayer import Simulation
from motionlayer.event import Event, Kind, Level
from motionlayer.layer import AxisCommand


async def main(run: Simulation) -> None:
    axis = run.axes["X"]
    await axis.enable()
    await axis.move_absolute(300.0)
    print("there", axis.set_position)


async def careless(run: Simulation) -> None:
    axis = run.axes["X"]
    await axis.enable()
    axis.move_velocity(20.0)
    run.sleep(1.0)  # nobody awaits it
    await run.sleep(0.2)


async def by_layer(run: Simulation) -> None:
    await run.layer.started()
    x = run.layer.axis["X"]
    x.ctrl.cmd = AxisCommand.ENABLE
    await x.state.done(AxisCommand.ENABLE)
    x.data.position, x.data.velocity, x.ctrl.cmd = 9000.0, 100.0, AxisCommand.MOVE_POS
    await x.state.done(AxisCommand.MOVE_POS)


async def noisy(run: Simulation) -> None:
    for tick in range(7):
        run.events.add(Event(tick, Level.WARNING, Kind.MESSAGE, "X", f"message {tick}"))
    await run.sleep(0.01)


async def flooding(run: Simulation) -> None:
    run.events.add(Event(0, Level.ERROR, Kind.MESSAGE, "X", "X: the drive is not ready", 0x4650, 0, 14_001))
    run.events.add(Event(0, Level.ERROR, Kind.ERROR, "X", "X.move: the drive is not ready", 0x4650, 7, 14_001))
    for tick in range(1, 30):
        text = f"{tick} ticks late, to be caught up; programs, {tick}.5 ms"
        run.events.add(Event(tick, Level.WARNING, Kind.MESSAGE, "runtime", text))
    await run.sleep(0.01)


def cyclic(run: Simulation, memory: SimpleNamespace) -> None:
    axis = run.axes["X"]
    if run.tick == 0:
        memory.enabling = axis.enable()
    elif run.tick == 10:
        assert memory.enabling.done
        axis.move_absolute(20.0)
    elif run.tick == 300:
        print("there", axis.set_position)


def cyclic_raising(run: Simulation) -> None:
    if run.tick == 20:
        raise ValueError("cyclic boom")


def cyclic_stuck(run: Simulation) -> None:
    while run.tick == 20:
        pass


async def raising(run: Simulation) -> None:
    await run.axes["X"].enable()
    move = run.axes["X"].move_absolute(300.0)
    await run.sleep(0.05)
    assert move.busy
    raise ValueError("boom")


async def misspelling(run: Simulation) -> None:
    await run.axes["X"].enable()
    await run.axes["X"].move_absolut(300.0)  # type: ignore[attr-defined]


async def raising_in_library(run: Simulation) -> None:
    await run.sleep(0.001)
    json.loads("nonsense")


async def foreign(run: Simulation) -> None:
    await run.axes["X"].enable()
    await asyncio.sleep(1)


async def refused(run: Simulation) -> None:
    await run.axes["X"].move_absolute(10.0)


async def in_error(run: Simulation) -> None:
    axis = run.axes["X"]
    await axis.enable()
    await axis.move_velocity(500.0).settled()  # until the software limit
    await axis.move_absolute(0.0)  # in error


async def exiting(run: Simulation) -> None:
    await run.sleep(0.01)
    sys.exit(7)


async def stuck(run: Simulation) -> None:
    await run.sleep(0.01)
    while True:
        pass


async def blocking(run: Simulation) -> None:
    await run.sleep(0.01)
    time.sleep(1000.0)  # noqa: ASYNC251 - the wrong call


async def stubborn(run: Simulation) -> None:
    await run.sleep(0.01)
    while True:
        try:
            while True:
                pass
        except BaseException:  # noqa: BLE001, S110
            pass


async def interrupting(run: Simulation) -> None:
    await run.sleep(0.01)
    os.kill(os.getpid(), signal.SIGINT)
    await run.sleep(1000.0)


async def terminating(run: Simulation) -> None:
    await run.sleep(0.01)
    os.kill(os.getpid(), signal.SIGTERM)
    await run.sleep(1000.0)


async def hanging_up(run: Simulation) -> None:
    await run.sleep(0.01)
    os.kill(os.getpid(), signal.SIGHUP)
    await run.sleep(0.05)


async def waiting(run: Simulation) -> None:
    print("waiting", flush=True)
    await run.sleep(1000.0)


async def interrupting_at_once(run: Simulation) -> None:
    os.kill(os.getpid(), signal.SIGINT)
    os.kill(os.getpid(), signal.SIGINT)
    await run.sleep(1000.0)


async def interrupting_between(run: Simulation) -> None:
    def kill(event: Event) -> None:
        if event.kind is Kind.DONE:
            os.kill(os.getpid(), signal.SIGINT)

    run.events.listen(kill)
    await run.axes["X"].enable()
    await run.sleep(1000.0)


async def hanging_predicate(run: Simulation) -> None:
    def hang() -> bool:
        while True:
            os.kill(os.getpid(), signal.SIGINT)

    await run.until(hang)


async def breaking_the_cycle(run: Simulation) -> None:
    def broken(event: Event) -> None:
        if event.kind is Kind.DONE:
            raise RuntimeError("broken listener")

    run.events.listen(broken)
    await run.axes["X"].enable()


async def shuttle(run: Simulation) -> None:
    axis = run.axes["X"]
    await axis.enable()
    while True:
        await axis.move_absolute(400.0)
        await axis.move_absolute(0.0)


async def workers_failing(run: Simulation) -> None:
    async def worker(number: int) -> None:
        raise ValueError(f"worker {number}")

    for number in range(7):
        run.start(worker(number), f"worker_{number}")
    await run.sleep(0.01)


async def without_run() -> None:
    pass


def not_async(run: Simulation) -> None:
    raise AssertionError(run)
