"""Rules over what redefines a coordinate: a command, a homing, a drive that gets its power, a cleared error."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from motionlayer.event import Kind
from motionlayer.verify._axis import Axis
from motionlayer.verify._lives import Life
from motionlayer.verify._report import Finding
from motionlayer.verify._requests import Request, request
from motionlayer.verify._tolerance import Slack, point_tolerance

AT_THE_END: Final = ("home", "reset", "enable")
"""Commands whose end redefines the coordinate, in its tick or the next."""


def redefinition_rules(axis: Axis, lives: Mapping[int, Life]) -> list[Finding]:
    """All rules over what redefines a coordinate; its first position is that of the drive."""
    own = [life for life in lives.values() if life.source == axis.name and life.kind != Kind.REFUSED]
    defined: dict[int, list[Request]] = {}
    free = set(axis.written.tolist()) | _powered(axis)
    for life in own:
        asked = request(life.text)
        if asked.name == "define_position":
            defined.setdefault(life.accepted, []).append(asked)
        elif asked.name in AT_THE_END:
            free |= {life.ended, life.ended + 1}
        if asked.name == "home":
            free |= {life.accepted}
    found = []
    for plan in np.flatnonzero(axis.curves.redefines & (axis.curves.tick > 0)).tolist():
        tick, kind = int(axis.curves.tick[plan]), str(axis.curves.kind[plan])
        causes = defined.get(tick, [])
        if not causes and (kind == "shift" or tick not in free):
            found.append(axis.finding("redefinition", tick, f"nothing asked for a new position ({kind})"))
        elif causes and tick not in free:
            found += _by_command(axis, plan, causes)
        if kind == "shift":
            found += _shifted(axis, plan)
    return found


def _shifted(axis: Axis, plan: int) -> list[Finding]:
    """A shift shows the command and the limits of the motion that goes on in its tick."""
    curves, tick = axis.curves, int(axis.curves.tick[plan])
    if plan + 1 == len(curves) or int(curves.tick[plan + 1]) != tick:
        return [axis.finding("redefinition", tick, "the coordinate is shifted, and the motion is not planned anew")]
    shown = (curves.command, curves.velocity, curves.acceleration, curves.deceleration, curves.jerk)
    if all(values[plan] == values[plan + 1] for values in shown):
        return []
    return [axis.finding("redefinition", tick, "the shift shows another command or limit than the motion goes on with")]


def _powered(axis: Axis) -> set[int]:
    """Return the ticks in which the drive got its power; all where nobody recorded it."""
    if "ready" not in axis.signals:
        return set(axis.ticks.tolist())
    ready = axis.signals["ready"]
    return set(axis.ticks[1:][np.diff(ready) > 0.0].tolist()) | ({int(axis.ticks[0])} if ready[0] else set())


def _by_command(axis: Axis, plan: int, causes: list[Request]) -> list[Finding]:
    """The position is the one that was asked for, or as far from the old one, where commands tell that alone."""
    curves, one = axis.curves, np.array([plan], np.int64)
    if any(cause.flag("clear_offset") or cause.flag("clear_lag") for cause in causes):
        return []
    tick, here = int(curves.tick[plan]), float(curves.pieces[curves.first[plan], 1])
    last = max((k for k, cause in enumerate(causes) if not cause.flag("relative")), default=-1)
    if last < 0:
        before = curves.at(one - 1, curves.time(one - 1, curves.tick[one]))
        place, allowed = float(before.p[0]), float(point_tolerance(axis, before, "handover")[0][0])
    elif axis.machine.get("drive", {}).get("kind") == "ideal":
        place, allowed = causes[last].number("position"), 0.0
    else:
        return []  # it is the actual position that was defined
    place += sum(cause.number("position") for cause in causes[last + 1 :])
    allowed += 8.0 * np.finfo(np.float64).eps * (abs(place) + abs(here)) + float(Slack.of(curves).p[max(plan - 1, 0)])
    if abs(here - place) <= allowed:
        return []
    text = "the new position is not the one that was asked for"
    return [axis.finding("redefinition", tick, text, value=here, limit=place, unit=axis.unit(0))]
