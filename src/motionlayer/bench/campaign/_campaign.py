"""`Campaign`: many random cases, each made from the seed and its number alone."""

import traceback
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np


class Failure(NamedTuple):
    """A case that went wrong.

    Attributes:
        case: its number.
        text: what is wrong, and the input, to be pasted.
    """

    case: int
    text: str


class Campaign(NamedTuple):
    """A kind of case, and how many of them make sense at once.

    Attributes:
        name: as commanded.
        unit: what is counted, in plural.
        size: how many of it a case holds.
        batch: cases that are made together; a case alone costs as much.
        full: count of a full campaign, in `unit`.
        run: given the seed and the numbers of cases of one batch, returns those that went wrong.
        describe: given the seed and a case, returns its input as text.
    """

    name: str
    unit: str
    size: int
    batch: int
    full: int
    run: Callable[[int, range], list[Failure]]
    describe: Callable[[int, int], str]


def stream(*key: int) -> np.random.Generator:
    """Return the random numbers that belong to a key: the seed, the number of a case or block, and what for."""
    return np.random.Generator(np.random.PCG64(key))


def judged(judge: Callable[[int, int], Sequence[str]], seed: int, cases: range) -> list[Failure]:
    """Judge cases one by one; an exception is a failure of its case as well."""
    failures = []
    for case in cases:
        try:
            faults = judge(seed, case)
        except Exception:  # noqa: BLE001 - whatever it is, the case has found it
            faults = [traceback.format_exc().rstrip()]
        if faults:
            failures.append(Failure(case, "\n".join(faults)))
    return failures
