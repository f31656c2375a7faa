"""Every state meets every command; the table here is written from function-blocks 1.2 and 1.3, not from the code."""

from collections.abc import Callable

import numpy as np
import pytest

from motionlayer import AxisState, Simulation
from motionlayer.command import ErrorId
from motionlayer.nc import TRANSITIONS, Axis, AxisCommand, AxisEvent, Direction
from motionlayer.store import Q
from tests.machines import SWITCH, error_of, finish, one_axis, ready, state_of

S, E = AxisState, ErrorId

CALLS: dict[str, Callable[[Axis], AxisCommand]] = {
    "enable": lambda x: x.enable(),
    "disable": lambda x: x.disable(),
    "reset": lambda x: x.reset(),
    "absolute": lambda x: x.move_absolute(120.0),
    "relative": lambda x: x.move_relative(1.0),
    "velocity": lambda x: x.move_velocity(20.0),
    "halt": lambda x: x.halt(),
    "stop": lambda x: x.stop(),
    "home": lambda x: x.home(),
}
MOVES = ("absolute", "relative")


def spread(
    enable: object, disable: object, reset: object, move: object, endless: object, *rest: object
) -> dict[str, object]:
    values = (enable, disable, reset, move, move, endless, *rest)
    return dict(zip(CALLS, values, strict=True))


OFF, LOCK, ERR = E.NOT_ENABLED, E.LOCKED_BY_STOP, E.CANNOT_START
EXPECTED: dict[str, dict[str, object]] = {
    # at once after the call:  enable    disable     reset       move       endless       halt       stop        home
    "disabled": spread(S.DISABLED, S.DISABLED, S.DISABLED, OFF, OFF, OFF, OFF, OFF),
    "standstill": spread(
        S.STANDSTILL, S.STANDSTILL, S.STANDSTILL,
        S.DISCRETE_MOTION, S.CONTINUOUS_MOTION, S.DISCRETE_MOTION, S.STOPPING, S.HOMING,
    ),
    "discrete": spread(
        S.DISCRETE_MOTION, S.STOPPING, S.DISCRETE_MOTION,
        S.DISCRETE_MOTION, S.CONTINUOUS_MOTION, S.DISCRETE_MOTION, S.STOPPING, ERR,
    ),
    "continuous": spread(
        S.CONTINUOUS_MOTION, S.STOPPING, S.CONTINUOUS_MOTION,
        S.DISCRETE_MOTION, S.CONTINUOUS_MOTION, S.DISCRETE_MOTION, S.STOPPING, ERR,
    ),
    "stopping": spread(LOCK, S.STOPPING, S.STOPPING, LOCK, LOCK, LOCK, E.STOP_ACTIVE, LOCK),
    "homing": spread(S.HOMING, S.STOPPING, S.HOMING, ERR, ERR, ERR, S.STOPPING, ERR),
    "error at rest": spread(ERR, S.ERRORSTOP, S.ERRORSTOP, ERR, ERR, ERR, ERR, ERR),
    "error in motion": spread(ERR, S.ERRORSTOP, S.ERRORSTOP, ERR, ERR, ERR, ERR, ERR),
    "error without power": spread(ERR, S.ERRORSTOP, S.ERRORSTOP, ERR, ERR, ERR, ERR, ERR),
}  # fmt: skip


def reach(situation: str) -> tuple[Simulation, Axis]:
    """Bring an axis into a situation by real calls."""
    run, x = one_axis(home=SWITCH) if situation == "disabled" else ready(home=SWITCH)
    if situation == "discrete":
        x.move_absolute(300.0)
    elif situation in ("continuous", "stopping", "error in motion"):
        x.move_velocity(200.0)
    elif situation == "homing":
        x.home()
    elif situation.startswith("error"):
        x.fault(E.INTERNAL)
    run.step(60 if x.command is not None else 1)
    if situation == "stopping":
        x.stop()
    elif situation == "error in motion":
        x.fault(E.INTERNAL)
    elif situation == "error without power":
        x.disable()
    run.step(2)
    return run, x


def everything(x: Axis) -> list[object]:
    """Return all that a refused command must leave alone."""
    store = x._store
    arrays = [store.table, store.pieces, store.counts, store.current]
    known = [x.state, x.command, x._job, x._homing, x._power, x._reset, x.error, x.homed, store.tick]
    busy = x.command.busy if x.command is not None else None
    return [*known, busy, *(array.tobytes() for array in arrays)]


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("situation", EXPECTED)
def test_state_meets_command(situation: str, call: str) -> None:
    _, x = reach(situation)
    before = everything(x)
    expected = EXPECTED[situation][call]
    command = CALLS[call](x)
    if isinstance(expected, AxisState):
        assert command.error is None
        assert state_of(x) is expected
        assert x._store.table[Q.STATE, 0] == expected
    else:
        assert error_of(command) is expected
        assert everything(x) == before


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("situation", EXPECTED)
def test_the_axis_goes_on_after_a_refused_command(situation: str, call: str) -> None:
    """A refused command has no later effect either: the next second is bit for bit the same without it."""
    if isinstance(EXPECTED[situation][call], AxisState):
        return
    futures = []
    for interfere in (False, True):
        run, x = reach(situation)
        if interfere:
            CALLS[call](x)
        rows = []
        for _ in range(300):
            run.step()
            rows.append(x._store.table.tobytes())
        futures.append(rows)
    assert futures[0] == futures[1]


