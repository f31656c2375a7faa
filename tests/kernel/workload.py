"""A fixed workload of planning and sampling; prints a hash of every byte it makes."""

import hashlib
import random

import numpy as np

from motionlayer.profile import MAX_PIECES, Limits, Profile, plan_position, plan_stop, plan_velocity
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
    kind = source.randrange(3)
    if kind == 0:
        return plan_position(p, v, a, source.uniform(-1e3, 1e3), bounds)
    if kind == 1:
        return plan_velocity(p, v, a, bounds.velocity * source.uniform(-1.0, 1.0), bounds)
    return plan_stop(p, v, a, bounds)


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
    print(digest.hexdigest())


if __name__ == "__main__":
    main()
