"""`motionlayer soak`: what it does."""

import sys
import time
from collections.abc import Sequence
from typing import Final

import click

from motionlayer.cli._exit import ExitCode, Stop, complain, say
from motionlayer.cli._failure import program_failure
from motionlayer.cli._files import load_machine, load_trace, refuse_overwriting
from motionlayer.cli._interrupt import Interrupts, orderly
from motionlayer.cli._memory import MemoryWatch
from motionlayer.cli._options import require_clock
from motionlayer.cli._programs import chosen, give_up, load
from motionlayer.cli._progress import Progress
from motionlayer.cli._soak_options import SoakOptions
from motionlayer.cli._soak_report import Soaked, SoakTally, lines, write
from motionlayer.machine import (
    Loaded,
    Machine,
    MachineRun,
    RealTime,
    RunKeywords,
    Simulation,
)
from motionlayer.record import TraceError
from motionlayer.runtime import CycleFault, ProgramStuck

MOST_WARM_UP: Final = 1_000_000
"""Cycles of warm-up where none are given: a tenth of all, and at most so many."""


JUDGED: Final = 100_000
"""Ticks at the end of a trace that are judged."""


def soaked(options: SoakOptions) -> ExitCode:
    """Run a machine for long and print the report; return how it went."""
    warm_up = min(options.cycles // 10, MOST_WARM_UP) if options.warm_up is None else options.warm_up
    _check(options, warm_up)
    machine = load_machine(options.machine)
    sources = chosen(machine, options.program)
    refuse_overwriting([options.trace, options.report], [options.machine, *(source.file for source in sources)])
    programs = load(sources)
    run = _made(machine, options)
    tally, memory = SoakTally(), MemoryWatch(warm_up, options.cycles, collect=not options.realtime)
    run.events.listen(tally)
    _start(run, programs)
    started = time.monotonic_ns()
    code, problem = _execute(run, options, memory)
    wall = (time.monotonic_ns() - started) * 1e-9
    growth = memory.growth(run.tick)
    judged, invalid = _judged(run, options)
    if invalid and not problem:
        code, problem = ExitCode.FAILED, invalid
    report = Soaked(run, options, tally, wall, growth, judged, problem)
    if problem:
        complain(problem)
    for line in lines(report):
        say(line)
    if options.report is not None:
        write(report, options.report)
    return code


def _made(machine: Machine, options: SoakOptions) -> MachineRun:
    settings: RunKeywords = {"seed": options.seed, "trace": options.trace, "programs": (), "log": False, "ads": False}
    try:
        if options.realtime:
            return RealTime(machine, speed=options.speed or 1.0, **settings)
        return Simulation(machine, statistics=True, **settings)
    except TraceError as error:
        raise Stop(ExitCode.OUTPUT, str(error)) from error


def _judged(run: MachineRun, options: SoakOptions) -> tuple[str, str]:
    """Close the run and judge the end of its trace; return what is to be said, and what is wrong, "" if nothing is."""
    try:
        run.close()
    except TraceError as error:
        return "", str(error)
    if options.trace is None or not run.tick:
        return "", ""
    from motionlayer.verify import verify  # noqa: PLC0415 - only those who record pay for it

    report = verify(load_trace(options.trace).tail(JUDGED))
    text = str(report).splitlines()[0]
    return text, "" if report.ok else f"the end of {options.trace} is not valid; see `motionlayer verify`: {text}"


def _check(options: SoakOptions, warm_up: int) -> None:
    require_clock(options.speed, realtime=options.realtime)
    if warm_up >= options.cycles:
        raise click.UsageError(f"a warm-up of {warm_up} cycles leaves none of {options.cycles}: give more --cycles")


def _start(run: MachineRun, programs: Sequence[Loaded]) -> None:
    for program in programs:
        if program.task is not None:
            program.start(run)
        else:
            run.start(_again(run, program), f"soak {program.name}")


async def _again(run: MachineRun, program: Loaded) -> None:
    """Start a program again and again; one that has failed ends the run."""
    while True:
        running = program.start(run)
        await run.until(lambda running=running: not running.busy)  # type: ignore[misc]
        if running.failure is not None:
            run.stop("a program failed")


def _execute(run: MachineRun, options: SoakOptions, memory: MemoryWatch) -> tuple[ExitCode, str]:
    """Run to the end, whichever it is; return exit code and what went wrong, "" if nothing did."""
    cycle = run.base_cycle_ns * 1e-9
    try:
        with Progress(options.cycles, cycle, sys.stderr) as progress, orderly(run, give_up) as interrupts:

            def watch(tick: int) -> None:
                memory(tick)
                if not options.realtime:  # a terminal that does not take it would hold up the cycle
                    progress(tick)

            run.run(time=options.cycles * cycle, watch=watch)
    except ProgramStuck as stuck:
        return ExitCode.STUCK, str(stuck).rstrip()
    except CycleFault as fault:
        return ExitCode.FAULT, f"a fault of motionlayer itself in {fault}; please report it"
    except KeyboardInterrupt:
        return _interrupted(run, interrupts)
    if interrupts.first is not None:
        return _interrupted(run, interrupts)
    if run.failures:
        return ExitCode.FAILED, program_failure(run.failures[0])
    return ExitCode.OK, ""


def _interrupted(run: MachineRun, interrupts: Interrupts) -> tuple[ExitCode, str]:
    code, said = interrupts.ending
    return code, f"{said} after {run.tick} cycles"
