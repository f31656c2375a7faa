"""Commands of one tick that replace one another (rules 1 and 3)."""

from collections.abc import Callable
from itertools import pairwise

import pytest

from motionlayer import Simulation
from motionlayer.command import ErrorId
from motionlayer.nc import Axis, AxisCommand
from tests.machines import error_of, finish, machine, play, ready

MOTIONS: dict[str, Callable[[Axis], AxisCommand]] = {
    "absolute": lambda x: x.move_absolute(200.0),
    "relative": lambda x: x.move_relative(-30.0),
    "velocity": lambda x: x.move_velocity(100.0),
    "halt": lambda x: x.halt(),
}


@pytest.mark.parametrize("moving", [False, True])
@pytest.mark.parametrize("second", MOTIONS)
@pytest.mark.parametrize("first", MOTIONS)
def test_the_last_of_a_tick_wins_and_the_earlier_ones_have_not_moved(
    first: str,
    second: str,
    moving: bool,
) -> None:
    """The axis moves bit for bit as if only the last one had been called."""
    paths = []
    for names in ((first, second), (second,)):
        run, x = ready()
        if moving:
            x.move_absolute(390.0)
            run.step(77)
        before = (x.set_position, x.set_velocity, x.set_acceleration)
        commands = [MOTIONS[name](x) for name in names]
        assert (x.set_position, x.set_velocity, x.set_acceleration) == before
        assert x.command is commands[-1]
        for earlier in commands[:-1]:
            assert earlier.aborted
            assert earlier.by is commands[-1]
            assert earlier.end_time is None
        path = []
        for _ in range(400):
            run.step()
            path.append((x.set_position, x.set_velocity, x.set_acceleration, int(x.state)))
        paths.append(path)
    # A halt takes over the dynamics of what it replaces, here the defaults both times.
    assert paths[0] == paths[1]


def test_one_hundred_commands_in_a_tick() -> None:
    run, x = ready()
    commands = [x.move_absolute(float(k)) for k in range(100)]
    finish(run, commands[-1])
    assert x.set_position == 99.0
    assert all(a.by is b for a, b in pairwise(commands))
    trace = run.trace
    positions = trace["X.set_position"]
    assert len([plan for plan in trace.plans if plan.kind == "position"]) == 1
    assert positions.max() <= 99.0


def test_a_refused_command_does_not_replace() -> None:
    run, x = ready()
    move = x.move_absolute(200.0)
    assert error_of(x.move_absolute(4000.0)) is ErrorId.TARGET_OUTSIDE_LIMITS
    assert error_of(x.move_velocity(-1.0)) is ErrorId.VELOCITY
    assert move.busy
    finish(run, move)
    assert x.set_position == 200.0


def test_axes_do_not_replace_one_another() -> None:
    run = Simulation(machine(3))

    async def program() -> None:
        for axis in run.axes.values():
            await axis.enable()
        moves = [axis.move_absolute(10.0 * k) for k, axis in enumerate(run.axes.values(), 1)]
        assert all(move.busy and move.active for move in moves)
        for move in moves:
            await move
        assert [axis.set_position for axis in run.axes.values()] == [10.0, 20.0, 30.0]

    play(run, program)


def test_a_command_acts_from_its_own_tick_and_is_first_sampled_for_the_next() -> None:
    run, x = ready()
    tick = run.tick
    x.move_absolute(300.0)
    finish(run, x.passes(1.0))
    positions = run.trace["X.set_position"]
    assert positions[tick] == 0.0
    assert positions[tick + 1] == pytest.approx(1e5 * 0.001**3 / 6.0, rel=1e-9)


def test_two_programs_in_one_tick_follow_the_order_of_start() -> None:
    run, x = ready()
    commands: list[AxisCommand] = []

    async def mover(goal: float) -> None:
        commands.append(x.move_absolute(goal))

    for goal in (100.0, 200.0, 50.0):
        run.start(mover(goal))
    run.run()
    assert [command.aborted for command in commands] == [True, True, False]
    finish(run, commands[-1])
    assert x.set_position == 50.0


def test_a_brake_is_no_weaker_than_what_really_moved_the_axis() -> None:
    """A weaker move of the same tick has not moved it: its limits do not count."""
    run, x = ready()
    x.move_absolute(290.0)
    run.step(200)
    x.move_absolute(295.0, deceleration=500.0)
    x.halt()
    assert x._job is not None
    assert x._job.limits.deceleration == x.config.default.deceleration
