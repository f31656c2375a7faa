"""Rules over what changes a state, and what an event must have changed: one table, and back.

A row shows the state after the commands of its tick. What ends with the setpoints of tick n - 1 shows in row n; so
does an error of the monitors of n - 1, and one of the inputs of n.
"""

from collections.abc import Mapping
from typing import Final

import numpy as np

from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Flags, Integers
from motionlayer.verify._lives import Life
from motionlayer.verify._moments import Moments, changes, just_after, just_before
from motionlayer.verify._report import Finding
from motionlayer.verify._states import COMMANDED, State

MOTION: Final = (State.STOPPING, State.HOMING, State.DISCRETE, State.CONTINUOUS, State.SYNCHRONIZED)


def cause_rules(axis: Axis, moments: Moments, lives: Mapping[int, Life]) -> list[Finding]:
    """All rules that join states and events."""
    state = axis.signals.get("state")
    if state is None or not np.isin(state, [float(one) for one in State]).all():
        return []
    numbers = state.astype(np.int64)
    return [
        *_changes(axis, numbers, moments),
        *_consequences(axis, numbers, moments),
        *_moved_by(axis, numbers, lives),
    ]


def _named(axis: Axis, rule: str, bad: Flags, state: Integers, message: str) -> list[Finding]:
    """Make findings whose value is the state, and whose limit the state of the row before."""
    before = np.concatenate([state[:1], state[:-1]]).astype(np.float64)
    return axis.findings(rule, bad, axis.ticks, message, value=state.astype(np.float64), limit=before)


def _changes(axis: Axis, state: Integers, moments: Moments) -> list[Finding]:
    """Every change has its cause."""
    before = np.concatenate([state[:1], state[:-1]])
    changed = changes(state)
    error, moves, rests = state == State.ERRORSTOP, np.isin(state, MOTION), state == State.STANDSTILL
    given = moments.accepted | moments.ended | just_before(moments.ended)
    ran = np.isin(before, COMMANDED)
    cases = (
        (error & ~moments.faulted & ~just_before(moments.faulted), "ErrorStop without an error of the axis"),
        ((before == State.ERRORSTOP) & ~moments.done, "the error is left without a reset that is done"),
        (moves & ~given, "motion begins without a command that was just accepted"),
        (rests & ran & ~moments.ended & ~just_before(moments.ended), "a motion is over and its command has not ended"),
        (~error & ~moves & ~moments.busy_before, "the state changes without a command"),
    )
    found = []
    for bad, text in cases:
        found += _named(axis, "state cause", changed & bad, state, text)
    return found


def _consequences(axis: Axis, state: Integers, moments: Moments) -> list[Finding]:
    """An error puts the axis in ErrorStop; a command that ends with one ends in it; an abortion is by a command."""
    error = state == State.ERRORSTOP
    soon = error | just_after(error)
    alone = moments.aborted & ~moments.accepted
    late = soon | (just_before(error) & moments.done)  # who waited for power in error fails when that is cleared
    return [
        *_named(axis, "state cause", moments.faulted & ~soon, state, "an error of the axis, and no ErrorStop follows"),
        *_named(
            axis,
            "command end",
            moments.failed & ~late,
            state,
            "a command ends with an error, the axis has none",
        ),
        *_named(axis, "command end", alone, state, "a command is aborted, and no other one was accepted"),
    ]


def _moved_by(axis: Axis, state: Integers, lives: Mapping[int, Life]) -> list[Finding]:
    """In a state of commanded motion the plan in force serves a command that is under way.

    So it does while the axis is Stopping, but for a brake that serves none.
    """
    spans = [_span(lives.get(number)) for number in axis.curves.command.tolist()]
    begin, end = np.array(spans, np.int64).T[:, axis.in_force]
    braking = (state == State.STOPPING) & (axis.signals["set_velocity"] != 0.0)
    braking &= axis.curves.command[axis.in_force] != 0
    idle = (np.isin(state, COMMANDED) | braking) & ~((begin <= axis.ticks) & (axis.ticks <= end))
    text = "the plan in force serves no command that is under way"
    return _named(axis, "state cause", idle, state, text)


def _span(life: Life | None) -> tuple[int, int]:
    return (1, 0) if life is None else (life.accepted, life.ended)
