"""Random problems of the planner, in families, made a block at a time."""

import math
from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motionlayer.bench.campaign._campaign import stream
from motionlayer.profile import (
    RANGES,
    Limits,
    Moving,
    Profile,
    State,
    plan_passing,
    plan_position,
    plan_rendezvous,
    plan_stop,
    plan_synchronise,
    plan_velocity,
)

Floats = NDArray[np.float64]

BLOCK: Final = 1000
"""Problems of a block: making one alone costs as much as making all of them."""

UNITS: Final = (1.0, 1e3, 1e-3, 72.0)
"""Lengths of a millimetre in mm, µm, m, and degrees of a spindle of 5 mm a turn."""

LARGEST_JERK: Final = 1e9
STREAM: Final = 1
KINDS: Final = ("position", "velocity", "stop", "passing", "synchronise", "rendezvous")
BESIDE: Final = "beside"
"""Is made a kind that has a target: one right beside where the fastest way ends."""

DRAWN: Final = (*KINDS, BESIDE)
SHARES: Final = (0.4, 0.15, 0.1, 0.12, 0.08, 0.1, 0.05)
"""Of what is drawn."""

NEAREST: Final = 17
"""Decades down to which a target lies beside that place: less than rounding does to the way."""

BELOW: Final = 0.95
"""Fastest moving target, of the velocity limit: one as fast as the limit and ahead stays out of reach."""


class Problem(NamedTuple):
    """A start state, what is asked, and limits.

    Attributes:
        kind: the name of the question; one of `KINDS`.
        p: start position.
        v: start velocity.
        a: start acceleration.
        target: the position asked for, of kind `velocity` the velocity.
        limits: in force.
        velocity: at the target.
        pull: acceleration at the target.
        at: when.
    """

    kind: str
    p: float
    v: float
    a: float
    target: float
    limits: Limits
    velocity: float = 0.0
    pull: float = 0.0
    at: float = math.inf

    def plan(self) -> Profile:
        """Plan it.

        Raises:
            PlanError: the plan failed its check.
        """
        function, arguments, keywords = self._call()
        return function(*arguments, **keywords)

    def __str__(self) -> str:
        function, arguments, keywords = self._call()
        texts = [*map(repr, arguments), *(f"{name}={value!r}" for name, value in keywords.items())]
        return f"{function.__name__}({', '.join(texts)})"

    def _call(self) -> tuple[Callable[..., Profile], tuple[object, ...], dict[str, float]]:
        start = self.p, self.v, self.a
        match self.kind:
            case "position":
                return plan_position, (*start, self.target, self.limits), {}
            case "velocity":
                return plan_velocity, (*start, self.target, self.limits), {}
            case "passing":
                return plan_passing, (*start, self.target, self.velocity, self.limits), {}
            case "synchronise":
                return plan_synchronise, (*start, Moving(self.target, self.velocity), self.limits), {}
            case "rendezvous":
                state = State(self.target, self.velocity, self.pull)
                return plan_rendezvous, (*start, state, self.limits), {"at": self.at}
        return plan_stop, (*start, self.limits), {}


def problems(seed: int, block: int) -> list[Problem]:
    """Return a block of problems, the families in turn."""
    rng = stream(seed, block, STREAM)
    rows = BLOCK // len(FAMILIES)
    columns = np.stack([family(rng, rows) for family in FAMILIES.values()], axis=1).reshape(BLOCK, -1)
    kinds = rng.choice(len(DRAWN), BLOCK, p=SHARES)
    shares = np.stack([_share(rng, BLOCK), _share(rng, BLOCK), _decades(rng, 0.0, 1.0, BLOCK)], axis=1)
    return [
        _problem(DRAWN[kind], row, *share)
        for kind, row, share in zip(kinds.tolist(), columns.tolist(), shares.tolist(), strict=True)
    ]


def _problem(kind: str, row: list[float], share: float, pull: float, later: float) -> Problem:
    """Return a problem; the shares say how fast its target is, how hard it accelerates, and how late it is met."""
    p, v, a, target, *rest = row
    limits = Limits(*rest)
    problem = Problem(kind, p, v, a, target, limits)
    u = share * limits.velocity
    match kind:
        case "velocity" | "stop":
            return problem._replace(target=u if kind == "velocity" else 0.0)
        case "passing" | "synchronise":
            return problem._replace(velocity=u if kind == "passing" else BELOW * u)
        case "rendezvous":
            return _rendezvous(problem, BELOW * u, pull, later)
        case _ if kind == BESIDE:
            return _beside(problem, BELOW * u, pull, later)
    return problem


def _beside(problem: Problem, velocity: float, share: float, nearness: float) -> Problem:
    """Return a problem with a target beside where the fastest way to a velocity ends; rest, a place, a moving one.

    In half of them the velocity is hardly another than the one that remains when the acceleration has been taken back.
    """
    p, v, a, limits = problem.p, problem.v, problem.a, problem.limits
    kind = ("position", "passing", "synchronise")[int(1e6 * nearness) % 3]
    away = math.copysign(10.0 ** (-NEAREST * math.log10(nearness)), share)
    remaining = v + 0.5 * a * abs(a) / limits.jerk
    if abs(share) > 0.5 and abs(remaining) < BELOW * limits.velocity:
        velocity = remaining * (1.0 + (1.0 - BELOW) * away)
    velocity = 0.0 if kind == "position" else velocity
    way = plan_velocity(p, v, a, velocity, limits)
    end = float(way.pieces[-1, 1]) - (velocity * way.duration if kind == "synchronise" else 0.0)
    target = end + away * max(abs(end - p), way.high - way.low)
    return problem._replace(kind=kind, target=target, velocity=velocity)


