"""Random calls of all blocks on several axes, with random faults of their drives; every call is observed."""

import math
import random
from dataclasses import dataclass, field
from typing import Any, Final

from motionlayer import Simulation, fb
from motionlayer.drive import Fault
from motionlayer.nc import TRANSITIONS, BufferMode, Calibration, Direction, JogMode
from tests.nc.servos import servo_machine

from .observer import Observer

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
    "MC_SetPosition": {"Position": POSITIONS},
}
"""Good values of the Execute blocks; more of a block's inputs keep their defaults."""

FAULTS: Final = ("drive_error", "encoder_jump", "lost_enable", "lost_communication", "blocked")


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


def value(draw: random.Random, good: tuple[Any, ...]) -> Any:
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
        setattr(block, name, 0.0 if new == HUGE and isinstance(block, (fb.MC_Home, fb.MC_SetPosition)) else new)
    if "Options" in block.INPUTS and draw.random() < 0.2 and isinstance(block.Options, fb.ST_MoveOptions):
        block.Options = fb.ST_MoveOptions(EnableBlendingPosition=True, BlendingPosition=value(draw, POSITIONS))
    elif "Options" in block.INPUTS:
        block.Options = type(block.Options)()
    block.Execute = True


def cycle(draw: random.Random, one: Station) -> None:
    """Call every block of an axis, some with other inputs, some twice."""
    if draw.random() < 0.01:
        one.power.Override = value(draw, (0.0, 30.0, 60.0, 100.0))
    if draw.random() < 0.002:
        one.power.BufferMode = draw.choice(tuple(BufferMode))
    off = draw.random() < 0.002
    feeds = {name: draw.random() > 0.1 for name in ("Enable_Positive", "Enable_Negative")}
    one.power(Enable=not off, **(feeds if draw.random() < 0.01 else {}))
    one.override(Enable=draw.random() < 0.5, VelFactor=value(draw, (0.0, 0.5, 1.0)) if draw.random() < 0.02 else 1.0)
    if draw.random() < 0.03:
        one.jog.Mode, one.jog.Velocity = draw.choice(tuple(JogMode)), value(draw, VELOCITIES)
        one.jog.Position = value(draw, (1.0, 5.0))
        one.jog.JogForward, one.jog.JogBackwards = draw.random() < 0.3, draw.random() < 0.3
    one.jog()
    assert one.jog.Busy + one.jog.Done + one.jog.CommandAborted + one.jog.Error <= 1
    for held in one.held:
        eager = 0.05 if isinstance(held.block, fb.MC_Reset) else 0.001 if isinstance(held.block, fb.MC_Stop) else 0.004
        if draw.random() < eager or (held.block.Execute and draw.random() < 0.02):
            act(draw, held)
        for _ in range(2 if draw.random() < 0.01 else 1):
            held.block()
            held.observer.look(held.block)
            del held.observer.calls[:-1]
    one.status(Enable=True)
    states = one.status.Disabled, one.status.StandStill, one.status.ErrorStop, one.status.Stopping, one.status.Homing
    more = one.status.DiscreteMotion, one.status.ContinuousMotion, one.status.SynchronizedMotion
    assert sum(states) + sum(more) == 1
    assert one.ref.axis.state in TRANSITIONS


def live(seed: int, ticks: int, axes: str = AXES) -> Simulation:
    """Run random calls for a number of ticks; return the run."""
    draw = random.Random(seed)
    monitor = {"lag": 40.0, "lag_time": 0.01, "target_window": 1.0, "target_time": 0.005, "target_timeout": 0.5}
    monitors = [monitor if draw.random() < 0.5 else {}, {"range_window": 2.0, "software_limits": True, "lag": 60.0}]
    run = Simulation(servo_machine(axes, monitor=draw.choice(monitors)), seed=seed)
    stations = [station(run, name) for name in axes]

    def main(_run: Simulation) -> None:
        for one in stations:
            cycle(draw, one)
        if draw.random() < 0.0005:
            kind = draw.choice(FAULTS)
            lasting = None if kind == "encoder_jump" else 0.02
            run.inject(draw.choice(axes), Fault(kind, 30.0 if kind == "encoder_jump" else None, lasting))

    program = run.cyclic(main)
    run.step(ticks)
    if program.failure is not None:
        raise program.failure
    return run
