"""The time-optimal motion to rest as a linear program. Runs with the interpreter of the peers, on scipy.

Time is cut into equal steps of constant jerk, so that acceleration is linear and velocity quadratic in a step; both at
the ends of the steps are the variables. Which limit holds for an acceleration depends on the sign of the velocity,
which is given: a phase in the direction of the target, and one before it where the start moves the other way. For a
duration the program finds how far the motion can come; the shortest duration is where that is the distance.

Reads `{"cases": [...], "steps": n}` as JSON from stdin; prints the shortest duration of every case. Everything is in
units of the limits' V, A and V/A, and the target lies in positive direction.
"""

import importlib
import json
import sys
from typing import Any

import numpy as np

linprog = importlib.import_module("scipy.optimize").linprog
sparse = importlib.import_module("scipy.sparse")

CLOSE = 2e-5
"""Relative precision of the duration; what the steps leave is a few times that."""

MOST_TRIES = 12
GOLDEN = 0.6180339887498949
SEARCHES = 8
"""Halvings, almost, of the bracket of the reversal's moment."""

Phases = list[tuple[float, float]]
"""Durations and directions."""


def farthest(case: dict[str, float], phases: Phases, steps: int) -> float:
    """Return the greatest displacement at rest after all phases; -inf if there is no motion that takes so long."""
    dec, jerk = case["deceleration"], case["jerk"]
    counts = [steps // len(phases)] * len(phases)
    h = np.concatenate([np.full(n, length / n) for n, (length, _) in zip(counts, phases, strict=True)])
    ahead = np.concatenate([np.full(n, sign) for n, (_, sign) in zip(counts, phases, strict=True)]) > 0.0
    reach_a = np.where(ahead, [[-dec], [1.0]], [[-1.0], [dec]]).T
    reach_v = np.where(ahead, [[0.0], [1.0]], [[-1.0], [0.0]]).T
    if len(phases) > 1:  # the reversal: v = 0 with no more than both limits
        reach_a[counts[0] - 1] = [-min(1.0, dec), min(1.0, dec)]
        reach_v[counts[0] - 1] = 0.0
    reach_a[-1] = reach_v[-1] = 0.0
    jerks, most = _jerks(h, case["a"], jerk)
    speeds, reached = _speeds(h, case["v"], case["a"])
    # p grows by h v + h² a/3 + h² a'/6 in a step from (v, a) to (v', a')
    weights = np.concatenate([h * h / 6 + np.append(h[1:] * h[1:] / 3, 0.0), np.append(h[1:], 0.0)])
    answer = linprog(
        -weights, A_ub=jerks, b_ub=most, A_eq=speeds, b_eq=reached, bounds=np.vstack([reach_a, reach_v]), method="highs"
    )
    if answer.status != 0:
        return float("-inf")
    return float(h[0] * case["v"] + h[0] * h[0] / 3 * case["a"] - answer.fun)


def _band(diagonal: Any, below: Any) -> Any:  # noqa: ANN401 - arrays of packages that are not installed where this is checked
    """Return a matrix with a diagonal and the one below it."""
    row = np.arange(len(diagonal))
    entries = np.append(diagonal, below), (np.append(row, row[1:]), np.append(row, row[:-1]))
    return sparse.coo_array(entries, shape=(len(row), len(row)))


def _jerks(h: Any, start: float, jerk: float) -> tuple[Any, Any]:  # noqa: ANN401 - as above
    """Return |a' - a| <= h J as rows and right side."""
    ones = np.ones(len(h))
    change, nothing = _band(ones, -ones[1:]), sparse.coo_array((len(h), len(h)))
    most = np.append(h * jerk, h * jerk)
    most[0] += start
    most[len(h)] -= start
    return sparse.vstack([sparse.hstack([change, nothing]), sparse.hstack([-change, nothing])]).tocsr(), most


def _speeds(h: Any, v: float, a: float) -> tuple[Any, Any]:  # noqa: ANN401 - as above
    """Return v' - v = h (a + a')/2 as rows and right side."""
    ones, reached = np.ones(len(h)), np.zeros(len(h))
    reached[0] = v + h[0] / 2 * a
    return sparse.hstack([_band(-h / 2, -h[1:] / 2), _band(ones, -ones[1:])]).tocsr(), reached


def _farthest_in(case: dict[str, float], duration: float, steps: int) -> float:
    """Return the greatest displacement in a duration; a start the other way chooses when it turns round."""
    turn = case["turn"]
    if turn == 0.0:
        return farthest(case, [(duration, 1.0)], steps)
    low, high = 0.7 * turn, min(1.3 * turn, 0.999 * duration)

    def gain(first: float) -> float:
        return farthest(case, [(first, -1.0), (duration - first, 1.0)], steps)

    inner, outer = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_inner, at_outer, best = gain(inner), gain(outer), gain(turn)
    for _ in range(SEARCHES):
        if at_inner > at_outer:
            high, outer, at_outer = outer, inner, at_inner
            inner = high - GOLDEN * (high - low)
            at_inner = gain(inner)
        else:
            low, inner, at_inner = inner, outer, at_outer
            outer = low + GOLDEN * (high - low)
            at_outer = gain(outer)
        best = max(best, at_inner, at_outer)
    return best


def shortest(case: dict[str, float], steps: int) -> float:
    """Return the shortest duration, by regula falsi with halving (Illinois) from a bracket around `guess`."""
    low, high = 0.97 * case["guess"], 1.001 * case["guess"]
    at_low, at_high = (_farthest_in(case, time, steps) - case["distance"] for time in (low, high))
    while at_high < 0.0:
        low, at_low, high = high, at_high, 1.003 * high
        at_high = _farthest_in(case, high, steps) - case["distance"]
    while at_low > 0.0:
        high, at_high, low = low, at_low, 0.9 * low
        at_low = _farthest_in(case, low, steps) - case["distance"]
    for _ in range(MOST_TRIES):
        if high - low <= CLOSE * high:
            break
        time = (low * at_high - high * at_low) / (at_high - at_low) if np.isfinite(at_low) else (low + high) / 2
        time = min(max(time, low + 0.3 * CLOSE * high), high - 0.3 * CLOSE * high)
        value = _farthest_in(case, time, steps) - case["distance"]
        if value >= 0.0:
            high, at_high, at_low = time, value, at_low / 2
        else:
            low, at_low, at_high = time, value, at_high / 2
    return high


def main() -> None:
    """Solve all cases."""
    work = json.load(sys.stdin)
    json.dump([shortest(case, work["steps"]) for case in work["cases"]], sys.stdout)


if __name__ == "__main__":
    main()
