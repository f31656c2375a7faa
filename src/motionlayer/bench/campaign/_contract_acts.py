"""Random clients of a motion layer: what they write into which symbol, and when.

All that a client does is to write symbols, drives fail by symbol too; so a case is a list of writes and nothing else.
"""

import math
from typing import Any, Final, NamedTuple

import numpy as np

from motionlayer.bench.campaign import _contract_words as words

CTRL: Final = "GVL_AXIS.Ctrl[{}].eCmd"
ENDS: Final = "GVL_AXIS.Ctrl[{}].eProgress"
FAULT: Final = "GVL_SIMULATION.DriveFault[{}].eFault"

NUMBERS: Final = (
    "GVL_AXIS.Data[{}].rSetPos",
    "GVL_AXIS.Data[{}].rSetVelo",
    "GVL_AXIS.Data[{}].rOverride",
    "GVL_AXIS.Data[{}].rAcc",
    "GVL_AXIS.Data[{}].rDec",
    "GVL_AXIS.Data[{}].rJerk",
)
TYPICAL: Final = (50.0, 500.0, 100.0, 50_000.0, 50_000.0, 5e6)
"""Values of NUMBERS that make sense."""

REACH: Final = 80.0
"""Positions to which axes are sent, u."""

NO_NUMBERS: Final = (math.nan, math.inf, -math.inf)

FLAGS: Final = tuple(
    f"GVL_AXIS.HomeParameter[{{}}].stHomingParam.{name}"
    for name in ("SimulateHomeSensor", "InvertHomeSensor", "HomeOnLimitMin", "HomeOnLimitMax", "InvertLimitMin")
) + tuple(f"GVL_AXIS.LimitSwitches[{{}}].{name}" for name in ("bMinimum", "bMaximum", "bCalibrate"))

CHOICES: Final[dict[str, tuple[int, ...]]] = {
    ENDS: (0, 0, words.DONE, words.DONE, words.ERROR),
    "GVL_AXIS.Data[{}].iDirection": (0, 1, 3, -1, 4, 2, 128),
    "GVL_AXIS.MotionOptions[{}].eBufferMode": (0, 1, 1, 18, 19, 20, 21, 2, 99),
    "GVL_AXIS.HomeParameter[{}].stHomingParam.HomingMode": (0, 4, 7, 8, 5, 77),
    "GVL_AXIS.HomeParameter[{}].stHomingParam.Options.ReferenceMode": (0, 1, 2, 5, 99),
    "GVL_AXIS.NcParameterIn[{}].ParameterNumber": (1004, 1005, 1, 2, 3, 1003, -5, 30_000),
}
"""Whole numbers, those that there are not among them."""

COMMANDS: Final = (
    *(4 * (words.NULL, words.MOVE_POS, words.MOVE_VELO, words.HALT, words.MOVE_BUFFER, words.MOVE_BUFFER_VELO)),
    *(2 * (words.STOP, words.SEND_TO_POS, words.ENABLE, words.IDLE, words.RESET, words.HOME, words.AXIS_INIT)),
    *(2 * (words.DISABLE, words.READ, words.WRITE, words.WRITE_PERSISTENT)),
    *words.ABSENT,
    *(4, 9, 21, 99, 100, 500, 999, 1000, 9012, 10_012, 65_535),
)
"""What is dropped; the last ones are no commands at all."""

LONGEST: Final = 250
"""Cycles in which the end of a command is awaited."""

WAITS: Final = (0, 0, 1, 1, 1, 2, 3, 5, 10, 25, 60, -LONGEST, -LONGEST)
"""Cycles before an act; 0 lets several writes reach the layer together, less waits for the end of the command."""

MOST_ACTS: Final = 14
LONGEST_BURST: Final = 8
"""Commands that change in every cycle, and set values of a buffered job."""

