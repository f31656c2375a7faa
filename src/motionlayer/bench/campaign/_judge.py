"""The physics of profiles, judged many at a time; shares nothing with the planner or its check but the tolerances.

Each piece is cut where its velocity or its acceleration passes zero. Between two cuts both signs are constant, |a| is
monotone and so is |v|: what holds at the cuts holds everywhere.
"""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motionlayer.bench.campaign._problems import Problem
from motionlayer.profile import MAX_PIECES, TOLERANCES, Profile

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

SLACK: Final = 2.0 * TOLERANCES.acceleration
UNDERFLOW: Final = 1e-290
ROOT: Final = 1e-5
"""A velocity that is known to this share of its tolerance leaves an acceleration of √(2 J Δv) at v = 0."""


class Batch(NamedTuple):
    """Profiles side by side; rows of pieces beyond the last one have no duration.

    Attributes:
        t: start of every piece, shape (n, k), as the following ones.
        length: duration of every piece; 0 for the endless last one.
        start: p, v, a asked for, shape (n, 3).
        limits: shape (n, 4).
    """

    t: Floats
    length: Floats
    p: Floats
    v: Floats
    a: Floats
    j: Floats
    start: Floats
    limits: Floats

    @property
    def pull(self) -> Floats:
        """The largest acceleration of limits and start, shape (n, 1)."""
        return np.asarray(np.maximum(self.limits[:, 1:3].max(axis=1), np.abs(self.start[:, 2]))[:, None])

    @property
    def speed(self) -> Floats:
        """The velocity limit, or what the start cannot avoid at full jerk, shape (n, 1)."""
        v, a, jerk = self.start[:, 1], self.start[:, 2], self.limits[:, 3]
        unavoidable = np.maximum(np.abs(v), np.abs(v + 0.5 * a * np.abs(a) / jerk))
        return np.asarray(np.maximum(self.limits[:, 0], unavoidable)[:, None])


def faults(problems: Sequence[Problem], profiles: Sequence[Profile]) -> dict[int, str]:
    """Return what is wrong, by the index of the profile."""
    found: dict[int, str] = {}
    for index, (problem, profile) in enumerate(zip(problems, profiles, strict=True)):
        wrong = _ends(problem, profile)
        if wrong:
            found[index] = wrong
    sound = [index for index in range(len(problems)) if index not in found]
    if sound:
        batch = _side_by_side([problems[index] for index in sound], [profiles[index] for index in sound])
        with np.errstate(all="ignore"):  # roots that do not exist are left out below
            rules = {**_joints(batch), **_limits(batch, [profiles[index] for index in sound])}
        for rule, broken in rules.items():
            for row in np.flatnonzero(broken.any(axis=tuple(range(1, broken.ndim)))):
                found.setdefault(sound[int(row)], rule)
    return found


def _ends(problem: Problem, profile: Profile) -> str:
    """Judge shape, start and end; "" if there is nothing wrong."""
    pieces = profile.pieces
    if not (1 <= len(pieces) <= MAX_PIECES and np.isfinite(pieces).all()):
        return "pieces are missing, too many or not finite"
    start, begin = np.array([problem.p, problem.v, problem.a]), pieces[0, 1:4]
    vel, acc, dec, _ = problem.limits
    allowed = TOLERANCES.position * np.array([np.abs(start[0]) + np.abs(begin[0]), vel, max(acc, dec)])
    if not (np.abs(begin - start) <= (allowed if len(pieces) == 1 else 0.0)).all() or pieces[0, 0] != 0.0:
        return "it does not begin at the start"
    t, p, *motion = pieces[-1].tolist()
    if motion != [problem.target if problem.kind == "velocity" else problem.velocity, problem.pull, 0.0]:
        return "it does not end at its velocity"
    if problem.kind == "rendezvous" and t != problem.at:
        return "it does not end at its time"
    there = problem.target + problem.velocity * t if problem.kind == "synchronise" else problem.target
    return "it does not end at its target" if p != there and problem.kind not in {"velocity", "stop"} else ""


def _side_by_side(problems: Sequence[Problem], profiles: Sequence[Profile]) -> Batch:
    table = np.empty((len(profiles), max(len(profile.pieces) for profile in profiles), 5))
    for row, profile in enumerate(profiles):
        count = len(profile.pieces)
        table[row, :count] = profile.pieces
        table[row, count:] = profile.pieces[-1]
    t, p, v, a, j = np.moveaxis(table, 2, 0)
    length = np.diff(t, axis=1, append=t[:, -1:])
    start = np.array([problem[1:4] for problem in problems])
    return Batch(t, length, p, v, a, j, start, np.array([problem.limits for problem in problems]))


