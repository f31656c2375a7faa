"""What a command asked for against the plans that serve it: each thing a trace could tell wrongly is found."""

import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from motionlayer import Direction, Machine, Simulation, Trace
from motionlayer.command import ErrorId
from motionlayer.event import Event, Kind
from motionlayer.nc import BufferMode, JogMode
from motionlayer.record import Plan
from motionlayer.verify import assert_valid, verify
from tests.machines import ready

from .bench import DISABLED, ERRORSTOP, STOPPING, changed

AXIS: dict[str, Any] = {"max_velocity": 500.0, "max_acceleration": 5000.0, "max_jerk": 1e5, "velocity": 200.0}
BLEND = BufferMode.BLENDING_LOW


def _run(**axis: Any) -> Simulation:
    run = Simulation(Machine.from_dict({"format": 1, "name": "m", "axis": {"X": {**AXIS, **axis}}}))
    run.axes["X"].enable()
    run.step(3)
    return run


@cache
def chain() -> Trace:
    """Two blended moves, a relative, a buffered additive and a modulo one, a shift in motion, an endless end."""
    run = _run()
    x = run.axes["X"]
    x.move_absolute(50.0, velocity=100.0)
    run.step(20)
    x.move_absolute(90.0, buffer_mode=BLEND, blending_position=40.0, jerk=5e4)
    run.step(700)
    x.move_relative(-30.0, acceleration=1000.0)
    run.step(50)
    x.move_additive(10.0, buffer_mode=BufferMode.BUFFERED)
    run.step(600)
    x.move_modulo(10.0, Direction.POSITIVE)
    run.step(100)
    x.define_position(5.0, relative=True)
    run.step(2500)
    x.move_continuous_absolute(500.0, 80.0)
    run.step(400)
    x.move_velocity(120.0, Direction.NEGATIVE)
    run.step(200)
    assert_valid(run.trace)
    return run.trace


def _messages(trace: Trace) -> str:
    return "; ".join(f"{finding.rule}: {finding.message}" for finding in verify(trace).findings)


def _told(trace: Trace, old: str, new: str) -> Trace:
    """Return the trace with another text of the one message that holds `old`."""
    hits = [event for event in trace.events if event.kind == Kind.ACCEPTED and old in event.text]
    assert len(hits) == 1
    return changed(trace, events=tuple(_retold(event, old, new) if event in hits else event for event in trace.events))


def _retold(event: Event, old: str, new: str) -> Event:
    return event._replace(text=event.text.replace(old, new))


WRONG = [
    ("position=50.0", "position=50.001", "leads to another place"),
    ("position=90.0", "position=-90.0", "leads to another place"),
    ("blending_position=40.0", "blending_position=40.1", "leads to another place"),
    ("distance=-30.0", "distance=-30.00001", "leads to another place"),
    ("distance=10.0", "distance=10.001", "leads to another place"),
    ("position=10.0, direction=POSITIVE", "position=11.0, direction=POSITIVE", "leads to another place"),
    ("position=10.0, direction=POSITIVE", "position=10.0, direction=NEGATIVE", "leads to another place"),
    ("position=10.0, direction=POSITIVE", "position=370.0, direction=POSITIVE", "leads to another place"),
    ("position=10.0, direction=POSITIVE", "position=10.0, direction=SHORTEST_WAY", "leads to another place"),
    ("velocity=100.0", "velocity=100.1", "the velocity limit is not"),
    (", acceleration=1000.0", "", "the acceleration is not"),
    ("jerk=50000.0", "jerk=50001.0", "the jerk is not"),
    ("end_velocity=80.0", "end_velocity=80.01", "goes on otherwise"),
    ("velocity=120.0", "velocity=119.0", "goes on otherwise"),
    ("direction=NEGATIVE", "direction=POSITIVE", "goes on otherwise"),
    (", buffer_mode=BUFFERED", "", "begins inside a cycle: "),
    ("buffer_mode=BLENDING_LOW", "buffer_mode=BUFFERED", "begins inside a cycle in motion"),
    ("buffer_mode=BLENDING_LOW", "buffer_mode=BUFFERED", "no other one waits to take over in motion"),
    ("define_position(position=5.0", "define_position(position=5.001", "not the one that was asked for"),
    ("define_position(", "passes(", "nothing asked for a new position"),
    ("move_velocity(", "halt(", "a plan of kind velocity serves"),
    ("move_relative(distance=-30.0", "reset(", "tells of no motion"),
]


@pytest.mark.parametrize(("old", "new", "text"), WRONG)
def test_a_plan_that_does_not_do_what_was_asked_is_found(old: str, new: str, text: str) -> None:
    assert text in _messages(_told(chain(), old, new))