FAULTS: Final = 5
DURATION: Final = "GVL_SIMULATION.DriveFault[{}].rDuration"
DURATIONS: Final = (0.005, 0.02, 0.08)
"""Seconds that a drive is out of order: less than the layer waits for it, and longer."""


class Act(NamedTuple):
    """Wait, then write a symbol.

    Attributes:
        ticks: cycles to wait; if negative until the command has ended, but no longer than so many.
        symbol: its name, in which `{}` stands for the index of the axis.
        value: what is written.
    """

    ticks: int
    symbol: str
    value: Any


class Sequence(NamedTuple):
    """One client of one axis.

    Attributes:
        start: key of `STARTS`, the state from which the axis begins.
        place: position to which the axis is sent in that state, u.
        acts: in their order.
    """

    start: str
    place: float
    acts: list[Act]


class Phase(NamedTuple):
    """A part of the way to a state: what is written, the State that is awaited, and for how many cycles at most."""

    writes: tuple[tuple[str, Any], ...]
    state: int | None
    ticks: int


_DEFAULTS: Final = (
    *zip(NUMBERS, TYPICAL, strict=True),
    ("GVL_AXIS.Data[{}].iDirection", 1),
    ("GVL_AXIS.MotionOptions[{}].eBufferMode", 0),
    ("GVL_AXIS.MotionOptions[{}].rDistance", 10.0),
    ("GVL_AXIS.NcParameterIn[{}].ParameterNumber", 1004),
    ("GVL_AXIS.NcParameterIn[{}].rValue", 40_000.0),
    ("GVL_AXIS.HomeParameter[{}].stHomingParam.HomingMode", 0),
    ("GVL_AXIS.HomeParameter[{}].stHomingParam.Options.ReferenceMode", 0),
    (ENDS, 0),
    (FAULT, 0),
    (CTRL, words.NULL),
)
_IDLE: Final = (
    Phase(_DEFAULTS, None, 1),
    Phase(((CTRL, words.AXIS_INIT),), words.AXIS_INIT + words.DONE, 40),
    Phase(((CTRL, words.IDLE),), words.IDLE + words.DONE, 200),
)
_REST: Final = (*_IDLE, Phase(((CTRL, words.STOP),), words.STOP + words.DONE, 200))
_RUN: Final = (*_IDLE, Phase(((CTRL, words.MOVE_VELO),), words.MOVE_VELO + words.DONE, 200))

STARTS: Final[dict[str, tuple[Phase, ...]]] = {
    "not initialised": (*_IDLE, Phase(((CTRL, words.AXIS_INIT),), None, 2)),
    "Disabled": (*_REST, Phase(((CTRL, words.DISABLE),), words.DISABLE + words.DONE, 200)),
    "StandStill": _REST,
    "ErrorStop": (*_RUN, Phase(((FAULT, 1),), None, 5)),
    "Stopping": (*_RUN, Phase(((CTRL, words.STOP),), None, 4)),
    "Homing": (*_REST, Phase(((CTRL, words.HOME),), None, 6)),
    "DiscreteMotion": (*_REST, Phase(((CTRL, words.MOVE_POS),), None, 10)),
    "ContinuousMotion": _RUN,
}
"""How each state of an axis is reached."""


def sequence(rng: np.random.Generator) -> Sequence:
    """Return a random client."""
    acts: list[Act] = []
    for _ in range(rng.integers(2, MOST_ACTS + 1)):
        kind = rng.random()
        acts += next((make(rng) for share, make in GROUPS if kind < share), []) or [_act(rng)]
    return Sequence(str(rng.choice(list(STARTS))), float(rng.uniform(-REACH, REACH)), acts)


def _burst(rng: np.random.Generator) -> list[Act]:
    return [Act(1, CTRL, _one(rng, COMMANDS)) for _ in range(rng.integers(2, LONGEST_BURST + 1))]


