"""The campaign `blocks`: whatever function blocks are called with, on axes whose drives fail, no rule is broken.

Every call of every block is watched by an observer that knows the rules of PLCopen and nothing of the blocks; the trace
is judged by `motionlayer.verify`.
"""

import random
from dataclasses import dataclass, field
from typing import Any, Final

from motionlayer import fb
from motionlayer.bench.campaign._block_inputs import EAGER, EAGER_AT_REST, INPUTS, VELOCITIES, machine, options, value
from motionlayer.bench.campaign._campaign import Campaign, Failure, judged
from motionlayer.bench.campaign._observer import Observer, must
from motionlayer.drive import Fault
from motionlayer.machine import Simulation
from motionlayer.nc import TRANSITIONS, BufferMode, JogMode
from motionlayer.verify import verify

TICKS: Final = 2000
"""Cycles of a case."""

MOST_TOLD: Final = 5
"""Findings that a failure quotes."""

AXES: Final = "ABCDEF"

CAMS: Final = ("none", "none", "place", "phase", "any")
"""Ways to read a cam: not at all, at a place, as an axis without one does, or as it comes."""

CAM_PLACE: Final = -5.0
"""At and below it the cam is on that is read at a place, u."""

LEAVING: Final = 4
"""`HomingState` from which on the cam is left."""

FAULTS: Final = ("drive_error", "encoder_jump", "lost_enable", "lost_communication", "blocked")


@dataclass
class Held:
    """A block, and who watches it."""

    block: Any
    observer: Observer
    called: int = 0


@dataclass
class Station:
    """One axis with its blocks.

    Attributes:
        cam: how the program reads a cam: one of `CAMS`.
    """

    name: str
    ref: fb.AXIS_REF
    power: fb.MC_Power
    jog: fb.MC_Jog
    override: fb.MC_SetOverride
    status: fb.MC_ReadStatus
    cam: str
    held: list[Held] = field(default_factory=list)


def station(run: Simulation, name: str, cam: str) -> Station:
    """Return an axis with one block of each kind, and a second absolute move that fights with the first."""
    ref = run.axis_refs[name]
    made = Station(name, ref, fb.MC_Power(ref), fb.MC_Jog(ref), fb.MC_SetOverride(ref), fb.MC_ReadStatus(ref), cam)
    for kind in INPUTS:
        if hasattr(fb, kind):
            made.held.append(Held(getattr(fb, kind)(ref), observer_of(kind)))
    made.held.append(Held(fb.MC_MoveAbsolute(ref), Observer()))
    return made


def observer_of(kind: str) -> Observer:
    """Return who knows how a block tells its end."""
    finish = {"MC_MoveVelocity": "InVelocity"}.get(kind, "InEndVelocity" if "Continuous" in kind else "Done")
    return Observer(finish, endless=finish != "Done" or kind == "MC_Stop")


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
    if "Options" in block.INPUTS:
        block.Options = options(draw, type(block.Options))
    block.Execute = True


def read_cam(draw: random.Random, one: Station, home: fb.MC_Home) -> None:
    """Give a homing the signal of the cam that the program reads."""
    if one.cam == "place":
        home.bCalibrationCam = one.ref.NcToPlc.ActPos <= CAM_PLACE
    elif one.cam == "phase":
        home.bCalibrationCam = one.ref.NcToPlc.HomingState < LEAVING
    elif one.cam == "any" and draw.random() < 0.01:
        home.bCalibrationCam = not home.bCalibrationCam


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
        kind = type(held.block).__name__
        eager = pace * EAGER.get(kind, EAGER_AT_REST.get(kind, 1.0) if one.status.StandStill else 1.0)
        if draw.random() < eager or (held.block.Execute and draw.random() < 0.02):
            act(draw, held)
        if isinstance(held.block, fb.MC_Home):
            read_cam(draw, one, held.block)
        for _ in range(2 if draw.random() < 0.01 else 1):
            held.block()
            held.observer.look(held.block)
    one.status(Enable=True)
    states = one.status.Disabled, one.status.StandStill, one.status.ErrorStop, one.status.Stopping, one.status.Homing
    more = one.status.DiscreteMotion, one.status.ContinuousMotion, one.status.SynchronizedMotion
    must(sum(states) + sum(more) == 1, "exactly one state", states, more)
    must(one.ref.axis.state in TRANSITIONS, "a state that is not in the table", one.ref.axis.state)


def live(seed: int, case: int, ticks: int, axes: str = AXES) -> Simulation:
    """Run random calls for a number of ticks; return the run.

    Raises:
        RuleBroken: the outputs of a block contradict the rules.
    """
    draw = random.Random(f"{seed} {case}")  # noqa: S311 - a case, no secret
    pace = draw.choice((0.0002, 0.001, 0.004))
    run = Simulation(machine(draw, axes), seed=case)
    stations = [station(run, name, draw.choice(CAMS)) for name in axes]

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
