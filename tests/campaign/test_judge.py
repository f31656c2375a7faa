"""The judge of profiles finds what is wrong with them."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from motionlayer.bench.campaign._judge import faults
from motionlayer.bench.campaign._problems import Problem
from motionlayer.profile import Limits, Profile

Floats = NDArray[np.float64]
MOVE = Problem("position", 10.0, 0.0, 0.0, 500.0, Limits(100.0, 400.0, 800.0, 10_000.0))
TURN = Problem("position", 0.0, -60.0, 0.0, 300.0, Limits(100.0, 400.0, 800.0, 10_000.0))
FAST = Problem("velocity", 0.0, 150.0, 0.0, 80.0, Limits(100.0, 400.0, 800.0, 10_000.0))
STOP = Problem("stop", 0.0, 90.0, 100.0, 0.0, Limits(100.0, 400.0, 800.0, 10_000.0))
PASS = MOVE._replace(kind="passing", velocity=60.0)
JOIN = MOVE._replace(kind="synchronise", velocity=60.0)
MEET = MOVE._replace(kind="rendezvous", velocity=60.0, pull=-300.0, at=9.0)


def changed(problem: Problem, change: Callable[[Floats], None]) -> str:
    """Return what is found in a plan of which a piece was changed."""
    profile = problem.plan()
    pieces = profile.pieces.copy()
    change(pieces)
    return faults([problem], [profile._replace(pieces=pieces)]).get(0, "")


def add(row: int, column: int, value: float) -> Callable[[Floats], None]:
    def change(pieces: Floats) -> None:
        pieces[row, column] += value

    return change


@pytest.mark.parametrize("problem", [MOVE, TURN, FAST, STOP, PASS, JOIN, MEET], ids=lambda problem: problem.kind)
def test_plans_are_fine(problem: Problem) -> None:
    assert faults([problem] * 2, [problem.plan()] * 2) == {}


@pytest.mark.parametrize(
    ("change", "found"),
    [
        (add(2, 1, 1e-5), "the position jumps"),
        (add(2, 2, 1e-6), "the velocity jumps"),
        (add(2, 3, 1e-5), "the acceleration jumps"),
        (add(1, 4, 1e-3), "the acceleration jumps"),
        (add(0, 4, 1.0), "the jerk limit is exceeded"),
        (add(2, 0, 10.0), "its pieces are not in order of time"),
        (add(-1, 1, 1e-9), "it does not end at its target"),
        (add(-1, 2, 1e-9), "it does not end at its velocity"),
        (add(-1, 3, 1e-9), "it does not end at its velocity"),
        (add(0, 1, 1e-9), "it does not begin at the start"),
        (add(0, 0, 1e-9), "it does not begin at the start"),
        (add(3, 2, np.nan), "pieces are missing, too many or not finite"),
    ],
)
def test_a_changed_piece_is_found(change: Callable[[Floats], None], found: str) -> None:
    assert changed(MOVE, change) == found


@pytest.mark.parametrize(
    ("problem", "column", "found"),
    [
        (PASS, 1, "it does not end at its target"),
        (PASS, 2, "it does not end at its velocity"),
        (JOIN, 0, "it does not end at its target"),
        (JOIN, 2, "it does not end at its velocity"),
        (MEET, 0, "it does not end at its time"),
        (MEET, 1, "it does not end at its target"),
        (MEET, 3, "it does not end at its velocity"),
        (MEET, 4, "it does not end at its velocity"),
    ],
)
def test_another_end_than_was_asked_for_is_found(problem: Problem, column: int, found: str) -> None:
    assert changed(problem, add(-1, column, 1e-9)) == found


@pytest.mark.parametrize(
    ("problem", "field", "factor", "found"),
    [
        (MOVE, "velocity", 0.999, "the velocity limit is exceeded"),
        (MOVE, "acceleration", 0.999, "the acceleration or deceleration limit is exceeded"),
        (MOVE, "deceleration", 0.999, "the acceleration or deceleration limit is exceeded"),
        (MOVE, "jerk", 0.999, "the jerk limit is exceeded"),
        (TURN, "acceleration", 0.999, "the acceleration or deceleration limit is exceeded"),
        (PASS, "velocity", 0.999, "the velocity limit is exceeded"),
        (JOIN, "jerk", 0.999, "the jerk limit is exceeded"),
        (MEET, "deceleration", 0.37, "the acceleration or deceleration limit is exceeded"),
        (STOP, "deceleration", 0.9, "the acceleration or deceleration limit is exceeded"),
    ],
)
def test_a_plan_of_wider_limits_is_found(problem: Problem, field: str, factor: float, found: str) -> None:
    tight = problem.limits._replace(**{field: factor * getattr(problem.limits, field)})
    assert faults([problem._replace(limits=tight)], [problem.plan()])[0] == found


def test_a_reversal_with_more_than_both_limits_is_found() -> None:
    """Braking is allowed 800 and acceleration 400: whoever passes v = 0 with 600 has broken the second one."""
    wide = TURN._replace(limits=TURN.limits._replace(acceleration=600.0))
    found = faults([TURN], [wide.plan()])[0]
    assert found in {"it passes v = 0 with more than both limits", "the acceleration or deceleration limit is exceeded"}


def test_lingering_above_the_limit_is_found() -> None:
    pieces = FAST.plan().pieces
    later = pieces.copy()
    later[:, 0] += 0.1
    later[:, 1] += 15.0
    slow = np.vstack([[0.0, 0.0, 150.0, 0.0, 0.0], later])
    assert faults([FAST], [Profile(slow, 0.0, 1e3)])[0] == "it lingers above the velocity limit"


def test_a_start_outside_may_not_go_further_out() -> None:
    limits = Limits(100.0, 400.0, 400.0, 4000.0)
    start = Problem("velocity", 0.0, 90.0, 400.0, 100.0, limits)  # cannot avoid 110
    assert faults([start], [start.plan()]) == {}
    held = start._replace(a=200.0)  # 95 would be enough; here the acceleration is held first
    pieces = np.array([[0.0, 0.0, 90.0, 200.0, 0.0], *start.plan().pieces.tolist()])
    pieces[1:, 0] += 0.05
    assert faults([held], [Profile(pieces, 0.0, 1e3)])


def test_a_small_extent_is_found() -> None:
    profile = TURN.plan()
    assert profile.low < -1.0
    assert faults([TURN], [profile._replace(low=profile.low / 2.0)])[0] == "its extent is too small"
