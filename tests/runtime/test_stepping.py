"""Pause, steps and breakpoints."""

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from motionlayer import AxisState, Fault, RealTime, Simulation
from motionlayer.event import Event, Kind, Level
from motionlayer.runtime import Breakpoint, Run, SteppedRun
from motionlayer.verify import assert_valid
from tests.machines import machine
from tests.nc.servos import servo_machine
from tests.runtime.bare import stepped
from tests.runtime.clock import MS, FakeClock
from tests.runtime.lives import lively


def told(run: SteppedRun, level: Level = Level.WARNING, source: str = "test", kind: Kind = Kind.MESSAGE) -> Event:
    event = Event(run.tick, level, kind, source, "told")
    run.events.add(event)
    return event


def teller(run: Run) -> None:
    """Tell something in every tenth tick, ever graver, and from two sources in turn."""
    if run.tick % 10 == 0 and run.tick:
        number = run.tick // 10
        level, kind = Level(max(2, 6 - number)), list(Kind)[number % 2]
        run.events.add(Event(run.tick, level, kind, "XY"[number % 2], f"number {number}"))


def test_advance_stops_at_the_end_of_the_tick_and_goes_on() -> None:
    run = lively(1)
    met = [run.breakpoint(level=Level.ERROR), run.breakpoint(source="Z", kind=Kind.DONE)]
    stops = []
    while (event := run.advance(1.0)) is not None:
        assert event.tick == run.tick - 1
        assert event.level <= Level.ERROR or (event.source, event.kind) == ("Z", Kind.DONE)
        stops.append(event)
        if len(stops) == 8:
            met[0].remove()
    assert {event.source for event in stops[8:]} <= {"Z"}
    assert len(stops) > 12
    assert not any(program.aborted for program in run._scheduler.programs)
    through = lively(1)
    through.step(run.tick)
    trace = run.trace
    assert trace.hash == through.trace.hash
    assert_valid(trace)


@pytest.mark.parametrize(
    ("make", "ticks"),
    [
        (lambda run: run.breakpoint(), [10, 20, 30, 40]),
        (lambda run: run.breakpoint(source="X"), [20, 40]),
        (lambda run: run.breakpoint(level=Level.WARNING), [30, 40]),
        (lambda run: run.breakpoint(kind=Kind.ACCEPTED), [10, 30]),
        (lambda run: run.breakpoint(source="Y", level=Level.WARNING), [30]),
        (lambda run: run.breakpoint(lambda event: event.text.endswith("2")), [20]),
        (lambda run: run.breakpoint(lambda event: event.text.endswith("2"), source="Y"), []),
    ],
)
def test_all_conditions_of_a_breakpoint_have_to_hold(
    make: Callable[[SteppedRun], Breakpoint], ticks: list[int]
) -> None:
    run, stops = stepped(), list[int]()
    run.cyclic(teller)
    run.step(2)  # the start of the program is an event too
    make(run)
    while run.tick < 45:
        event = run.advance((45 - run.tick) * 1e-3)
        if event is not None:
            stops.append(event.tick)
    assert stops == ticks


def test_the_first_of_several_events_of_a_tick_is_returned_and_none_twice() -> None:
    run = stepped()
    run.breakpoint()

    def twice(run: Any) -> None:
        if run.tick == 3:
            seen.extend([told(run), told(run, source="other")])

    run.cyclic(twice)
    seen: list[Event] = []
    run.step()
    assert run.advance(0.01) is seen[0]
    assert run.tick == 4
    assert run.advance(0.01) is None


def test_events_between_two_calls_stop_nothing() -> None:
    run = stepped()
    run.breakpoint()
    told(run)
    assert run.advance(0.005) is None
    assert run.tick == 5


def test_a_predicate_that_fails_concerns_who_advances_and_no_program() -> None:
    run = stepped()
    program = run.cyclic(teller)
    run.step(2)
    wrong = run.breakpoint(lambda event: event.text[99] == "x")
    with pytest.raises(IndexError):
        run.advance(0.1)
    wrong.remove()
    wrong.remove()
    assert run.tick == 11
    assert run.advance(0.1) is None
    assert program.busy


