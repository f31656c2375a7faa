"""Rules over what a command asked for and what the plans that serve it do: what kind, where to, taken over when."""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from motionlayer.event import Kind
from motionlayer.verify._axis import Axis
from motionlayer.verify._carried import Carried, Place
from motionlayer.verify._goals import Goals
from motionlayer.verify._lives import Life
from motionlayer.verify._report import Finding
from motionlayer.verify._requests import BRAKES, MOTIONS, Request, request
from motionlayer.verify._states import State

Lives = Mapping[int, Life]


def asked_rules(axis: Axis, lives: Lives) -> list[Finding]:
    """All rules over what commands asked for but those over dynamics."""
    own = served(axis, lives)
    found = []
    for life in own.values():
        if request(life.text).name not in MOTIONS:
            text = f"a plan serves command {life.number}, whose message tells of no motion: {life.text!r}"
            found.append(axis.finding("command text", life.accepted, text))
    found += [
        *_begun(axis, lives),
        *_brakes_alone(axis, lives),
        *_states(axis, own),
        *_kinds(axis, own),
        *_joints(axis, own, lives),
    ]
    goals = Goals(axis, lives)
    return [*found, *_targets(axis, own, lives, goals), *_held(axis, own, goals)]


def _begun(axis: Axis, lives: Lives) -> list[Finding]:
    """A motion that does not wait has a plan from the tick in which it was accepted; one that is done has had one."""
    found, curves = [], axis.curves
    for life in lives.values():
        asked = request(life.text)
        if life.source != axis.name or life.kind == Kind.REFUSED or asked.name not in MOTIONS:
            continue
        if not axis.ticks[0] <= life.accepted <= axis.ticks[-1]:
            continue
        ticks = curves.tick[curves.command == life.number]
        at_once = asked.mode == "ABORTING" and life.accepted < life.ended
        moved = (ticks == life.accepted).any() if at_once else len(ticks) > 0
        if not moved and (at_once or (life.kind == Kind.DONE and asked.name != "home")):
            text = f"no plan serves command {life.number} from where it begins, {life.text}"
            found.append(axis.finding("command plan", life.accepted, text))
    return found


def served(axis: Axis, lives: Lives) -> dict[int, Life]:
    """Return the commands of an axis that plans serve."""
    numbers = set(axis.curves.command.tolist())
    return {
        number: life
        for number, life in lives.items()
        if number in numbers and life.source == axis.name and life.kind != Kind.REFUSED
    }


def plans_of(axis: Axis, own: Lives, *kinds: str) -> Iterator[tuple[int, Life, Request]]:
    """Yield the plans of some kinds with the commands they serve."""
    for plan in np.flatnonzero(np.isin(axis.curves.kind, kinds)).tolist():
        life = own.get(int(axis.curves.command[plan]))
        if life is not None:
            yield plan, life, request(life.text)


def override_of(axis: Axis, plan: int) -> float:
    """Return the override under which a plan was made; nan where it is not recorded lossless."""
    if "override" not in axis.signals or not axis.recorded[plan] or axis.resolution["override"] != 0.0:
        return math.nan
    return float(axis.signals["override"][axis.row_taken[plan]])


def _brakes_alone(axis: Axis, lives: Lives) -> list[Finding]:
    """A brake that serves no command is that of an error, or of a command that takes power or a direction away."""
    if "state" not in axis.signals:
        return []
    curves, own = axis.curves, [life for life in lives.values() if life.source == axis.name]
    taken = {life.accepted for life in own if request(life.text).name in ("disable", "enable")}
    found = []
    for plan in np.flatnonzero((curves.kind == "stop") & (curves.command == 0) & axis.recorded).tolist():
        tick, state = int(curves.tick[plan]), axis.signals["state"][axis.row_taken[plan]]
        shifted = plan > 0 and curves.kind[plan - 1] == "shift" and int(curves.tick[plan - 1]) == tick
        if state != State.ERRORSTOP and tick not in taken and not shifted:
            found.append(axis.finding("command plan", tick, "a brake serves no command, and the axis is not in error"))
    return found


def _states(axis: Axis, own: Lives) -> list[Finding]:
    """An axis that moves is in the state of the command that its plan serves."""
    if "state" not in axis.signals:
        return []
    state, command = axis.signals["state"], axis.curves.command[axis.in_force]
    found = []
    for life in own.values():
        expected = _state_of(request(life.text))
        rows = (command == life.number) & (axis.ticks <= life.ended) & (axis.signals["set_velocity"] != 0.0)
        # The state of a row in which the command ends is that of what comes after it, if that is in the inputs.
        bad = rows & (state != expected) & ((axis.ticks < life.ended) | (life.kind == Kind.DONE))
        text = f"state (value) is not the one (limit) in which command {life.number} moves the axis, {life.text}"
        limit = np.full(len(state), float(expected))
        found += axis.findings("state and plan", bad, axis.ticks, text, value=state, limit=limit)
    return found


