"""Random programs: what they command when, and how they end."""

from typing import Any, Final, NamedTuple

import numpy as np

MOVES: Final = {
    "absolute": 8, "relative": 3, "velocity": 4, "buffered": 10, "onward": 3, "additive": 3, "modulo": 3,
    "continuous": 3, "further": 2, "jog": 3, "halt": 2, "late_halt": 2, "stop": 2, "hold": 2, "emergency_stop": 1,
    "home": 2, "calibrate": 1, "define": 3,
}  # fmt: skip
"""Calls that move an axis or its coordinate, and how often they come."""

OTHERS: Final = {
    "override": 4, "sweep": 2, "enable": 5, "feed": 2, "disable": 1, "late_disable": 1, "reset": 5, "passes": 1,
    "fault": 1,
}  # fmt: skip
"""The others."""

CALLS: Final = MOVES | OTHERS

FRACTIONS: Final = (0.0, 1.0, 1.0, 1.0, 1.5)
"""Of a maximum, beside those in between."""

LONGEST_WAIT: Final = 70
MOST_ACTS: Final = 24
MOST_PARTS: Final = 4
CHOICES: Final = 5 * 6 * 7 * 4
"""Holds every combination of a direction with one of the other enumerations."""


class Act(NamedTuple):
    """Wait some ticks, then make one call.

    Attributes:
        ticks: to wait.
        axis: its name.
        call: one of `CALLS`.
        place: of the range of the axis; a little outside of it where it is not between 0 and 1.
        fractions: of the maxima of the axis: velocity, acceleration, deceleration, jerk.
        awaits: whether the end of the command is awaited; whether a held one is released.
        choice: of whatever else the call leaves to choose: direction, mode, flags.
    """

    ticks: int
    axis: str
    call: str
    place: float
    fractions: tuple[float, float, float, float]
    awaits: bool
    choice: int


class Part(NamedTuple):
    """One program: what it does, how it ends, and whether it stops its axes."""

    acts: list[Act]
    end: str
    cancel_at: int
    stops: bool


def parts(rng: np.random.Generator, axes: list[str], ticks: int) -> list[Part]:
    """Return some programs that work on the same axes."""
    return [
        Part(
            acts=[_act(rng, axes) for _ in range(rng.integers(1, MOST_ACTS + 1))],
            end=str(rng.choice(["ends", "ends", "raises", "cancelled"])),
            cancel_at=int(rng.integers(0, ticks)),
            stops=bool(rng.random() < 0.3),
        )
        for _ in range(rng.integers(1, MOST_PARTS + 1))
    ]


def _act(rng: np.random.Generator, axes: list[str]) -> Act:
    weights = np.array(list(CALLS.values()), dtype=float)
    return Act(
        ticks=0 if rng.random() < 0.2 else int(rng.integers(0, LONGEST_WAIT)),
        axis=str(rng.choice(axes)),
        call=str(rng.choice(list(CALLS), p=weights / weights.sum())),
        place=float(rng.integers(0, 2) if rng.random() < 0.1 else rng.uniform(-0.1, 1.1)),
        fractions=(_fraction(rng), _fraction(rng), _fraction(rng), _fraction(rng)),
        awaits=bool(rng.random() < 0.3),
        choice=int(rng.integers(0, CHOICES)),
    )


def _fraction(rng: np.random.Generator) -> float:
    return float(rng.choice(FRACTIONS) if rng.random() < 0.3 else rng.uniform(0.02, 1.0))


def from_data(data: list[Any]) -> list[Part]:
    """Return programs from what JSON makes of them."""
    return [Part([_act_from(*act) for act in acts], end, cancel_at, stops) for acts, end, cancel_at, stops in data]


def _act_from(ticks: int, axis: str, call: str, place: float, fractions: list[float], awaits: bool, choice: int) -> Act:
    velocity, acceleration, deceleration, jerk = fractions
    return Act(ticks, axis, call, place, (velocity, acceleration, deceleration, jerk), awaits, choice)