def test_advance_ends_with_the_last_program_and_at_once_without_any() -> None:
    run = stepped()

    async def main() -> None:
        await run.sleep(0.01)

    program = run.start(main())
    assert run.advance() is None
    assert (program.done, run.tick) == (True, 11)
    assert run.advance() is None
    assert run.tick == 11


def test_stop_ends_advance() -> None:
    run = stepped()
    program = run.cyclic(lambda run: run.stop("enough") if run.tick == 7 else None)
    assert run.advance() is None
    assert (run.tick, program.busy, run.ending) == (8, True, "enough")


@pytest.mark.parametrize(("time", "said"), [(-1.0, "allowed: 0 to"), (float("nan"), "allowed: 0 to")])
def test_a_time_that_is_none_is_refused(time: float, said: str) -> None:
    with pytest.raises(ValueError, match=rf"advance\({time}\): {said}"):
        stepped().advance(time)


@pytest.mark.parametrize(("ticks", "error"), [(-1, ValueError), (1.5, TypeError), (True, TypeError), ("3", TypeError)])
def test_step_takes_whole_ticks_and_goes_on_after_a_mistake(ticks: Any, error: type[Exception]) -> None:
    run = stepped()
    with pytest.raises(error, match=r"step\("):
        run.step(ticks)
    run.step(2)
    assert run.tick == 2


@pytest.mark.parametrize("ticks", [0, -1, 1.5, True, "3"])
def test_resume_takes_whole_ticks(ticks: Any) -> None:
    with pytest.raises(ValueError, match="ticks must be a whole number from 1 on"):
        stepped().resume(ticks)


def test_a_breakpoint_at_the_error_of_an_axis() -> None:
    run = Simulation(servo_machine("XY"))
    for axis in run.axes.values():
        axis.enable()
    run.step(5)
    for axis in run.axes.values():
        axis.move_velocity(100.0)
    run.inject("Y", Fault("drive_error"), tick=50)
    run.breakpoint(source="Y", level=Level.ERROR)
    event = run.advance(1.0)
    assert event is not None
    assert (run.tick, event.tick, run.axes["Y"].state) == (51, 50, AxisState.ERRORSTOP)
    run.step(100)
    assert_valid(run.trace)


# pause


@contextmanager
def running(run: SteppedRun) -> Iterator[Callable[[], int]]:
    """Let a run go on in a thread of its own; what is yielded waits until it stands, and returns its tick."""
    run.areas.add("pulse", 1, outside=True)
    thread = threading.Thread(target=run.run, daemon=True)

    def standing() -> int:
        """Two inputs that are applied one after the other before the same tick."""
        first = second = -2
        while first != second:
            first, second = (run.areas["pulse"].post(b"x").wait(60.0) for _ in range(2))
        return run.tick

    run.pause()
    thread.start()
    try:
        yield standing
    finally:
        run.stop("over")
        run.resume()
        thread.join(60.0)
        assert not thread.is_alive()


def test_a_paused_run_stands_takes_inputs_and_shows_them() -> None:
    run = stepped()
    run.cyclic(lambda _: None)
    data = run.areas.add("data", 1, outside=True)
    with running(run) as standing:
        assert standing() == 0
        for number in range(3):
            assert data.post(bytes([number])).wait(60.0) == 0
            assert data.read_with_tick() == (-1, bytes([number]))
        run.resume(5)
        while not run.paused:
            pass
        assert standing() == 5
        data.post(b"!").wait(60.0)
        assert data.read_with_tick() == (4, b"!")
        assert run.paused


def test_resume_lets_exactly_so_many_ticks_through() -> None:
    run = stepped()
    run.cyclic(lambda _: None)
    with running(run) as standing:
        tick = standing()
        for ticks in (1, 3, 1, 1000):
            run.resume(ticks)
            while not run.paused:
                pass
            tick += ticks
            assert standing() == tick
        run.resume()
        assert not run.paused
        run.areas["pulse"].post(b"x").wait(60.0)
        run.pause()
        assert standing() > tick


def test_a_run_without_programs_is_counted_too() -> None:
    run = stepped()
    run.mailbox.register("go", lambda _: run.resume(300) if run.tick < 600 else run.resume())
    run.pause()
    ticks = []

    def watch(tick: int) -> None:
        ticks.append(tick)
        if run.paused:
            run.mailbox.post("go")

    run.run(time=1.0, watch=watch)
    assert run.tick == 1000
    assert {0, 256, 300, 512, 600, 768} <= set(ticks)


