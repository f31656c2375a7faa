"""Absolute, relative and endless moves, halt and stop: where they end, when, and what they report on the way."""

import math
from typing import Any

import numpy as np
import pytest

from motionlayer import AxisState
from motionlayer.command import ErrorId
from motionlayer.nc import Axis, AxisCommand, Direction
from tests.effort import thinned
from tests.machines import (
    PER_TICK,
    assert_smooth,
    error_of,
    finish,
    follow,
    full_move_time,
    play,
    ready,
    state_of,
)

PHASES = [1, 20, 60, 100, 200, 500, 650, 680, 720, 745]
"""Ticks into a move of 300: rise, constant, fall of the acceleration, cruise, the same while braking, last ticks."""


def test_a_full_move_takes_the_time_of_the_closed_form() -> None:
    run, x = ready()
    start = run.time
    move = x.move_absolute(300.0)
    ticks = finish(run, move)
    exact = full_move_time(300.0)
    assert move.end_time == pytest.approx(start + exact, rel=1e-12)
    assert ticks == math.ceil(exact / PER_TICK)
    assert x.set_position == 300.0
    assert (x.set_velocity, x.set_acceleration) == (0.0, 0.0)


@pytest.mark.parametrize("distance", [0.0, 1e-12, 1e-6, 0.01, 1.0, 30.0, 399.0, -1e-9, -80.0])
def test_every_distance_is_reached_exactly(distance: float) -> None:
    run, x = ready()
    move = x.move_absolute(distance)
    assert move.busy
    finish(run, move)
    assert x.set_position == distance
    assert move.end_time is not None
    assert run.time - PER_TICK - 1e-12 <= move.end_time <= run.time + 1e-12


def test_a_move_of_nothing_is_done_in_the_next_cycle() -> None:
    run, x = ready()
    time = run.time
    move = x.move_absolute(0.0)
    assert finish(run, move) == 1
    assert move.end_time == pytest.approx(time, abs=1e-15)


@pytest.mark.parametrize("tick", [0, *PHASES])
def test_relative_counts_from_the_set_position_of_the_call(tick: int) -> None:
    run, x = ready()
    x.move_absolute(300.0)
    run.step(tick)
    here = x.set_position
    move = x.move_relative(30.0)
    finish(run, move)
    assert x.set_position == here + 30.0


def test_remaining_time_counts_down_to_the_end() -> None:
    run, x = ready()
    move = x.move_absolute(300.0)
    start, exact = run.tick, full_move_time(300.0)
    assert move.end_time is None
    while move.busy:
        assert move.remaining_time == pytest.approx(exact - (run.tick - start) * PER_TICK, abs=1e-12)
        run.step()
    assert move.at_target
    assert move.remaining_time == 0.0


def test_remaining_time_of_what_has_no_end_in_sight_is_infinite() -> None:
    run, x = ready(home={"mode": "switch", "switch": -50.0, "velocity": 40.0})
    power = x.disable()
    assert power.remaining_time == math.inf
    x.enable()
    home = x.home()
    run.step(300)
    assert home.remaining_time == math.inf
    finish(run, home)
    assert home.remaining_time == 0.0
    move = x.move_absolute(300.0)
    x.set_override(0.0)
    run.step(500)
    assert move.busy
    assert move.remaining_time == math.inf
    assert not move.at_target
    x.set_override(1.0)
    run.step()  # the override is in force from the tick of its call on
    assert 0.5 < move.remaining_time < 1.0


def test_an_aborted_move_has_no_end_time() -> None:
    run, x = ready()
    move = x.move_absolute(300.0)
    run.step(50)
    finish(run, x.halt())
    assert move.aborted
    assert move.end_time is None
    assert not move.at_target
    assert move.remaining_time == 0.0


@pytest.mark.parametrize("tick", thinned(PHASES, 2))
@pytest.mark.parametrize("goal", [-90.0, 0.0, 150.0, 300.0, 390.0])
def test_the_target_can_change_in_every_phase(tick: int, goal: float) -> None:
    run, x = ready()
    first = x.move_absolute(300.0)
    run.step(tick)
    state = (x.set_position, x.set_velocity, x.set_acceleration)
    second = x.move_absolute(goal)
    assert (x.set_position, x.set_velocity, x.set_acceleration) == state
    assert first.aborted
    assert first.by is second
    follow(run, x, second)
    assert x.set_position == goal


@pytest.mark.parametrize("tick", thinned(PHASES, 2))
@pytest.mark.parametrize(
    "dynamics",
    [
        {"velocity": 50.0},
        {"velocity": 500.0, "jerk": 2e4},
        {"acceleration": 500.0},
        {"velocity": 450.0, "acceleration": 3000.0, "deceleration": 5500.0, "jerk": 8e4},
    ],
)
def test_the_dynamics_can_change_in_every_phase(tick: int, dynamics: dict[str, Any]) -> None:
    run, x = ready()
    x.move_absolute(300.0)
    run.step(tick)
    second = x.move_absolute(300.0, **dynamics)
    rows = follow(run, x, second)
    assert x.set_position == 300.0
    if dynamics == {"velocity": 50.0} and tick <= 500:
        assert abs(rows[-40, 1]) <= 50.0 * (1.0 + 1e-12)