def _planned(trace: Trace, which: Callable[[Plan], bool], **fields: Any) -> Trace:
    plans = tuple(replace(plan, **fields) if which(plan) else plan for plan in trace.plans)
    assert plans != trace.plans
    return changed(trace, plans=plans)


@pytest.mark.parametrize("limit", ["velocity", "acceleration", "deceleration", "jerk"])
def test_a_shift_shows_the_limits_of_the_motion_that_goes_on(limit: str) -> None:
    trace = chain()
    shown = next(plan for plan in trace.plans if plan.kind == "shift")
    wrong = _planned(trace, lambda plan: plan.kind == "shift", **{limit: 0.9 * getattr(shown, limit)})
    assert "the shift shows another command or limit" in _messages(wrong)


def test_only_a_jog_brakes_in_the_motion_it_began() -> None:
    run = _run()
    jog = run.axes["X"].jog(Direction.POSITIVE, JogMode.CONTINUOUS, velocity=100.0)
    run.step(100)
    jog.release()
    run.step(100)
    trace = run.trace
    assert jog.done
    assert_valid(trace)
    other = _told(trace, "jog(direction=POSITIVE, mode=CONTINUOUS", "move_velocity(direction=POSITIVE")
    assert "a plan of kind stop serves" in _messages(other)


def test_a_jog_leads_as_far_as_its_step_and_the_right_way() -> None:
    run = _run(manual={"forward": 3.0})
    run.axes["X"].jog(Direction.POSITIVE, JogMode.INCHING)
    run.step(400)
    run.axes["X"].jog(Direction.POSITIVE, JogMode.INCHING_MODULO, step=2.5)
    run.step(400)
    trace = run.trace
    assert trace["X.set_position"][-1] == 5.0
    assert_valid(trace)
    for old, new in (("step=3.0", "step=3.1"), ("step=2.5", "step=2.6"), ("step=2.5", "step=1.0")):
        assert "leads to another place" in _messages(_told(trace, old, new))


def test_a_jog_in_motion_leads_to_a_multiple_of_the_coordinate_that_it_was_given_in() -> None:
    """A shift in the tick in which it begins comes behind it: the multiple is shifted, not looked for again."""
    run = _run()
    x = run.axes["X"]
    x.move_absolute(300.0)
    run.step(60)
    jog = x.jog(Direction.POSITIVE, JogMode.INCHING_MODULO, step=70.0, velocity=100.0)
    x.define_position(33.0, relative=True)
    run.step(1500)
    assert jog.done
    assert x.set_position == pytest.approx(103.0, abs=1e-9)
    assert_valid(run.trace)
    for old, new in (
        ("step=70.0", "step=71.0"),
        ("step=70.0", "step=7.0"),
        ("direction=POSITIVE", "direction=NEGATIVE"),
    ):
        assert "leads to another place" in _messages(_told(run.trace, old, new))


@pytest.mark.parametrize("way", [Direction.POSITIVE, Direction.CURRENT, Direction.SHORTEST_WAY])
def test_a_modulo_move_in_motion_takes_the_first_orientation_that_it_can_rest_at(way: Direction) -> None:
    run = _run(max_deceleration=2000.0)
    x = run.axes["X"]
    x.move_velocity(300.0)
    run.step(450)
    assert 95.0 < x.set_position < 130.0
    move = x.move_modulo(150.0, way, velocity=300.0, deceleration=500.0)
    x.define_position(40.0, relative=True)
    run.step(3000)
    assert move.done
    assert x.set_position == pytest.approx(190.0, abs=1e-9)
    assert_valid(run.trace)
    for other in ("position=151.0", "position=149.0"):
        assert "leads to another place" in _messages(_told(run.trace, "position=150.0", other))
    axis = run.trace.header["machine"]["axis"]["X"] | {"modulo": {"period": 3.0, "tolerance": 0.0}}
    header = {**run.trace.header, "machine": {"axis": {"X": axis}}}  # it could have come to rest some turns before
    assert "leads to another place" in _messages(changed(run.trace, header=header))
    if way is Direction.POSITIVE:
        assert "leads to another place" in _messages(
            _told(run.trace, "150.0, direction=POSITIVE", "150.0, direction=NEGATIVE")
        )


def test_a_command_counts_as_the_last_one_if_it_was_active_and_replaced_before_it_moved() -> None:
    run = _run()
    x = run.axes["X"]
    first = x.move_absolute(20.0)
    second = x.move_relative(30.0, buffer_mode=BufferMode.BUFFERED)
    x.set_override(0.5)
    while first.busy:
        x.set_override(0.0 if x.set_position > 19.0 and x.override else x.override or 0.5)
        run.step()
    assert second.active
    x.halt()
    run.step(5)
    x.move_additive(7.0)
    run.step(600)
    assert x.set_position == pytest.approx(57.0, abs=1e-9)
    assert second.aborted
    assert_valid(run.trace)
    assert "leads to another place" in _messages(_told(run.trace, "distance=30.0", "distance=31.0"))


