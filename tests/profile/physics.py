"""The physics of a profile, evaluated densely in extended precision: shares nothing with the planner or its check."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer.profile import TOLERANCES, Limits, Profile

Wide = NDArray[np.longdouble]

STEPS: Final = 17
UNDERFLOW: Final = 1e-290
SLACK: Final = 1.0 + 2.0 * TOLERANCES.acceleration


def curve(pieces: NDArray[np.float64], extra: float = 0.0) -> tuple[Wide, Wide, Wide, Wide]:
    """Return (t, p, v, a) on a grid inside every piece, its turning points among it; the last one lasts `extra`."""
    rows = pieces.astype(np.longdouble)
    ends = np.append(rows[1:, 0], rows[-1, 0] + np.longdouble(extra))
    parts = []
    for (t, p, v, a, j), end in zip(rows, ends, strict=True):
        s = np.union1d(np.linspace(0.0, 1.0, STEPS, dtype=np.longdouble) * (end - t), turns(v, a, j, end - t))
        parts.append((t + s, p + s * (v + s * (a / 2 + s * j / 6)), v + s * (a + s * j / 2), a + s * j))
    t, p, v, a = (np.concatenate(column) for column in zip(*parts, strict=True))
    return t, p, v, a


def turns(v: np.longdouble, a: np.longdouble, j: np.longdouble, duration: np.longdouble) -> Wide:
    """Return the times inside a piece at which v or a is zero."""
    found: list[np.longdouble] = []
    if j != 0:
        found.append(-a / j)
        under = a * a - 2 * j * v
        if under >= 0:
            # the stable half of each root
            q = -(a + np.copysign(np.sqrt(under), a))
            found.extend([q / j] + ([2 * v / q] if q != 0 else []))
    elif a != 0:
        found.append(-v / a)
    return np.array([s for s in found if 0 < s < duration], dtype=np.longdouble)


def assert_continuous(profile: Profile) -> None:
    """Assert that no quantity jumps by more than published, the blur of a late clock allowed for."""
    rows = profile.pieces.astype(np.longdouble)
    assert rows[0, 0] == 0
    steps = np.diff(rows[:, 0])
    assert (steps > 0).all()
    t, p, v, a, j = rows[:-1].T
    following = rows[1:]
    end_a = a + steps * j
    end_v = v + steps * (a + steps * j / 2)
    end_p = p + steps * (v + steps * (a / 2 + steps * j / 6))
    fastest, hardest = speeds(profile).max(), np.abs(rows[:, 3]).max()
    path = (steps * speeds(profile)[:-1]).sum()
    blur = TOLERANCES.clock * (t + steps)
    reach = TOLERANCES.position * path + TOLERANCES.rounding * np.maximum(np.abs(p), np.abs(end_p))
    allowed_a = TOLERANCES.acceleration * hardest + blur * np.abs(j) + UNDERFLOW
    allowed_v = TOLERANCES.velocity * fastest + blur * hardest + UNDERFLOW
    assert (np.abs(end_a - following[:, 3]) <= allowed_a * SLACK).all()  # on the edge floats and these round apart
    assert (np.abs(end_v - following[:, 2]) <= allowed_v * SLACK).all()
    assert (np.abs(end_p - following[:, 1]) <= (reach + blur * fastest + UNDERFLOW) * SLACK).all()


def speeds(profile: Profile) -> Wide:
    """Return the largest |v| of every piece; of the last one that at its start."""
    rows = profile.pieces.astype(np.longdouble)
    found = []
    for (t, _, v, a, j), end in zip(rows, np.append(rows[1:, 0], rows[-1, 0]), strict=True):
        s = np.append(turns(v, a, j, end - t), [0.0, end - t])
        found.append(np.abs(v + s * (a + s * j / 2)).max())
    return np.array(found)


def assert_within(profile: Profile, limits: Limits) -> None:
    """Assert every limit, each raised at most to what the start cannot avoid at full jerk."""
    assert (np.abs(profile.pieces[:, 4]) <= limits.jerk).all()
    t, _, v, a = curve(profile.pieces)
    v0, a0 = float(v[0]), float(a[0])
    unavoidable = max(abs(v0), abs(v0 + 0.5 * a0 * abs(a0) / limits.jerk))
    assert (np.abs(v) <= max(limits.velocity, unavoidable) * SLACK).all()
    calm = (np.abs(v) <= limits.velocity) & (np.abs(v + a * np.abs(a) / (2 * limits.jerk)) <= limits.velocity)
    if calm.any():
        assert (np.abs(v[int(np.argmax(calm)) :]) <= limits.velocity * SLACK).all()
    # Velocities within tolerance of zero belong to both sides; the crossing itself is judged below.
    still = np.abs(v) <= 2.0 * TOLERANCES.velocity * max(limits.velocity, unavoidable)
    grows = v * a > 0
    allowed = np.where(grows, limits.acceleration, limits.deceleration)
    allowed = np.where(still, max(limits.acceleration, limits.deceleration), allowed)
    left = abs(a0) - limits.jerk * t  # an acceleration outside is taken back at full jerk from the start
    most = max(limits.acceleration, limits.deceleration, abs(a0))
    blur = TOLERANCES.clock * t * limits.jerk + (SLACK - 1.0) * most
    assert (np.abs(a) <= np.maximum(allowed, left) + blur).all()
    crossing, when = reversals(profile)
    least = np.maximum(min(limits.acceleration, limits.deceleration), abs(a0) - limits.jerk * when)
    loose = (SLACK - 1.0) * most + TOLERANCES.clock * when * limits.jerk
    # a = root of 2 J dv near zero: a velocity known to its tolerance leaves that much acceleration
    loose = loose + np.sqrt(2 * limits.jerk * TOLERANCES.velocity * 1e-5 * limits.velocity)
    assert (crossing <= least + loose).all()


def reversals(profile: Profile) -> tuple[Wide, Wide]:
    """Return |a| and the time wherever the velocity changes its sign."""
    t, _, v, a = curve(profile.pieces)
    real = np.abs(v) > 1e-9 * np.abs(v).max()
    sign, index = np.sign(v[real]), np.flatnonzero(real)
    before, after = index[:-1][np.diff(sign) != 0], index[1:][np.diff(sign) != 0]
    found = [i + int(np.argmin(np.abs(v[i : k + 1]))) for i, k in zip(before, after, strict=True)]
    return np.abs(a[found]), t[found]


def assert_lawful(profile: Profile, start: tuple[float, float, float], limits: Limits) -> None:
    """Assert start state, continuity and limits."""
    assert_begins(profile, start, limits)
    assert_continuous(profile)
    assert_within(profile, limits)


def assert_begins(profile: Profile, start: tuple[float, float, float], limits: Limits) -> None:
    """Assert the start state: exact, but within tolerance where it is the end state too."""
    begin = profile.pieces[0, 1:4]
    if len(profile.pieces) > 1:
        assert tuple(begin.tolist()) == start
    else:
        reach = abs(start[0]) + abs(float(begin[0]))
        scale = np.array([reach, limits.velocity, max(limits.acceleration, limits.deceleration)])
        assert (np.abs(begin - start) <= TOLERANCES.position * scale).all()


def assert_rests_at(profile: Profile, target: float) -> None:
    assert profile.pieces[-1, 1:].tolist() == [target, 0.0, 0.0, 0.0]


def assert_runs_at(profile: Profile, velocity: float) -> None:
    assert profile.pieces[-1, 2:].tolist() == [velocity, 0.0, 0.0]
