"""What can be damaged in the plans that follow one another without rest, and in what commands asked for."""

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Final

import numpy as np

from motionlayer.bench.campaign._damage import SHARE, Damage, axes_of, copied, pick, replanned
from motionlayer.event import Kind
from motionlayer.record import Plan, Trace

NUMBER: Final = re.compile(r"\b(position|distance|velocity|acceleration|deceleration|jerk)=([-+0-9.e]+)")
JUDGED: Final = ("move_absolute(", "move_relative(", "move_velocity(", "halt(", "stop(")
"""Commands all of whose numbers show in each of their plans."""


def _inside(trace: Trace, plan: Plan) -> bool:
    """Tell whether a plan begins inside a cycle, after some time in it."""
    return plan.offset < -0.01 * trace.base_cycle


def joint(rng: np.random.Generator, trace: Trace) -> Damage | None:
    """Move the instant at which a buffered command takes over, by a thousandth of a cycle or a whole one."""
    index = pick(rng, [k for k, plan in enumerate(trace.plans) if _inside(trace, plan)])
    if index is None:
        return None
    plan, sign = trace.plans[index], int(rng.choice([-1, 1]))
    if rng.random() < 0.5:
        return replanned(trace, index, f"joint, tick {sign:+d}", replace(plan, tick=plan.tick + sign))
    offset = plan.offset + sign * SHARE * trace.base_cycle
    return replanned(trace, index, f"joint, offset {offset!r}", replace(plan, offset=offset))


def passing(rng: np.random.Generator, trace: Trace) -> Damage | None:
    """Let a plan that hands over in motion say that it ends at rest, or hand over somewhere else."""
    index = pick(rng, [k for k, plan in enumerate(trace.plans) if plan.kind == "passing"])
    if index is None:
        return None
    plan = trace.plans[index]
    if rng.random() < 0.5:
        return replanned(trace, index, "passing, position instead", replace(plan, kind="position"))
    step = float(rng.choice([-1.0, 1.0])) * SHARE * axes_of(trace)[plan.axis]["max_velocity"]
    pieces = plan.pieces + np.array([0.0, step, 0.0, 0.0, 0.0])
    text = f"passing, {step:+.6g} beside"
    return replanned(trace, index, text, replace(plan, target=plan.target + step, pieces=pieces))


def shift(rng: np.random.Generator, trace: Trace) -> Damage | None:
    """Redefine a coordinate that moves to another position, or without having been told to."""
    index = pick(rng, [k for k, plan in enumerate(trace.plans) if plan.kind == "shift"])
    if index is None:
        return None
    plan = trace.plans[index]
    if rng.random() < 0.5:
        step = float(rng.choice([-1.0, 1.0])) * SHARE * axes_of(trace)[plan.axis]["max_velocity"]
        pieces = plan.pieces + np.array([0.0, step, 0.0, 0.0, 0.0])
        return replanned(trace, index, f"shift, {step:+.6g}", replace(plan, target=plan.target + step, pieces=pieces))
    told = [one for one in trace.events if one.source == plan.axis and one.tick == plan.tick and _defines(one.text)]
    events = tuple(one for one in trace.events if one not in told)
    return Damage(f"left out: {told}", copied(trace, events=events), plan.axis)


def _defines(text: str) -> bool:
    return text.startswith("define_position(") or text.endswith(".define_position")


def mode(rng: np.random.Generator, trace: Trace) -> Damage | None:
    """Let a command that took over inside a cycle have been told to begin at once."""
    waited = {plan.command for plan in trace.plans if _inside(trace, plan)}
    index = pick(rng, [k for k, one in enumerate(trace.events) if one.command in waited and one.kind == Kind.ACCEPTED])
    if index is None:
        return None
    told = trace.events[index]
    other = told._replace(text=re.sub(r",? ?buffer_mode=\w+", "", told.text))
    events = (*trace.events[:index], other, *trace.events[index + 1 :])
    return Damage(f"{other.text} instead of {told.text}", copied(trace, events=events), told.source)


def asked(rng: np.random.Generator, trace: Trace) -> Damage | None:
    """Let a command have asked for another position, distance, velocity or limit than the one its plans show."""
    plans = {plan.command: plan for plan in reversed(trace.plans) if plan.kind in ("position", "velocity", "stop")}
    index = pick(rng, [k for k, one in enumerate(trace.events) if one.kind == Kind.ACCEPTED and one.command in plans])
    if index is None:
        return None
    told = trace.events[index]
    shown = [match for match in NUMBER.finditer(told.text) if _shows(plans[told.command], match)]
    which = pick(rng, list(range(len(shown))))
    if which is None or not told.text.startswith(JUDGED):
        return None
    match = shown[which]
    size = axes_of(trace)[told.source]["max_velocity"] if match[1] in ("position", "distance") else float(match[2])
    step = float(rng.choice([-1.0, 1.0])) * SHARE * size
    text = f"{told.text[: match.start(2)]}{float(match[2]) + step!r}{told.text[match.end(2) :]}"
    events = (*trace.events[:index], told._replace(text=text), *trace.events[index + 1 :])
    return Damage(f"{text} instead of {told.text}", copied(trace, events=events), told.source)


def _shows(plan: Plan, match: re.Match[str]) -> bool:
    """Tell whether a plan is made after a number of its command: not raised, moved or held by another one."""
    number, name = float(match[2]), match[1]
    if plan.kind == "stop" and not match.string.startswith(("halt(", "stop(")):
        return False
    if name == "position":
        return plan.target == number
    if name == "distance":
        return abs(plan.target - float(plan.pieces[0, 1]) - number) <= 1e-9 * (abs(plan.target) + abs(number))
    return name == "velocity" or bool(getattr(plan, name) == number)


FOLLOWING: Final[Mapping[Callable[[np.random.Generator, Trace], Damage | None], int]] = {
    joint: 2, passing: 1, shift: 1, mode: 1, asked: 3,
}  # fmt: skip
"""Operators, and how often they come."""
