"""Random programs: what they command when, and how they end."""

from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np

from motionlayer.command import Command, ErrorId
from motionlayer.machine import Simulation
from motionlayer.nc import Axis, Direction, stopping

if TYPE_CHECKING:
    from collections.abc import Callable

CALLS: Final = {
    "absolute": 8, "relative": 3, "velocity": 4, "halt": 2, "stop": 2, "home": 2, "override": 3, "sweep": 2,
    "enable": 4, "disable": 1, "reset": 4, "passes": 1, "fault": 1,
}  # fmt: skip
"""Calls and how often they come."""

FRACTIONS: Final = (0.0, 1.0, 1.0, 1.0, 1.5)
"""Of a maximum, beside those in between."""

LONGEST_WAIT: Final = 70
LONGEST_SWEEP: Final = 40
MOST_ACTS: Final = 24
MOST_PARTS: Final = 4
AWAITED: Final = 200
"""Ticks that a command is awaited at most."""

PURPOSE: Final = "on purpose"


class Act(NamedTuple):
    """Wait some ticks, then make one call; fractions are of the axis's maxima, the place is one of its range."""

    ticks: int
    axis: str
    call: str
    place: float
    fractions: tuple[float, float, float, float]
    awaits: bool


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
    )


def _fraction(rng: np.random.Generator) -> float:
    return float(rng.choice(FRACTIONS) if rng.random() < 0.3 else rng.uniform(0.02, 1.0))


def call(axis: Axis, act: Act, reach: tuple[float, float]) -> Command[Any] | None:
    """Make the call; a fault and an override are no commands.

    Args:
        axis: that it is made to.
        act: what to call.
        reach: least and greatest place.
    """
    low, span = reach[0], reach[1] - reach[0]
    place = low + act.place * span
    v, a, d, j = (fraction * most for fraction, most in zip(act.fractions, axis.config.maximum, strict=True))
    calls: dict[str, Callable[[], Command[Any] | None]] = {
        "absolute": lambda: axis.move_absolute(place, velocity=v, acceleration=a, deceleration=d, jerk=j),
        "relative": lambda: axis.move_relative((act.place - 0.5) * span / 4.0, velocity=v, jerk=j),
        "velocity": lambda: axis.move_velocity(
            v, list(Direction)[act.ticks % len(Direction)], acceleration=a, deceleration=d, jerk=j
        ),
        "halt": lambda: axis.halt(deceleration=d or None, jerk=j or None),
        "stop": lambda: axis.stop(deceleration=d or None, jerk=j or None),
        "home": lambda: axis.home(place if act.awaits else None),
        "override": lambda: axis.set_override(min(act.fractions[0], 1.0) if act.place < 0.8 else 1.0),
        "enable": axis.enable,
        "disable": axis.disable,
        "reset": axis.reset,
        "passes": lambda: axis.passes(place),
        "fault": lambda: axis.fault(ErrorId.PARAMETER, PURPOSE),
    }
    return calls[act.call]()


async def play(run: Simulation, part: Part, reach: dict[str, tuple[float, float]], given: list[Command[Any]]) -> None:
    """Do what a part says; every command is appended to `given`."""
    cycle = run.base_cycle_ns * 1e-9
    async with stopping(*(run.axes.values() if part.stops else ())):
        for act in part.acts:
            if act.ticks:
                await run.sleep(act.ticks * cycle)
            axis = run.axes[act.axis]
            if act.call == "sweep":
                await _sweep(run, axis, act)
                continue
            command = call(axis, act, reach[act.axis])
            if command is None:
                continue
            given.append(command)
            if act.awaits and act.call != "velocity":
                await _await(run, command, AWAITED * cycle)
        if part.end == "raises":
            raise LookupError(PURPOSE)


async def _sweep(run: Simulation, axis: Axis, act: Act) -> None:
    """Change the override in every cycle for a while."""
    first, last, *_ = act.fractions
    for factor in np.linspace(min(first, 1.0), min(last, 1.0), 2 + act.ticks % LONGEST_SWEEP).tolist():
        axis.set_override(factor)
        await run.sleep(run.base_cycle_ns * 1e-9)


async def _await(run: Simulation, command: Command[Any], seconds: float) -> None:
    try:
        with run.fail_after(seconds):
            await command.settled()
    except TimeoutError:
        pass
