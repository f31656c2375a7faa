"""Show where the time of a case goes: `make profile CASE=plan|cycle|override|trace|start`."""

import cProfile
import pstats
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from time import perf_counter_ns

import click

from motionlayer.bench import _command, _load, _recording
from motionlayer.bench._timing import quiet
from motionlayer.machine import Machine
from motionlayer.machine._build import build
from motionlayer.machine._tracing import Tracing
from motionlayer.runtime import Run, Stage, Step

ROWS = 18
TICKS = 2000
AXES = {"plan": 1, "cycle": 1000, "override": 64, "trace": _recording.AXES}


class Clocked:
    """A stage, and the time that it takes in all."""

    def __init__(self, stage: Stage) -> None:
        self.name = f"{stage.step.name.lower()}: {stage.name}"
        self.total = 0
        self._run = stage.run

    def run(self, tick: int) -> None:
        """Run the stage."""
        begin = perf_counter_ns()
        self._run(tick)
        self.total += perf_counter_ns() - begin


def assembled(machine: Machine, folder: Path | None, wrap: Callable[[Stage], Stage]) -> tuple[Run, dict]:
    """Return a run whose axes all move, its stages wrapped, and the axes; it records where a folder is given."""
    parts = build(machine.description)
    stages = list(parts.stages)
    if folder is not None:
        tracing = Tracing(machine, parts, 0, (), folder / "profile.trace", keep=True)
        stages.append(Stage(Step.CAPTURE, "trace", tracing.capture))
    run = Run(
        [wrap(stage) for stage in stages],
        base_cycle_ns=machine.description.base_cycle_ns,
        ledger=parts.ledger,
        events=parts.events,
        on_failure=lambda _program: None,
    )
    _load.set_off(run, parts.axes)
    return run, parts.axes


def action(case: str, run: Run, axes: dict) -> Callable[[], object]:
    """Return what a case does in every tick."""
    if case == "plan":
        targets = _load.targets(TICKS)

        def work() -> None:
            axes["A0"].move_absolute(targets[run.tick % TICKS])
            run.step()
    elif case == "override":

        def work() -> None:
            for number, axis in enumerate(axes.values()):
                axis.set_override(0.5 + 0.4 * ((run.tick + number) % 7) / 7)
            run.step()
    else:
        work = run.step
    return work


def in_ticks(case: str) -> None:
    """Profile a case that happens in ticks, once by stage and once by function."""
    machine = _load.machine(AXES[case], _recording.SIGNALS)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) if case == "trace" else None
        clocks: list[Clocked] = []

        def clocked(stage: Stage) -> Stage:
            clocks.append(Clocked(stage))
            return stage._replace(run=clocks[-1].run)

        run, axes = assembled(machine, folder, clocked)
        work = action(case, run, axes)
        for clock in clocks:
            clock.total = 0
        with quiet():
            begin = perf_counter_ns()
            for _ in range(TICKS):
                work()
            total = perf_counter_ns() - begin
        click.echo(f"{case}: {AXES[case]} axes, {TICKS} ticks; µs per tick, each stage 0.1 of it for its clock")
        for clock in clocks:
            click.echo(f"{clock.total / TICKS / 1e3:10.2f}  {clock.name}")
        rest = total - sum(clock.total for clock in clocks)
        click.echo(f"{rest / TICKS / 1e3:10.2f}  the rest: programs, the loop, what the case itself calls")
        click.echo(f"{total / TICKS / 1e3:10.2f}  in all\n")
        run, axes = assembled(machine, folder, lambda stage: stage)
        work = action(case, run, axes)
        with quiet(), cProfile.Profile() as profile:
            for _ in range(TICKS):
                work()
        pstats.Stats(profile).sort_stats("tottime").print_stats(ROWS)


def start() -> None:
    """Profile the command itself, from the start of the process, kernels cached."""
    with tempfile.TemporaryDirectory() as name:
        machine = _command._short(Path(name))  # noqa: SLF001 - the same machine as the row
        file = Path(name) / "start.profile"
        command = [
            sys.executable,
            "-m",
            "cProfile",
            "-o",
            str(file),
            "-m",
            "motionlayer",
            "run",
            str(machine),
            "--hash",
        ]
        for _ in range(2):  # the first fills the cache
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        pstats.Stats(str(file)).sort_stats("cumulative").print_stats(2 * ROWS)


@click.command()
@click.argument("case", type=click.Choice([*AXES, "start"]))
def main(case: str) -> None:
    """Print the time by stage and by function of a CASE."""
    if case == "start":
        start()
    else:
        in_ticks(case)


if __name__ == "__main__":
    main()
