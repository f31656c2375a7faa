"""The campaign `life`: whatever is commanded to the axes of a machine, nothing breaks a rule.

Motion, states and the recorded life of commands are judged by `motionlayer.verify`. What a trace does not hold is
judged here: that commands say of themselves what their events say, and that nothing fails inside.
"""

import math
import pprint
from typing import Any, Final, NamedTuple

from motionlayer.bench.campaign import _machines
from motionlayer.bench.campaign._acts import Part, parts
from motionlayer.bench.campaign._calls import PURPOSE, play
from motionlayer.bench.campaign._campaign import Campaign, Failure, judged, stream
from motionlayer.command import Command, ErrorId
from motionlayer.event import Kind
from motionlayer.machine import Machine, Simulation
from motionlayer.record import Trace
from motionlayer.verify import verify

TICKS: Final = 1000
"""Cycles of a case."""

STREAM: Final = 2
MOST_TOLD: Final = 5
"""Findings that a failure quotes."""


class Life(NamedTuple):
    """A case: a machine as data, and the programs on it."""

    machine: dict[str, Any]
    parts: list[Part]


def life(seed: int, case: int) -> Life:
    """Return a case."""
    rng = stream(seed, case, STREAM)
    machine = _machines.machine(rng, TICKS)
    return Life(machine, parts(rng, list(machine["axis"]), TICKS))


def live(case: Life) -> tuple[Trace, list[Command[Any]]]:
    """Run a case; return its trace and its commands."""
    run, commands = perform(case)
    return run.trace, commands


def perform(case: Life, *, trace: bool = True) -> tuple[Simulation, list[Command[Any]]]:
    """Run a case, with or without recording it; return the run and its commands."""
    run = Simulation(Machine.from_dict(case.machine), trace=trace)
    given: list[Command[Any]] = [axis.enable() for axis in run.axes.values()]
    run.step(2)
    reach = {name: _reach(run, name) for name in run.axes}
    programs = [run.start(play(run, part, reach, given), f"part {k}") for k, part in enumerate(case.parts)]

    async def canceller() -> None:
        for tick, k in sorted((part.cancel_at, k) for k, part in enumerate(case.parts) if part.end == "cancelled"):
            await run.until(lambda tick=tick: run.tick >= tick)  # type: ignore[misc]
            programs[k].cancel()
        await run.sleep(TICKS)  # longer than the run: only its time ends it

    run.start(canceller(), "canceller")
    run.run(time=(TICKS - run.tick) * run.base_cycle_ns * 1e-9)
    return run, given + programs


def _reach(run: Simulation, name: str) -> tuple[float, float]:
    """Return the range in which an axis is sent about: its software limits, or as far as it comes."""
    config = run.axes[name].config
    far = _machines.REACH * config.maximum.velocity
    return (
        config.limit_min if math.isfinite(config.limit_min) else -far,
        config.limit_max if math.isfinite(config.limit_max) else far,
    )


def violations(trace: Trace, commands: list[Command[Any]]) -> list[str]:
    """Return every broken rule."""
    report = verify(trace)
    found = [str(finding) for finding in report.findings[:MOST_TOLD]]
    found += [f"cannot be judged: {reason}" for reason in report.refused]
    if len(trace.ticks) != TICKS:
        found.append(f"{len(trace.ticks)} ticks are recorded, {TICKS} were run")
    return found + _inside(trace) + _lives(trace, commands)


def _inside(trace: Trace) -> list[str]:
    """No command, no plan and no program may fail for a reason other than ours."""
    wrong = [event for event in trace.events if event.code == ErrorId.INTERNAL and f": {PURPOSE}" not in event.text]
    return [f"{event.source} at tick {event.tick}: {event.text}" for event in wrong]


def _lives(trace: Trace, commands: list[Command[Any]]) -> list[str]:
    """What a command says of itself is what its events say."""
    numbers: dict[Kind, set[int]] = {kind: set() for kind in Kind}
    for event in trace.events:
        if event.command:
            numbers[event.kind].add(event.command)
    failed = numbers[Kind.ERROR] | numbers[Kind.REFUSED]
    running = numbers[Kind.ACCEPTED] - numbers[Kind.DONE] - numbers[Kind.ABORTED] - numbers[Kind.ERROR]
    found = []
    for command in commands:
        number = command.number
        says = {
            "busy": (command.busy, number in running),
            "done": (command.done, number in numbers[Kind.DONE]),
            "aborted": (command.aborted, number in numbers[Kind.ABORTED]),
            "in error": (command.error is not None, number in failed),
            "active and not busy": (command.active and not command.busy, False),
        }
        found += [
            f"command {number} {command.name}: {what} is {own}, its events say {told}"
            for what, (own, told) in says.items()
            if own != told
        ]
    return found


def run(seed: int, cases: range) -> list[Failure]:
    """Run and judge cases."""
    return judged(lambda seed, case: violations(*live(life(seed, case))), seed, cases)


def describe(seed: int, case: int) -> str:
    """Return machine and programs of a case."""
    return pprint.pformat(life(seed, case)._asdict(), width=118, sort_dicts=False)


LIFE: Final = Campaign("life", "cycles", TICKS, 1, 10_000_000, run, describe)
