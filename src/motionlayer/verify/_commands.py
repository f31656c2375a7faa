"""Rules that join plans, samples and the life of commands."""

import math
from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from motionlayer.event import Kind
from motionlayer.verify._axis import Axis
from motionlayer.verify._lives import FOREVER, Life
from motionlayer.verify._report import Finding
from motionlayer.verify._requests import MOTIONS, Request, request
from motionlayer.verify._states import State
from motionlayer.verify._tolerance import Slack, sample_tolerance

Lives = Mapping[int, Life]


def command_rules(axis: Axis, lives: Lives) -> list[Finding]:
    """All rules over the commands of an axis."""
    return [
        *_plans_of_commands(axis, lives),
        *_replaced(axis, lives),
        *_endless(axis, lives),
        *_done_at_target(axis, lives),
        *_done_in_window(axis, lives),
        *_ended_in(axis, lives, State.STANDSTILL, 1),
        *_ended_in(axis, lives, State.ERRORSTOP, 0),
        *_ended_in(axis, lives, State.DISABLED, 0),
        *_aborted(axis, lives),
    ]


def _plans_of_commands(axis: Axis, lives: Lives) -> list[Finding]:
    """A plan serves a command that was accepted, and that has not ended."""
    found = []
    for tick, number, _ in _plan_rows(axis):
        life = lives.get(number)
        if number == 0:
            continue
        if life is None or life.kind == Kind.REFUSED or life.accepted > tick or life.source != axis.name:
            text = f"a plan serves command {number}, which the axis has not accepted"
            found.append(axis.finding("command plan", tick, text))
        elif life.ended < tick:
            text = f"a plan serves command {number}, which ended in tick {life.ended}"
            found.append(axis.finding("command plan", tick, text))
    return found


def _plan_rows(axis: Axis) -> list[tuple[int, int, str]]:
    curves = axis.curves
    return list(zip(curves.tick.tolist(), curves.command.tolist(), curves.kind.tolist(), strict=True))


def _replaced(axis: Axis, lives: Lives) -> list[Finding]:
    """A command whose plan is replaced has ended then, whether another command did it or a brake that serves none."""
    found = []
    for (_, old, _), (tick, new, _) in pairwise(_plan_rows(axis)):
        life = lives.get(old)
        if new != old and life is not None and life.ended > tick:
            text = f"the plan of command {old} is replaced by one of command {new}, and it has not ended"
            found.append(axis.finding("command end", tick, text))
    return found


def _aborted(axis: Axis, lives: Lives) -> list[Finding]:
    """A motion ends aborted where another one begins, the axis is switched off, or a direction is not released."""
    found, own = [], [life for life in lives.values() if life.source == axis.name and life.kind != Kind.REFUSED]
    replacing = {(life.accepted, life.number) for life in own if _replaces(request(life.text))}
    for life in own:
        if life.kind != Kind.ABORTED or request(life.text).name not in MOTIONS:
            continue
        if not any(tick == life.ended and number > life.number for tick, number in replacing):
            text = f"command {life.number} is aborted, and nothing that replaces it was accepted"
            found.append(axis.finding("command end", life.ended, text))
    return found


def _replaces(asked: Request) -> bool:
    return asked.name in (*MOTIONS, "disable") or (asked.name == "enable" and "positive" in asked.values)


def _last_plans(axis: Axis) -> dict[int, int]:
    """Return the last plan of each command, as index."""
    return {number: plan for plan, number in enumerate(axis.curves.command.tolist()) if number}


def _done_at_target(axis: Axis, lives: Lives) -> list[Finding]:
    """A command that is done in tick n has its set position (or velocity) at its target at n + 1."""
    curves, found = axis.curves, []
    slack = Slack.of(curves)
    wide_p, wide_v = sample_tolerance(axis, "set_position"), sample_tolerance(axis, "set_velocity")
    for life in lives.values():
        plan = _plan_when_done(axis, life)
        row = life.ended + 1 - int(axis.ticks[0])
        if plan is None or not 0 <= row < len(axis.ticks):
            continue
        p, v = float(axis.signals["set_position"][row]), float(axis.signals["set_velocity"][row])
        if axis.redefined[row]:  # another coordinate already: what the plan says is what the old one would show
            p = float(curves.at(np.array([plan]), curves.time(np.array([plan]), np.array([life.ended + 1]))).p[0])
        if _handed_over(axis, plan, life):  # inside the cycle: the next plan began where this one ends
            _, p, v, _, _ = curves.pieces[curves.first[plan + 1]].tolist()
        target = float(curves.target[plan])
        by_position, by_velocity = (p, target, wide_p[row] + slack.p[plan], 0), (v, target, wide_v[row], 1)
        cases = {"velocity": by_velocity, "stop": (v, 0.0, wide_v[row], 1)}
        value, limit, allowed, order = cases.get(str(curves.kind[plan]), by_position)
        if not abs(value - limit) <= allowed:
            text = f"command {life.number} is done beside its target"
            found.append(axis.finding("done", life.ended, text, value=value, limit=limit, unit=axis.unit(order)))
    return found


