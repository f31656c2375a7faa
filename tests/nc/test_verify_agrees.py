"""Ordinary programs whose traces `verify` must find valid; and that it holds plans to what the planner promises."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from motionlayer import profile
from motionlayer.command import ErrorId
from motionlayer.profile._check import FINE, JUMP, check_way
from motionlayer.record import Plan
from motionlayer.verify import TOLERANCES, assert_valid, verify
from tests.machines import finish, one_axis, play, ready
from tests.verify.bench import changed


def test_a_move_and_then_a_homing() -> None:
    run, x = ready()

    async def program() -> None:
        await x.move_absolute(10.0)
        await x.home()

    play(run, program)
    run.step(2)
    assert_valid(run.trace)


def test_a_move_in_the_tick_in_which_the_drive_becomes_ready() -> None:
    run, x = one_axis()

    async def program() -> None:
        x.enable()
        await run.until(lambda: x.enabled)
        await x.move_absolute(10.0)

    play(run, program)
    run.step(2)
    assert_valid(run.trace)


def test_an_error_in_the_tick_of_a_homing() -> None:
    run, x = ready()
    x.home(5.0)
    x.fault(ErrorId.INTERNAL)
    run.step(2)
    assert_valid(run.trace)


def test_a_homing_and_then_a_move() -> None:
    run, x = ready()

    async def program() -> None:
        await x.home(5.0)
        await x.move_absolute(10.0)

    play(run, program)
    run.step(2)
    assert_valid(run.trace)


def test_a_run_that_ends_in_the_tick_of_a_command() -> None:
    run, x = ready()

    async def program() -> None:
        await x.move_absolute(10.0)
        x.move_absolute(20.0)

    play(run, program)
    assert_valid(run.trace)


def sizes(plan: Plan) -> tuple[float, float, float]:
    """Return the path of a plan that only goes forwards and has its extremes at joints, its largest |v| and |a|."""
    t, _, v, a, _ = plan.pieces.T
    fastest = np.maximum(np.abs(v[:-1]), np.abs(v[1:]))
    return float((fastest * np.diff(t)).sum()), float(np.abs(v).max()), float(np.abs(a).max())


def missed(plan: Plan, row: int, quantity: int, off: float) -> NDArray[np.float64]:
    """Return the pieces of a plan in which one joint misses; all others fit again."""
    pieces = np.array(plan.pieces)
    pieces[row, 1 + quantity] += off
    for one in range(row, len(pieces) - 1):
        t, p, v, a, j = pieces[one]
        s = pieces[one + 1, 0] - t
        pieces[one + 1, 1:4] = p + s * (v + s * (a / 2 + s * j / 6)), v + s * (a + s * j / 2), a + s * j
    return pieces


@pytest.mark.parametrize("start", [0.0, -90.0])
@pytest.mark.parametrize("quantity", [0, 1, 2], ids=["position", "velocity", "acceleration"])
@pytest.mark.parametrize(("share", "kept"), [(-0.97, True), (-1.03, False)])
def test_a_joint_is_held_to_the_same_promise_by_the_planner_and_by_verify(
    start: float, quantity: int, share: float, kept: bool
) -> None:
    run, x = ready(start_position=start)
    finish(run, x.move_absolute(start + 200.0))
    run.step(2)
    trace = run.trace
    moved = trace.plans[-1]
    off = share * profile.TOLERANCES[quantity] * sizes(moved)[quantity]
    pieces = missed(moved, 3, quantity, off)
    limits = moved.velocity, moved.acceleration, moved.deceleration, moved.jerk
    assert check_way(pieces, len(pieces), *limits) == (FINE if kept else JUMP)
    plans = (*trace.plans[:-1], replace(moved, pieces=pieces))
    found = {finding.rule for finding in verify(changed(trace, plans=plans)).findings}
    assert ("piece continuity" not in found) is kept


def test_both_publish_the_same_numbers() -> None:
    promised = profile.TOLERANCES
    assert promised.position == promised.velocity == promised.acceleration == TOLERANCES["continuity"].relative
    assert promised.rounding == pytest.approx(TOLERANCES["handover"].relative, rel=0.02)
