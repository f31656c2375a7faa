"""`RealTime` is the run that `Simulation` makes, on a clock; what lateness does enters as a recorded input."""

import itertools
import os
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.cli.support import python
from tests.effort import examples
from tests.machines import LINEAR
from tests.runtime.clock import MS, FakeClock

from motionlayer import AxisState, CommandAborted, Machine, RealTime, Simulation
from motionlayer.event import Device, Event, Input, Level
from motionlayer.machine import MachineRun, _logging
from motionlayer.verify import assert_valid

QUIET = {"priority": 0, "lock_memory": False}
"""A real-time run that asks nothing of the computer which the other tests would notice."""

SERVO = {"kind": "servo", "position_gain": 80.0, "time_constant": 0.002, "noise": 0.001}


def machine(**changes: Any) -> Machine:
    axes = {"X": LINEAR, "Y": LINEAR | {"drive": SERVO}}
    return Machine.from_dict({"format": 1, "name": "test", "axis": axes, "realtime": QUIET} | changes)


def there_and_back(run: MachineRun) -> Any:
    async def program() -> None:
        x, y = run.axes["X"], run.axes["Y"]
        await x.enable()
        await y.enable()
        move = x.move_absolute(150.0)
        await y.move_absolute(90.0)
        await run.until(lambda: x.set_position > 100.0)
        x.move_absolute(20.0)
        await move.settled()
        await run.sleep(0.3)

    return program()


def late_events(run: MachineRun) -> list[Event]:
    return [event for event in run.events.last(Level.WARNING) if event.source == "runtime"]


class Slow:
    """A program that shuttles X, and lets time pass on the clock in some of its ticks."""

    def __init__(self, clock: FakeClock, works: dict[int, int]) -> None:
        self._clock = clock
        self._works = works

    async def __call__(self, run: MachineRun) -> None:
        x = run.axes["X"]
        await x.enable()
        move = x.move_absolute(300.0)
        for _ in range(400):
            self._clock.work(self._works.get(run.tick, 0))
            await run.sleep(0.0)
        await move.settled()


def recorded(run: MachineRun) -> list[Input]:
    found: list[Input] = []
    run.mailbox.listen(found.append)
    return found


def play_late(works: dict[int, int]) -> tuple[RealTime, list[Input]]:
    clock = FakeClock()
    run = RealTime(machine(), clock=clock)
    inputs = recorded(run)
    run.run(Slow(clock, works)(run))
    return run, inputs


def replayed(inputs: list[Input]) -> Simulation:
    run = Simulation(machine())
    run.mailbox.feed(inputs)
    run.run(Slow(FakeClock(), {})(run))
    return run


@settings(max_examples=examples(10), deadline=None)
@given(
    speed=st.sampled_from([0.01, 0.7, 1.0, 10.0, 1000.0]),
    delays=st.lists(st.integers(0, MS - 2000), min_size=1, max_size=50),
    seed=st.integers(0, 2**63 - 1),
)
def test_paced_without_lateness_gives_the_hash_of_the_simulation(speed: float, delays: list[int], seed: int) -> None:
    """With every speed, and however late within a tick the sleeps end."""
    found = iter(range(10**9))
    clock = FakeClock(oversleep=lambda: delays[next(found) % len(delays)])
    with RealTime(machine(), clock=clock, speed=speed, seed=seed) as paced:
        paced.run(there_and_back(paced))
        trace = paced.trace
    with Simulation(machine(), seed=seed) as simulated:
        simulated.run(there_and_back(simulated))
        assert simulated.trace.hash == trace.hash
    assert paced.statistics.overruns == 0
    assert paced.statistics.lateness.count == paced.statistics.compute.count == paced.tick
    assert_valid(trace)


