"""Chains of buffered and blended moves, fed one at a time: nothing is lost on the way, however long they are."""

from typing import NamedTuple

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from motionlayer import Simulation
from motionlayer.nc import Axis, AxisCommand, BufferMode
from motionlayer.profile import Limits, passable_velocity, plan_passing, plan_position, stop_displacement
from motionlayer.verify import assert_valid
from tests.effort import examples, thinned
from tests.machines import LINEAR, finish, machine

MAXIMUM = Limits(500.0, 5000.0, 6000.0, 1e5)
PHASES = (Phase.explicit, Phase.reuse, Phase.generate)
"""Without shrinking: a case is a whole run."""

FAR = {"software_limit_min": None, "software_limit_max": None}


class Leg(NamedTuple):
    """One move of a chain; fractions are of the maxima."""

    way: float
    velocity: float
    acceleration: float
    deceleration: float
    jerk: float
    mode: BufferMode

    @property
    def limits(self) -> Limits:
        """Limits of the move."""
        shares = (self.velocity, self.acceleration, self.deceleration, self.jerk)
        return Limits(*(share * most for share, most in zip(shares, MAXIMUM, strict=True)))


def feed(run: Simulation, axis: Axis, legs: list[Leg], ticks: int = 100_000) -> list[AxisCommand]:
    """Command a chain: each leg as soon as the one before it has begun; return its commands."""
    commands: list[AxisCommand] = []
    for leg in legs:
        while axis.buffered is not None:
            run.step()
            assert run.tick < ticks
        limits = leg.limits._asdict()
        commands.append(axis.move_relative(leg.way, buffer_mode=leg.mode, **limits))
        assert commands[-1].error is None, commands[-1].error
    finish(run, commands[-1], ticks)
    return commands


def chain(**changes: object) -> tuple[Simulation, Axis]:
    """Return a run and its axis without software limits, in StandStill."""
    run = Simulation(machine(**(LINEAR | FAR | changes)))
    axis = run.axes["X"]
    axis.enable()
    run.step(2)
    return run, axis


FRACTION = st.one_of(st.just(1.0), st.floats(0.05, 1.0))
LEG = st.builds(
    Leg,
    way=st.one_of(st.floats(-80.0, 80.0), st.floats(-1.0, 1.0), st.sampled_from([20.0, 5.0, -20.0])),
    velocity=FRACTION,
    acceleration=FRACTION,
    deceleration=FRACTION,
    jerk=FRACTION,
    mode=st.sampled_from(BufferMode),
)


def usable(legs: list[Leg]) -> list[Leg]:
    """Leave out moves that are refused or that have no length, and let nothing break the chain off."""
    kept = [leg for leg in legs if abs(leg.way) > 1e-6]
    return [leg._replace(mode=BufferMode.BUFFERED if leg.mode is BufferMode.ABORTING else leg.mode) for leg in kept]


@settings(max_examples=examples(40), deadline=None, phases=PHASES)
@given(legs=st.lists(LEG, min_size=2, max_size=12).map(usable).filter(lambda legs: len(legs) > 1))
def test_random_chains_lose_no_position(legs: list[Leg]) -> None:
    run, x = chain()
    commands = feed(run, x, legs)
    place = 0.0
    for leg in legs:
        place += leg.way
    assert x.set_position == place
    assert all(command.done for command in commands)
    run.step(2)
    trace = run.trace
    assert_valid(trace)
    begun = {plan.command: plan for plan in trace.plans if plan.tick}
    assert len(begun) == len(legs)


def rule(legs: list[Leg]) -> float:
    """Return how long a chain in one direction takes by the rule of its modes, leg by leg."""
    total, entry = 0.0, 0.0
    for leg, after in zip(legs, [*legs[1:], None], strict=True):
        limits, speed = leg.limits, 0.0
        if after is not None and after.mode is not BufferMode.BUFFERED:
            own, next_one = limits.velocity, after.limits.velocity
            speed = {
                BufferMode.BLENDING_LOW: min(own, next_one),
                BufferMode.BLENDING_PREVIOUS: own,
                BufferMode.BLENDING_NEXT: next_one,
                BufferMode.BLENDING_HIGH: max(own, next_one),
            }[after.mode]
            assert stop_displacement(speed, 0.0, after.limits.deceleration, after.limits.jerk) <= after.way
            assert passable_velocity(0.0, entry, 0.0, leg.way, speed, limits) == speed
        plan = plan_passing if speed else None
        end = plan(0.0, entry, 0.0, leg.way, speed, limits) if plan else plan_position(0.0, entry, 0.0, leg.way, limits)
        total, entry = total + end.duration, speed
    return total