def _rendezvous(problem: Problem, before: float, share: float, later: float) -> Problem:
    """Return a problem with a state that a ramp from a velocity leads into, and with ample time.

    Time to stop, to go there and back at full speed, and for all ramps: any state can be met then. Where that is
    longer than the clock is promised to be fine, the problem is a move to rest.
    """
    vel, acc, dec, jerk = problem.limits
    pull = share * min(acc, dec, math.sqrt(2.0 * jerk * (0.99 * vel - abs(before))))
    top = abs(problem.v) + 0.5 * problem.a * problem.a / jerk + vel
    ramps = 4.0 * (top / min(acc, dec) + (abs(problem.a) + acc + dec) / jerk)
    at = later * ((abs(problem.target - problem.p) + ramps * top) / vel + ramps)
    if at > RANGES.duration:
        return problem._replace(kind="position")
    return problem._replace(velocity=before + 0.5 * pull * abs(pull) / jerk, pull=pull, at=at)


def _share(rng: np.random.Generator, count: int) -> Floats:
    """Return shares in [-1, 1], the edges and zero among them."""
    share = rng.uniform(-1.0, 1.0, count)
    return np.where(rng.random(count) < 0.15, rng.integers(-1, 2, count).astype(float), share)


def _decades(rng: np.random.Generator, low: float, high: float, count: int) -> Floats:
    return np.asarray(10.0 ** rng.uniform(low, high, count))


def _state(rng: np.random.Generator, vel: Floats, acc: Floats, dec: Floats) -> tuple[Floats, Floats]:
    """Return velocity and acceleration inside the limits."""
    v, share = vel * _share(rng, len(vel)), _share(rng, len(vel))
    return v, share * np.where(v * share > 0.0, acc, dec)


def units(rng: np.random.Generator, count: int) -> Floats:
    """Axes of usual machines in mm, µm, m and degrees; jerk up to 1e9."""
    unit = rng.choice(UNITS, count)
    vel, acc = unit * _decades(rng, 0.0, 4.0, count), unit * _decades(rng, 1.0, 5.0, count)
    dec = acc * _decades(rng, -0.5, 0.5, count)
    jerk = np.minimum(unit * _decades(rng, 2.0, 9.0, count), LARGEST_JERK)
    v, a = _state(rng, vel, acc, dec)
    p = unit * 1e4 * _share(rng, count)
    target = p + vel * vel / acc * _share(rng, count) * _decades(rng, -3.0, 3.0, count)
    return np.stack([p, v, a, target, vel, acc, dec, jerk], axis=1)


def integers(rng: np.random.Generator, count: int) -> Floats:
    """Small integers: full of degenerate cases, starts outside the limits among them."""
    state, limits = rng.integers(-6, 7, (count, 3)), rng.integers(1, 7, (count, 4))
    return np.hstack([state, rng.integers(-40, 41, (count, 1)), limits]).astype(float)


def _any_size(rng: np.random.Generator, count: int, spread: float, apart: float) -> Floats:
    """Machines of any size: `spread` decades around one, deceleration up to `apart` decades from acceleration."""
    length, time = (
        _decades(rng, -3.0 * spread, 3.0 * spread, count),
        _decades(rng, -1.5 * spread, spread, count),
    )
    vel = length / time
    acc = vel / time * _decades(rng, -spread, spread, count)
    dec = acc * _decades(rng, -apart, apart, count)
    jerk = acc / time * _decades(rng, -spread, spread, count)
    v, a = _state(rng, vel, acc, dec)
    p = 100.0 * length * _share(rng, count)
    target = p + length * _share(rng, count) * _decades(rng, -3.0, 3.0, count)
    return np.stack([p, v, a, target, vel, acc, dec, jerk], axis=1)


def extreme(rng: np.random.Generator, count: int) -> Floats:
    """Sizes over twelve decades."""
    return _any_size(rng, count, 2.0, 2.0)


def asymmetric(rng: np.random.Generator, count: int) -> Floats:
    """Deceleration up to a thousand times apart from acceleration."""
    return _any_size(rng, count, 1.0, 3.0)


def outside(rng: np.random.Generator, count: int) -> Floats:
    """Starts up to ten times outside the limits."""
    rows = _any_size(rng, count, 1.0, 1.0)
    rows[:, 1:3] *= rng.uniform(1.0, 10.0, (count, 2))
    return rows


FAMILIES: Final[dict[str, Callable[[np.random.Generator, int], Floats]]] = {
    "units": units,
    "integers": integers,
    "extreme": extreme,
    "asymmetric": asymmetric,
    "outside": outside,
}