def _joints(b: Batch) -> dict[str, Flags]:
    """Judge what a piece hands to the next one."""
    s, jerk = b.length[:, :-1], b.limits[:, 3:]
    p, v, a, j = (column[:, :-1] for column in (b.p, b.v, b.a, b.j))
    end_a, end_v = a + s * j, v + s * (a + s * j / 2.0)
    end_p = p + s * (v + s * (a / 2.0 + s * j / 6.0))
    fastest = np.maximum(np.abs(b.v).max(axis=1), _speeds(b).max(axis=1))[:, None]
    hardest = np.abs(b.a).max(axis=1)[:, None]
    blur = TOLERANCES.clock * b.t[:, 1:]
    path = (b.length * _speeds(b)).sum(axis=1)[:, None]
    reach = TOLERANCES.position * path + TOLERANCES.rounding * np.maximum(np.abs(p), np.abs(end_p))
    real = s > 0.0
    return {
        "its pieces are not in order of time": s < 0.0,
        "the jerk limit is exceeded": np.abs(b.j) > jerk,
        "the acceleration jumps": real
        & (np.abs(end_a - b.a[:, 1:]) > TOLERANCES.acceleration * hardest + blur * np.abs(j) + UNDERFLOW),
        "the velocity jumps": real
        & (np.abs(end_v - b.v[:, 1:]) > TOLERANCES.velocity * fastest + blur * hardest + UNDERFLOW),
        "the position jumps": real & (np.abs(end_p - b.p[:, 1:]) > reach + blur * fastest + UNDERFLOW),
    }


def _speeds(b: Batch) -> Floats:
    """Return the largest |v| of every piece, shape (n, k)."""
    return np.asarray(np.abs(_at(b, _cuts(b))[1]).max(axis=2))


def _cuts(b: Batch) -> Floats:
    """Return the times inside each piece at which v or a is zero, between its ends, shape (n, k, 5)."""
    root = np.sqrt(b.a * b.a - 2.0 * b.j * b.v)
    q = -(b.a + np.copysign(root, b.a))  # the stable half of each root
    times = np.stack([-b.a / b.j, q / b.j, 2.0 * b.v / q], axis=2)
    inside = (times > 0.0) & (times < b.length[:, :, None])
    inner = np.sort(np.where(inside, times, 0.0), axis=2)
    return np.concatenate([np.zeros_like(b.t)[:, :, None], inner, b.length[:, :, None]], axis=2)


def _at(b: Batch, s: Floats) -> tuple[Floats, Floats, Floats]:
    p, v, a, j = (column[:, :, None] for column in (b.p, b.v, b.a, b.j))
    return p + s * (v + s * (a / 2.0 + s * j / 6.0)), v + s * (a + s * j / 2.0), a + s * j


def _limits(b: Batch, profiles: Sequence[Profile]) -> dict[str, Flags]:
    """Judge velocity and acceleration between all cuts, and the extent at them.

    A start outside the limits is taken back at full jerk: |a| may be |a₀| - J t wherever that is more than is allowed,
    and |v| may grow beyond its limit only while it is no more than that.
    """
    vel, acc, dec, jerk = (b.limits[:, k, None, None] for k in range(4))
    speed, pull = b.speed[:, :, None], b.pull[:, :, None]
    cuts = _cuts(b)
    p, v, a = _at(b, cuts)
    _, middle_v, middle_a = _at(b, (cuts[:, :, :-1] + cuts[:, :, 1:]) / 2.0)
    t = b.t[:, :, None] + cuts
    left = np.abs(b.start[:, 2, None, None]) - jerk * t
    loose = SLACK * pull + TOLERANCES.clock * t * jerk
    grows = middle_v * middle_a > 0.0
    # Velocities within tolerance of zero belong to both sides; the passing itself is judged below.
    allowed = np.where(grows, acc, dec)
    allowed = np.where(np.abs(middle_v) <= SLACK * speed, np.maximum(acc, dec), allowed)
    real = np.diff(cuts, axis=2) > 0.0
    over, fast = np.zeros_like(real), np.zeros_like(real)
    for side in (slice(None, -1), slice(1, None)):
        most = np.maximum(allowed, left[:, :, side]) + loose[:, :, side]
        over |= real & (np.abs(a[:, :, side]) > most)
        beyond = np.abs(v[:, :, side]) > vel + SLACK * speed
        fast |= real & beyond & grows & (np.abs(a[:, :, side]) > left[:, :, side] + loose[:, :, side])
    passes = _passes(b, v, cuts)
    uncertain = np.sqrt(2.0 * jerk * TOLERANCES.velocity * ROOT * speed)
    hard = passes & (np.abs(a) > np.maximum(np.minimum(acc, dec), left) + loose + uncertain)
    low = np.array([profile.low for profile in profiles])[:, None, None]
    high = np.array([profile.high for profile in profiles])[:, None, None]
    blur = TOLERANCES.position * (np.abs(p) + np.abs(low) + np.abs(high)) + UNDERFLOW
    return {
        "the velocity limit is exceeded": np.abs(v) > speed * (1.0 + SLACK),
        "the velocity grows beyond its limit": fast,
        "it lingers above the velocity limit": _lingers(b, vel[:, :, 0] + SLACK * speed[:, :, 0]),
        "the acceleration or deceleration limit is exceeded": over,
        "it passes v = 0 with more than both limits": hard,
        "its extent is too small": (p < low - blur) | (p > high + blur),
    }


def _passes(b: Batch, v: Floats, cuts: Floats) -> Flags:
    """Tell at which cuts inside a piece the velocity changes its sign."""
    before, after = np.roll(v, 1, axis=2), np.roll(v, -1, axis=2)
    inside = (cuts > 0.0) & (cuts < b.length[:, :, None])
    return np.asarray(inside & (np.abs(v) <= SLACK * b.speed[:, :, None]) & (before * after < 0.0))


def _lingers(b: Batch, most: Floats) -> Flags:
    """Tell which pieces stay at a velocity above the limit."""
    return np.asarray((b.length > 0.0) & (b.j == 0.0) & (b.a == 0.0) & (np.abs(b.v) > most))
