"""A planner of its own: slow, exact, and not optimal where the start is in motion."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Phases = list[tuple[float, float]]


@dataclass(frozen=True)
class Limits:
    velocity: float
    acceleration: float
    deceleration: float
    jerk: float


def ramp(dv: float, acc: float, jerk: float) -> Phases:
    """Return (duration, jerk) of a change of the velocity by `dv`, from a = 0 to a = 0."""
    if dv == 0.0:
        return []
    sign, size = math.copysign(1.0, dv), abs(dv)
    if size <= acc * acc / jerk:
        t = math.sqrt(size / jerk)
        return [(t, sign * jerk), (t, -sign * jerk)]
    t = acc / jerk
    return [(t, sign * jerk), (size / acc - t, 0.0), (t, -sign * jerk)]


def change(v: float, target: float, limits: Limits) -> Phases:
    """Change the velocity; the deceleration limit counts down to 0, the acceleration limit up from there."""
    if v * target < 0.0:
        return [*change(v, 0.0, limits), *change(0.0, target, limits)]
    acc = limits.acceleration if abs(target) > abs(v) else limits.deceleration
    return ramp(target - v, acc, limits.jerk)


def _duration(phases: Phases) -> float:
    return sum(t for t, _ in phases)


def travel(distance: float, limits: Limits) -> Phases:
    """Return the phases of a way from rest to rest."""

    def ramps(peak: float) -> tuple[Phases, Phases, float]:
        up = ramp(peak, limits.acceleration, limits.jerk)
        down = ramp(-peak, limits.deceleration, limits.jerk)
        return up, down, peak * (_duration(up) + _duration(down)) / 2

    way, peak = abs(distance), limits.velocity
    if ramps(peak)[2] > way:
        low, high = 0.0, peak
        while low < (peak := (low + high) / 2) < high:
            low, high = (low, peak) if ramps(peak)[2] > way else (peak, high)
    up, down, used = ramps(peak)
    cruise = [((way - used) / peak, 0.0)] if way - used > 1e-9 * way else []
    sign = math.copysign(1.0, distance)
    return [(t, sign * j) for t, j in [*up, *cruise, *down]]


def roll(start: tuple[float, float, float], phases: Phases, time: float = 0.0) -> list[list[float]]:
    """Return the pieces of phases from p, v, a; the last one is where they end, without jerk."""
    p, v, a = start
    pieces = []
    for t, j in phases:
        if time + t > time:  # shorter than the rounding of its time, a phase is none
            pieces.append([time, p, v, a, j])
            p, v, a = p + t * (v + t * (a / 2 + t * j / 6)), v + t * (a + t * j / 2), a + t * j
            time += t
    return [*pieces, [time, p, v, a, 0.0]]


def relent(a: float, limits: Limits) -> Phases:
    """Bring the acceleration to zero with the full jerk."""
    return [(abs(a) / limits.jerk, -math.copysign(limits.jerk, a))]


def to_velocity(start: tuple[float, float, float], target: float, limits: Limits) -> Floats:
    """Plan to a velocity."""
    pieces = roll(start, relent(start[2], limits))
    time, p, v = pieces[-1][:3]
    pieces = pieces[:-1] + roll((p, v, 0.0), change(v, target, limits), time)
    pieces[-1][2:4] = target, 0.0
    return np.array(pieces)


def to_stop(start: tuple[float, float, float], limits: Limits) -> Floats:
    """Plan the shortest stop: with the brakes already on they are kept on."""
    p, v, a = start
    sign = math.copysign(1.0, v if v != 0.0 else a)
    speed, pull = sign * v, -sign * a
    jerk, most = limits.jerk, limits.deceleration
    if pull <= 0.0 or pull * pull > 2.0 * jerk * speed:
        return to_velocity(start, 0.0, limits)
    phases: Phases = []
    if pull > most:
        t = (pull - most) / jerk
        phases.append((t, sign * jerk))
        speed, pull = speed - t * (pull + most) / 2.0, most
    peak = min(most, math.sqrt(jerk * speed + pull * pull / 2.0))
    hold = (speed - (2.0 * peak * peak - pull * pull) / (2.0 * jerk)) / peak
    phases += [((peak - pull) / jerk, -sign * jerk), (max(hold, 0.0), 0.0), (peak / jerk, sign * jerk)]
    pieces = roll((p, v, a), phases)
    pieces[-1][2:4] = 0.0, 0.0
    return np.array(pieces)


def to_position(start: tuple[float, float, float], target: float, limits: Limits) -> Floats:
    """Plan to a position: from motion, by way of a stop."""
    pieces = to_velocity(start, 0.0, limits).tolist()
    time, p = pieces[-1][:2]
    pieces = pieces[:-1] + roll((p, 0.0, 0.0), travel(target - p, limits), time)
    pieces[-1][1:4] = target, 0.0, 0.0
    return np.array(pieces)
