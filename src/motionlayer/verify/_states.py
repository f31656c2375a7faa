"""Rules over the sampled state of an axis, after the PLCopen diagram (function-blocks 1.1 and 1.2).

A row shows the state after the commands of its tick were accepted. What lies between two rows is at most
one change by the axis itself (at the end of the earlier tick, or with the inputs of the later one), then any
number of commands, which take no time.
"""

import enum
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Flags, Integers
from motionlayer.verify._report import Finding
from motionlayer.verify._tolerance import sample_tolerance


class State(enum.IntEnum):
    """`MC_AxisStates`."""

    DISABLED = 1
    STANDSTILL = 2
    ERRORSTOP = 3
    STOPPING = 4
    HOMING = 5
    DISCRETE = 6
    CONTINUOUS = 7
    SYNCHRONIZED = 8


_S = State
MAY_BE_OUTSIDE: Final = (_S.DISABLED, _S.HOMING)
"""States in which software limits do not hold."""

AT_REST: Final = (_S.DISABLED, _S.STANDSTILL)
REDEFINES: Final = (_S.DISABLED, _S.STANDSTILL, _S.HOMING, _S.ERRORSTOP)
"""States in which a coordinate may be redefined; an error may come in the same tick."""

COMMANDED: Final = (_S.DISCRETE, _S.CONTINUOUS, _S.HOMING)
"""States that last exactly as long as the command does that moves the axis."""

BY_ITSELF: Final[Mapping[State, Sequence[State]]] = {
    _S.DISABLED: (_S.STANDSTILL,),
    _S.ERRORSTOP: (_S.DISABLED, _S.STANDSTILL),
    _S.STOPPING: (_S.STANDSTILL,),
    _S.HOMING: (_S.STANDSTILL,),
    _S.DISCRETE: (_S.STANDSTILL,),
    _S.CONTINUOUS: (_S.STANDSTILL,),
    _S.SYNCHRONIZED: (_S.STANDSTILL,),
}
"""Changes at the end of a tick, all to a state of rest. ErrorStop, which all may enter, is left out."""

BY_COMMAND: Final[Mapping[State, Sequence[State]]] = {
    _S.STANDSTILL: (_S.DISCRETE, _S.CONTINUOUS, _S.SYNCHRONIZED, _S.HOMING, _S.DISABLED),
    _S.DISCRETE: (_S.CONTINUOUS, _S.SYNCHRONIZED, _S.STOPPING, _S.DISABLED),
    _S.CONTINUOUS: (_S.DISCRETE, _S.SYNCHRONIZED, _S.STOPPING, _S.DISABLED),
    _S.SYNCHRONIZED: (_S.DISCRETE, _S.CONTINUOUS, _S.STOPPING, _S.DISABLED),
    _S.HOMING: (_S.STOPPING, _S.DISABLED),
    _S.STOPPING: (_S.DISABLED,),
}
"""Changes by commands, which may follow one another within a tick."""

ILLEGAL: Final = 0
LEGAL: Final = 1
LEGAL_AT_REST: Final = 2


def _reach(start: State) -> set[State]:
    """Return the states that commands reach within a tick."""
    seen, open_states = {start}, [start]
    while open_states:
        for state in BY_COMMAND.get(open_states.pop(), ()):
            if state not in seen:
                seen.add(state)
                open_states.append(state)
    return seen


def _successions() -> Integers:
    """Return for each pair of states of two successive rows whether it is legal, shape (9, 9)."""
    table = np.full((9, 9), ILLEGAL, np.int64)
    for state in State:
        table[state, [end for rest in BY_ITSELF.get(state, ()) for end in _reach(rest)]] = LEGAL_AT_REST
        table[state, [state, State.ERRORSTOP, *_reach(state)]] = LEGAL
    table[:, State.DISABLED] = np.where(table[:, State.DISABLED] == LEGAL, LEGAL_AT_REST, table[:, State.DISABLED])
    return table


SUCCESSIONS: Final = _successions()