@pytest.mark.parametrize("name", ["velocity", "acceleration", "deceleration", "jerk"])
def test_each_dynamic_value_is_kept(name: str) -> None:
    """A smaller value bounds just what it names."""
    run, x = ready()
    value: Any = {"velocity": 400.0, "acceleration": 2500.0, "deceleration": 3000.0, "jerk": 8e4}[name]
    _, v, a = follow(run, x, x.move_absolute(300.0, **{name: value})).T
    peak = {"velocity": 500.0, "acceleration": 5000.0, "deceleration": 6000.0, "jerk": 1e5} | {name: value}
    assert v.max() == pytest.approx(peak["velocity"], rel=1e-9)
    assert a.max() == pytest.approx(peak["acceleration"], rel=1e-9)
    assert -a.min() == pytest.approx(peak["deceleration"], rel=1e-9)
    assert np.abs(np.diff(a)).max() / PER_TICK == pytest.approx(peak["jerk"], rel=1e-6)


@pytest.mark.parametrize("direction", [Direction.POSITIVE, Direction.NEGATIVE])
def test_endless_motion_reaches_its_velocity_and_keeps_it(direction: Direction) -> None:
    run, x = ready(software_limit_min=None, software_limit_max=None)
    start = run.time
    move = x.move_velocity(200.0, direction)
    sign = 1.0 if direction is Direction.POSITIVE else -1.0
    entered = None
    rows = []
    for _ in range(1000):
        rows.append((x.set_position, x.set_velocity, x.set_acceleration))
        if move.in_velocity and entered is None:
            entered = run.time
        assert move.in_velocity == (x.set_velocity == sign * 200.0 and x.set_acceleration == 0.0)
        run.step()
    assert_smooth(np.array(rows))
    ramp = 2.0 * math.sqrt(200.0 / 1e5)  # the acceleration stays below 5000
    assert entered == pytest.approx(start + math.ceil(ramp / PER_TICK) * PER_TICK, abs=1e-9)
    assert move.end_time == pytest.approx(start + ramp, rel=1e-12)
    assert move.busy
    assert move.active
    assert state_of(x) is AxisState.CONTINUOUS_MOTION


def test_endless_motion_reverses_smoothly() -> None:
    run, x = ready()
    x.move_velocity(300.0)
    run.step(250)
    move = x.move_velocity(200.0, Direction.NEGATIVE)
    rows = []
    for _ in range(500):
        rows.append((x.set_position, x.set_velocity, x.set_acceleration))
        run.step()
    assert_smooth(np.array(rows))
    assert move.in_velocity
    assert x.set_velocity == -200.0
    x.move_absolute(0.0)
    assert not move.in_velocity


@pytest.mark.parametrize("tick", PHASES)
@pytest.mark.parametrize("name", ["halt", "stop"])
def test_halt_and_stop_brake_in_every_phase(tick: int, name: str) -> None:
    run, x = ready()
    move = x.move_absolute(300.0)
    run.step(tick)
    v, a = x.set_velocity, x.set_acceleration
    brake: AxisCommand = getattr(x, name)()
    assert (move.aborted, move.by) == (True, brake)
    rows = follow(run, x, brake)
    assert rows[-1, 1] == rows[-1, 2] == 0.0
    assert x.set_position <= 300.0
    assert state_of(x) is AxisState.STANDSTILL
    assert v <= 0.0 or a > 0.0 or np.all(np.diff(rows[:, 1]) <= 1e-9)


@pytest.mark.parametrize("name", ["halt", "stop"])
def test_weaker_brakes_are_raised_to_the_running_dynamics_and_harder_ones_kept(name: str) -> None:
    lengths = {}
    for deceleration in (100.0, 3000.0, 6000.0, None):
        run, x = ready()
        x.move_velocity(400.0, deceleration=3000.0)
        run.step(300)
        brake = getattr(x, name)(deceleration=deceleration)
        lengths[deceleration] = len(follow(run, x, brake))
    assert lengths[100.0] == lengths[3000.0] == lengths[None]
    assert lengths[6000.0] < lengths[3000.0]


def test_a_halt_can_be_replaced_and_a_stop_cannot() -> None:
    run, x = ready()
    x.move_velocity(300.0)
    run.step(200)
    halt = x.halt()
    run.step(5)
    move = x.move_absolute(300.0)
    assert halt.aborted
    assert halt.by is move
    run.step(20)
    stop = x.stop()
    run.step(5)
    refused = x.move_absolute(0.0)
    assert error_of(refused) is ErrorId.LOCKED_BY_STOP
    assert stop.busy
    finish(run, stop)
    assert stop.done


@pytest.mark.parametrize("position", [0.1, 100.0, 299.999, 300.0])
def test_passes_ends_where_the_setpoint_passes(position: float) -> None:
    run, x = ready()
    start = run.time
    move = x.move_absolute(300.0, velocity=250.0)
    passes = x.passes(position)
    finish(run, passes)
    assert passes.end_time is not None
    assert run.time - PER_TICK <= passes.end_time + 1e-12
    assert passes.end_time <= run.time + 1e-12
    if position == 100.0:  # in the cruise: the ramp takes v/a + a/j at half the velocity
        ramp = 250.0 / 5000.0 + 5000.0 / 1e5
        assert passes.end_time == pytest.approx(start + ramp / 2.0 + 100.0 / 250.0, rel=1e-9)
    finish(run, move)
    assert x.set_position == 300.0


def test_commands_work_in_a_program_as_outside() -> None:
    results = []
    for inside in (False, True):
        run, x = ready()
        if inside:

            async def program(x: Axis = x) -> None:
                await x.move_absolute(300.0)

            play(run, program)
        else:
            finish(run, x.move_absolute(300.0))
        results.append((x.set_position, x._store.table[5:13, 0].tobytes()))
    assert results[0] == results[1]