@pytest.mark.parametrize("call", ["move_absolute", "move_velocity"])
def test_what_the_override_holds_is_not_done(call: str) -> None:
    run = _run()
    x = run.axes["X"]
    getattr(x, call)(100.0)
    run.step(100)
    x.set_override(0.0)
    run.step(300)
    x.halt()
    run.step(5)
    assert_valid(run.trace)
    wrong = tuple(
        event._replace(kind=Kind.DONE) if event.kind == Kind.ABORTED and call in event.text else event
        for event in run.trace.events
    )
    assert "is done where the override held it" in _messages(changed(run.trace, events=wrong))


@pytest.mark.parametrize("mode", ["switch", "cam", "index"])
def test_each_search_of_a_homing_has_the_velocity_of_the_machine_description(mode: str) -> None:
    home = {"mode": mode, "switch": -10.0, "velocity": 50.0, "sync_velocity": 20.0, "pulse_period": 4.0}
    run = _run(home=home)
    command = run.axes["X"].home(0.0)
    run.step(1500)
    trace = run.trace
    assert command.done
    assert_valid(trace)
    searches = [plan for plan in trace.plans if plan.kind == "velocity"]
    assert {abs(plan.target) for plan in searches} == ({50.0} if mode == "switch" else {50.0, 20.0})
    for plan in searches:
        header = {**trace.header, "machine": {**trace.header["machine"]}}
        key = "velocity" if abs(plan.target) == 50.0 else "sync_velocity"
        axis = trace.header["machine"]["axis"]["X"]
        header["machine"]["axis"] = {"X": {**axis, "home": {**axis["home"], key: abs(plan.target) + 1.0}}}
        assert "the velocity limit is not what" in _messages(changed(trace, header=header))


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("search_velocity=60.0", "search_velocity=70.0"),
        (", search_velocity=60.0", ""),
        ("sync_velocity=5.0", "sync_velocity=6.0"),
        ("search_direction=POSITIVE", "search_direction=NEGATIVE"),
        ("search_direction=POSITIVE", "search_direction=POSITIVE, sync_direction=POSITIVE"),
    ],
)
def test_a_homing_that_asks_for_its_own_searches_does_them(old: str, new: str) -> None:
    """The switch is at +50, the description searches it at -50: the call says otherwise, and is held to it."""
    run, x = ready(home={"mode": "cam", "switch": -50.0, "velocity": 40.0})
    home = x.home(search_direction=Direction.POSITIVE, search_velocity=60.0, sync_velocity=5.0)
    while home.busy:
        assert run.tick < 10_000, "the homing did not end"
        home.cam(on=x.actual_position >= 50.0)
        run.step()
    run.step(2)
    assert home.done
    assert_valid(run.trace)
    assert "goes on otherwise than it asked for" in _messages(_told(run.trace, old, new))


def test_a_step_in_the_cycle_of_a_joint_is_found() -> None:
    """The plans may part there by what a plan is allowed beside its target, and by no more."""
    trace = chain()
    inside = [plan.tick + 1 for plan in trace.plans if plan.offset < 0.0]
    assert len(inside) > 1
    for name, step in (("X.set_position", 1e-5), ("X.set_velocity", 0.03), ("X.set_acceleration", 200.0)):
        for row in inside:
            values = trace[name].copy()
            values[row:] += step
            rules = {finding.rule for finding in verify(trace.replace({name: values})).findings}
            assert {"set value", "sample step"} <= rules


def test_power_may_be_asked_for_between_two_ticks() -> None:
    """The drive answers in the inputs of the next tick: the very one in which the command is accepted."""
    run = Simulation(Machine.from_dict({"format": 1, "name": "m", "axis": {"X": AXIS}}))
    run.step(5)
    run.axes["X"].enable()
    run.step(5)
    trace = run.trace
    assert trace["X.ready"].tolist() == [0.0] * 5 + [1.0] * 5
    assert_valid(trace)
    other = _told(trace, "enable(", "reset(")
    assert "nobody asked for" in _messages(other)
    enable = trace["X.enable"].copy()
    enable[5] = 0.0
    assert "nobody asked for" in _messages(trace.replace({"X.enable": enable}))


def test_a_number_in_a_message_reads_back_exactly() -> None:
    run = _run()
    run.axes["X"].move_absolute(1.0 / 3.0, velocity=np.nextafter(7.0, 8.0))
    text = run.trace.events[-1].text
    assert [float(one) for one in re.findall(r"=([-0-9.e]+)", text)] == [1.0 / 3.0, float(np.nextafter(7.0, 8.0))]


