"""`motionlayer run`: what it does."""

import contextlib
import math
import sys
import time
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import Final, NamedTuple, NoReturn

import click

from motionlayer import _kernel
from motionlayer.cli._ads import FOREVER, ads_of
from motionlayer.cli._ads import lines as ads_lines
from motionlayer.cli._exit import ExitCode, Stop, complain, say
from motionlayer.cli._failure import place, program_failure
from motionlayer.cli._files import draw, load_machine, refuse_overwriting
from motionlayer.cli._interrupt import Interrupts, orderly
from motionlayer.cli._log import log_of, losses, warn
from motionlayer.cli._options import Options, require_clock
from motionlayer.cli._programs import chosen, give_up, load
from motionlayer.cli._progress import Progress
from motionlayer.cli._summary import lines_of, summary
from motionlayer.cli._tally import Tally
from motionlayer.machine import (
    REALTIME_PATIENCE,
    Loaded,
    Machine,
    MachineRun,
    RealTime,
    RunKeywords,
    ServerFailed,
    Simulation,
    Source,
)
from motionlayer.record import TraceError
from motionlayer.record.log import LogError
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
    run = _made(machine, _load(sources, options), options)
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
        say(line)
    if digest and (options.trace or options.hash):
        say(f"trace hash: {digest}")
    if problems:
        return problems[0].code
    with contextlib.suppress(OSError):  # then the next start says once more that it compiles
        _kernel.mark_cached()
    return ExitCode.OK


def _sources(machine: Machine, options: Options) -> list[Source]:
    require_clock(options.speed, realtime=options.realtime)
    sources = chosen(machine, options.program)
    if not sources and options.time is None and not _commanded(machine, options):
        raise click.UsageError(
            f"{options.machine} names no program, and the run would never end: give --program FILE[:NAME], or --time S"
            + (", or --realtime, where ADS clients command it" if ads_of(machine, options) is not False else "")
        )
    return sources


def _commanded(machine: Machine, options: Options) -> bool:
    """Tell whether the run is one that clients command, and goes on until somebody ends it."""
    return options.realtime and ads_of(machine, options) is not False


def _load(sources: Sequence[Source], options: Options) -> list[Loaded]:
    loaded = load(sources)
    cyclic = [one.name for one in loaded if one.task is not None]
    if cyclic and options.time is None and not options.realtime:
        raise click.UsageError(
            f"cyclic program {cyclic[0]} goes on until it is cancelled, and the run might never end: give --time S"
        )
    return loaded


def _made(machine: Machine, programs: list[Loaded], options: Options) -> MachineRun:
    if not _kernel.is_cached():
        click.echo("compiling the kernels, once for this version; the next run starts at once", err=True)
    trace: bool | Path | None = options.trace
    if trace is None and (options.plot or options.hash):
        trace = options.plot is not None  # in memory, or the hash alone
    patience = options.patience or (REALTIME_PATIENCE if options.realtime else PATIENCE)
    common: RunKeywords = {"seed": options.seed, "trace": trace, "programs": programs, "patience": patience}
    common["log"], common["ads"] = log_of(machine, options), ads_of(machine, options)
    try:
        if options.realtime:
            return RealTime(machine, speed=options.speed or 1.0, **common)
        return Simulation(machine, statistics=options.statistics, **common)
    except (TraceError, LogError, ServerFailed) as error:
        raise Stop(ExitCode.OUTPUT, str(error)) from error


def _execute(run: MachineRun, options: Options) -> list[Problem]:
    """Run to the end, whichever it is; return what went wrong."""
    cycle = run.base_cycle_ns * 1e-9
    ticks = None if options.time is None else math.ceil(options.time / cycle)
    try:
        with Progress(ticks, cycle, sys.stderr) as progress, orderly(run, lambda: _give_up(run)) as interrupts:
            # In real time a terminal that does not take it would hold up the cycle.
            for line in lines_of("ads", ads_lines(run)):
                say(line)
            alone = options.time is None and run.idle  # then clients command it
            run.run(time=FOREVER if alone else options.time, watch=None if options.realtime else progress)
    except ProgramStuck as stuck:
        return [Problem(ExitCode.STUCK, str(stuck).rstrip())]
    except CycleFault as fault:
        return [_fault(fault)]
    except KeyboardInterrupt:
        return [_interrupted(run, interrupts)]
    except SystemExit as leak:
        if not run.failures:
            return [Problem(ExitCode.FAILED, f"sys.exit() was called in a program; return instead{place(leak)}")]
    return [_interrupted(run, interrupts)] if interrupts.first is not None else _failures(run)


def _interrupted(run: MachineRun, interrupts: Interrupts) -> Problem:
    code, said = interrupts.ending
    return Problem(code, f"{said} at {run.time:.9g} s of the run")


def _failures(run: MachineRun) -> list[Problem]:
    texts = [program_failure(program) for program in run.failures]
    if len(texts) > MOST_FAILURES:
        texts[MOST_FAILURES:] = [f"and {len(texts) - MOST_FAILURES} more programs failed"]
    return [Problem(ExitCode.FAILED, text) for text in texts]


def _fault(fault: CycleFault) -> Problem:
    cause = fault.__cause__
    if isinstance(cause, TraceError):  # found when the next block was to be written
        return Problem(ExitCode.OUTPUT, str(cause))
    lines = "".join(traceback.format_exception(cause)) if cause is not None else ""
    text = f"a fault of motionlayer itself in {fault}; the run has ended. Please report it with these lines:\n{lines}"
    return Problem(ExitCode.FAULT, text.rstrip())


def _finish(run: MachineRun) -> tuple[str, list[Problem]]:
    """Close trace and message files; return the hash of the run."""
    digest, problems = "", []
    try:
        digest = run.close()
    except TraceError as error:
        problems.append(Problem(ExitCode.OUTPUT, str(error)))
    except LogError as error:
        problems.append(Problem(ExitCode.FAULT, str(error)))
    warn(run)
    return digest, problems + [Problem(ExitCode.OUTPUT, text) for text in losses(run)]


def _draw(run: MachineRun, page: Path | None, problems: list[Problem]) -> list[str]:
    """Draw what was recorded, also of a run that failed; return the page if it was written."""
    if page is None or any(problem.code is ExitCode.OUTPUT for problem in problems):
        return []
    try:
        draw(run.trace, page)
    except Stop as stop:
        problems.append(Problem(stop.code, str(stop)))
        return []
    return [str(page)]


def _give_up(run: MachineRun) -> NoReturn:
    """End the process with what there is of trace and messages."""
    with contextlib.suppress(TraceError, LogError):
        run.close()
    give_up()
