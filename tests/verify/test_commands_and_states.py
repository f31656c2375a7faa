"""Life of commands and order of states: what does not fit is noticed."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from motionlayer.event import Event, Kind, Level
from motionlayer.record import Trace
from motionlayer.verify import assert_valid, verify
from tests.effort import examples, thinned

from .bench import CONTINUOUS, DISABLED, DISCRETE, ERRORSTOP, HOMING, STANDSTILL, STOPPING, Bench, changed
from .planner import to_position
from .scenarios import axis, recorded

EVENTS = range(len(recorded("mm").events))


def _rules(trace: Trace) -> set[str]:
    return {finding.rule for finding in verify(trace).findings}


@pytest.mark.parametrize("index", EVENTS)
def test_a_missing_event_is_found(index: int) -> None:
    events = recorded("mm").events
    findings = verify(changed(recorded("mm"), events=events[:index] + events[index + 1 :])).findings
    # Without its end a command that nothing follows is one that still runs; enabling moves nothing.
    assert findings or events[index].command == 1


@pytest.mark.parametrize("index", EVENTS)
def test_a_doubled_event_is_found(index: int) -> None:
    events = recorded("mm").events
    if events[index].kind == Kind.MESSAGE:
        return  # it can be said twice
    assert _rules(changed(recorded("mm"), events=events[: index + 1] + events[index:])) == {"command life"}


@pytest.mark.parametrize("index", EVENTS)
@pytest.mark.parametrize("kind", thinned(list(Kind), 2))
def test_an_event_of_another_kind_is_found(index: int, kind: Kind) -> None:
    trace, event = recorded("mm"), recorded("mm").events[index]
    ends = {Kind.DONE, Kind.ABORTED, Kind.ERROR}
    if kind == event.kind or event.command == 1 or (event.kind in ends and kind in ends - {Kind.DONE}):
        return  # nothing but the event tells an abortion from an error
    events = (*trace.events[:index], event._replace(kind=kind), *trace.events[index + 1 :])
    assert _rules(changed(trace, events=events))


def test_a_refused_command_has_no_other_event() -> None:
    trace = recorded("mm")
    refused = Event(50, Level.WARNING, Kind.REFUSED, "X", "", 0x4222, 77)
    events = sorted([*trace.events, refused], key=lambda event: event.tick)
    assert_valid(changed(trace, events=events))
    events = sorted([*trace.events, refused, refused._replace(kind=Kind.DONE)], key=lambda event: event.tick)
    assert _rules(changed(trace, events=events)) == {"command life"}


def test_events_out_of_order_are_found() -> None:
    trace = recorded("mm")
    messages = [Event(tick, Level.INFO, Kind.MESSAGE, "X", "hello") for tick in (9, 8)]
    assert _rules(changed(trace, events=(*messages, *trace.events))) == {"command life"}


def test_done_beside_the_target_is_found() -> None:
    trace = recorded("mm")
    index = next(i for i, e in enumerate(trace.events) if e.kind == Kind.DONE and e.command == 2)
    early = trace.events[index]._replace(tick=trace.events[index].tick - 1)
    assert "done" in _rules(changed(trace, events=(*trace.events[:index], early, *trace.events[index + 1 :])))


def _with_state(trace: Trace, row: int, state: float) -> Trace:
    values = trace["X.state"].copy()
    values[row] = state
    return trace.replace({"X.state": values})


@settings(max_examples=examples(300), deadline=None)
@given(st.integers(0, len(recorded("mm").ticks) - 2), st.sampled_from([0.0, 2.5, *map(float, range(1, 10))]))
def test_a_changed_state_is_found_where_the_axis_moves(row: int, state: float) -> None:
    trace = recorded("mm")
    before, after = trace["X.state"][row : row + 2]
    assume(state != before and trace["X.set_velocity"][row : row + 2].any())
    assume((before, state) != (STOPPING, DISCRETE))  # a halt, and in the next row a stop
    assume(state != ERRORSTOP or after not in {ERRORSTOP, STANDSTILL})  # an error, and a reset
    assert _rules(_with_state(trace, row, state)), (before, row)


@pytest.mark.parametrize("state", [0, *range(2, 10)])
def test_a_run_begins_disabled(state: int) -> None:
    legal = state in {STANDSTILL, HOMING, ERRORSTOP}  # at rest, by commands given before the very first tick
    assert legal or _rules(_with_state(recorded("mm"), 0, state))


def test_a_coordinate_is_not_redefined_in_motion_states() -> None:
    bench = Bench()
    bench.enable()
    bench.home(3.0)
    bench.state = DISCRETE
    bench.run()
    bench.run(1)
    assert _rules(bench.trace()) == {"state and plan"}


SEQUENCES = [
    [DISABLED, STANDSTILL],
    [DISABLED, DISCRETE],
    [DISABLED, ERRORSTOP, DISABLED],
    [STANDSTILL, DISCRETE, STANDSTILL],
    [STANDSTILL, STOPPING, STANDSTILL],
    [STANDSTILL, CONTINUOUS, STANDSTILL],
    [ERRORSTOP, STANDSTILL],
    [ERRORSTOP, DISCRETE],
    [STOPPING, CONTINUOUS],
]


@pytest.mark.parametrize("states", SEQUENCES)
def test_order_of_states_at_rest(states: list[int]) -> None:
    """Commands take no time: at rest any state may follow in the next row, and what caused it is asked by itself."""
    bench = Bench()
    bench.accept()
    for state in [*([] if states[0] == DISABLED else [DISABLED, STANDSTILL]), *states]:
        bench.state = state
        bench._step()
        bench.open = 1
    trace = changed(bench.trace(), events=(Event(0, Level.INFO, Kind.ACCEPTED, "X", "", 0, 1),))
    assert "state order" not in _rules(trace)


def test_a_state_change_without_a_command_is_found() -> None:
    bench = Bench()
    bench.run(2)
    bench.state, bench.asked, bench.ready = STANDSTILL, True, True
    bench.run(2)
    assert _rules(bench.trace()) == {"state cause", "power"}


def test_motion_that_does_not_fit_the_state_is_found() -> None:
    bench = axis("mm")
    bench.enable()
    bench.move_velocity(100.0)
    bench.state = DISCRETE
    bench.run(30)
    assert _rules(bench.trace()) == {"state and plan"}


@pytest.mark.parametrize(("target", "rules"), [(5.0, set()), (4.0, {"state and plan", "command target"})])
def test_an_endless_motion_may_end_at_a_software_limit_only(target: float, rules: set[str]) -> None:
    bench = Bench(soft=(-1.0, 5.0))
    bench.enable()
    bench.accept("move_velocity(direction=POSITIVE)", velocity=bench.maxima.velocity)
    bench.state = CONTINUOUS
    bench._plan("position", target, to_position(bench.now, target, bench.maxima))
    bench.run(20)
    assert _rules(bench.trace()) == rules


def test_motion_at_rest_is_found() -> None:
    bench = axis("mm")
    bench.enable()
    bench.move(1.0)
    bench.state = STANDSTILL
    bench.run()
    assert "motion at rest" in _rules(bench.trace())


def test_the_first_cycle_of_a_motion_is_no_rest() -> None:
    trace = recorded("mm")
    row = int(np.flatnonzero(trace["X.state"] == DISCRETE)[0])
    assert trace["X.set_velocity"][row] == 0.0
    assert "motion at rest" in _rules(_with_state(trace, row, STANDSTILL))
