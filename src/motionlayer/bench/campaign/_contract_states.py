"""The oracle's rules of State: the answer, the steps in their order, the end and its reason (motion-layer 5.1 to 5.9).

Each rule is given an axis and what one command has shown, and yields what is wrong.
"""

from collections.abc import Iterator
from typing import Final

from motionlayer.bench.campaign import _contract_words as words
from motionlayer.bench.campaign._contract_watch import Fault, Given, Segment, Watch
from motionlayer.event import Kind

SOON: Final = 5
"""Cycles in which a job goes on without an axis that works for it: each step takes a call, and its result another."""

EPSILON: Final = 1e-9

OVERRIDE: Final = 2e-6
"""Relative; the NC counts the override in steps of a millionth (D23)."""


def answered(watch: Watch, segment: Segment) -> Iterator[Fault]:
    """State shows a new command in the cycle in which it is seen."""
    if segment.start == 0 and segment.command == words.NULL:
        return  # nothing has been commanded yet
    expected = words.answer(segment.command, initialised=segment.initialised)
    state = watch.state[segment.start]
    if state != expected:
        text = f"State is {state}, {expected} answers command {segment.command}"
        yield Fault(watch.name, segment.start, "answer", text)


def stepped(watch: Watch, segment: Segment) -> Iterator[Fault]:
    """Afterwards it goes from step to step as the table of 5.5 has them, and stays where the job has ended."""
    base, steps = _base(segment), _steps(segment)
    before = watch.state[segment.start] - base
    for tick in range(segment.start + 1, segment.stop):
        now = watch.state[tick] - base
        if now == before and now not in (words.INIT, _short(segment)):
            continue
        allowed = _following(watch, segment, steps, before, tick)
        if now not in allowed:
            shown = ", ".join(str(base + one) for one in allowed) or "nothing else"
            text = f"State {base + now} after {base + before}; command {segment.command} allows {shown}"
            yield Fault(watch.name, tick, "order of steps", text)
            return
        before = now


def _base(segment: Segment) -> int:
    """Return the number that State is based on."""
    if segment.command in {words.NULL, words.AXIS_INIT}:
        return segment.command
    if not segment.initialised:
        return words.NO_INIT
    return segment.command if segment.command <= words.LARGEST else 0


def _steps(segment: Segment) -> words.Steps:
    """Return what may follow what; nothing follows an answer that is an end."""
    if segment.command in {words.NULL, words.AXIS_INIT} or segment.initialised:
        return words.STEPS.get(segment.command, {})
    return {words.INIT: ()}


def _short(segment: Segment) -> int:
    """Return the step that shows for one cycle alone, as INIT does."""
    return words.STARTUP if segment.command == words.MOVE_BUFFER else words.INIT


def _following(watch: Watch, segment: Segment, steps: words.Steps, before: int, tick: int) -> list[int]:
    """Return what may be shown next, brackets of 5.5 resolved."""
    if before not in steps:
        return []
    allowed = [one for one in steps[before] if _fits(watch, segment, before, one, tick)]
    return [*allowed, words.ERROR]


def _fits(watch: Watch, segment: Segment, before: int, after: int, tick: int) -> bool:
    """Tell whether the condition of a step in brackets holds; the others have none."""
    match segment.command, before, after:
        case words.AXIS_INIT, 3000, _:
            return (after == 5000) is (watch.encoder[tick] > 1)
        case words.HOME, 1000, _:
            wanted = after == words.STARTUP
            return any(bool(watch.bits[one] & words.REFERENCED) is wanted for one in (segment.start - 1, segment.start))
        case words.IDLE, _, words.PREPARE:
            return any(one.failed for one in segment.given) or tick - segment.start > watch.patience
        case ((words.MOVE_BUFFER | words.MOVE_BUFFER_VELO), _, words.DONE):
            return watch.ends[tick - 1] == words.DONE
    return True