def test_a_tick_takes_its_time() -> None:
    clock = FakeClock()
    with RealTime(machine(), clock=clock, speed=0.5) as run:
        before = clock.now
        run.run(time=2.0)
        assert clock.now - before == pytest.approx(1999 * 2 * MS, abs=10_000)
        before = clock.now
        clock.work(3600 * 1000 * MS)  # between two calls nothing is due
        run.step(11)
        assert clock.now - before == pytest.approx(3600 * 1000 * MS + 10 * 2 * MS, abs=10_000)
        assert run.statistics.overruns == 0


def test_a_few_late_ticks_are_a_warning_and_nothing_else() -> None:
    run, inputs = play_late({100: int(4.5 * MS)})
    (event,) = late_events(run)
    assert event.level is Level.WARNING
    assert event.tick == 101
    assert event.text == "3 ticks late, to be caught up; the slowest was programs, 4.500 ms"
    assert run.statistics.overruns == 3
    assert [one.tick for one in inputs] == [101]
    assert run.axes["X"].set_position == 300.0
    assert_valid(run.trace)


def test_time_slips_with_a_warning() -> None:
    run, _ = play_late({100: int(8.5 * MS)})
    (event,) = late_events(run)
    assert (event.level, event.tick) == (Level.WARNING, 101)
    assert event.text == "7 ticks late, more than 5: time slipped; the slowest was programs, 8.500 ms"
    assert run.statistics.slips == 1
    assert run.statistics.slipped == pytest.approx(0.008)
    assert run.axes["X"].set_position == 300.0
    assert_valid(run.trace)


def test_more_than_ten_late_ticks_brake_all_axes_and_a_replay_does_the_same() -> None:
    run, inputs = play_late({100: int(12.5 * MS), 250: 2 * MS})
    x = run.axes["X"]
    (event,) = [event for event in late_events(run) if event.level is Level.ERROR]
    assert event.tick == 101
    assert event.text == "11 ticks late, more than 10: all axes brake; the slowest was programs, 12.500 ms"
    assert x.state is AxisState.STANDSTILL
    assert x.set_position < 100.0
    assert run.trace.inputs == tuple(inputs)
    again = replayed(inputs)
    assert again.trace.hash == run.trace.hash
    assert replayed([]).trace.hash != run.trace.hash
    assert_valid(run.trace)


def test_axes_that_brake_because_of_lateness_come_to_rest_though_the_only_program_fails() -> None:
    clock = FakeClock()
    run = RealTime(machine(), clock=clock)
    x, y = run.axes.values()

    async def leaves() -> None:
        await y.enable()
        y.move_velocity(400.0)

    async def shuttle() -> None:
        await x.enable()
        move = x.move_absolute(300.0)
        await run.sleep(0.1)
        clock.work(1000 * MS)  # as SIGSTOP does, and SIGCONT a second later
        await move

    run.start(leaves())
    with pytest.raises(CommandAborted):
        run.run(shuttle())
    assert [axis.state for axis in (x, y)] == [AxisState.STANDSTILL] * 2
    assert x.set_velocity == y.set_velocity == 0.0
    assert_valid(run.trace)


def test_messages_about_lateness_are_of_the_main_program() -> None:
    run, _ = play_late({100: int(12.5 * MS)})
    assert [event.device for event in late_events(run)] == [Device.Device_Main]


def test_a_suspended_computer_brakes_once_and_goes_on() -> None:
    nights = iter([*[0] * 50, 8 * 3600 * 1000 * MS])
    clock = FakeClock(oversleep=lambda: next(nights, 0))
    run = RealTime(machine(), clock=clock)
    run.run(Slow(clock, {})(run))
    (event,) = late_events(run)
    assert event.text == (
        f"{8 * 3600 * 1000} ticks late, more than 10: all axes brake; "
        "no part of the cycle was slow, but the computer itself: busy, or asleep"
    )
    assert run.statistics.slips == 1
    assert_valid(run.trace)


