"""Where a homing finds its reference: at an edge of the switch, at a zero pulse, or where a program tells its cam."""

import copy
from functools import cache
from typing import Any

import pytest

from motionlayer import Direction, Machine, Simulation, Trace
from motionlayer.event import Kind
from motionlayer.verify import assert_valid, verify

from .bench import changed

AXIS: dict[str, Any] = {"max_velocity": 500.0, "max_acceleration": 5000.0, "max_jerk": 1e5, "velocity": 200.0}
RULE = "has found its reference where there is none"


@cache
def homed(mode: str) -> Trace:
    """A homing after a shift in motion and a redefinition without power, and a second one in the new coordinate."""
    home = {"mode": mode, "switch": -10.0, "velocity": 50.0, "sync_velocity": 20.0, "pulse_period": 4.0, "pulse": 1.5}
    axis = {**AXIS, "home": home, "start_position": 7.0}
    run = Simulation(Machine.from_dict({"format": 1, "name": "m", "axis": {"X": axis}}))
    x = run.axes["X"]
    run.step(3)
    x.define_position(100.0)
    run.step(2)
    x.enable()
    run.step(3)
    x.move_relative(20.0)
    run.step(40)
    x.define_position(-13.0, relative=True)
    run.step(600)
    for place in (3.0, -8.0):
        command = x.home(place)
        run.step(3000)
        assert command.done
    assert_valid(run.trace)
    return run.trace


def _messages(trace: Trace) -> str:
    return "; ".join(f"{finding.rule}: {finding.message}" for finding in verify(trace).findings)


def _home(trace: Trace, **home: Any) -> Trace:
    """Return the trace of another machine, whose homing is described otherwise."""
    header = copy.deepcopy(trace.header)
    header["machine"]["axis"]["X"]["home"].update(home)
    return changed(trace, header=header)


@pytest.mark.parametrize("mode", ["switch", "cam", "index"])
@pytest.mark.parametrize("place", ["position=3.0", "position=-8.0"])
def test_a_reference_beside_the_one_that_was_asked_for_is_found(mode: str, place: str) -> None:
    trace = homed(mode)
    hits = [event for event in trace.events if event.kind == Kind.ACCEPTED and f"home({place}" in event.text]
    assert len(hits) == 1
    told = hits[0]._replace(text=hits[0].text.replace(place, f"{place}001"))
    assert RULE in _messages(changed(trace, events=tuple(told if one is hits[0] else one for one in trace.events)))


@pytest.mark.parametrize(
    ("mode", "home"),
    [("switch", {"switch": -10.001}), ("cam", {"switch": -9.999}), ("index", {"pulse": 1.501})],
)
def test_a_reference_that_is_not_where_the_machine_has_it_is_found(mode: str, home: dict[str, float]) -> None:
    assert RULE in _messages(_home(homed(mode), **home))


def test_the_edges_of_a_cam_are_a_width_apart() -> None:
    """The far edge is where the width ends: not beside it."""
    trace = homed("cam")
    assert_valid(_home(trace, switch=-30.0, switch_width=20.0))
    assert RULE in _messages(_home(trace, switch=-30.0, switch_width=20.001))


def test_a_cam_that_a_program_reads_is_where_the_axis_is_in_a_tick() -> None:
    run = Simulation(
        Machine.from_dict(
            {
                "format": 1,
                "name": "m",
                "axis": {"X": {**AXIS, "home": {"mode": "cam", "switch": -50.0, "velocity": 40.0}}},
            }
        )
    )
    x = run.axes["X"]
    x.enable()
    run.step(3)
    home = x.home(5.0, search_direction=Direction.POSITIVE)
    while home.busy:
        assert run.tick < 10_000, "the homing did not end"
        home.cam(on=x.actual_position >= 50.0)
        run.step()
    run.step(2)
    assert home.done
    assert_valid(run.trace)
    told = tuple(one._replace(text=one.text.replace("position=5.0", "position=5.002")) for one in run.trace.events)
    assert RULE in _messages(changed(run.trace, events=told))