def _handed_over(axis: Axis, plan: int, life: Life) -> bool:
    """Tell whether the plan after that of a command began inside the cycle in which the command ended."""
    curves = axis.curves
    return plan + 1 < len(curves) and bool(curves.inside[plan + 1]) and int(curves.tick[plan + 1]) == life.ended


def _endless(axis: Axis, lives: Lives) -> list[Finding]:
    """An endless motion is never done: it is replaced, or ends with an error on the software limit ahead."""
    curves, state = axis.curves, axis.signals.get("state")
    found = []
    for life in lives.values():
        plan = _plan_when_done(axis, life)
        if plan is None:
            continue
        endless = curves.kind[plan] == "velocity"
        if state is not None and axis.recorded[plan] and curves.kind[plan] == "position":
            row = min(int(axis.row_taken[plan]) + int(curves.inside[plan]), len(state) - 1)  # its own state
            endless = bool(state[row] == State.CONTINUOUS)
        if endless:
            text = f"command {life.number} is done, and moved the axis without end"
            found.append(axis.finding("done", life.ended, text))
    return found


def _done_in_window(axis: Axis, lives: Lives) -> list[Finding]:
    """A positioning that waits for a window of the actual position is done inside it, and after its time there.

    Function-blocks 2.7: the target window, or without one the range window, which has no time. One that hands over to a
    blended successor does not wait, nor does one that was told so.
    """
    monitor, actual = axis.machine.get("monitor", {}), axis.signals.get("actual_position")
    window = monitor.get("target_window")
    rows = math.ceil(monitor["target_time"] / axis.dt - 1e-6) if window is not None else 0
    window = monitor.get("range_window") if window is None else window
    if window is None or actual is None:
        return []
    found, wide = [], sample_tolerance(axis, "actual_position")
    for life in lives.values():
        plan = _plan_when_done(axis, life)
        last = life.ended - int(axis.ticks[0])
        if plan is None or axis.curves.kind[plan] != "position" or not 0 <= last < len(actual):
            continue
        if _handed_over(axis, plan, life) and _blends(axis, plan + 1, lives):
            continue
        if not request(life.text).monitored:
            continue
        since = max(last - rows, int(axis.curves.tick[plan] - axis.ticks[0]), 0)
        off = np.abs(actual[since : last + 1] - axis.curves.target[plan])
        if not (off <= window + wide[since : last + 1]).all():
            text = f"command {life.number} is done outside the window, or too soon in it"
            found.append(axis.finding("done", life.ended, text, value=off.max(), limit=window, unit=axis.unit(0)))
    return found


def _blends(axis: Axis, plan: int, lives: Lives) -> bool:
    """Tell whether a plan serves a command that was to take over in motion."""
    life = lives.get(int(axis.curves.command[plan]))
    return life is not None and request(life.text).blends


def _plan_when_done(axis: Axis, life: Life) -> int | None:
    """Return the last plan a command of the axis had when it was done; None without."""
    if life.kind != Kind.DONE or life.source != axis.name:
        return None
    own = np.flatnonzero((axis.curves.command == life.number) & (axis.curves.tick <= life.ended))
    return int(own[-1]) if len(own) else None


def _ended_in(axis: Axis, lives: Lives, state: State, before: int) -> list[Finding]:
    """When an axis is in `state`, each command that had moved it has ended, at least `before` ticks ago."""
    if "state" not in axis.signals:
        return []
    rows = axis.ticks[axis.signals["state"] == state]
    found = []
    for number, plan in _last_plans(axis).items():
        life, index = lives.get(number), int(np.searchsorted(rows, axis.curves.tick[plan], side="right"))
        if life is None or index == len(rows) or not _moves(axis, plan):
            continue
        if life.ended > rows[index] - before:
            when = "only later" if life.ended < FOREVER else "never"
            text = f"the axis is in {state.name}, and command {number}, which had moved it, ends {when}"
            found.append(axis.finding("command end", int(rows[index]), text))
    return found


def _moves(axis: Axis, plan: int) -> bool:
    """Whether a plan is a motion, or redefines the coordinate at the end of one (homing)."""
    row = int(axis.curves.tick[plan] - axis.ticks[0])
    homing = 0 <= row < len(axis.ticks) and axis.signals["state"][row] == State.HOMING
    return bool(axis.curves.kind[plan] != "set" or homing)
