"""Rules over how fast and how hard a command asked to be moved, and the limits its plans were made under."""

import math
from typing import Final

from motionlayer.event import Kind
from motionlayer.verify._asked import Lives, override_of, plans_of, served
from motionlayer.verify._axis import Axis
from motionlayer.verify._lives import Life
from motionlayer.verify._report import Finding
from motionlayer.verify._requests import BRAKES, CONTINUOUS, Request, request
from motionlayer.verify._tolerance import TOLERANCES

LIMITS: Final = (("acceleration", 2), ("deceleration", 2), ("jerk", 3))
SIGN: Final = {"negative": -1.0, "positive": 1.0}


def dynamics_rules(axis: Axis, lives: Lives) -> list[Finding]:
    """All rules over dynamics; a default that was written since is not known, and not judged."""
    own = served(axis, lives)
    return [*_endless(axis, own), *_velocity_limits(axis, own), *_limits(axis, own, lives)]


def asked_for(axis: Axis, life: Life, name: str, tick: int | None = None) -> float:
    """Return a number of the dynamics of a command: its own, or that of the axis; nan if that is not known.

    Args:
        axis: the axis.
        life: of the command.
        name: of the number.
        tick: in which the default of the axis counts; where left out that in which the command was accepted.
    """
    asked = request(life.text)
    own, most = asked.number(name), asked.name == "emergency_stop"
    if not (math.isnan(own) or most):
        return own
    if (axis.written <= (life.accepted if tick is None else tick)).any():
        return math.nan
    return axis.maximum(name) if most else float(axis.machine.get(name, math.nan))


def differs(value: float, expected: float) -> bool:
    """Tell whether a limit is another one; a number that is not known (nan) never is."""
    return abs(value - expected) > TOLERANCES["limits"].relative * (abs(value) + abs(expected))


def _endless(axis: Axis, own: Lives) -> list[Finding]:
    """An endless motion goes on with the velocity that was asked for, or leads to the software limit ahead."""
    found = []
    for plan, life, asked in plans_of(axis, own, "velocity", "position"):
        override, target = override_of(axis, plan), float(axis.curves.target[plan])
        if asked.to_position or not override > 0.0:
            continue
        order = 1 if axis.curves.kind[plan] == "velocity" else 0
        if order == 1:
            ends = [override * speed for speed in _speeds(axis, life, asked)]
        else:
            sides = ["min" if sign < 0.0 else "max" for sign in _signs(axis, life, asked)]
            row = axis.row_taken[plan]
            ends = [] if asked.name == "home" else [float(axis.software_limit(side)[row]) for side in sides]
        if any(math.isnan(end) or not differs(target, end) for end in ends):
            continue
        nearest = min(ends, key=lambda end: abs(end - target), default=math.nan)
        text = f"command {life.number} goes on otherwise than it asked for, {life.text}"
        tick = int(axis.curves.tick[plan])
        found.append(axis.finding("command target", tick, text, value=target, limit=nearest, unit=axis.unit(order)))
    return found


def _signs(axis: Axis, life: Life, asked: Request) -> tuple[float, ...]:
    """Return the directions that an endless motion may have."""
    direction, row = asked.values.get("direction", ""), life.accepted - int(axis.ticks[0])
    if direction == "CURRENT" and 0 <= row < len(axis.ticks):
        return (-1.0,) if axis.signals["set_velocity"][row] < 0.0 else (1.0,)
    return {"POSITIVE": (1.0,), "NEGATIVE": (-1.0,)}.get(direction, (1.0, -1.0))


def _speeds(axis: Axis, life: Life, asked: Request) -> list[float]:
    """Return the signed velocities that a motion may go on with at override 1."""
    if asked.name == "home":
        return _searches(axis, life, asked)
    name = "end_velocity" if asked.name in CONTINUOUS else "velocity"
    return [sign * asked_for(axis, life, name) for sign in _signs(axis, life, asked)]


