"""The campaign `mutation`: what was damaged in a valid trace is found."""

from typing import Final

import numpy as np

from motionlayer.bench.campaign._campaign import Campaign, Failure, judged, stream
from motionlayer.bench.campaign._damage import OPERATORS as RECORDS
from motionlayer.bench.campaign._damage import Damage, sample
from motionlayer.bench.campaign._damage_asked import FOLLOWING
from motionlayer.bench.campaign._life import life, live
from motionlayer.record import Trace
from motionlayer.verify import verify

BATCH: Final = 50
"""Mutations of one trace."""

STREAM: Final = 3

OPERATORS: Final = {**RECORDS, **FOLLOWING}


def mutation(seed: int, case: int, trace: Trace) -> Damage:
    """Return what a case does to a trace."""
    rng = stream(seed, case, STREAM)
    weights = np.array(list(OPERATORS.values()), dtype=float)
    operator = list(OPERATORS)[int(rng.choice(len(OPERATORS), p=weights / weights.sum()))]
    return operator(rng, trace) or sample(rng, trace)


def missed(damage: Damage) -> list[str]:
    """Return what is wrong if `verify` does not find the damage."""
    for finding in verify(damage.trace).findings:
        if finding.axis == damage.axis and damage.tick in (None, finding.tick):
            return []
    return [f"not found: {damage.text}"]


def run(seed: int, cases: range) -> list[Failure]:
    """Damage one trace again and again."""
    base = cases.start // BATCH
    trace, _ = live(life(seed, base))
    report = verify(trace)
    if not report.ok:
        return [Failure(cases.start, f"the trace itself (NAME=life CASE={base}) is not valid: {report}")]
    return judged(lambda seed, case: missed(mutation(seed, case, trace)), seed, cases)


def describe(seed: int, case: int) -> str:
    """Return what a case changes, and in which trace."""
    base = case // BATCH
    text = mutation(seed, case, live(life(seed, base))[0]).text
    return f"{text}; in the trace of NAME=life SEED={seed} CASE={base}"


MUTATION: Final = Campaign("mutation", "mutations", 1, BATCH, 100_000, run, describe)
