"""What the campaign `blocks` draws from: inputs and options of blocks, and the machines they are called on."""

import math
import random
from typing import Any, Final

from motionlayer import fb
from motionlayer.machine import Machine
from motionlayer.nc import BufferMode, Calibration, Direction

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
    "MC_Home": {"Position": POSITIONS, "HomingMode": (*[Calibration.DEFAULT] * 5, *Calibration)},
    "MC_SetPosition": {"Position": POSITIONS, "Mode": (False, True)},
}
"""Good values of the Execute blocks; more of a block's inputs keep their defaults."""

EAGER: Final = {"MC_Reset": 10.0, "MC_Stop": 0.2}
"""How much more often than others a block is started."""

EAGER_AT_REST: Final = {"MC_Home": 40.0, "MC_SetPosition": 10.0}
"""The same in StandStill, of those that are mostly refused elsewhere."""

SEARCHES: Final = (Direction.UNDEFINED, Direction.UNDEFINED, Direction.NEGATIVE, Direction.POSITIVE)
NO_YES: Final = (False, True)

OPTIONS: Final[dict[type, dict[str, tuple[Any, ...]]]] = {
    fb.ST_MoveOptions: {
        "EnableBlendingPosition": NO_YES,
        "BlendingPosition": POSITIONS,
        "IgnorePositionMonitoring": NO_YES,
        "EnableStopPositionMonitoring": NO_YES,
    },
    fb.ST_HomingOptions: {
        "ClearPositionLag": NO_YES,
        "SearchDirection": SEARCHES,
        "SearchVelocity": (0.0, 0.0, *VELOCITIES),
        "SyncDirection": SEARCHES,
        "SyncVelocity": (0.0, 0.0, *VELOCITIES),
        "ReferenceMode": tuple(fb.E_EncoderReferenceMode),
    },
    fb.ST_SetPositionOptions: {
        "ClearPositionLag": NO_YES,
        "SelectEncoderIndex": NO_YES,
        "EncoderIndex": (0, 0, 0, 1),
        "ClearPositionOffset": NO_YES,
    },
}
"""Good values of the options; one encoder is that there is not."""

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

CAM: Final = {
    "mode": "cam",
    "switch": -20.0,
    "switch_width": 60.0,
    "velocity": 200.0,
    "sync_velocity": 60.0,
    "travel": 200.0,
}
SIGNALS: Final = CAM | {"pulse_period": 7.0, "turn": 11.0, "latch": -10.0, "latch_width": 2.0}

HOMES: Final[tuple[dict[str, Any], ...]] = (
    {},
    CAM,
    CAM | {"mode": "switch", "direction": "positive", "switch": 60.0},
    SIGNALS,
    SIGNALS | {"mode": "index", "pulse_distance": 0.5, "switch_width": 3.0},
    SIGNALS | {"mode": "latch_negative", "sync_direction": "negative", "latch": -90.0},
    SIGNALS | {"mode": "soft_latch_positive", "latch_width": 0.1},
)
"""References near the places where the axes are, so that searches come to their ends within a case."""


def value(draw: random.Random, good: tuple[Any, ...]) -> Any:  # noqa: ANN401 - of the type of the input
    """Return a good value mostly; for the others, numbers that no input takes or members that do not exist."""
    if draw.random() > 0.08:
        return draw.choice(good)
    return 77 if isinstance(good[0], int) else draw.choice(BAD)


def options(draw: random.Random, kind: type) -> Any:  # noqa: ANN401 - of that kind
    """Return options of a block: the defaults mostly, else with about half of the fields drawn."""
    made = kind()
    if draw.random() < 0.4:
        for name, good in OPTIONS[kind].items():
            if draw.random() < 0.5:
                setattr(made, name, draw.choice(good) if good is NO_YES else value(draw, good))
    return made


def machine(draw: random.Random, axes: str) -> Machine:
    """Return a machine of equal servo axes with one of three sets of monitors and one of the ways to home."""
    monitors: tuple[dict[str, Any], ...] = (
        {},
        {"lag": 40.0, "lag_time": 0.01, "target_window": 1.0, "target_time": 0.005, "target_timeout": 0.5},
        {"range_window": 2.0, "software_limits": True, "lag": 60.0},
    )
    axis = AXIS | {"monitor": draw.choice(monitors), "home": draw.choice(HOMES)}
    return Machine.from_dict({"format": 1, "name": "blocks", "axis": dict.fromkeys(axes, axis)})
