"""What has to do with the outside when a run goes back: areas, inputs, real time, message files."""

from pathlib import Path

from motionlayer import RealTime, Simulation
from motionlayer.event import Input, Level
from motionlayer.machine import LogDescription
from motionlayer.runtime import Run
from tests.machines import machine
from tests.record.log.support import files
from tests.runtime.bare import stepped
from tests.runtime.clock import FakeClock


def test_areas_come_back_and_readers_see_the_tick() -> None:
    run = stepped()
    inside, outside = run.areas.add("inside", 2), run.areas.add("outside", 2, outside=True)

    def counts(run: Run) -> None:
        inside.claim()[0] = run.tick

    run.cyclic(counts)
    outside.post(b"ab")
    run.step(6)
    kept = run.snapshot()
    outside.post(b"cd")
    run.step(20)
    assert outside.read() == b"cd"
    run.restore(kept)
    assert (inside.read_with_tick(), outside.read()) == ((5, b"\x05\0"), b"ab")
    run.step()
    assert inside.read_with_tick() == (6, b"\x06\0")


def test_what_is_posted_and_not_applied_stays_and_what_was_fed_comes_again() -> None:
    run, got = stepped(), list[bytes]()
    run.mailbox.register("test", got.append)
    waiting = run.mailbox.post("test", b"posted")
    kept = run.snapshot()
    run.restore(kept)
    assert not waiting.settled
    run.step()
    assert waiting.wait(0.0) == 0
    run.mailbox.feed([Input(3, "test", b"early"), Input(8, "test", b"late")])
    run.step(5)
    kept = run.snapshot()
    for _ in range(2):
        run.step(10)
        run.restore(kept)
    assert got == [b"posted", b"early", b"late", b"late"]


def test_a_real_time_run_goes_back_and_begins_in_time() -> None:
    run = RealTime(machine(), clock=FakeClock(), trace=False)
    x, clock = run.axes["X"], run._pace._clock
    assert isinstance(clock, FakeClock)
    x.enable()
    run.run(time=0.1)
    clock.work(10**9)
    run.reset()
    run.run(time=0.1)
    assert run.statistics.overruns == 0
    assert run.statistics.lateness.count == 200
    assert not run.events.last(Level.WARNING)
    fresh = Simulation(machine(), trace=False)
    fresh.axes["X"].enable()
    fresh.run(time=0.1)
    assert run.close() == fresh.close()


def test_time_in_message_files_goes_on(tmp_path: Path) -> None:
    log = LogDescription(folder=str(tmp_path), level="verbose", start="2025-10-24T13:00:00")
    with Simulation(machine(), log=log) as run:
        x = run.axes["X"]
        run.step(50)
        kept = run.snapshot()
        for _ in range(3):
            x.enable()
            run.step(100)
            run.restore(kept)
        run.step(10)
        x.enable()
    (lines,) = files(tmp_path).values()
    accepted = [line.split("\t")[1] for line in lines if line.endswith("enable()")]
    assert accepted == [f"2025-10-24-13:00:00.{ms:03d}" for ms in (50, 150, 250, 360)]
