"""A fixed workload of planning, sampling and encoding; prints a hash of every byte it makes."""

import hashlib
import random

import numpy as np

from motionlayer.profile import (
    MAX_PIECES,
    Limits,
    Moving,
    Profile,
    State,
    passable_velocity,
    plan_passing,
    plan_position,
    plan_rendezvous,
    plan_stop,
    plan_synchronise,
    plan_velocity,
)
from motionlayer.record import TraceWriter
from motionlayer.store import Store

PLANS = 150
TICKS = 400


def limits(source: random.Random) -> Limits:
    vel, acc, dec, jerk = (10.0 ** source.uniform(-2.0, 4.0) for _ in range(4))
    return Limits(vel, acc, dec, jerk)


def plan(source: random.Random) -> Profile:
    bounds = limits(source)
    p, v, a = source.uniform(-1e3, 1e3), bounds.velocity * source.gauss(0.0, 0.7), source.gauss(0.0, 1.0)
    if source.random() < 0.2:  # small integers: touching phases
        bounds = Limits(*(float(source.randint(1, 5)) for _ in range(4)))
        p, v, a = (float(source.randint(-4, 4)) for _ in range(3))
    target, u = source.uniform(-1e3, 1e3), bounds.velocity * source.uniform(-0.9, 0.9)
    match source.randrange(6):
        case 0:
            return plan_position(p, v, a, target, bounds)
        case 1:
            return plan_velocity(p, v, a, u, bounds)
        case 2:
            return plan_passing(p, v, a, target, u, bounds)
        case 3:
            return plan_passing(p, v, a, target, passable_velocity(p, v, a, target, u, bounds), bounds)
        case 4:
            return plan_synchronise(p, v, a, Moving(target, u), bounds)
    stop = plan_stop(p, v, a, bounds)
    rest = State(float(stop.pieces[-1, 1]), 0.0, 0.0)
    return plan_rendezvous(p, v, a, rest, bounds, at=stop.duration + 1.0)


def main() -> None:
    source = random.Random("kernels")
    digest = hashlib.sha256()
    profiles = [plan(source) for _ in range(PLANS)]
    for profile in profiles:
        digest.update(profile.pieces.tobytes() + np.array([profile.low, profile.high]).tobytes())
    store = Store(8, dt=0.001, max_pieces=MAX_PIECES, sums=[(0, 1), (8, 2)])
    for tick in range(1, TICKS + 1):
        if tick % 20 == 1:
            store.adopt(source.randrange(8), source.choice(profiles).pieces, offset=source.uniform(0.0, 0.001))
        digest.update(repr(store.sample(tick)).encode())
        digest.update(store.table.tobytes())
    for chunk in encode().chunks:
        digest.update(chunk)
    print(digest.hexdigest())


def encode() -> TraceWriter:
    """Write columns of every kind: constant, as they are, multiples of a resolution, and what is no multiple."""
    resolutions = [0.0, 0.0, 1e-3, 0.5, 1e-9, 1e-300]
    signals = [{"name": str(number), "unit": "mm", "resolution": each} for number, each in enumerate(resolutions)]
    writer = TraceWriter(None, {"base_cycle_ns": 1_000_000, "signals": signals})
    for first in range(0, 300, 60):
        block = np.random.default_rng(first).normal(scale=100.0, size=(60, len(signals)))
        block[:, 0] = np.nan
        block[::7, 3] = np.inf
        writer.rows(first, block)
    return writer


if __name__ == "__main__":
    main()