def test_a_pause_changes_nothing_in_what_a_run_computes() -> None:
    run, through = lively(2, trace=False), lively(2, trace=False)
    run.mailbox.register("go", lambda _: run.resume())
    through.mailbox.register("go", lambda _: None)

    def pauses(run: Any) -> None:
        if run.tick % 50 == 7:
            run.pause()
            run.mailbox.post("go")

    run.cyclic(pauses, name="same")
    through.cyclic(lambda _: None, name="same")
    run.run(time=0.4)
    through.run(time=0.4)
    assert run.close() == through.close()


def test_in_real_time_the_deadlines_move_with_the_pause() -> None:
    clock = FakeClock()
    run = RealTime(machine(), clock=clock)

    def resume(_: bytes) -> None:
        clock.work(3600 * 1000 * MS)
        run.resume()

    run.mailbox.register("go", resume)

    def pauses(run: Any) -> None:
        if run.tick == 20:
            run.pause()
            run.mailbox.post("go")

    run.cyclic(pauses)
    run.run(time=0.1)
    assert (run.statistics.overruns, run.statistics.slips) == (0, 0)
    assert run.statistics.lateness.spread.max < MS


def test_who_watches_can_end_a_paused_run() -> None:
    run = stepped()
    program = run.cyclic(lambda _: None)
    run.pause()

    def watch(_: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run.run(watch=watch)
    assert (run.tick, program.aborted) == (0, True)


def test_a_paused_run_can_be_stepped_by_its_own_thread() -> None:
    run = stepped()
    run.pause()
    run.step(3)
    assert (run.tick, run.paused) == (3, True)


def test_advance_in_real_time_is_in_time() -> None:
    clock = FakeClock()
    run = RealTime(machine(), clock=clock)
    run.breakpoint(source="X", kind=Kind.DONE)
    command = run.axes["X"].enable()
    begin = clock.now
    assert run.advance(1.0) is not None
    assert command.done
    assert clock.now - begin == pytest.approx((run.tick - 1) * MS, abs=MS / 10)


# -- until a condition holds -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("make", [Simulation, lambda machine: RealTime(machine, clock=FakeClock())])
def test_a_run_goes_on_until_a_condition_holds(make: Callable[..., Simulation]) -> None:
    with make(machine()) as run:
        x = run.axes["X"]
        x.enable()
        assert run.advance_until(lambda: x.state is AxisState.STANDSTILL, time=0.1)
        x.move_absolute(100.0)
        assert run.advance_until(lambda: x.set_position > 50.0, time=5.0)
        position, tick = x.set_position, run.tick
        assert 50.0 < position < 51.0
        assert run.advance_until(lambda: x.set_position > 50.0, time=5.0)
        assert run.tick == tick
        assert not run.advance_until(lambda: x.set_position > 100.0, time=1.0)
        assert run.tick == tick + 1000
        assert x.set_position == 100.0
        assert_valid(run.trace)


def test_the_condition_is_waited_for_also_when_the_programs_have_ended() -> None:
    with Simulation(machine()) as run:

        async def program() -> None:
            await run.axes["X"].enable()
            run.axes["X"].move_absolute(300.0)

        run.start(program())
        assert run.advance_until(lambda: run.axes["X"].set_position == 300.0, time=5.0)
        assert_valid(run.trace)


def test_who_stops_the_run_ends_the_wait_for_a_condition() -> None:
    run = stepped()
    run.cyclic(lambda one: one.stop("enough") if one.tick == 7 else None)
    assert not run.advance_until(lambda: False, time=1.0)
    assert (run.tick, run.ending) == (8, "enough")


def test_what_is_no_condition_and_what_is_no_time() -> None:
    run = stepped()
    with pytest.raises(TypeError, match=r"advance_until\(True\): give a function, as in advance_until\(lambda: "):
        run.advance_until(True, time=1.0)  # type: ignore[arg-type]
    for time in (-1.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="advance_until"):
            run.advance_until(lambda: False, time)
    with pytest.raises(ZeroDivisionError):
        run.advance_until(lambda: 1 // 0 > 0, time=1.0)
    run.step(3)
    assert run.tick == 3