def test_a_brake_that_serves_no_command_is_that_of_an_error() -> None:
    """An axis cannot have been Stopping in the tick in which an error brakes it."""
    run = _run()
    run.axes["X"].move_absolute(300.0)
    run.step(100)
    run.axes["X"].stop()
    run.axes["X"].fault(ErrorId.PARAMETER, "on purpose")
    tick = run.tick
    run.step(100)
    trace = run.trace
    assert_valid(trace)
    state = trace["X.state"].copy()
    assert state[tick] == ERRORSTOP
    state[tick] = STOPPING
    assert "a brake serves no command" in _messages(trace.replace({"X.state": state}))


def test_a_motion_that_never_had_a_plan_is_found() -> None:
    """A stop with the same limits as the one before it goes on as that did: only its own plan tells of it."""
    run = _run()
    run.axes["X"].move_absolute(300.0)
    run.step(100)
    run.axes["X"].stop(deceleration=5000.0, jerk=1e5)
    run.step(5)
    again = run.axes["X"].emergency_stop()
    run.step(200)
    assert again.done
    assert_valid(run.trace)
    plans = tuple(plan for plan in run.trace.plans if plan.command != again.number)
    assert "no plan serves command" in _messages(changed(run.trace, plans=plans))


@pytest.mark.parametrize("by", ["reset()", "enable()", "define_position(position=0.0)"])
def test_a_motion_is_aborted_by_what_replaces_it_alone(by: str) -> None:
    run = _run()
    run.axes["X"].move_absolute(300.0)
    run.step(100)
    run.axes["X"].halt()
    run.step(200)
    assert_valid(run.trace)
    assert "nothing that replaces it was accepted" in _messages(_told(run.trace, "halt(", by[:-1] + ", "))


def test_in_disabled_every_motion_has_ended() -> None:
    run = _run()
    run.axes["X"].move_absolute(20.0)
    run.step(20)
    run.axes["X"].disable(buffer_mode=BufferMode.BUFFERED)
    run.step(600)
    trace = run.trace
    assert trace["X.state"][-1] == DISABLED
    assert_valid(trace)
    silent = tuple(one for one in trace.events if not (one.kind == Kind.DONE and "move_absolute" in one.text))
    assert "the axis is in DISABLED, and command" in _messages(changed(trace, events=silent))


@pytest.mark.parametrize("shifts", [(7.0,), (7.0, -2.5)])
@pytest.mark.parametrize("before", ["home", "define_position", ""])
def test_what_is_redefined_and_then_shifted_in_one_tick_is_told_apart(before: str, shifts: tuple[float, ...]) -> None:
    """The trace keeps the shift alone; how far that was, the commands tell."""
    run = _run(start_position=-40.0)
    x = run.axes["X"]
    x.move_absolute(-30.0)
    run.step(500)
    if before == "home":
        x.home(3.0)
    elif before:
        x.define_position(11.0, relative=True)
    move = x.move_absolute(92.0)
    for shift in shifts:
        x.define_position(shift, relative=True)
    run.step(1500)
    assert move.done
    assert x.set_position == 92.0 + sum(shifts)
    assert_valid(run.trace)
    assert "another place" in _messages(_told(run.trace, "position=92.0", "position=92.1"))


def test_an_additive_move_behind_a_redefinition_at_rest_counts_from_there_also_before_a_shift() -> None:
    """The trace keeps the shift alone; the last commanded target is that of before the redefinition no more."""
    run = _run()
    x = run.axes["X"]
    x.move_absolute(80.0)
    run.step(600)
    x.move_absolute(20.0)
    run.step(100)
    x.halt()
    run.step(300)
    x.define_position(0.0)
    move = x.move_additive(50.0)
    x.define_position(7.0, relative=True)
    run.step(1000)
    assert move.done
    assert x.set_position == pytest.approx(57.0)
    assert_valid(run.trace)
    assert "another place" in _messages(_told(run.trace, "distance=50.0", "distance=50.1"))


def test_only_what_was_held_before_a_joint_has_the_brake_of_the_one_behind() -> None:
    run, x = ready(software_limit_max=None)
    x.move_absolute(200.0, velocity=400.0, deceleration=300.0)
    x.move_absolute(350.0, velocity=400.0, buffer_mode=BufferMode.BLENDING_HIGH)
    run.step(500)
    assert 100.0 < x.set_position < 200.0
    x.set_override(0.0)
    run.step(300)
    x.set_override(1.0)
    run.step(2000)
    trace = run.trace
    assert_valid(trace)
    strong = _planned(trace, lambda plan: plan.kind == "passing", deceleration=6000.0)
    assert "the deceleration is not what command" in _messages(strong)