@settings(max_examples=examples(20), deadline=None, phases=PHASES)
@given(
    legs=st.lists(
        st.builds(
            Leg,
            way=st.floats(150.0, 200.0),
            velocity=st.floats(0.3, 1.0),
            acceleration=st.floats(0.5, 1.0),
            deceleration=st.floats(0.5, 1.0),
            jerk=st.floats(0.5, 1.0),
            mode=st.sampled_from([BufferMode.BUFFERED, BufferMode.BLENDING_LOW]),
        ),
        min_size=2,
        max_size=10,
    )
)
def test_a_chain_takes_exactly_as_long_as_its_rule_says(legs: list[Leg]) -> None:
    """Not a part of a cycle is lost: legs that are long enough are the sum of their parts."""
    run, x = chain()
    start = run.time
    commands = feed(run, x, legs)
    assert commands[-1].end_time == pytest.approx(start + rule(legs), rel=1e-10)
    run.step(2)
    assert_valid(run.trace)


@settings(max_examples=examples(15), deadline=None, phases=PHASES)
@given(
    legs=st.lists(LEG, min_size=2, max_size=6).map(usable).filter(lambda legs: len(legs) > 1),
    overrides=st.lists(st.tuples(st.integers(1, 80), st.sampled_from([0.0, 0.1, 0.5, 0.9, 1.0])), max_size=8),
)
def test_chains_under_a_changing_override(legs: list[Leg], overrides: list[tuple[int, float]]) -> None:
    run, x = chain()

    async def knob() -> None:
        for ticks, factor in overrides:
            await run.sleep(ticks * 0.001)
            x.set_override(factor)
        await run.sleep(0.02)
        x.set_override(1.0)

    run.start(knob())
    feed(run, x, legs)
    place = 0.0
    for leg in legs:
        place += leg.way
    assert x.set_position == place
    run.step(2)
    assert_valid(run.trace)


@pytest.mark.parametrize("ticks", range(196, 216, 4))
def test_an_override_that_falls_too_late_to_brake_before_a_joint(ticks: int) -> None:
    """The joint is passed with the nearest speed that is left."""
    run, x = chain()
    x.move_absolute(100.0)
    after = x.move_absolute(200.0, buffer_mode=BufferMode.BLENDING_HIGH)
    run.step(ticks)
    x.set_override(0.1)
    finish(run, after)
    assert x.set_position == 200.0
    run.step(2)
    assert_valid(run.trace)


@pytest.mark.parametrize("offset", [0.0, 1e6])
@pytest.mark.parametrize("mode", [BufferMode.BUFFERED, BufferMode.BLENDING_LOW])
def test_a_follower_that_comes_while_the_axis_brakes_leaves_the_running_motion_alone(
    offset: float, mode: BufferMode
) -> None:
    """In the midst of a brake the time grows with the third root of a way: rounding would cost microseconds there."""

    def end(ticks: int, following: bool) -> float:
        run, x = chain(start_position=offset)
        move = x.move_relative(100.0)
        run.step(ticks)
        if following:
            assert x.move_relative(-30.0, buffer_mode=mode).error is None
        finish(run, move)
        assert move.end_time is not None
        run.step(2)
        assert_valid(run.trace)
        return move.end_time

    alone = end(1, following=False)
    for ticks in (230, 290, 310, 340, 347):
        assert end(ticks, following=True) == alone


@pytest.mark.parametrize("offset", thinned([1e6, -1e6], 2))
@pytest.mark.parametrize("mode", [BufferMode.BLENDING_LOW, BufferMode.BUFFERED])
def test_far_away_from_0_a_chain_takes_as_long(offset: float, mode: BufferMode) -> None:
    """Whole ways are what they are elsewhere; only the setpoints between are rounded there."""
    legs = [Leg(20.0 + k, 0.2 + 0.01 * (k % 7), 1.0, 0.9, 1.0, mode) for k in range(60)]
    run, x = chain(start_position=offset)
    start = run.time
    commands = feed(run, x, legs)
    assert commands[-1].end_time == pytest.approx(start + rule(legs), rel=1e-11)
    run.step(2)
    assert_valid(run.trace)


@pytest.mark.slow
def test_a_thousand_moves_lose_nothing() -> None:
    legs = [Leg(10.0, 0.2 + 0.001 * (k % 7), 1.0, 1.0, 1.0, BufferMode.BLENDING_LOW) for k in range(1000)]
    run, x = chain()
    start = run.time
    commands = feed(run, x, legs, 200_000)
    assert commands[-1].end_time == pytest.approx(start + rule(legs), rel=1e-12)
    assert x.set_position == 10_000.0
    run.step(2)
    assert_valid(run.trace)
