"""The campaign `mutation`: one changed sample of a valid trace is found, at its tick."""

from typing import Final, NamedTuple

import numpy as np

from motionlayer.bench.campaign._campaign import Campaign, Failure, judged, stream
from motionlayer.bench.campaign._life import life, live
from motionlayer.record import Trace
from motionlayer.verify import tolerance, verify

SIGNALS: Final = (
    "set_position", "set_velocity", "set_acceleration", "set_jerk", "actual_position", "max_velocity",
    "max_acceleration", "max_deceleration", "max_jerk", "software_limit_min", "software_limit_max",
)  # fmt: skip

BATCH: Final = 50
"""Mutations of one trace."""

LEAST, MOST = 1.0, 6.0
"""Decades of the change, in tolerances of the sample; 10 itself is not promised."""

STREAM: Final = 3


class Mutation(NamedTuple):
    """A sample, and the change to it in its tolerances."""

    signal: str
    row: int
    factor: float


def mutation(seed: int, case: int, trace: Trace) -> Mutation:
    """Return what a case does to a trace."""
    rng = stream(seed, case, STREAM)
    candidates = [name for name in trace if _judged(trace, name)]
    edge = rng.random() < 0.1
    row = (0, len(trace.ticks) - 1)[rng.integers(0, 2)] if edge else int(rng.integers(0, len(trace.ticks)))
    factor = 1.001 * 10.0 ** rng.uniform(LEAST, MOST)
    return Mutation(str(rng.choice(candidates)), row, float(factor * rng.choice([-1.0, 1.0])))


def _judged(trace: Trace, name: str) -> bool:
    """Tell whether a signal has a tolerance: a drive that lags has its own actual position, no limit has no edge."""
    axis, _, signal = name.rpartition(".")
    if signal == "actual_position" and trace.header["machine"]["axis"][axis]["drive"]["kind"] != "ideal":
        return False
    return signal in SIGNALS and bool(np.isfinite(trace[name]).all())


def missed(trace: Trace, change: Mutation) -> list[str]:
    """Return what is wrong if `verify` does not find the change at its row."""
    name, row, factor = change
    values = trace[name].copy()
    values[row] += factor * tolerance(trace, name)[row]
    axis, tick = name.rpartition(".")[0], int(trace.ticks[row])
    if any((finding.axis, finding.tick) == (axis, tick) for finding in verify(trace.replace({name: values})).findings):
        return []
    return [f"not found: {change} from {trace[name][row]!r} to {values[row]!r}"]


def run(seed: int, cases: range) -> list[Failure]:
    """Change samples of one trace, one by one."""
    base = cases.start // BATCH
    trace, _ = live(life(seed, base))
    report = verify(trace)
    if not report.ok:
        return [Failure(cases.start, f"the trace itself (NAME=life CASE={base}) is not valid: {report}")]
    return judged(lambda seed, case: missed(trace, mutation(seed, case, trace)), seed, cases)


def describe(seed: int, case: int) -> str:
    """Return what a case changes, and in which trace."""
    base = case // BATCH
    return f"{mutation(seed, case, live(life(seed, base))[0])} in the trace of NAME=life SEED={seed} CASE={base}"


MUTATION: Final = Campaign("mutation", "mutations", 1, BATCH, 100_000, run, describe)
