"""The campaign `blocks`: whatever function blocks are called with, on axes whose drives fail, no rule is broken.

Every call of every block is watched by an observer that knows the rules of PLCopen and nothing of the blocks; the trace
is judged by `motionlayer.verify`.
"""

import math
import random
from dataclasses import dataclass, field
from typing import Any, Final

from motionlayer import fb
from motionlayer.bench.campaign._campaign import Campaign, Failure, judged
from motionlayer.bench.campaign._observer import Observer, must
from motionlayer.drive import Fault
from motionlayer.machine import Machine, Simulation
from motionlayer.nc import TRANSITIONS, BufferMode, Calibration, Direction, JogMode
from motionlayer.verify import verify

TICKS: Final = 2000
"""Cycles of a case."""

MOST_TOLD: Final = 5
"""Findings that a failure quotes."""

AXES: Final = "ABCDEF"
NAN: Final = math.nan

POSITIONS: Final = (0.0, 10.0, 50.0, 120.0, 300.0, -50.0, 390.0)
VELOCITIES: Final = (20.0, 200.0, 500.0)
DYNAMICS: Final = (0.0, 0.0, 800.0, 4000.0)
JERKS: Final = (0.0, 0.0, 2e4, 1e5)
HUGE: Final = 1e300
BAD: Final = (NAN, math.inf, -math.inf, -5.0, 0.0, HUGE)
"""Values that no input of a motion takes; some take 0."""

MOTION: Final = {
    "Velocity": VELOCITIES,
    "Acceleration": DYNAMICS,
    "Deceleration": DYNAMICS,
    "Jerk": JERKS,
    "BufferMode": tuple(BufferMode),
}
BRAKE: Final = {"Deceleration": DYNAMICS, "Jerk": JERKS}

INPUTS: Final[dict[str, dict[str, tuple[Any, ...]]]] = {
    "MC_MoveAbsolute": MOTION | {"Position": POSITIONS},
    "MC_MoveRelative": MOTION | {"Distance": POSITIONS},
    "MC_MoveAdditive": MOTION | {"Distance": POSITIONS},
    "MC_MoveModulo": MOTION | {"Position": POSITIONS, "Direction": tuple(Direction)},
    "MC_MoveVelocity": MOTION | {"Direction": tuple(Direction)},
    "MC_MoveContinuousAbsolute": MOTION | {"Position": POSITIONS, "EndVelocity": VELOCITIES},
    "MC_MoveContinuousRelative": MOTION | {"Distance": POSITIONS, "EndVelocity": VELOCITIES},
    "MC_Halt": BRAKE | {"BufferMode": tuple(BufferMode)},
    "MC_Stop": BRAKE,
    "MC_Reset": {},
    "MC_Home": {"Position": POSITIONS, "HomingMode": tuple(Calibration)},
    "MC_SetPosition": {"Position": POSITIONS, "Mode": (False, True)},
}
"""Good values of the Execute blocks; more of a block's inputs keep their defaults."""

EAGER: Final = {"MC_Reset": 10.0, "MC_Stop": 0.2, "MC_Home": 0.5}
"""How much more often than others a block is started."""

FAULTS: Final = ("drive_error", "encoder_jump", "lost_enable", "lost_communication", "blocked")


AXIS: Final[dict[str, Any]] = {
    "max_velocity": 500.0,
    "max_acceleration": 4000.0,
    "max_deceleration": 4000.0,
    "max_jerk": 100_000.0,
    "software_limit_min": -50.0,
    "software_limit_max": 400.0,
    "drive": {
        "kind": "servo",
        "position_gain": 50.0,
        "time_constant": 0.002,
        "dead_time": 0.002,
        "brake_deceleration": 8000.0,
    },
}


@dataclass
class Held:
    """A block, and who watches it."""

    block: Any
    observer: Observer
    called: int = 0


@dataclass
class Station:
    """One axis with its blocks."""

    name: str
    ref: fb.AXIS_REF
    power: fb.MC_Power
    jog: fb.MC_Jog
    override: fb.MC_SetOverride
    status: fb.MC_ReadStatus
    held: list[Held] = field(default_factory=list)


def station(run: Simulation, name: str) -> Station:
    ref = run.axis_refs[name]
    made = Station(name, ref, fb.MC_Power(ref), fb.MC_Jog(ref), fb.MC_SetOverride(ref), fb.MC_ReadStatus(ref))
    for kind in INPUTS:
        if hasattr(fb, kind):
            made.held.append(Held(getattr(fb, kind)(ref), observer_of(kind)))
    made.held.append(Held(fb.MC_MoveAbsolute(ref), Observer()))
    return made


def observer_of(kind: str) -> Observer:
    """Return who knows how a block tells its end."""
    finish = {"MC_MoveVelocity": "InVelocity"}.get(kind, "InEndVelocity" if "Continuous" in kind else "Done")
    return Observer(finish, endless=finish != "Done" or kind == "MC_Stop")


def value(draw: random.Random, good: tuple[Any, ...]) -> Any:  # noqa: ANN401 - of the type of the input
    """Return a good value mostly; for the others, numbers that no input takes or members that do not exist."""
    if draw.random() > 0.08:
        return draw.choice(good)
    return 77 if isinstance(good[0], int) else draw.choice(BAD)