def _buffered(rng: np.random.Generator) -> list[Act]:
    """Return a buffered job that is fed with set values and ended."""
    feeding = [Act(int(rng.integers(0, 60)), *_number(rng)) for _ in range(rng.integers(1, LONGEST_BURST + 1))]
    begin = [Act(1, ENDS, 0), Act(0, CTRL, _one(rng, words.ENDLESS))]
    return [*begin, *feeding, Act(5, ENDS, words.DONE), Act(5, ENDS, 0)]


def _faulty(rng: np.random.Generator) -> list[Act]:
    """Return a drive that fails, and a command that is given meanwhile."""
    fails = [Act(1, FAULT, 0), Act(0, DURATION, float(rng.choice(DURATIONS))), Act(1, FAULT, _one(rng, (1, 3, 4, 5)))]
    return [*fails, Act(int(rng.integers(0, 10)), CTRL, _one(rng, words.SWITCHING)), Act(-LONGEST, CTRL, words.NULL)]


GROUPS: Final = ((0.04, _burst), (0.1, _buffered), (0.14, _faulty))
"""Acts that belong together, with the share of those up to them."""


def _act(rng: np.random.Generator) -> Act:
    symbol, value = _write(rng)
    return Act(_one(rng, WAITS), symbol, value)


def _write(rng: np.random.Generator) -> tuple[str, Any]:
    """Return what is written: a command in half of all cases."""
    kind = rng.random()
    if kind < 0.5:
        return CTRL, _one(rng, COMMANDS)
    if kind < 0.75:
        return _number(rng)
    if kind < 0.9:
        symbol = list(CHOICES)[int(rng.integers(len(CHOICES)))]
        return symbol, _one(rng, CHOICES[symbol])
    if kind < 0.96:
        return FLAGS[int(rng.integers(len(FLAGS)))], bool(rng.random() < 0.5)
    return FAULT, int(rng.integers(0, FAULTS + 1))


def _number(rng: np.random.Generator) -> tuple[str, float]:
    """Return a real number to be written: one that makes sense, in most cases."""
    if rng.random() < 0.2:
        symbol = ("GVL_AXIS.MotionOptions[{}].rDistance", "GVL_AXIS.NcParameterIn[{}].rValue")[int(rng.integers(2))]
        return symbol, float(rng.choice(NO_NUMBERS) if rng.random() < 0.1 else rng.uniform(-10.0, 100.0))
    place = int(rng.choice(len(NUMBERS), p=(0.4, 0.25, 0.15, 0.08, 0.08, 0.04)))
    symbol, typical, odd = NUMBERS[place], TYPICAL[place], rng.random()
    if odd < 0.08:
        return symbol, float(rng.choice(NO_NUMBERS))
    if odd < 0.16:
        return symbol, float(rng.choice((0.0, -typical, 1e9, 1e-9, 5e-324, -1e300)))
    return symbol, float(rng.uniform(-REACH, REACH) if place == 0 else rng.uniform(0.1, 1.0) * typical)


def selector(rng: np.random.Generator, axes: int, count: int) -> list[Act]:
    """Return what clients of the parameter selector do; indices reach from 0 to one behind the last axis."""
    acts = []
    for _ in range(count):
        name, value = (
            ("Control.eCmd", _one(rng, (0, 40, 40, 41, 41, 42, 12, 99))),
            ("Selector", _one(rng, (0, 0, 1, 1, 2))),
            ("Axis", int(rng.integers(0, axes + 2))),
            ("Data.ParameterNumber", _one(rng, (1004, 1005, 1, -5))),
            ("Data.rValue", float(rng.choice((math.nan, 30_000.0, 40_000.0)))),
        )[int(rng.choice(5, p=(0.5, 0.1, 0.2, 0.1, 0.1)))]
        acts.append(Act(abs(_one(rng, WAITS)), f"GVL_AXIS.SelectorCtrl.{name}", value))
    return acts


def _one(rng: np.random.Generator, among: tuple[int, ...]) -> int:
    return among[int(rng.integers(len(among)))]
