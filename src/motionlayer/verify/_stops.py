"""The shortest stop, in closed form: where it comes to rest, and how far out it swings.

Take v >= 0 (the rest is its mirror image), deceleration limit D and jerk limit J. Whatever a is, the stop passes
through, or comes from, the velocity at which a is zero::

    v0 = v + a²/2J        at the time t = a/J from now, at the place p + v0 t - J t³/6

and from there it brakes over the way ::

    v0 sqrt(v0/J)         if v0 <= D²/J: the deceleration rises to sqrt(v0 J) and falls at once
    v0/2 (v0/D + D/J)     else: it stays at D in between

An a below -D is first taken back to it with the full jerk. If a < 0 and a² > 2 J v, the axis cannot help turning: the
full jerk takes a to zero at v - a²/2J < 0, and from there it brakes the other way round.
"""

from dataclasses import dataclass

import numpy as np

from motionlayer.verify._curves import Curves, Flags, Floats, Integers


@dataclass(frozen=True)
class Stops:
    """The shortest stop from where each plan takes over, shape (P,) each.

    Attributes:
        rest: position at which it comes to rest, u.
        turn: position at which it turns, u; nan where it does not.
        heading: direction in which it sets out, +1 or -1.
    """

    rest: Floats
    turn: Floats
    heading: Floats

    def furthest(self, sign: float) -> Floats:
        """Return how far it comes in a direction once it moves that way: sign times position; -inf if it never does."""
        turns, out = np.isfinite(self.turn), self.heading == sign
        way = np.where(turns & out, self.turn, self.rest)
        return np.asarray(np.where(turns | out, sign * way, -np.inf))


def _advance(v: Floats, a: Floats, j: Floats, t: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the way, v and a after `t` seconds of constant jerk."""
    return t * (v + t * (a / 2.0 + t * j / 6.0)), v + t * (a + t * j / 2.0), a + t * j


def _brake(v: Floats, most: Floats, jerk: Floats) -> Floats:
    """Return the way from v >= 0 without acceleration to rest."""
    short = v * np.sqrt(v / jerk)
    return np.where(v * jerk <= most * most, short, v / 2.0 * (v / most + most / jerk))


def _from(v: Floats, a: Floats, most: Floats, jerk: Floats) -> tuple[Floats, Floats]:
    """Return way to rest, and way to the turn (nan without), from v >= 0."""
    swings: Flags = (a < 0.0) & (a * a > 2.0 * jerk * v)
    too_hard = np.where(swings, 0.0, np.maximum(-a - most, 0.0) / jerk)
    early, v1, a1 = _advance(v, a, jerk, too_hard)
    t, v0 = a1 / jerk, v1 + a1 * a1 / (2.0 * jerk)
    onward = early + v0 * t - jerk * t * t * t / 6.0 + _brake(v0, most, jerk)
    # Turning: a goes to zero with +J, then the mirror image brakes.
    t = np.where(swings, -a / jerk, 0.0)
    way, back, _ = _advance(v, a, jerk, t)
    backward = way - _brake(np.maximum(-back, 0.0), most, jerk)
    root = np.sqrt(np.where(swings, a * a - 2.0 * jerk * v, 1.0))
    turn, _, _ = _advance(v, a, jerk, 2.0 * v / np.where(swings, root - a, 1.0))
    return np.where(swings, backward, onward), np.where(swings, turn, np.nan)


def stops(curves: Curves, most: Floats, jerk: Floats) -> Stops:
    """Compute the shortest stop from the state in which each plan takes over.

    Args:
        curves: the plans.
        most: deceleration limit of each, u/s².
        jerk: jerk limit of each, u/s³.
    """
    plan: Integers = np.arange(len(curves), dtype=np.int64)
    start = curves.at(plan, np.maximum(curves.offset, 0.0))
    heading = np.where(np.where(start.v == 0.0, start.a, start.v) < 0.0, -1.0, 1.0)
    rest, turn = _from(np.abs(start.v), heading * start.a, most, jerk)
    return Stops(rest=start.p + heading * rest, turn=start.p + heading * turn, heading=heading)