def test_a_slow_task_is_named() -> None:
    clock = FakeClock()
    run = RealTime(machine(task={"vision": {"every": 10, "phase": 0}}), clock=clock)

    def look(run: MachineRun) -> None:
        clock.work(13 * MS if run.tick == 50 else 1000)

    run.cyclic(look, task="vision")
    run.run(time=0.1)
    (event,) = late_events(run)
    assert event.text.endswith("the slowest was task vision, 13.000 ms")


def test_a_cycle_that_is_always_too_long_brakes_once() -> None:
    clock = FakeClock()
    run = RealTime(machine(), clock=clock)
    run.run(Slow(clock, dict.fromkeys(range(60, 402), int(1.3 * MS)))(run))
    assert [event.level for event in late_events(run)].count(Level.ERROR) == 1
    assert run.axes["X"].set_velocity == 0.0
    assert_valid(run.trace)


@pytest.mark.parametrize("priority", [0, 1])
def test_it_never_spins_under_fifo(priority: int) -> None:
    """Where FIFO is refused, both runs are alike."""
    clock = FakeClock(oversleep=itertools.cycle([60_000, 0]).__next__)
    run = RealTime(machine(realtime=QUIET | {"priority": priority}), clock=clock)
    reads: list[int] = []
    policies: list[int] = []

    async def program() -> None:
        await run.sleep(0.01)
        policies.append(os.sched_getscheduler(0) & 0xFF)
        reads.append(clock.reads)
        await run.sleep(0.1)
        reads.append(clock.reads)

    run.run(program())
    spins = (reads[1] - reads[0]) / 100 > 200
    assert spins == (policies != [os.SCHED_FIFO])
    assert (policies == [os.SCHED_FIFO]) == (priority > 0 and not run.refused)
    assert os.sched_getscheduler(0) & 0xFF == os.SCHED_OTHER


@pytest.mark.parametrize("speed", [0.0, 2000.0, float("nan")])
def test_a_speed_out_of_range_is_refused_before_anything_is_opened(speed: float, tmp_path: Any) -> None:
    with pytest.raises(ValueError, match=r"speed = .*: must be 0\.01 to 1000 \(times real time\)"):
        RealTime(machine(), speed=speed, trace=tmp_path / "run.trace")
    assert not list(tmp_path.iterdir())


def test_what_is_no_machine() -> None:
    with pytest.raises(TypeError, match=r"RealTime\('m.toml'\): give a machine, as in RealTime\(Machine.load"):
        RealTime("m.toml")  # type: ignore[arg-type]


def test_a_simulation_measures_on_request_only_and_stays_the_same() -> None:
    hashes = []
    for statistics in (False, True):
        with Simulation(machine(), statistics=statistics) as run:
            run.run(there_and_back(run))
            if statistics:
                assert run.statistics.compute.count == run.tick
                assert run.statistics.compute.spread.min > 0
                assert "programs: programs" in run.statistics.stages
                assert run.statistics.lateness.count == 0
            else:
                with pytest.raises(ValueError, match=r"give Simulation\(..., statistics=True\)"):
                    _ = run.statistics
            hashes.append(run.trace.hash)
    assert hashes[0] == hashes[1]


def test_with_a_layer_and_without_message_files_the_first_tick_is_no_more_than_any_other(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Without files the time of messages begins in 1970; the first tick takes it to the time of day."""
    looked_up: list[int] = []

    def offset(second: int) -> int:
        looked_up.append(second)
        return 0

    monkeypatch.setattr(_logging, "_no_offset", offset)
    with RealTime(machine(layer={}), clock=FakeClock()) as run:
        run.step(50)
        assert run.log.time(run.tick) > "2020"
    assert 0 < len(looked_up) < 10


@pytest.mark.slow
def test_after_the_rehearsal_no_command_loads_a_kernel() -> None:
    """Else the first use of a command would cost some ten milliseconds in the middle of a tick."""
    done = python(str(Path(__file__).with_name("rehearsed.py")))
    assert (done.stdout, done.stderr) == ("compiled True []\n", "")
