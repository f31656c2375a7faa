"""The campaign `planning`: no random state may be refused or planned wrongly."""

import traceback
from typing import Final

from motionlayer.bench.campaign._campaign import Campaign, Failure
from motionlayer.bench.campaign._judge import faults
from motionlayer.bench.campaign._problems import BLOCK, Problem, problems
from motionlayer.profile import Profile


def run(seed: int, cases: range) -> list[Failure]:
    """Plan cases of one block and judge the profiles."""
    block = problems(seed, cases.start // BLOCK)
    failures, planned = [], []
    for case in cases:
        problem = block[case % BLOCK]
        try:
            planned.append((case, problem, problem.plan()))
        except Exception as error:  # noqa: BLE001 - a PlanError, or worse
            failures.append(Failure(case, _refused(problem, error)))
    return failures + _wrong(planned)


def _wrong(planned: list[tuple[int, Problem, Profile]]) -> list[Failure]:
    found = faults([problem for _, problem, _ in planned], [profile for _, _, profile in planned])
    return [Failure(planned[row][0], f"{rule}: {planned[row][1]}") for row, rule in sorted(found.items())]


def _refused(problem: Problem, error: Exception) -> str:
    return f"{traceback.format_exception_only(error)[-1].strip()}\n{problem}"


def describe(seed: int, case: int) -> str:
    """Return the call of a case."""
    return str(problems(seed, case // BLOCK)[case % BLOCK])


PLANNING: Final = Campaign("planning", "states", 1, BLOCK, 1_000_000, run, describe)