def _searches(axis: Axis, life: Life, asked: Request) -> list[float]:
    """Return the signed velocities of the searches of a homing; nan where a default that was written counts."""
    home = axis.machine.get("home", {"mode": "direct"})
    mode = asked.values.get("method", home["mode"]).lower()
    if mode == "direct":
        return []
    usual = SIGN[home["direction"]]
    sign = SIGN[asked.values.get("search_direction", home["direction"]).lower()]
    search = sign * _leg(axis, life, "search_velocity", home["velocity"])
    if mode == "switch":
        return [search, -search]
    way = -usual if home["sync_direction"] is None else SIGN[home["sync_direction"]]
    way = SIGN[asked.values["sync_direction"].lower()] if "sync_direction" in asked.values else way * usual * sign
    return [search, way * _leg(axis, life, "sync_velocity", home["sync_velocity"] or home["velocity"])]


def _leg(axis: Axis, life: Life, name: str, usual: float) -> float:
    """Return a velocity of a homing: its own, or that of the description; nan if that may not hold any more."""
    own = request(life.text).number(name)
    if not math.isnan(own):
        return own
    return math.nan if (axis.written <= life.accepted).any() else float(usual)


def _velocity_limits(axis: Axis, own: Lives) -> list[Finding]:
    """The velocity limit is the override's share of what was asked for.

    A joint that is faster raises it to its own velocity, and an end velocity above the velocity of the way does.
    """
    found = []
    for plan, life, asked in plans_of(axis, own, "position", "velocity", "passing"):
        override, limit = override_of(axis, plan), float(axis.curves.velocity[plan])
        if not override > 0.0:
            continue
        if asked.name == "home":
            most = [abs(speed) for speed in _searches(axis, life, asked)]
        else:
            end = asked.number("end_velocity") if asked.name in CONTINUOUS else 0.0
            most = [max(asked_for(axis, life, "velocity"), end)]
        ends = [override * one for one in most]
        if axis.curves.kind[plan] == "passing" and ends[0] < limit:
            ends = [abs(float(axis.curves.last_piece()[plan, 2]))]
        if not any(math.isnan(one) or not differs(limit, one) for one in ends):
            text = f"the velocity limit is not what command {life.number} asked for, {life.text}"
            tick, expected = int(axis.curves.tick[plan]), ends[0] if ends else math.nan
            found.append(axis.finding("command limits", tick, text, value=limit, limit=expected, unit=axis.unit(1)))
    return found


def _limits(axis: Axis, own: Lives, lives: Lives) -> list[Finding]:
    """Plans are made under the limits asked for; a halt that waits lends its brake to what is before it.

    So are those that brake: a halt and a stop, a motion that the override holds, a jog that is released. What the
    override has held before a joint has the brake of any command that takes over there.
    """
    others, found = [life for life in lives.values() if life.source == axis.name], []
    held: dict[int, int] = {}
    for plan, life, asked in plans_of(axis, own, "position", "velocity", "passing", "stop"):
        tick = int(axis.curves.tick[plan])
        if axis.curves.kind[plan] == "stop" and override_of(axis, plan) == 0.0:
            held[life.number] = tick
        lent = [
            one
            for one in others
            if life.accepted <= one.accepted <= tick and one.number > life.number
            if _lends(one, held.get(life.number, -1))
        ]
        for name, order in LIMITS[1:] if asked.name in BRAKES else LIMITS:  # a brake does not accelerate
            since = tick if asked.name == "home" else None  # each of its legs has the defaults of its own tick
            limit, own_one = float(getattr(axis.curves, name)[plan]), asked_for(axis, life, name, since)
            stronger = [asked_for(axis, one, name) for one in lent if name != "acceleration"]
            if any(
                math.isnan(one) or not differs(limit, one) for one in (own_one, *(o for o in stronger if o > own_one))
            ):
                continue
            text = f"the {name} is not what command {life.number} asked for, {life.text}"
            found.append(axis.finding("command limits", tick, text, value=limit, limit=own_one, unit=axis.unit(order)))
    return found


def _lends(waiting: Life, held: int) -> bool:
    """Tell whether a command that waits lends its brake to what was last held by the override in the tick `held`."""
    asked = request(waiting.text)
    return asked.name == "halt" or (asked.blends and waiting.kind != Kind.REFUSED and waiting.accepted <= held)
