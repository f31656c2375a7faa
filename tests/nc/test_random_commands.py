"""Random commands at random times on three axes, from programs that end, fail or are cancelled.

Whatever is commanded: no jump, no limit exceeded, every accepted command ends exactly once or runs to the end.
"""

import math
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from motionlayer import Command, Direction, Machine, Simulation, Trace, stopping
from motionlayer.command import ErrorId
from motionlayer.event import Kind
from motionlayer.nc import Axis, BufferMode, JogMode
from motionlayer.verify import assert_valid

if TYPE_CHECKING:
    from collections.abc import Callable

AXES: dict[str, dict[str, Any]] = {
    "X": {
        "max_velocity": 500.0,
        "max_acceleration": 5000.0,
        "max_deceleration": 6000.0,
        "max_jerk": 1e5,
        "software_limit_min": -100.0,
        "software_limit_max": 400.0,
        "home": {"mode": "switch", "switch": -20.0, "velocity": 100.0},
    },
    "Y": {
        "unit": "degree",
        "max_velocity": 3600.0,
        "max_acceleration": 40_000.0,
        "max_deceleration": 15_000.0,
        "max_jerk": 2e6,
        "velocity": 720.0,
    },
    "Z": {
        "unit": "µm",
        "max_velocity": 2e4,
        "max_acceleration": 1e5,
        "max_jerk": 4e6,
        "software_limit_min": -500.0,
        "start_position": 1000.0,
    },
}
MACHINE = Machine.from_dict({"format": 1, "name": "random", "axis": AXES})
TIME = 1.5
DISABLED, ERRORSTOP, HOMING = 1, 3, 5


class Act(NamedTuple):
    """Wait some ticks, then call one command; fractions are of the axis's maxima or of its range."""

    ticks: int
    axis: str
    call: str
    place: float
    fractions: tuple[float, float, float, float]
    awaits: bool


class Part(NamedTuple):
    """One program: what it does, how it ends, and whether it stops its axes."""

    acts: list[Act]
    end: str
    cancel_at: int
    stops: bool


FRACTION = st.one_of(st.just(1.0), st.floats(0.02, 1.0), st.sampled_from([0.0, 1.5]))
ACT = st.builds(
    Act,
    ticks=st.one_of(st.just(0), st.integers(0, 150)),
    axis=st.sampled_from("XYZ"),
    call=st.sampled_from(
        ["absolute"] * 4 + ["relative", "velocity", "velocity", "halt", "stop", "home", "override", "override"]
        + ["blended"] * 4 + ["additive", "modulo", "continuous", "jog"]
        + ["enable", "enable", "disable", "reset", "passes", "fault"]
    ),
    place=st.one_of(st.floats(-0.1, 1.0), st.sampled_from([0.0, 1.0])),
    fractions=st.tuples(FRACTION, FRACTION, FRACTION, FRACTION),
    awaits=st.booleans(),
)  # fmt: skip
PART = st.builds(
    Part,
    acts=st.lists(ACT, max_size=12),
    end=st.sampled_from(["ends", "ends", "raises", "cancelled"]),
    cancel_at=st.integers(0, 800),
    stops=st.booleans(),
)


def call(axis: Axis, act: Act) -> Command[Any] | None:
    """Make the call; a fault and an override are no commands."""
    low, span = {"X": (-100.0, 500.0), "Y": (-720.0, 1440.0), "Z": (-500.0, 3000.0)}[act.axis]
    place = low + act.place * span
    most = axis.config.maximum
    v, a, d, j = (fraction * value for fraction, value in zip(act.fractions, most, strict=True))
    direction = list(Direction)[act.ticks % len(Direction)]
    mode = BufferMode(act.ticks % len(BufferMode))
    calls: dict[str, Callable[[], Command[Any] | None]] = {
        "absolute": lambda: axis.move_absolute(place, velocity=v, acceleration=a, deceleration=d, jerk=j),
        "relative": lambda: axis.move_relative((act.place - 0.5) * span / 4.0, velocity=v, jerk=j),
        "blended": lambda: axis.move_absolute(place, velocity=v, deceleration=d, buffer_mode=mode),
        "additive": lambda: axis.move_additive((act.place - 0.5) * span / 4.0, velocity=v, buffer_mode=mode),
        "modulo": lambda: axis.move_modulo(act.place * span, direction, velocity=v, buffer_mode=mode),
        "continuous": lambda: axis.move_continuous_absolute(place, v, acceleration=a, jerk=j, buffer_mode=mode),
        "jog": lambda: axis.jog(direction, JogMode(act.ticks % len(JogMode)), velocity=v),
        "velocity": lambda: axis.move_velocity(v, direction, acceleration=a, deceleration=d, jerk=j),
        "halt": lambda: axis.halt(deceleration=d or None, jerk=j),
        "stop": lambda: axis.stop(deceleration=d, jerk=j or None),
        "home": lambda: axis.home(place),
        "override": lambda: axis.set_override(min(act.fractions[0], 1.0) if act.place < 0.8 else 1.0),
        "enable": axis.enable,
        "disable": axis.disable,
        "reset": axis.reset,
        "passes": lambda: axis.passes(place),
        "fault": lambda: axis.fault(ErrorId.INTERNAL) if act.place > 0.9 else None,
    }
    return calls[act.call]()


async def play(run: Simulation, part: Part, commands: list[Command[Any]]) -> None:
    """Do what a part says."""
    async with stopping(*(run.axes.values() if part.stops else ())):
        for act in part.acts:
            if act.ticks:
                await run.sleep(act.ticks * 0.001)
            command = call(run.axes[act.axis], act)
            if command is None:
                continue
            commands.append(command)
            if act.awaits and act.call not in ("velocity", "continuous", "jog"):
                try:
                    with run.fail_after(0.3):
                        await command.settled()
                except TimeoutError:
                    pass
        if part.end == "raises":
            raise LookupError("on purpose")


