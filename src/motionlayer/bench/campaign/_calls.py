"""What a random program does to its axes: its calls, and how it waits for them."""

from collections.abc import Callable
from contextlib import suppress
from typing import Any, Final, NamedTuple

import numpy as np

from motionlayer.bench.campaign._acts import Act, Part
from motionlayer.command import Command, ErrorId
from motionlayer.machine import Simulation
from motionlayer.nc import Axis, BufferMode, Calibration, Direction, HeldCommand, JogMode, stopping

LONGEST_SWEEP: Final = 40
LONGEST_HOLD: Final = 90
"""Ticks that a jog key or a locking stop is held."""

AWAITED: Final = 200
"""Ticks that a command is awaited at most."""

ENDLESS: Final = ("velocity", "continuous", "further")
"""Calls whose commands are not awaited."""

PURPOSE: Final = "on purpose"


class Given(NamedTuple):
    """An act in the numbers of its axis.

    Attributes:
        axis: that is called.
        place: u.
        way: u, in either direction.
        v, a, d, j: u/s, u/s², u/s³.
        direction: one of five.
        mode: one of six.
        awaits, choice: see `Act`.
    """

    axis: Axis
    place: float
    way: float
    v: float
    a: float
    d: float
    j: float
    direction: Direction
    mode: BufferMode
    awaits: bool
    choice: int


def _blending_position(g: Given) -> float | None:
    """Return a place between here and the target of the move, for one command in three."""
    return g.axis.set_position + 0.5 * g.way if g.choice % 3 == 0 else None


MOVING: Final[dict[str, Callable[[Given], Command[Any]]]] = {
    "absolute": lambda g: g.axis.move_absolute(g.place, velocity=g.v, acceleration=g.a, deceleration=g.d, jerk=g.j),
    "relative": lambda g: g.axis.move_relative(g.way, velocity=g.v, jerk=g.j),
    "velocity": lambda g: g.axis.move_velocity(g.v, g.direction, acceleration=g.a, deceleration=g.d, jerk=g.j),
    "buffered": lambda g: g.axis.move_absolute(
        g.place, velocity=g.v, deceleration=g.d, buffer_mode=g.mode, blending_position=_blending_position(g)
    ),
    "onward": lambda g: g.axis.move_relative(g.way, velocity=g.v, jerk=g.j, buffer_mode=g.mode),
    "additive": lambda g: g.axis.move_additive(g.way, velocity=g.v, deceleration=g.d, buffer_mode=g.mode),
    "modulo": lambda g: g.axis.move_modulo(abs(g.place), g.direction, velocity=g.v, buffer_mode=g.mode),
    "continuous": lambda g: g.axis.move_continuous_absolute(
        g.place, g.v, velocity=g.v if g.awaits else None, acceleration=g.a, jerk=g.j, buffer_mode=g.mode
    ),
    "further": lambda g: g.axis.move_continuous_relative(g.way, g.v, deceleration=g.d, buffer_mode=g.mode),
    "jog": lambda g: g.axis.jog(
        g.direction, JogMode(g.choice // 5 % len(JogMode)), step=abs(g.way) or None, velocity=g.v, jerk=g.j
    ),
    "halt": lambda g: g.axis.halt(deceleration=g.d or None, jerk=g.j or None),
    "late_halt": lambda g: g.axis.halt(deceleration=g.d or None, buffer_mode=g.mode),
    "stop": lambda g: g.axis.stop(deceleration=g.d or None, jerk=g.j or None),
    "hold": lambda g: g.axis.stop(deceleration=g.d or None, hold=True),
    "emergency_stop": lambda g: g.axis.emergency_stop(),
    "home": lambda g: g.axis.home(g.place if g.awaits else None),
    "calibrate": lambda g: g.axis.home(g.place, Calibration(g.choice % len(Calibration)), clear_lag=g.awaits),
    "define": lambda g: g.axis.define_position(
        g.way if g.choice % 2 else g.place,
        relative=bool(g.choice % 2),
        clear_lag=g.choice % 5 == 0,
        clear_offset=g.choice % 7 == 0,
    ),
}


def _fault(g: Given) -> None:
    g.axis.fault(ErrorId.PARAMETER, PURPOSE)


OTHER: Final[dict[str, Callable[[Given], Command[Any] | None]]] = {
    "enable": lambda g: g.axis.enable(),
    "feed": lambda g: g.axis.enable(positive=g.choice % 2 == 0, negative=g.choice % 3 == 0),
    "disable": lambda g: g.axis.disable(),
    "late_disable": lambda g: g.axis.disable(buffer_mode=g.mode),
    "reset": lambda g: g.axis.reset(),
    "passes": lambda g: g.axis.passes(g.place),
    "fault": _fault,
}


def call(axis: Axis, act: Act, reach: tuple[float, float]) -> Command[Any] | None:
    """Make the call; a fault and an override are no commands.

    Args:
        axis: that it is made to.
        act: what to call; all of `CALLS` but "sweep", which takes time.
        reach: least and greatest place.
    """
    if act.call == "override":
        axis.set_override(min(act.fractions[0], 1.0) if act.place < 0.8 else 1.0)
        return None
    low, span = reach[0], reach[1] - reach[0]
    v, a, d, j = (fraction * most for fraction, most in zip(act.fractions, axis.config.maximum, strict=True))
    direction = list(Direction)[act.choice % len(Direction)]
    mode = BufferMode(act.choice // len(Direction) % len(BufferMode))
    place, way = low + act.place * span, (act.place - 0.5) * span / 4.0
    given = Given(axis, place, way, v, a, d, j, direction, mode, act.awaits, act.choice)
    return (MOVING.get(act.call) or OTHER[act.call])(given)


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
            if act.awaits and act.call not in ENDLESS:
                await _await(run, command, act, cycle)
        if part.end == "raises":
            raise LookupError(PURPOSE)


async def _sweep(run: Simulation, axis: Axis, act: Act) -> None:
    """Change the override in every cycle for a while."""
    first, last, *_ = act.fractions
    for factor in np.linspace(min(first, 1.0), min(last, 1.0), 2 + act.ticks % LONGEST_SWEEP).tolist():
        axis.set_override(factor)
        await run.sleep(run.base_cycle_ns * 1e-9)


async def _await(run: Simulation, command: Command[Any], act: Act, cycle: float) -> None:
    """Wait for the end of a command; one that is held is let go before."""
    if isinstance(command, HeldCommand) and command.held:
        await run.sleep(act.choice % LONGEST_HOLD * cycle)
        command.release()
    with suppress(TimeoutError), run.fail_after(AWAITED * cycle):
        await command.settled()
