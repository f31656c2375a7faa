"""`motionlayer run`: what it does."""

import contextlib
import math
import os
import sys
import time
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import Final, NamedTuple, NoReturn

import click

from motionlayer import _kernel
from motionlayer.cli._exit import ExitCode, Stop, complain
from motionlayer.cli._failure import place, program_failure
from motionlayer.cli._files import draw, load_machine, refuse_overwriting
from motionlayer.cli._interrupt import orderly
from motionlayer.cli._options import Options
from motionlayer.cli._progress import Progress
from motionlayer.cli._summary import lines_of, summary
from motionlayer.cli._tally import Tally
from motionlayer.machine import (
    Loaded,
    Machine,
    ProgramError,
    Simulation,
    Source,
    load_program,
    parse_source,
    sources_of,
)
from motionlayer.record import TraceError
from motionlayer.runtime import PATIENCE, CycleFault, ProgramStuck

MOST_FAILURES: Final = 5
"""Failed programs that are named one by one."""


class Problem(NamedTuple):
    """What went wrong in a run."""

    code: ExitCode
    text: str


def simulate(options: Options) -> ExitCode:
    """Run a machine and print the summary; return how it went."""
    machine = load_machine(options.machine)
    sources = _sources(machine, options)
    refuse_overwriting([options.trace, options.plot], [options.machine, *(source.file for source in sources)])
    run = _simulation(machine, _load(sources), options)
    tally = Tally()
    run.events.listen(tally)
    started = time.perf_counter()
    problems = _execute(run, options)
    wall = time.perf_counter() - started
    digest, unwritten = _finish(run)
    known = {problem.text for problem in problems}
    problems += [problem for problem in unwritten if problem.text not in known]
    drawn = _draw(run, options.plot, problems)
    for problem in problems:
        complain(problem.text)
    for line in [*summary(run, tally, wall, options), *lines_of("plot", drawn)]:
        click.echo(line)
    if digest and (options.trace or options.hash):
        click.echo(f"trace hash: {digest}")
    if problems:
        return problems[0].code
    with contextlib.suppress(OSError):  # then the next start says once more that it compiles
        _kernel.mark_cached()
    return ExitCode.OK


def _sources(machine: Machine, options: Options) -> list[Source]:
    sources = [parse_source(options.program)] if options.program else sources_of(machine)
    if not sources and options.time is None:
        raise click.UsageError(
            f"{options.machine} names no program, and the run would never end: give --program FILE[:NAME], or --time S"
        )
    return sources


def _load(sources: Sequence[Source]) -> list[Loaded]:
    try:
        return [load_program(source) for source in sources]
    except ProgramError as error:
        raise Stop(ExitCode.FAILED, f"{error}{place(error.__cause__)}") from error


def _simulation(machine: Machine, programs: list[Loaded], options: Options) -> Simulation:
    if not _kernel.is_cached():
        click.echo("compiling the kernels, once for this version; the next run starts at once", err=True)
    trace: bool | Path | None = options.trace
    if trace is None and (options.plot or options.hash):
        trace = options.plot is not None  # in memory, or the hash alone
    patience = PATIENCE if options.patience is None else options.patience
    try:
        return Simulation(machine, seed=options.seed, trace=trace, programs=programs, patience=patience)
    except TraceError as error:
        raise Stop(ExitCode.TRACE, str(error)) from error


def _execute(run: Simulation, options: Options) -> list[Problem]:
    """Run to the end, whichever it is; return what went wrong."""
    cycle = run.base_cycle_ns * 1e-9
    ticks = None if options.time is None else math.ceil(options.time / cycle)
    try:
        with Progress(ticks, cycle, sys.stderr) as progress, orderly(lambda: _give_up(run)) as check:

            def watch(tick: int) -> None:
                check(tick)
                progress(tick)

            run.run(time=options.time, watch=watch)
    except ProgramStuck as stuck:
        return [Problem(ExitCode.STUCK, str(stuck).rstrip())]
    except CycleFault as fault:
        return [_fault(fault)]
    except KeyboardInterrupt:
        return [Problem(ExitCode.INTERRUPTED, f"interrupted at {run.time:.9g} s of the run")]
    except SystemExit as leak:
        if not run.failures:
            return [Problem(ExitCode.FAILED, f"sys.exit() was called in a program; return instead{place(leak)}")]
    return _failures(run)


def _failures(run: Simulation) -> list[Problem]:
    texts = [program_failure(program) for program in run.failures]
    if len(texts) > MOST_FAILURES:
        texts[MOST_FAILURES:] = [f"and {len(texts) - MOST_FAILURES} more programs failed"]
    return [Problem(ExitCode.FAILED, text) for text in texts]


def _fault(fault: CycleFault) -> Problem:
    cause = fault.__cause__
    if isinstance(cause, TraceError):  # found when the next block was to be written
        return Problem(ExitCode.TRACE, str(cause))
    lines = "".join(traceback.format_exception(cause)) if cause is not None else ""
    text = f"a fault of motionlayer itself in {fault}; the run has ended. Please report it with these lines:\n{lines}"
    return Problem(ExitCode.FAULT, text.rstrip())


def _finish(run: Simulation) -> tuple[str, list[Problem]]:
    """Close the trace; return the hash of the run."""
    try:
        return run.close(), []
    except TraceError as error:
        return "", [Problem(ExitCode.TRACE, str(error))]


def _draw(run: Simulation, page: Path | None, problems: list[Problem]) -> list[str]:
    """Draw what was recorded, also of a run that failed; return the page if it was written."""
    if page is None or any(problem.code is ExitCode.TRACE for problem in problems):
        return []
    try:
        draw(run.trace, page)
    except Stop as stop:
        problems.append(Problem(stop.code, str(stop)))
        return []
    return [str(page)]


def _give_up(run: Simulation) -> NoReturn:
    """End the process: a program swallows every interrupt, so that nothing else ends it."""
    with contextlib.suppress(TraceError):
        run.close()
    complain("a program does not yield and swallows interrupts (`except:` or `except BaseException`); ended here")
    sys.stdout.flush()
    os._exit(ExitCode.STUCK)
