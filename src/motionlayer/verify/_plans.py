"""Rules over the plans: within the machine, continuous inside and from one to the next, right at the end."""

from typing import Final

import numpy as np

from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Flags, Floats
from motionlayer.verify._report import Finding
from motionlayer.verify._tolerance import TOLERANCES, Slack, point_tolerance

Numbers = tuple[Floats, Floats, Floats]
QUANTITIES: Final = ("position", "velocity", "acceleration")


def machine_maxima(axis: Axis) -> list[Finding]:
    """Limits of a plan are positive and within the machine; those of `set` equal it until parameters are written."""
    curves, found = axis.curves, []
    untouched = curves.tick < (axis.written.min() if len(axis.written) else np.inf)
    for order, name in ((1, "velocity"), (2, "acceleration"), (2, "deceleration"), (3, "jerk")):
        limit, most = getattr(curves, name), axis.maximum(name)
        slack = TOLERANCES["limits"].relative * most
        other = (curves.kind == "set") & (np.abs(limit - most) > slack) & untouched
        bad = (limit <= 0.0) | (limit > most + slack) | other
        text = f"{name} a plan was made under does not fit the machine's maximum"
        found += axis.findings(
            "plan limits", bad, curves.tick, text, value=limit, limit=np.full(len(curves), most), order=order
        )
    return found


def succession(axis: Axis) -> list[Finding]:
    """Plans follow one another, one per tick and one `set` plan before it, beginning with a `set` plan at tick 0.

    Another one may begin inside the cycle: exactly where the one before it comes to its last piece.
    """
    curves, nothing = axis.curves, np.full(len(axis.curves), np.nan)
    found = axis.findings(
        "plan order",
        np.concatenate([[False], np.diff(curves.tick + curves.holds) + curves.inside[1:] <= 0]),
        curves.tick,
        "two plans in one tick, or a plan older than the one before it",
        value=nothing,
        limit=nothing,
    )
    if curves.tick[0] != 0 or curves.kind[0] != "set":
        text = f"the first plan is {curves.kind[0]!r} at tick {curves.tick[0]}, not 'set' at tick 0"
        found.append(axis.finding("plan order", int(curves.tick[0]), text))
    begin = curves.pieces[curves.first[:-1], 0]
    bad = (begin < 0.0) | (begin > np.maximum(curves.offset, 0.0)) | (curves.offset < -axis.dt)
    text = "the plan says nothing about its first cycle: its time there against its first piece"
    found += axis.findings("plan order", bad, curves.tick, text, value=curves.offset, limit=begin)
    before = np.maximum(np.arange(len(curves)) - 1, 0)
    left = curves.last_piece()[before, 0] - curves.time(before, curves.tick)
    late = TOLERANCES["handover"].relative * (np.abs(curves.last_piece()[before, 0]) + axis.dt)
    bad = curves.inside & ~(np.abs(left + curves.offset) <= late)
    text = "the plan begins inside a cycle, not where the one before it ends: its wait against that"
    return found + axis.findings("plan order", bad, curves.tick, text, value=-curves.offset, limit=left)


def pieces_continuous(axis: Axis) -> list[Finding]:
    """Each piece of a plan begins where the one before it ends, in p, v and a."""
    curves, slack = axis.curves, Slack.of(axis.curves)
    piece = np.arange(len(curves.pieces) - 1, dtype=np.int64)
    inside = curves.owner[:-1] == curves.owner[1:]
    plan, length = curves.owner[:-1], curves.durations()[:-1]
    end = curves.evaluate(piece, length, np.zeros(len(piece)))
    found = []
    for order, (value, allowed) in enumerate(zip((end.p, end.v, end.a), (slack.p, slack.v, slack.a), strict=True)):
        begin = curves.pieces[1:, 1 + order]
        bad = inside & (np.abs(value - begin) > allowed[plan])
        text = f"{QUANTITIES[order]} steps from piece to piece of a plan"
        found += axis.findings("piece continuity", bad, curves.tick[plan], text, value=begin, limit=value, order=order)
    return found


def handovers(axis: Axis) -> list[Finding]:
    """A plan starts with the p, v, a of the plan before it; `set` may move the position, at rest only.

    A plan that takes over inside a cycle has a negative offset: it begins that much after its tick.
    """
    curves = axis.curves
    new = np.arange(1, len(curves), dtype=np.int64)
    wait = np.maximum(-curves.offset[1:], 0.0)
    now = curves.at(new, curves.offset[1:] + wait)
    old = curves.at(new - 1, curves.time(new - 1, curves.tick[1:]) + wait)
    sizes = zip(point_tolerance(axis, now, "handover"), point_tolerance(axis, old, "handover"), strict=True)
    allowed = [one + other for one, other in sizes]
    redefines, rests = curves.redefines[1:], curves.kind[1:] == "set"
    found = []
    for order, (begin, end) in enumerate(zip((now.p, now.v, now.a), (old.p, old.v, old.a), strict=True)):
        text = f"{QUANTITIES[order]} at the start of a plan is not that of the plan before it"
        bad = np.abs(begin - end) > allowed[order]
        if order == 0:
            bad &= ~redefines
        found += axis.findings("plan continuity", bad, curves.tick[1:], text, value=begin, limit=end, order=order)
        if order > 0:
            moving = rests & ~bad & (np.abs(begin) > allowed[order])
            text = f"the coordinate is redefined while it moves: {QUANTITIES[order]}"
            zero = np.zeros(len(begin))
            found += axis.findings(
                "plan continuity", moving, curves.tick[1:], text, value=begin, limit=zero, order=order
            )
    return found


def ends(axis: Axis) -> list[Finding]:
    """A plan ends for ever at its target: a position or a stop at rest, a velocity or a passing without acceleration.

    The last piece has no end, so that its velocity, acceleration and jerk are exact, not within a
    tolerance.
    """
    curves, slack = axis.curves, Slack.of(axis.curves)
    p, v, a, j = curves.last_piece()[:, 1:].T
    velocity, stop = curves.kind == "velocity", curves.kind == "stop"
    zero = np.zeros(len(p))
    reaches = ~velocity & ~stop
    cases: list[tuple[Flags, Floats, Floats, Floats, str, int]] = [
        (reaches, p, curves.target, slack.p, "the plan ends beside its target", 0),
        (velocity, v, curves.target, slack.v, "the plan ends beside its target velocity", 1),
        (~velocity & ~np.isin(curves.kind, ("passing", "shift")), v, zero, zero, "the plan ends with a velocity", 1),
        (curves.kind != "shift", a, zero, zero, "the plan ends with an acceleration", 2),
        (p == p, j, zero, zero, "the plan ends with a jerk", 3),  # noqa: PLR0124
    ]
    found = []
    for which, value, limit, allowed, text, order in cases:
        bad = which & (np.abs(value - limit) > allowed)
        found += axis.findings("plan end", bad, curves.tick, text, value=value, limit=limit, order=order)
    far = velocity & (np.abs(curves.target) > curves.velocity * (1 + TOLERANCES["plan limits"].relative))
    text = "the target velocity is above the limit"
    return found + axis.findings(
        "plan end", far, curves.tick, text, value=curves.target, limit=curves.velocity, order=1
    )
