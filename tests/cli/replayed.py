"""Programs whose runs are replayed: what they do depends on the outside, and nothing of that may be in the program."""

import random
import threading
import time
from types import SimpleNamespace

from motionlayer import CommandAborted, MachineRun
from motionlayer.runtime import Area


async def shuttle(run: MachineRun) -> None:
    axis = run.axes["X"]
    await axis.enable()
    try:
        while True:
            await axis.move_absolute(200.0)
            await axis.move_absolute(0.0)
    finally:
        axis.halt()  # cancelled programs act, too


def told(run: MachineRun, memory: SimpleNamespace) -> None:
    """Go where threads outside say."""
    if run.tick == 0:
        memory.area = run.areas.add("wish", 100, outside=True)
        memory.wish = 0
        run.axes["X"].enable()
        for seed in (1, 2):
            threading.Thread(target=_write, args=(memory.area, seed), daemon=True).start()
    wish = int.from_bytes(memory.area.view[:8], "little")
    if wish != memory.wish:
        memory.wish = wish
        run.axes["X"].move_absolute(wish / 1000.0)


def _write(area: Area, seed: int) -> None:
    numbers = random.Random(seed)
    while True:
        time.sleep(numbers.random() * 0.004)
        area.post(numbers.randrange(300_000).to_bytes(8, "little") + bytes(92))


async def slow(run: MachineRun) -> None:
    """Be late twice: by a few ticks, and by so many that all axes brake."""
    axis = run.axes["X"]
    await axis.enable()
    for seconds in (0.0035, 0.03):
        move = axis.move_absolute(300.0 - axis.set_position)
        await run.sleep(0.02)
        time.sleep(seconds)  # noqa: ASYNC251 - that is the point
        try:
            await move
        except CommandAborted:
            await run.until(lambda: axis.set_velocity == 0.0)
            await run.sleep(0.01)


async def stuck(run: MachineRun) -> None:
    await run.axes["X"].enable()
    run.axes["X"].move_absolute(300.0)
    await run.sleep(0.05)
    while True:
        pass
