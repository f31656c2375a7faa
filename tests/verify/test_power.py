"""Power: who asks for it, who gets it, and that no drive runs after a set position it has not stood at."""

import numpy as np
import pytest

from motionlayer import Fault, Machine, Simulation, Trace
from motionlayer.command import ErrorId
from motionlayer.event import Event, Kind, Level
from motionlayer.verify import assert_valid, verify

from .bench import DISABLED, ERRORSTOP, STANDSTILL, Bench, changed


def _rules(trace: Trace) -> set[str]:
    return {finding.rule for finding in verify(trace).findings}


def _messages(trace: Trace) -> str:
    return "; ".join(finding.message for finding in verify(trace).findings)


@pytest.fixture(scope="module")
def back() -> Trace:
    """A servo in error that loses its power while it brakes, and is offered it again."""
    axis = {"max_velocity": 500.0, "max_acceleration": 5000.0, "max_jerk": 1e5}
    machine = {"format": 1, "name": "m", "axis": {"X": {**axis, "drive": {"kind": "servo", "position_gain": 20.0}}}}
    run = Simulation(Machine.from_dict(machine))
    x = run.axes["X"]
    x.enable()
    run.step(3)
    x.move_absolute(400.0)
    run.step(500)
    x.fault(ErrorId.PARAMETER, "on purpose")
    run.inject("X", Fault("lost_enable", duration=0.2), tick=run.tick + 1)
    run.step(600)
    return run.trace


def test_an_axis_in_error_that_lost_its_power_does_not_leap_when_it_could_have_it_again(back: Trace) -> None:
    """Its drive would go to the set position, from which it has parted, while the axis is in ErrorStop."""
    assert_valid(back)
    stands = back["X.actual_position"][800:]
    assert back["X.state"][-1] == ERRORSTOP
    assert abs(stands[0] - back["X.set_position"][-1]) > 10.0
    assert np.ptp(stands) == 0.0


@pytest.mark.parametrize("asked", [False, True])
def test_power_that_comes_back_in_error_is_found(back: Trace, *, asked: bool) -> None:
    """Without having been asked for, and where the drive does not stand at its set position."""
    enable, ready = back["X.enable"].copy(), back["X.ready"].copy()
    ready[900:] = 1.0
    if asked:
        enable[500:] = 1.0
    trace = back.replace({"X.enable": enable, "X.ready": ready})
    assert _rules(trace) == {"power"}
    assert "set position is not the actual one" in _messages(trace)
    assert ("nobody asked for" in _messages(trace)) is not asked


def test_who_waits_for_power_asks_again_once_the_setpoint_rests() -> None:
    """The drive stands, and could have its power back, while the setpoint still brakes elsewhere."""
    drive = {"kind": "servo", "position_gain": 20.0, "brake_deceleration": 50000.0}
    axis = {"max_velocity": 500.0, "max_acceleration": 500.0, "max_jerk": 1e5, "drive": drive}
    run = Simulation(Machine.from_dict({"format": 1, "name": "m", "axis": {"X": axis}}))
    x = run.axes["X"]
    x.enable()
    run.step(3)
    x.move_velocity(300.0)
    run.step(1000)
    waits = x.enable(positive=False)
    x.fault(ErrorId.PARAMETER, "on purpose")
    run.inject("X", Fault("lost_enable", duration=0.05), tick=run.tick + 10)
    run.step(100)
    assert x.set_velocity > 0.0
    assert waits.busy
    run.step(1000)
    trace = run.trace
    assert (trace["X.ready"][1100], trace["X.enable"][1100]) == (0.0, 0.0)
    assert waits.error is not None
    assert (trace["X.ready"][-1], x.set_position) == (1.0, x.actual_position)
    assert_valid(trace)
    silent = tuple(one for one in trace.events if one.command != waits.number)
    assert "power is asked for without a command" in _messages(changed(trace, events=silent))


def _resting() -> Bench:
    bench = Bench()
    bench.enable()
    bench.run(3)
    return bench


def test_an_axis_does_not_come_back_to_standstill_by_itself() -> None:
    bench = _resting()
    bench.state, bench.ready = DISABLED, False
    bench.run(3)
    bench.state, bench.ready = STANDSTILL, True
    bench.run(3)
    trace = bench.trace()
    assert _rules(trace) == {"state cause", "power"}
    assert "lost, and no error follows" in _messages(trace)


@pytest.mark.parametrize(
    ("attributes", "text"),
    [
        ({"ready": False}, "without power in this state"),
        ({"asked": False}, "taken away without a disable() or an error"),
        ({"state": DISABLED}, "is Disabled and its drive has power"),
    ],
)
def test_power_and_state_fit_one_another(attributes: dict[str, int], text: str) -> None:
    bench = _resting()
    for name, value in attributes.items():
        setattr(bench, name, value)
    bench.run(3)
    assert text in _messages(bench.trace())


def test_an_error_of_the_axis_and_errorstop_belong_together() -> None:
    bench = _resting()
    bench.fault()
    bench.run(5)
    trace = bench.trace()
    assert_valid(trace)
    silent = changed(trace, events=tuple(event for event in trace.events if event.kind != Kind.MESSAGE))
    assert "ErrorStop without an error" in _messages(silent)
    bench.state = STANDSTILL
    bench.run(3)
    assert "left without a reset" in _messages(bench.trace())
    quiet = _resting()
    told = Event(3, Level.ERROR, Kind.MESSAGE, "X", "", 0x4550, 0)
    assert "no ErrorStop follows" in _messages(changed(quiet.trace(), events=(*quiet.trace().events, told)))


def test_a_command_that_waits_for_ever_hides_no_change_of_state() -> None:
    """As one that waits for a position: it moves nothing, and says nothing about what does."""
    bench = _resting()
    bench.accept()
    bench.run(5)
    bench.state = 6
    bench.run(3)
    trace = bench.trace()
    assert _rules(trace) == {"state cause"}
    assert "without a command that was just accepted" in _messages(trace)


def test_power_that_is_taken_away_while_only_an_enable_is_under_way_is_found() -> None:
    """Found by the campaign `mutation`: the enable that waits for a brake counted as a reason."""
    limits = {"max_velocity": 500.0, "max_acceleration": 5000.0, "max_jerk": 1e5}
    run = Simulation(Machine.from_dict({"format": 1, "name": "m", "axis": {"X": limits}}))
    x = run.axes["X"]
    x.enable()
    run.step(3)
    x.move_velocity(500.0)
    run.step(300)
    waits = x.enable(positive=False)
    run.step(20)
    assert waits.busy
    assert x.set_velocity > 100.0
    enable = run.trace["X.enable"].copy()
    enable[-10] = 0.0
    assert_valid(run.trace)
    assert "power is taken away without a disable()" in _messages(run.trace.replace({"X.enable": enable}))
