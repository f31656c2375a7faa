"""Random problems of the planner, in families, made a block at a time."""

from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motionlayer.bench.campaign._campaign import stream
from motionlayer.profile import Limits, Profile, plan_position, plan_stop, plan_velocity

Floats = NDArray[np.float64]

BLOCK: Final = 1000
"""Problems of a block: making one alone costs as much as making all of them."""

UNITS: Final = (1.0, 1e3, 1e-3, 72.0)
"""Lengths of a millimetre in mm, µm, m, and degrees of a spindle of 5 mm a turn."""

LARGEST_JERK: Final = 1e9
STREAM: Final = 1
KINDS: Final = ("position", "velocity", "stop")
SHARES: Final = (0.7, 0.2, 0.1)
"""Of the kinds."""


class Problem(NamedTuple):
    """A start state, what is asked, and limits."""

    kind: str
    p: float
    v: float
    a: float
    target: float
    limits: Limits

    def plan(self) -> Profile:
        """Plan it.

        Raises:
            PlanError: the plan failed its check.
        """
        if self.kind == "position":
            return plan_position(self.p, self.v, self.a, self.target, self.limits)
        if self.kind == "velocity":
            return plan_velocity(self.p, self.v, self.a, self.target, self.limits)
        return plan_stop(self.p, self.v, self.a, self.limits)

    def __str__(self) -> str:
        target = "" if self.kind == "stop" else f"{self.target!r}, "
        return f"plan_{self.kind}({self.p!r}, {self.v!r}, {self.a!r}, {target}{self.limits!r})"


def problems(seed: int, block: int) -> list[Problem]:
    """Return a block of problems, the families in turn."""
    rng = stream(seed, block, STREAM)
    rows = BLOCK // len(FAMILIES)
    columns = np.stack([family(rng, rows) for family in FAMILIES.values()], axis=1).reshape(BLOCK, -1)
    kinds = rng.choice(len(KINDS), BLOCK, p=SHARES)
    velocities = columns[:, 4] * _share(rng, BLOCK)
    return [
        _problem(KINDS[kind], row, velocity)
        for kind, row, velocity in zip(kinds.tolist(), columns.tolist(), velocities.tolist(), strict=True)
    ]


def _problem(kind: str, row: list[float], velocity: float) -> Problem:
    p, v, a, target, *limits = row
    targets = {"position": target, "velocity": velocity, "stop": 0.0}
    return Problem(kind, p, v, a, targets[kind], Limits(*limits))


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