@pytest.mark.parametrize("situation", EXPECTED)
def test_an_error_wins_over_every_state(situation: str) -> None:
    _, x = reach(situation)
    running = x.command
    x.fault(E.INTERNAL, "test")
    assert state_of(x) is S.ERRORSTOP
    assert x.error is not None
    assert x.error.id is E.INTERNAL
    assert x.command is None
    if running is not None:
        assert running.error is x.error


def test_the_table_of_the_code_holds_the_same() -> None:
    """The documentation's diagrams are made from that table."""
    events = {
        "enable": AxisEvent.ENABLE,
        "disable": AxisEvent.DISABLE,
        "absolute": AxisEvent.MOVE,
        "velocity": AxisEvent.MOVE_ENDLESS,
        "halt": AxisEvent.HALT,
        "stop": AxisEvent.STOP,
        "home": AxisEvent.HOME,
    }
    for situation, row in EXPECTED.items():
        _, x = reach(situation)
        table = TRANSITIONS[x.state]
        assert {call: table[event] for call, event in events.items()} == {call: row[call] for call in events}
        assert table[AxisEvent.FAULT] is S.ERRORSTOP
    assert set(TRANSITIONS) == set(S) - {S.UNDEFINED, S.SYNCHRONIZED_MOTION}


@pytest.mark.parametrize(
    ("call", "situation"),
    [("absolute", "standstill"), ("halt", "continuous"), ("stop", "discrete"), ("home", "standstill")],
)
def test_at_rest_the_axis_returns_to_standstill(call: str, situation: str) -> None:
    run, x = reach(situation)
    command = CALLS[call](x)
    finish(run, command)
    assert command.done
    assert state_of(x) is S.STANDSTILL
    assert (x.set_velocity, x.set_acceleration) == (0.0, 0.0)
    assert x.command is None


def test_a_stop_holds_its_lock_until_rest() -> None:
    run, x = reach("continuous")
    stop = x.stop()
    refused = 0
    while stop.busy:
        assert error_of(x.move_absolute(0.0)) is E.LOCKED_BY_STOP
        refused += 1
        run.step()
    assert refused > 50
    assert x.set_velocity == 0.0
    assert x.move_absolute(0.0).busy


@pytest.mark.parametrize(("situation", "state"), [("error at rest", S.STANDSTILL), ("error without power", S.DISABLED)])
def test_reset_at_rest_takes_a_tick(situation: str, state: AxisState) -> None:
    run, x = reach(situation)
    reset = x.reset()
    assert (reset.busy, state_of(x)) == (True, S.ERRORSTOP)
    assert error_of(x.move_absolute(10.0)) is ERR
    assert finish(run, reset) == 1
    assert (state_of(x), x.error) == (state, None)


def test_reset_in_motion_waits_for_rest() -> None:
    run, x = reach("error in motion")
    assert x.set_velocity > 0.0
    first = x.reset()
    run.step()
    second = x.reset()
    assert first.aborted
    assert first.by is second
    finish(run, second)
    assert second.done
    assert (x.set_velocity, x.state, x.error) == (0.0, S.STANDSTILL, None)
    assert x.move_absolute(0.0).busy


def test_reset_without_an_error_leaves_the_motion_alone() -> None:
    run, x = reach("discrete")
    move = x.command
    assert move is not None
    reset = x.reset()
    run.step(2)
    assert reset.done
    assert x.command is move
    finish(run, move)
    assert x.set_position == 300.0


def test_error_in_motion_brakes_with_the_maximum_dynamics_and_fails_the_command() -> None:
    run, x = ready()
    move = x.move_velocity(300.0, deceleration=500.0, jerk=5000.0)
    run.step(600)
    assert move.in_velocity
    x.fault(E.INTERNAL, "test")
    ticks = 0
    while x.set_velocity != 0.0:
        run.step()
        ticks += 1
    # from 300 at rest of acceleration: under J = 1e5 the peak sqrt(J v) = 5477 stays below D = 6000
    assert ticks == np.ceil(2.0 * np.sqrt(300.0 / 1e5) / 0.001)
    assert state_of(x) is S.ERRORSTOP


@pytest.mark.parametrize("call", ["absolute", "velocity", "home"])
def test_an_error_in_the_tick_in_which_a_motion_begins_leaves_the_axis_at_rest(call: str) -> None:
    run, x = reach("standstill")
    command = CALLS[call](x)
    x.fault(E.INTERNAL)
    run.step(100)
    assert error_of(command) is E.INTERNAL
    assert x.set_position == 0.0
    assert state_of(x) is S.ERRORSTOP


def test_direction_current_keeps_the_direction() -> None:
    run, x = ready()
    x.move_velocity(50.0, Direction.NEGATIVE)
    run.step(100)
    move = x.move_velocity(20.0, Direction.CURRENT)
    run.step(200)
    assert move.in_velocity
    assert x.set_velocity == -20.0