def founded(watch: Watch, segment: Segment) -> Iterator[Fault]:
    """DONE and ERROR have the reason that 5.5 names, and come one cycle after it."""
    tick = ended(watch, segment)
    if tick is None or segment.command not in words.STEPS or _base(segment) != segment.command:
        return
    progress = watch.state[tick] - segment.command
    if progress == words.ERROR:
        timed_out = watch.bits[tick] & words.TIMEOUT
        if not timed_out and not any(one.failed and one.end < tick for one in segment.given):
            yield Fault(watch.name, tick, "reason", f"State {watch.state[tick]}, and nothing has failed")
    elif progress == words.DONE and not _reached(watch, segment, tick):
        yield Fault(watch.name, tick, "reason", f"State {watch.state[tick]}, and its condition does not hold")


def ended(watch: Watch, segment: Segment) -> int | None:
    """Return the tick that shows the end of a command first."""
    base = _base(segment)
    for tick in range(segment.start, segment.stop):
        if watch.state[tick] - base in words.FINAL:
            return tick
    return None


def _reached(watch: Watch, segment: Segment, tick: int) -> bool:
    """Tell whether a command may be DONE; the job saw in the cycle before what the axis had done by then."""
    own = [one for one in segment.given if one.start < tick and one.method in words.CALLS[segment.command]]
    last = own[-1] if own else None
    done = last is not None and last.how is Kind.DONE and last.end < tick
    match segment.command:
        case words.ENABLE | words.IDLE | words.DISABLE:
            wanted = segment.command != words.DISABLE
            return done and any(bool(watch.bits[one] & words.ENABLED) is wanted for one in range(tick - 2, tick + 1))
        case words.HALT | words.STOP:
            return done or any(watch.rests(one) for one in (tick - 2, tick - 1))
        case words.MOVE_VELO:
            return last is not None and last.how is not Kind.REFUSED and _in_velocity(watch, last, tick)
        case words.SEND_TO_POS:
            return done or _way(watch, segment, tick) > watch.distance[segment.start] - EPSILON
        case words.MOVE_BUFFER | words.MOVE_BUFFER_VELO | words.READ:
            return True  # what ends these is told by eProgress, or nothing has to be waited for
    return done


def _in_velocity(watch: Watch, given: Given, tick: int) -> bool:
    """Tell whether the axis has come to the velocity that was asked for, at an override of the last cycles."""
    recent = range(max(tick - 2, 0), tick + 1)
    asked = float(words.VELOCITY.findall(given.text)[0])
    allowed = [asked * min(max(float(watch.data[one]["override"]), 0.0), 100.0) / 100.0 for one in recent]
    return any(
        abs(abs(watch.velocity[one]) - speed) <= EPSILON + OVERRIDE * asked for one in recent for speed in allowed
    )


def _way(watch: Watch, segment: Segment, tick: int) -> float:
    """Return how far an axis has come, as Info shows it, which is a cycle later than the axis itself."""
    return abs(watch.actual[tick] - watch.actual[segment.start])


def goes_on(watch: Watch, segment: Segment) -> Iterator[Fault]:
    """A command ends, or the axis works on it; none waits for what will not come (D6, D7, D8)."""
    if segment.command not in words.STEPS or segment.command in words.ENDLESS:
        return
    stop = ended(watch, segment) or segment.stop
    lives: list[Given] = segment.given
    quiet = 0
    for tick in range(segment.start, stop):
        quiet = 0 if any(one.lives(tick) for one in lives) else quiet + 1
        if quiet > SOON:
            yield Fault(watch.name, tick, "goes on", f"State {watch.state[tick]}, and the axis does nothing for it")
            return
    yield from _in_time(watch, segment, stop)


def _in_time(watch: Watch, segment: Segment, stop: int) -> Iterator[Fault]:
    """Switching on, off and clearing are supervised; a progress stands for two of their steps at most."""
    if segment.command not in words.SWITCHING:
        return
    begin = segment.start
    for tick in range(segment.start + 1, stop):
        if watch.state[tick] != watch.state[tick - 1]:
            begin = tick
        elif tick - begin > 2 * (watch.patience + SOON):
            yield Fault(watch.name, tick, "time-out", f"State {watch.state[tick]} since tick {begin}")
            return
