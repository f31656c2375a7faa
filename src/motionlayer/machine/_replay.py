"""`replay`: run a recorded run again, from its trace alone, and compare.

The trace holds the checked machine, the seed, which programs there were, and everything that came from outside with
the tick at which it was applied: what other threads posted, faults and emergency stops that the owner of the run asked
for, how late ticks were, tasks over their budget, trouble with files. The replay is a simulation of that machine with
these programs. The inputs are applied at their ticks, what threads of the programs post is not, and it has
exactly as many ticks; then the programs are cancelled, as they were. So the hash must be the same.

What a trace cannot hold is what a script does with a run from Python: commands between `run.step()`, programs that it
starts. Programs can be handed over again; the rest shows as a difference.
"""

import math
from collections.abc import Callable, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any, Final, NamedTuple

from motionlayer.event import Kind
from motionlayer.machine._programs import Loaded, Source
from motionlayer.machine._recorded import ReplayError, function_program, installation_notes, load_recorded, machine_of
from motionlayer.machine._simulation import Simulation
from motionlayer.machine._tracing import header
from motionlayer.record import Difference, Trace, difference

STRIDE: Final = 256
"""Ticks between two calls of who watches."""


class Replay(NamedTuple):
    """How a replay compares with what was recorded.

    Attributes:
        same: every bit that was compared is the same.
        difference: the first one that is not, in words; "" if they are the same.
        ticks: number of ticks that were run.
        compared: what was compared, in words.
        notes: what may have made it another run, or could not be compared.
    """

    same: bool
    difference: str
    ticks: int
    compared: str
    notes: tuple[str, ...] = ()


class _Part(NamedTuple):
    """Which part of a recorded run can be repeated and compared.

    Attributes:
        ticks: to be run.
        end: nothing from this tick on is compared.
        what: in words, "" for the whole run.
    """

    ticks: int
    end: float = math.inf
    what: str = ""


def replay(
    trace: Trace,
    programs: Sequence[Loaded | Callable[..., Any]] | None = None,
    *,
    folder: Path | None = None,
    instead: Sequence[Source] = (),
    watch: Callable[[int], None] = lambda _tick: None,
) -> Replay:
    """Run what was recorded again, and compare bit for bit.

    Of a whole trace the hash is compared, and where it differs the signals, plans and events. Of one that broke off,
    that has gaps, or whose run ended inside of a tick, all that is there is compared instead.

    Args:
        trace: what was recorded.
        programs: what ran: loaded programs, or functions as a program file has them; those that the trace names,
            loaded from their files, where left out.
        folder: of the trace, where program files are looked for as well; the working directory where left out.
        instead: files in the place of those that the trace names, by their names; a single one for a single program.
        watch: called with the tick now and then.

    Raises:
        CycleFault: a step of the runtime itself failed.
        ProgramError: a program file cannot be loaded.
        ReplayError: the trace does not hold a run from its beginning on, or a program of it is not found.
    """
    part, machine = _part_of(trace), machine_of(trace)
    if programs is None:
        loaded, notes = load_recorded(trace, folder or Path(), instead)
    else:
        loaded, notes = [one if isinstance(one, Loaded) else function_program(one) for one in programs], []
    run = Simulation(machine, seed=trace.header["seed"], programs=loaded, log=False, ads=False)
    try:
        _play(run, trace, part, watch)
    finally:
        digest = run.close()
    compared, text = _compared(trace, run, digest, part, others=bool(notes))
    notes += installation_notes(trace.header, header(machine, run.seed, loaded))
    return Replay(not text, text, run.tick, compared, tuple(notes))


def _part_of(trace: Trace) -> _Part:
    """Return what of a trace can be repeated.

    Raises:
        ReplayError: nothing.
    """
    first = min([int(tick) for tick in trace.ticks[:1]] + [gap.first for gap in trace.gaps], default=0)
    if first > 0:
        raise ReplayError(
            f"the trace begins at tick {first}: only a run that was recorded from its beginning can be run"
        )
    if not trace.signals and not (trace.hash and trace.end is not None and not trace.end.inside):
        raise ReplayError("the trace holds no signals, and no hash of a whole run: there is nothing to be compared")
    if trace.end is None:
        if not len(trace.ticks):
            raise ReplayError("the trace holds no tick: there is nothing to be compared")
        count = int(trace.ticks[-1]) + 1
        return _before_losses(trace, _Part(count, count, f"all that it holds: it broke off after tick {count - 1}"))
    ticks, cause, inside = trace.end
    if inside:
        what = f"up to tick {ticks}, inside of which the run ended ({cause}): how far it had come cannot be repeated"
        return _before_losses(trace, _Part(ticks, ticks, what))
    return _before_losses(trace, _Part(ticks, what="all that it holds: it has gaps" if trace.gaps else ""))


def _before_losses(trace: Trace, part: _Part) -> _Part:
    """Leave out what comes after a gap in which records are missing: inputs may be among them."""
    first = min((gap.first for gap in trace.gaps if gap.records), default=math.inf)
    if first >= part.end:
        return part
    count = int(first)
    return _Part(count, count, f"up to tick {count}, where records are missing; inputs may be among them")


def _compared(trace: Trace, run: Simulation, digest: str, part: _Part, *, others: bool) -> tuple[str, str]:
    """Return what was compared, and the first difference, "" if there is none; `others` ran than were recorded."""
    whole = bool(trace.hash) and not part.what
    if whole and trace.hash == digest:
        return f"the hash, {digest}", ""
    text = "the trace holds nothing beside its hash"
    if trace.signals:
        found = difference(trace, run.trace, end=part.end)
        text = "" if found is None else _told(found, trace, guess=not others)
    if whole:
        text = text or "of what the trace holds beside its hash nothing differs"
        return "the hash", f"{text}; hash {trace.hash} in the trace, {digest} in the replay"
    return part.what or "all that it holds: it has no hash", text


def _play(run: Simulation, trace: Trace, part: _Part, watch: Callable[[int], None]) -> None:
    """Run all ticks, each with its inputs.

    Raises:
        ReplayError: there is an input for a channel that nobody has opened.
    """
    run.mailbox.deaf = True
    for tick, inputs in groupby(trace.inputs, key=lambda one: one.tick):
        if tick > part.ticks or tick >= part.end:
            break
        _step_to(run, tick, watch)
        try:
            run.mailbox.feed(inputs)
        except KeyError as error:
            raise ReplayError(
                f"{error.args[0]}: a script has opened it; let a program do so, in its first tick, and record again"
            ) from error
    _step_to(run, part.ticks, watch)
    if part.end > part.ticks:  # what was done to the run after its last tick
        run.mailbox.apply(run.tick)


def _step_to(run: Simulation, tick: int, watch: Callable[[int], None]) -> None:
    while run.tick < tick:
        run.step(min(STRIDE, tick - run.tick))
        watch(run.tick)


def _told(found: Difference, trace: Trace, *, guess: bool) -> str:
    """Return a difference in words, with what a script may have to do with it where nothing else explains it."""
    text = f"tick {found.tick} ({found.tick * trace.base_cycle:.9g} s): {found.text}"
    if guess and found.missing is not None and found.missing.kind is Kind.ACCEPTED:
        text += (
            "; a script may have started it: what a script does between the ticks of a run is not recorded, "
            "programs are given in `replay(trace, programs=[...])` or with --program"
        )
    return text
