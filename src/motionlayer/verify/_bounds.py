"""Rules over the exact curves of the plans: velocity, acceleration and jerk between the samples as well.

A piece is cut where its velocity or its acceleration passes zero. On such a stretch |v| grows, falls or
stays, and both |v| and |a| have their extremes at its ends; the acceleration limit applies where |v| grows,
the deceleration limit where it falls. As a is continuous, a reversal passes v = 0 with |a| within both.

A plan may start outside its limits, when they were lowered in motion. The way back is narrow:

- while |a| is outside, it falls with the full jerk;
- before |v| falls, it may only do what it does while a goes to zero with the full jerk; then it falls until
  it is inside, and stays there. A ride in between is none that is so short that braking would have changed the
  velocity by its rounding only. A stop does the same until it is at rest, where the shortest one comes to rest.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Curves, Flags, Floats, Integers
from motionlayer.verify._report import Finding
from motionlayer.verify._stops import stops
from motionlayer.verify._tolerance import TOLERANCES, Slack


@dataclass(frozen=True)
class Stretches:
    """Stretches of constant signs in order of time, shape (M,) each.

    Attributes:
        plan: that each belongs to.
        length: s.
        speed: largest |v|.
        strength: largest |a|.
        grows, falls: what |v| does.
        brief: whether braking with the full jerk instead would have changed |v| by no more than rounding does.
        relents: whether |a| falls with the full jerk of the plan.
    """

    plan: Integers
    length: Floats
    speed: Floats
    strength: Floats
    grows: Flags
    falls: Flags
    brief: Flags
    relents: Flags


def _roots(v: Floats, a: Floats, j: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the times at which v and a of a piece pass zero; nan or inf where they do not."""
    with np.errstate(all="ignore"):
        # The form that does not cancel; the other root follows from the product of both.
        q = -(a + np.copysign(np.sqrt(a * a - 2.0 * j * v), a))
        return q / j, 2.0 * v / q, -a / j


def stretches(curves: Curves) -> Stretches:
    """Cut all pieces, from where each plan takes over."""
    t, _, v, a, j = curves.pieces.T
    length = curves.durations()
    begin = np.clip(np.maximum(curves.offset, 0.0)[curves.owner] - t, 0.0, length)
    cuts = [np.clip(np.where(np.isfinite(root), root, 0.0), begin, length) for root in _roots(v, a, j)]
    s = np.sort(np.stack([begin, *cuts, length], axis=1), axis=1)
    # Shorter than the rounding of its ends, or of an acceleration at its start, a stretch has no sign to speak of.
    ramp = (np.maximum(curves.acceleration, curves.deceleration) / curves.jerk)[curves.owner]
    keep = np.diff(s, axis=1) > TOLERANCES["handover"].relative * (t + length + curves.dt + ramp)[:, None]
    piece = np.repeat(np.arange(len(t), dtype=np.int64)[:, None], 4, axis=1)[keep]
    nothing = np.zeros(len(piece))
    start, end = s[:, :-1][keep], s[:, 1:][keep]
    first, last = (curves.evaluate(piece, at, nothing) for at in (start, end))
    middle = curves.evaluate(piece, 0.5 * (start + end), nothing)
    plan, power = curves.owner[piece], middle.v * middle.a
    full = curves.jerk[plan] * (1.0 - TOLERANCES["plan limits"].relative)
    speed, braked = np.maximum(np.abs(first.v), np.abs(last.v)), 0.5 * curves.jerk[plan] * (end - start) ** 2
    return Stretches(
        plan=plan,
        length=end - start,
        speed=speed,
        strength=np.maximum(np.abs(first.a), np.abs(last.a)),
        grows=power > 0.0,
        falls=power < 0.0,
        brief=(middle.a == 0.0) & (braked <= TOLERANCES["handover"].relative * speed),
        relents=-np.sign(middle.a) * j[piece] >= full,
    )


def _relenting(cut: Stretches, rows: slice) -> int:
    """Return how many stretches from the start of a plan bring a to zero with the full jerk."""
    relents = cut.relents[rows]
    return len(relents) if relents.all() else int(np.argmin(relents))


def _comes_inside(cut: Stretches, rows: slice, count: int) -> bool:
    """Whether |v| falls over the first `count` stretches of a plan, once a has come to zero."""
    falls = cut.falls[rows] | cut.brief[rows]
    return bool(falls[_relenting(cut, rows) : count].all())


def _softens(cut: Stretches, rows: slice, count: int) -> bool:
    """Whether |a| falls with the full jerk over the first `count` stretches of a plan."""
    return _relenting(cut, rows) >= count


def comes_inside(cut: Stretches, rows: slice) -> bool:
    """Tell whether |v| falls all the way of a plan, once a has come to zero."""
    return _comes_inside(cut, rows, rows.stop - rows.start)


def _illegal(cut: Stretches, over: Flags, legal: Callable[[Stretches, slice, int], bool]) -> Flags:
    """Leave in `over` only the plans whose stretches are not `legal` up to the last one that is over."""
    kept = np.zeros(len(over), np.bool_)
    for plan in np.unique(cut.plan[over]):
        first, end = np.searchsorted(cut.plan, [plan, plan + 1])
        rows = slice(int(first), int(end))
        if not legal(cut, rows, int(np.flatnonzero(over[rows])[-1]) + 1):
            kept[rows] = over[rows]
    return kept


def planned_limits(axis: Axis) -> list[Finding]:
    """The curve of every plan stays inside its limits, or comes back inside by the straight way."""
    curves = axis.curves
    cut, slack, share = stretches(curves), Slack.of(curves), 1.0 + TOLERANCES["plan limits"].relative
    plan, tick = cut.plan, curves.tick[cut.plan]
    velocity, rise, fall = curves.velocity[plan], curves.acceleration[plan], curves.deceleration[plan]
    applies = np.where(cut.grows, rise, np.where(cut.falls, fall, np.minimum(rise, fall)))
    fast = _illegal(cut, cut.speed > velocity * share + slack.v[plan], _comes_inside)
    hard = _illegal(cut, cut.strength > applies * share + slack.a[plan], _softens)
    stop = _illegal(cut, (curves.kind[plan] == "stop") & (cut.speed > slack.v[plan]), _comes_inside)
    jerk = np.abs(curves.pieces[:, 4])
    most = curves.jerk[curves.owner]
    found = axis.findings("planned velocity", fast, tick, "above the limit", value=cut.speed, limit=velocity, order=1)
    found += axis.findings(
        "planned acceleration", hard, tick, "above the limit", value=cut.strength, limit=applies, order=2
    )
    found += axis.findings(
        "planned stop", stop, tick, "does not brake all the way", value=cut.speed, limit=velocity, order=1
    )
    when = curves.tick[curves.owner]
    return found + axis.findings(
        "planned jerk", jerk > most * share, when, "above the limit", value=jerk, limit=most, order=3
    )


def shortest_stops(axis: Axis) -> list[Finding]:
    """A stop comes to rest where the shortest one under its limits does: it does not brake weaker than it may."""
    curves, slack = axis.curves, Slack.of(axis.curves)
    rest, last = stops(curves, curves.deceleration, curves.jerk).rest, curves.last_piece()
    time = last[:, 0] - np.maximum(curves.offset, 0.0)
    # An error of v or a at the start is carried on until the end.
    allowed = slack.p + time * (slack.v + time * slack.a)
    bad = (curves.kind == "stop") & ~(np.abs(last[:, 1] - rest) <= allowed)
    text = "does not come to rest where the shortest stop does"
    return axis.findings("planned stop", bad, curves.tick, text, value=last[:, 1], limit=rest, order=0)
