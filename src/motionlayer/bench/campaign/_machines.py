"""Random machines: axes of any size in several units, with and without software limits, a reference, a servo."""

from typing import Any, Final

import numpy as np

UNITS: Final = {"mm": 1.0, "µm": 1e3, "m": 1e-3, "degree": 72.0}
"""Lengths of a millimetre."""

CYCLES: Final = (250_000, 1_000_000, 1_000_000, 2_000_000, 4_000_000)
"""Base cycles in nanoseconds."""

MOST_AXES: Final = 4
SERVOS: Final = 0.4
"""Share of the axes whose drive lags."""

FAULTS: Final = ("drive_error", "encoder_jump", "lost_enable", "lost_communication", "blocked")
MOST_FAULTS: Final = 2
"""Of a machine."""

REACH: Final = 0.3
"""Range of an axis, in seconds at its maximum velocity."""


def machine(rng: np.random.Generator, ticks: int) -> dict[str, Any]:
    """Return a machine description as data; its drives fail within some ticks."""
    count, cycle = int(rng.integers(1, MOST_AXES + 1)), int(rng.choice(CYCLES))
    axes = {f"A{number}": _axis(rng, cycle * 1e-9) for number in range(count)}
    servos = [name for name, axis in axes.items() if "drive" in axis]
    faults = [_fault(rng, axes, servos, ticks) for _ in range(rng.integers(0, MOST_FAULTS + 1)) if servos]
    return {"format": 1, "name": "campaign", "base_cycle_ns": cycle, "axis": axes, "fault": faults}


def _fault(rng: np.random.Generator, axes: dict[str, Any], servos: list[str], ticks: int) -> dict[str, Any]:
    """Return something that goes wrong with one of the servo drives, most often not for the whole run."""
    name, kind = str(rng.choice(servos)), str(rng.choice(FAULTS))
    fault: dict[str, Any] = {"axis": name, "kind": kind, "tick": int(rng.integers(0, ticks))}
    if kind == "encoder_jump":
        fault["value"] = axes[name]["max_velocity"] * 10.0 ** rng.uniform(-5.0, -1.0) * float(rng.choice([-1.0, 1.0]))
    elif rng.random() < 0.8:
        fault["duration"] = 10.0 ** rng.uniform(-3.0, -0.5)
    return fault


def _axis(rng: np.random.Generator, cycle: float) -> dict[str, Any]:
    unit = str(rng.choice(list(UNITS)))
    velocity = UNITS[unit] * 10.0 ** rng.uniform(1.0, 3.5)
    acceleration = velocity * 10.0 ** rng.uniform(0.5, 1.7)
    axis: dict[str, Any] = {
        "unit": unit,
        "max_velocity": velocity,
        "max_acceleration": acceleration,
        "max_deceleration": acceleration * 10.0 ** rng.uniform(-0.7, 0.7),
        "max_jerk": acceleration * 10.0 ** rng.uniform(0.7, 2.7),
        "velocity": velocity * rng.uniform(0.2, 1.0),
    }
    low, high = -REACH * velocity * rng.uniform(0.1, 1.0), REACH * velocity * rng.uniform(0.1, 1.0)
    if rng.random() < 0.6:
        axis["software_limit_min"] = low
    if rng.random() < 0.6:
        axis["software_limit_max"] = high
    axis["start_position"] = rng.uniform(1.2 * low, 1.2 * high)  # a few of them outside
    if rng.random() < 0.4:
        axis["home"] = _home(rng, low, high, velocity)
    step = velocity * 10.0 ** rng.uniform(-3.0, -1.0)
    axis["manual"] = {"forward": step, "backward": step * rng.uniform(0.5, 2.0)}
    axis["modulo"] = {"period": (high - low) * 10.0 ** rng.uniform(-1.0, 0.5), "tolerance": step}
    if rng.random() < SERVOS:
        axis["drive"] = _servo(rng, velocity, cycle)
        axis["monitor"] = _monitor(rng, velocity)
    return axis


def _servo(rng: np.random.Generator, velocity: float, cycle: float) -> dict[str, Any]:
    """Return a servo drive whose loop is well damped."""
    dead, slow = int(rng.integers(0, 4)) * cycle, float(rng.uniform(0.0, 3.0)) * cycle
    step = velocity * cycle
    drive = {
        "kind": "servo",
        "position_gain": float(rng.uniform(0.05, 0.2)) / (cycle + dead + slow),
        "velocity_feed_forward": float(rng.choice([0.0, 0.9, 1.0])),
        "dead_time": dead,
        "time_constant": slow,
    }
    for key, share in (("backlash", 1e-2), ("encoder_resolution", 1e-3), ("noise", 1e-3)):
        if rng.random() < 0.5:
            drive[key] = share * step
    return drive


def _monitor(rng: np.random.Generator, velocity: float) -> dict[str, Any]:
    """Return what is watched; a position lag of some cycles is usual without feed forward."""
    monitor: dict[str, Any] = {}
    if rng.random() < 0.5:
        monitor = {"lag": velocity * 10.0 ** rng.uniform(-2.5, -0.5), "lag_time": float(rng.choice([0.0, 0.01]))}
    if rng.random() < 0.5:
        monitor |= {"target_window": velocity * 10.0 ** rng.uniform(-4.0, -2.0), "target_time": 0.004}
    elif rng.random() < 0.3:
        monitor["range_window"] = velocity * 10.0 ** rng.uniform(-4.0, -2.0)
    return monitor


def _home(rng: np.random.Generator, low: float, high: float, velocity: float) -> dict[str, Any]:
    mode = str(rng.choice(["direct", "switch", "cam", "index"]))
    if mode == "direct":
        return {"mode": mode, "position": 0.0}
    search = velocity * rng.uniform(0.1, 0.5)
    home: dict[str, Any] = {
        "mode": mode,
        "switch": rng.uniform(low, high),
        "velocity": search,
        "direction": str(rng.choice(["negative", "positive"])),
    }
    if rng.random() < 0.5:
        home["sync_velocity"] = search * rng.uniform(0.1, 1.0)
    if rng.random() < 0.3:
        home["travel"] = (high - low) * rng.uniform(0.1, 2.0)
    if mode == "index":
        home["pulse_period"] = (high - low) * rng.uniform(0.01, 0.3)
        home["pulse"] = rng.uniform(low, high)
        home["pulse_distance"] = home["pulse_period"] * float(rng.choice([0.0, 0.0, 0.1]))
    return home