def _state_of(asked: Request) -> State:
    """Return the state in which a motion moves the axis."""
    if asked.name in ("stop", "emergency_stop"):
        return State.STOPPING
    if asked.name == "home":
        return State.HOMING
    return State.CONTINUOUS if asked.endless else State.DISCRETE


def _kinds(axis: Axis, own: Lives) -> list[Finding]:
    """A brake brakes; what moves brakes only where the override holds it, and a jog whose key was released."""
    found, released = [], set()
    for plan, life, asked in plans_of(axis, own, "position", "velocity", "passing", "stop"):
        kind = str(axis.curves.kind[plan])
        brakes = kind == "stop" and override_of(axis, plan) > 0.0
        wrong = asked.name in BRAKES and kind != "stop"
        wrong |= brakes and asked.name not in (*BRAKES, "jog", "home")
        wrong |= life.number in released and kind != "stop"
        if brakes and asked.name == "jog":
            released.add(life.number)
        if wrong:
            text = f"a plan of kind {kind} serves command {life.number}, {life.text}"
            found.append(axis.finding("command plan", int(axis.curves.tick[plan]), text))
    return found


def _joints(axis: Axis, own: Lives, lives: Lives) -> list[Finding]:
    """What begins inside a cycle has waited for it, and at rest unless it blends; what passes has one that blends."""
    found, curves = [], axis.curves
    for plan, life, asked in plans_of(axis, own, "position", "velocity", "passing", "stop"):
        tick = int(curves.tick[plan])
        if curves.inside[plan]:
            moves = bool(curves.pieces[curves.first[plan], 2:4].any())
            if asked.mode == "ABORTING" or (moves and not asked.blends):
                text = f"command {life.number} begins inside a cycle{' in motion' * moves}: {life.text}"
                found.append(axis.finding("command plan", tick, text))
        if curves.kind[plan] == "passing" and not waiting(axis, lives, life, tick):
            text = f"command {life.number} passes its target, and no other one waits to take over in motion"
            found.append(axis.finding("command plan", tick, text))
    return found


def waiting(axis: Axis, lives: Lives, running: Life, tick: int) -> list[Life]:
    """Return the commands that wait to take over a running one in motion, in a tick."""
    return [
        life
        for life in lives.values()
        if life.source == axis.name and life.number > running.number and life.accepted <= tick <= life.ended
        if life.kind != Kind.REFUSED and request(life.text).blends
    ]


def _targets(axis: Axis, own: Lives, lives: Lives, goals: Goals) -> list[Finding]:
    """A positioning leads to the position that was asked for, or to the joint where a blended one takes over.

    One that the override has held past its joint does not come back to it.
    """
    found = []
    held = [str(kind) == "stop" and override_of(axis, plan) == 0.0 for plan, kind in enumerate(axis.curves.kind)]
    carried = Carried(axis, held)
    for plan, life, asked in plans_of(axis, own, "position", "passing"):
        known = goals.of(life) if asked.to_position else None
        if known is None:
            continue
        tick, target = int(axis.curves.tick[plan]), float(axis.curves.target[plan])
        others = waiting(axis, lives, life, tick)
        for one in others:
            joint = request(one.text).number("blending_position")
            known += goals.told(joint, one.accepted) if math.isfinite(joint) else ()
        places = [Place(*goals.at(goal, plan)) for goal in known]
        off = [(abs(target - place) - allowed, place) for place, allowed in places]
        nearest, place = min(off, default=(math.inf, math.nan))
        if nearest > 0.0 and not (others and carried.hands_over(plan, places)):
            text = f"command {life.number} leads to another place than it asked for, {life.text}"
            found.append(axis.finding("command target", tick, text, value=target, limit=place, unit=axis.unit(0)))
    return found


def _held(axis: Axis, own: Lives, goals: Goals) -> list[Finding]:
    """What the override holds at rest is not done there; a positioning only where it had come to its target before."""
    last = {number: plan for plan, number in enumerate(axis.curves.command.tolist())}
    found = []
    for plan, life, asked in plans_of(axis, own, "stop"):
        if last[life.number] != plan or life.kind != Kind.DONE or asked.name in (*BRAKES, "home"):
            continue
        known = goals.of(life) if asked.to_position else ()
        if known is None or (asked.name == "jog" and not asked.steps):
            continue
        here = float(axis.curves.last_piece()[plan, 1])
        if not any(abs(here - place) <= allowed for place, allowed in (goals.at(goal, plan) for goal in known)):
            text = f"command {life.number} is done where the override held it, {life.text}"
            found.append(axis.finding("done", life.ended, text))
    return found