def act(draw: random.Random, held: Held) -> None:
    """Change inputs of a block."""
    block = held.block
    if block.Execute:
        if draw.random() < 0.3:
            block.Execute = False
        return
    for name, good in INPUTS[type(block).__name__].items():
        new = value(draw, good)
        setattr(block, name, new)
    if "Options" in block.INPUTS and draw.random() < 0.2 and isinstance(block.Options, fb.ST_MoveOptions):
        block.Options = fb.ST_MoveOptions(EnableBlendingPosition=True, BlendingPosition=value(draw, POSITIONS))
    elif "Options" in block.INPUTS:
        block.Options = type(block.Options)()
    block.Execute = True


def cycle(draw: random.Random, one: Station, pace: float) -> None:
    """Call every block of an axis, some with other inputs, some twice.

    Args:
        draw: source of chance.
        one: the axis.
        pace: chance per cycle that a block is started.
    """
    if draw.random() < 0.01:
        one.power.Override = value(draw, (0.0, 30.0, 60.0, 100.0))
    if draw.random() < 0.002:
        one.power.BufferMode = draw.choice(tuple(BufferMode))
    off = draw.random() < 0.5 * pace
    feeds = {name: draw.random() > 0.1 for name in ("Enable_Positive", "Enable_Negative")}
    one.power(Enable=not off, **(feeds if draw.random() < 0.01 else {}))
    one.override(Enable=draw.random() < 0.5, VelFactor=value(draw, (0.0, 0.5, 1.0)) if draw.random() < 0.02 else 1.0)
    if draw.random() < 5.0 * pace:
        one.jog.Mode, one.jog.Velocity = draw.choice(tuple(JogMode)), value(draw, VELOCITIES)
        one.jog.Position = value(draw, (1.0, 5.0))
        one.jog.JogForward, one.jog.JogBackwards = draw.random() < 0.3, draw.random() < 0.3
    one.jog()
    must(one.jog.Busy + one.jog.Done + one.jog.CommandAborted + one.jog.Error <= 1, "MC_Jog shows two things", one.name)
    for held in one.held:
        eager = pace * EAGER.get(type(held.block).__name__, 1.0)
        if draw.random() < eager or (held.block.Execute and draw.random() < 0.02):
            act(draw, held)
        for _ in range(2 if draw.random() < 0.01 else 1):
            held.block()
            held.observer.look(held.block)
    one.status(Enable=True)
    states = one.status.Disabled, one.status.StandStill, one.status.ErrorStop, one.status.Stopping, one.status.Homing
    more = one.status.DiscreteMotion, one.status.ContinuousMotion, one.status.SynchronizedMotion
    must(sum(states) + sum(more) == 1, "exactly one state", states, more)
    must(one.ref.axis.state in TRANSITIONS, "a state that is not in the table", one.ref.axis.state)


def machine(draw: random.Random, axes: str) -> Machine:
    """Return a machine of equal servo axes with one of three sets of monitors."""
    monitors: tuple[dict[str, Any], ...] = (
        {},
        {"lag": 40.0, "lag_time": 0.01, "target_window": 1.0, "target_time": 0.005, "target_timeout": 0.5},
        {"range_window": 2.0, "software_limits": True, "lag": 60.0},
    )
    axis = AXIS | {"monitor": draw.choice(monitors)}
    return Machine.from_dict({"format": 1, "name": "blocks", "axis": dict.fromkeys(axes, axis)})


def live(seed: int, case: int, ticks: int, axes: str = AXES) -> Simulation:
    """Run random calls for a number of ticks; return the run.

    Raises:
        RuleBroken: the outputs of a block contradict the rules.
    """
    draw = random.Random(f"{seed} {case}")  # noqa: S311 - a case, no secret
    pace = draw.choice((0.0002, 0.001, 0.004))
    run = Simulation(machine(draw, axes), seed=case)
    stations = [station(run, name) for name in axes]

    def main(_run: Simulation) -> None:
        for one in stations:
            cycle(draw, one, pace)
        if draw.random() < 0.0005:
            kind = draw.choice(FAULTS)
            lasting = None if kind == "encoder_jump" else 0.02
            run.inject(draw.choice(axes), Fault(kind, 30.0 if kind == "encoder_jump" else None, lasting))

    program = run.cyclic(main)
    run.step(ticks)
    if program.failure is not None:
        raise program.failure
    return run


def violations(seed: int, case: int) -> list[str]:
    """Return what is wrong with a case."""
    report = verify(live(seed, case, TICKS).trace)
    found = [str(finding) for finding in report.findings[:MOST_TOLD]]
    return found + [f"cannot be judged: {reason}" for reason in report.refused]


def run(seed: int, cases: range) -> list[Failure]:
    """Run and judge cases."""
    return judged(violations, seed, cases)


def describe(seed: int, case: int) -> str:
    """Return what repeats a case: its calls are drawn as it goes."""
    return f"live({seed}, {case}, {TICKS})  # motionlayer.bench.campaign._blocks"


BLOCKS: Final = Campaign("blocks", "cycles", TICKS, 1, 10_000_000, run, describe)