def _moving(axis: Axis) -> Flags:
    v, a = axis.signals["set_velocity"], axis.signals["set_acceleration"]
    wide_v, wide_a = sample_tolerance(axis, "set_velocity"), sample_tolerance(axis, "set_acceleration")
    return np.asarray((np.abs(v) > wide_v) | (np.abs(a) > wide_a))


def state_rules(axis: Axis) -> list[Finding]:
    """All rules over the state signal but those over what a change is caused by."""
    if "state" not in axis.signals:
        return []
    value = axis.signals["state"]
    known = np.isin(value, [float(state) for state in State])
    if not known.all():
        least = np.clip(np.nan_to_num(value), State.DISABLED, State.SYNCHRONIZED)
        return axis.findings("state", ~known, axis.ticks, "no such state", value=value, limit=least)
    state = value.astype(np.int64)
    moving = _moving(axis)
    found = [*_succession(axis, state, moving), *_rest(axis, state, moving)]
    return [*found, *_kinds(axis, state, moving), *_redefinitions(axis, state)]


def _named(axis: Axis, rule: str, bad: Flags, state: Integers, message: str) -> list[Finding]:
    """Make findings whose value is the state, and whose limit the state of the row before."""
    before = np.concatenate([state[:1], state[:-1]]).astype(np.float64)
    return axis.findings(rule, bad, axis.ticks, message, value=state.astype(np.float64), limit=before)


def _succession(axis: Axis, state: Integers, moving: Flags) -> list[Finding]:
    """States follow the diagram."""
    # Before a run begins its axes are Disabled.
    first = SUCCESSIONS[State.DISABLED, state[0]] if axis.ticks[0] == 0 else LEGAL
    verdict = np.concatenate([[first], SUCCESSIONS[state[:-1], state[1:]]])
    wrong = (verdict == ILLEGAL) | ((verdict == LEGAL_AT_REST) & moving)
    return _named(axis, "state order", wrong, state, "state (value) cannot follow the one before it (limit)")


def _rest(axis: Axis, state: Integers, moving: Flags) -> list[Finding]:
    """In Disabled and StandStill nothing moves, from this row to the next."""
    rest = np.isin(state, AT_REST)
    soon = np.concatenate([moving[1:], [False]])
    return _named(axis, "motion at rest", rest & (moving | soon), state, "set values move in a state of rest")


def _kinds(axis: Axis, state: Integers, moving: Flags) -> list[Finding]:
    """What moves the axis fits its state. Under override 0 any plan may hold it."""
    kind = axis.curves.kind[axis.in_force]
    # An endless motion with a software limit ahead is planned to rest there.
    target = axis.curves.target[axis.in_force]
    to_limit = (kind == "position") & ((target == axis.software_limit("min")) | (target == axis.software_limit("max")))
    fits = np.select(
        [
            state == State.DISCRETE,
            state == State.CONTINUOUS,
            np.isin(state, (State.STOPPING, State.ERRORSTOP)),
            state == State.SYNCHRONIZED,  # a coupling, for which format 1 has no kind of plan
        ],
        [kind != "velocity", (kind == "velocity") | to_limit, kind == "stop", False],
        True,
    )
    # A jog key that is released brakes within the motion it began.
    before = np.maximum(axis.in_force - 1, 0)
    released = (kind == "stop") & (axis.curves.command[before] == axis.curves.command[axis.in_force])
    fits |= (state == State.CONTINUOUS) & released
    override = axis.signals.get("override", np.zeros(len(state)))
    soon = np.concatenate([moving[1:], [False]])
    bad = (moving | soon) & ~fits & (override != 0.0)
    return _named(axis, "state and plan", bad, state, "the plan in force is not of the kind this state moves by")


def _redefinitions(axis: Axis, state: Integers) -> list[Finding]:
    """A coordinate is redefined while Disabled, in StandStill or Homing; a motion may begin in the same tick."""
    curves, plan = axis.curves, axis.in_force
    begins = (curves.tick[plan] == axis.ticks) & ~curves.redefines[plan]
    bad = axis.redefined & ~np.isin(state, REDEFINES) & ~begins
    return _named(axis, "state and plan", bad, state, "the coordinate is redefined in a state of motion")
