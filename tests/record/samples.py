"""Traces for the tests: small and arbitrary ones, and a gantry that picks and places."""

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motionlayer.event import Event, Input, Kind, Level
from motionlayer.record import Gap, Plan, Trace, TraceWriter

Floats = NDArray[np.float64]

STATE_STANDSTILL = 2.0
STATE_DISCRETE = 6.0


def header(names: list[str], resolution: float = 0.0, **other: Any) -> dict[str, Any]:
    signals = [{"name": name, "unit": "mm", "resolution": resolution} for name in names]
    return {
        "format": 1,
        "product": "motionlayer test",
        "base_cycle_ns": 1_000_000,
        "signals": signals,
        **other,
    }


def plan(axis: str = "X", tick: int = 0, command: int = 1, pieces: Floats | None = None) -> Plan:
    return Plan(
        axis=axis,
        tick=tick,
        offset=0.00025,
        command=command,
        kind="stop" if command == 0 else "position",
        target=np.nan if command == 0 else 12.5,
        velocity=1000.0,
        acceleration=1e4,
        deceleration=np.inf,
        jerk=1e6,
        pieces=np.zeros((1, 5)) if pieces is None else pieces,
    )


def event(tick: int = 0, text: str = "start ✓\nline \ud800", command: int = 1) -> Event:
    return Event(tick, Level.WARNING, Kind.ACCEPTED, "X", text, 0x4B, command)


def received(tick: int = 0, payload: bytes = b"\x00PLAN\xff") -> Input:
    return Input(tick, "late ✓", payload)


def write(block: Floats, names: list[str], target: Any = None, resolution: float = 0.0, size: int = 7) -> TraceWriter:
    """Write a small trace with a gap, an input, a plan and an event in front of every block."""
    writer = TraceWriter(target, header(names, resolution))
    for first in range(0, len(block), size):
        writer.gap(Gap(first, 0, 2))
        writer.input(received(first))
        writer.plan(plan(tick=first, pieces=np.full((2, 5), first + 0.1)))
        writer.event(event(first))
        writer.rows(first, block[first : first + size])
    writer.close(len(block), "ab" * 16)
    return writer


def gantry(points: int = 40, *, dt: float = 0.001) -> Trace:
    """Return a gantry X, Y, Z that visits random places with smooth moves; Z dips at each."""
    rng = np.random.default_rng(7)
    places = rng.choice([[90.0, 80.0], [180.0, 80.0], [620.0, 300.0], [700.0, 380.0], [500.0, 120.0]], points)
    columns: dict[str, list[Floats]] = {name: [] for axis in "XYZ" for name in _names(axis)}
    plans: list[Plan] = []
    for number, (start, end) in enumerate(pairwise(places), 1):
        for axis, path in zip("XYZ", ((start[0], end[0]), (start[1], end[1]), (60.0, 60.0)), strict=True):
            tick = sum(len(part) for part in columns["X.set_position"])
            plans.append(plan(axis, tick if axis == "X" else plans[-1].tick, number))
            _move(columns, axis, path, dt)
    names = list(columns)
    block = np.array([np.concatenate(columns[name]) for name in names]).T
    limits = {
        "max_velocity": 2000.0,
        "max_acceleration": 12000.0,
        "max_deceleration": 15000.0,
        "max_jerk": 400000.0,
    }
    machine = {"name": "gantry", "axis": {axis: {"unit": "mm", **limits} for axis in "XYZ"}}
    writer = TraceWriter(None, header(names, machine=machine))
    for each in plans:
        writer.plan(each)
    writer.rows(0, block)
    writer.close(len(block), "5f" * 16)
    return Trace.from_chunks(writer.chunks)


def _names(axis: str) -> list[str]:
    kinds = "set_position set_velocity set_acceleration set_jerk actual_position max_velocity max_acceleration"
    return [f"{axis}.{kind}" for kind in (*kinds.split(), "max_deceleration", "max_jerk", "state")]


def _move(columns: dict[str, list[Floats]], axis: str, path: tuple[float, float], dt: float) -> None:
    """Append a fifth-order polynomial move of 0.4 s (Z: down and up afterwards), then rest."""
    way, rest = 400, 260
    s = np.concatenate([np.arange(1, way + 1) / way, np.ones(rest)])
    blend = s**3 * (10 - 15 * s + 6 * s * s)
    p = path[0] + (path[1] - path[0]) * blend
    if axis == "Z":
        dip = np.clip((np.arange(way + rest) - way) / rest, 0.0, 1.0)
        p = 60.0 - 55.0 * np.sin(np.pi * dip) ** 4
    v = np.gradient(p, dt)
    a = np.gradient(v, dt)
    moving = np.where(np.abs(v) > 1e-9, STATE_DISCRETE, STATE_STANDSTILL)
    lag = np.concatenate([np.full(4, p[0]), p[:-4]])
    limits = [np.full(len(p), limit) for limit in (2000.0, 12000.0, 15000.0, 400000.0)]
    for name, values in zip(_names(axis), (p, v, a, np.gradient(a, dt), lag, *limits, moving), strict=True):
        columns[name].append(values)