def perform(parts: list[Part], *, trace: bool = True) -> tuple[Simulation, list[Command[Any]]]:
    """Run all parts at once, on axes that are enabled first."""
    run = Simulation(MACHINE, trace=trace)
    commands: list[Command[Any]] = [axis.enable() for axis in run.axes.values()]
    run.step(2)
    programs = [run.start(play(run, part, commands), f"part {k}") for k, part in enumerate(parts)]

    async def canceller() -> None:
        for tick, k in sorted((part.cancel_at, k) for k, part in enumerate(parts) if part.end == "cancelled"):
            await run.until(lambda tick=tick: run.tick >= tick)  # type: ignore[misc]
            programs[k].cancel()
        await run.sleep(100.0)

    run.start(canceller())
    run.run(time=TIME)
    commands += programs
    return run, commands


def check_motion(trace: Trace, name: str) -> None:
    """Check p, v, a from tick to tick against the machine's maxima, from the samples alone."""
    axis, dt = MACHINE.description.axis[name], 0.001
    p, v, a, state = (
        trace[f"{name}.{signal}"] for signal in ("set_position", "set_velocity", "set_acceleration", "state")
    )
    wide = 1.0 + 1e-9
    assert np.all(np.abs(v) <= axis.max_velocity * wide)
    assert np.all(np.abs(a)[v * a > 0.0] <= axis.max_acceleration * wide)
    assert np.all(np.abs(a)[v * a < 0.0] <= axis.max_deceleration * wide)
    jerk = axis.max_jerk * wide
    assert np.all(np.abs(np.diff(a)) <= jerk * dt + 1e-9 * axis.max_acceleration)
    assert np.all(np.abs(np.diff(v) - a[:-1] * dt) <= jerk * dt**2 / 2.0 + 1e-11 * axis.max_velocity)
    off = np.abs(np.diff(p) - (v[:-1] + a[:-1] * dt / 2.0) * dt) > jerk * dt**3 / 6.0 + 1e-12 * (1.0 + np.abs(p[1:]))
    redefined = {plan.tick - 1 for plan in trace.plans if plan.axis == name and plan.kind == "set"}
    assert set((np.flatnonzero(off)).tolist()) <= redefined
    assert np.all(v[np.isin(state, (1, 2))] == 0.0)
    assert np.array_equal(p, trace[f"{name}.actual_position"])


def check_software_limits(trace: Trace, name: str) -> None:
    """No tick is outside, unless the axis was homed: then it may have been given a place outside."""
    axis = MACHINE.description.axis[name]
    p = trace[f"{name}.set_position"]
    homing = trace[f"{name}.state"] == HOMING
    redefined = any(plan.axis == name and plan.kind == "set" and plan.target != p[0] for plan in trace.plans)
    if not homing.any() and not redefined:
        low = -math.inf if axis.software_limit_min is None else axis.software_limit_min
        high = math.inf if axis.software_limit_max is None else axis.software_limit_max
        assert np.all((p >= low - 1e-9) & (p <= high + 1e-9))


def check_lives(trace: Trace, commands: list[Command[Any]]) -> None:
    """Every command is accepted or refused once, and an accepted one ends once or runs to the end."""
    by_kind: dict[Kind, list[int]] = {kind: [] for kind in Kind}
    for event in trace.events:
        if event.command:
            by_kind[event.kind].append(event.command)
    accepted, refused = by_kind[Kind.ACCEPTED], by_kind[Kind.REFUSED]
    ended = by_kind[Kind.DONE] + by_kind[Kind.ABORTED] + by_kind[Kind.ERROR]
    assert len(set(accepted)) == len(accepted)
    assert len(set(ended)) == len(ended)
    assert set(ended) <= set(accepted)
    assert not set(refused) & set(accepted)
    running = set(accepted) - set(ended)
    for command in commands:
        assert (command.number in running) == command.busy
        assert (command.number in by_kind[Kind.DONE]) == command.done
        assert (command.number in by_kind[Kind.ABORTED]) == command.aborted
        in_error = command.number in by_kind[Kind.ERROR] + refused
        assert in_error == (command.error is not None)
        assert not (command.active and not command.busy)
    assert all(first.tick <= second.tick for first, second in pairwise(trace.events))


def check_rest_at_redefinitions(trace: Trace, name: str) -> None:
    """A coordinate is redefined at rest only."""
    for plan in trace.plans:
        if plan.axis == name and plan.kind == "set" and plan.tick < len(trace.ticks):
            assert trace[f"{name}.set_velocity"][plan.tick] == 0.0
            assert trace[f"{name}.set_acceleration"][plan.tick] == 0.0


def check(parts: list[Part]) -> None:
    run, commands = perform(parts)
    trace = run.trace
    for name in AXES:
        check_motion(trace, name)
        check_software_limits(trace, name)
        check_rest_at_redefinitions(trace, name)
    check_lives(trace, commands)
    assert_valid(trace)


@settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(st.lists(PART, min_size=1, max_size=4))
def test_random_commands(parts: list[Part]) -> None:
    check(parts)


@pytest.mark.slow
@settings(max_examples=1500, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(st.lists(PART, min_size=1, max_size=4))
def test_many_random_commands(parts: list[Part]) -> None:
    check(parts)


@settings(max_examples=10, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(st.lists(PART, min_size=2, max_size=3))
def test_the_same_commands_give_the_same_hash_with_and_without_a_trace(parts: list[Part]) -> None:
    hashes = [perform(parts, trace=trace)[0].close() for trace in (True, True, False)]
    assert hashes[0]
    assert len(set(hashes)) == 1
