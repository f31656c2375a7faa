"""The oracle's rules of Info and of the client's data: errors come with their state and go by D14 (5.2, 5.3, 6)."""

from collections.abc import Iterator

import numpy as np

from motionlayer.bench.campaign import _contract_words as words
from motionlayer.bench.campaign._contract_recording import Recording
from motionlayer.bench.campaign._contract_states import ended
from motionlayer.bench.campaign._contract_watch import Fault, Segment, Watch
from motionlayer.event import Kind


def flagged(watch: Watch, parts: list[Segment]) -> Iterator[Fault]:
    """BError is what 6 means by it: a command has failed and nothing has cleared that, or the axis is in error.

    Whether a command's error is pending cannot be told at times: an AXIS_IDLE that is replaced in the very cycle that
    would have shown its DONE has cleared it, and an error of the axis hides that. So both are kept as possible, until
    bError tells which it is.
    """
    pending, last = {False}, words.NULL
    for segment in parts:
        if segment.command == words.RESET or (last == words.AXIS_INIT and segment.initialised):
            pending = {False}
        last = segment.command
        end = ended(watch, segment) if segment.command != words.NULL else None
        clears = _clears(watch, segment, end)
        for tick in range(segment.start, segment.stop):
            if tick == end:
                pending = _pending(watch.state[tick], segment.command, before=pending)
            elif tick == clears:
                pending = pending | {False}
            shown = bool(watch.bits[tick] & words.IN_ERROR)
            pending = {one for one in pending if shown in _allowed(watch, tick, pending=one)}
            if not pending:
                yield Fault(watch.name, tick, "bError", f"it is {shown}, State {watch.state[tick]}")
                return


def _clears(watch: Watch, segment: Segment, end: int | None) -> int | None:
    """Return the tick whose call may have cleared the error; DONE is shown a cycle later, or another command is."""
    if segment.command not in words.CLEARING:
        return None
    if end is not None:
        return end - 1 if _is_done(watch.state[end]) else None
    last = segment.stop - 1
    following = words.STEPS[segment.command].get(watch.state[last] - segment.command, ())
    return last if words.DONE in following else None


def _pending(state: int, command: int, *, before: set[bool]) -> set[bool]:
    """Return whether an error may be pending once an end is shown (D14)."""
    if not _is_done(state):
        return {True}
    return {False} if command in words.CLEARING else before


def _is_done(state: int) -> bool:
    return state >= words.DONE


def _allowed(watch: Watch, tick: int, *, pending: bool) -> set[bool]:
    """Return what bError may show; an error of the axis is seen within a cycle."""
    return {pending or bool(number) for number in _axis_errors(watch, tick)}


def _axis_errors(watch: Watch, tick: int) -> set[int]:
    """Return the numbers that the axis itself may show: those of two cycles, and none right after a reset."""
    own = {watch.errors[max(tick - 1, 0)], watch.errors[tick]}
    return own | {0} if tick in watch.cleared or tick - 1 in watch.cleared else own


def numbered(watch: Watch, segment: Segment) -> Iterator[Fault]:
    """NErrorId is the number of what has failed while State shows it, and that of the axis, or 0, otherwise."""
    end = ended(watch, segment)
    if segment.command == words.NULL:
        end = None
    for tick in range(segment.start, segment.stop):
        own = _axis_errors(watch, tick)
        failed = end is not None and tick >= end and not _is_done(watch.state[tick])
        allowed = (_numbers(segment, end) if failed and end is not None else {0}) | own
        shown = watch.error_id[tick]
        if failed and _at_once(segment):
            if shown == 0:
                yield Fault(watch.name, tick, "nErrorId", f"it is 0, State {watch.state[tick]}")
                return
        elif shown not in allowed and not watch.bits[tick] & words.TIMEOUT:
            listed = ", ".join(f"0x{one:X}" for one in sorted(allowed))
            yield Fault(watch.name, tick, "nErrorId", f"it is 0x{shown:X}, State {watch.state[tick]}; allowed {listed}")
            return


def _at_once(segment: Segment) -> bool:
    """Tell whether a command fails without asking the axis."""
    return segment.command not in words.STEPS or not (segment.initialised or segment.command == words.AXIS_INIT)


def _numbers(segment: Segment, end: int) -> set[int]:
    """Return the number of what was asked for last and has failed; what was taken over has none."""
    lost = [one for one in segment.given if one.failed and one.end < end]
    return {0 if lost[-1].how is Kind.ABORTED else lost[-1].code} if lost else set()


def occupied(watch: Watch, segment: Segment) -> Iterator[Fault]:
    """BBusy shows a command under way; bReady excludes bBusy and bError and needs bEnabled."""
    end = ended(watch, segment) if segment.command != words.NULL else segment.start
    for tick in range(segment.start, segment.stop):
        bits = watch.bits[tick]
        if (end is None or tick < end) and not bits & words.BUSY:
            yield Fault(watch.name, tick, "bBusy", f"it is false, State {watch.state[tick]}")
            return
        if bits & words.READY and (bits & (words.BUSY | words.IN_ERROR) or not bits & words.ENABLED):
            yield Fault(watch.name, tick, "bReady", f"it is true, bits of Info are 0x{bits:02X}")
            return


def finite(recording: Recording) -> Iterator[Fault]:
    """What is no number is 0.0 in the client's structure from the cycle on that sees it; all else is left alone."""
    for name in recording.asked.dtype.names or ():
        asked, stands = recording.asked[name], recording.data[name]
        expected = np.where(np.isfinite(asked), asked, 0)
        for tick, place in np.argwhere(stands != expected)[:1].tolist():
            text = f"{name} was written as {asked[tick, place]}, {stands[tick, place]} stands there"
            yield Fault(recording.axes[place], tick, "data", text)
