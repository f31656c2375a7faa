"""`replay` from Python: what a run holds of the outside, on a clock of its own where time matters."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.effort import examples
from tests.machines import LINEAR
from tests.runtime.clock import MS, FakeClock

from motionlayer import Fault, Machine, MachineRun, RealTime, Simulation, Trace, replay
from motionlayer.event import Event, Kind, Level
from motionlayer.machine import ReplayError, load_program, parse_source
from motionlayer.record import End, Gap, TraceWriter
from motionlayer.verify import assert_valid

SERVO = {"kind": "servo", "position_gain": 80.0, "time_constant": 0.002, "noise": 0.001}


def machine(**changes: Any) -> Machine:
    axes = {"X": LINEAR, "Y": LINEAR | {"drive": SERVO}}
    quiet = {"priority": 0, "lock_memory": False}
    return Machine.from_dict({"format": 1, "name": "test", "axis": axes, "realtime": quiet} | changes)


async def shuttle(run: MachineRun) -> None:
    x, y = run.axes["X"], run.axes["Y"]
    await x.enable()
    await y.enable()
    while True:
        await x.move_absolute(150.0).settled()
        y.move_relative(10.0)
        await run.sleep(0.013)
        await x.move_absolute(20.0).settled()


def same(trace: Trace, *programs: Any) -> None:
    done = replay(trace, programs)
    assert (done.same, done.difference, done.notes) == (True, "", ())


@settings(max_examples=examples(20), deadline=None)
@given(
    works=st.dictionaries(st.integers(5, 250), st.integers(2 * MS, 30 * MS), max_size=6), seed=st.integers(0, 2**63 - 1)
)
def test_late_ticks_have_the_same_consequences(works: dict[int, int], seed: int) -> None:
    clock = FakeClock()

    def load(run: MachineRun) -> None:
        clock.work(works.get(run.tick, 0))  # in a replay nobody looks at this clock

    with RealTime(machine(), clock=clock, seed=seed) as run:
        run.start(shuttle(run))
        run.cyclic(load)
        run.run(time=0.3)
    trace = run.trace
    assert {one.channel for one in trace.inputs} >= ({"late"} if works else set())
    assert_valid(trace)
    same(trace, shuttle, load)


@settings(max_examples=examples(20), deadline=None)
@given(
    doings=st.lists(
        st.tuples(st.integers(0, 60), st.sampled_from(["fault", "later fault", "stop", "post"])), max_size=8
    )
)
def test_what_the_owner_of_a_run_does_between_its_ticks_is_done_again(doings: list[tuple[int, str]]) -> None:
    def listen(run: MachineRun) -> None:
        if run.tick == 0:
            run.areas.add("goal", 1, outside=True)
        elif run.areas["goal"].view[0]:
            run.axes["X"].move_absolute(100.0)

    with Simulation(machine()) as run:
        run.start(shuttle(run))
        run.cyclic(listen)
        run.step(3)
        for ticks, doing in doings:
            run.step(ticks)
            if doing == "stop":
                run.emergency_stop()
            elif doing == "post":
                run.areas["goal"].post(bytes([ticks % 2]))
            else:
                run.inject("Y", Fault("lost_enable", duration=0.02), run.tick + 30 if doing == "later fault" else None)
    trace = run.trace  # the last ones may have been done after the last tick
    assert len(trace.inputs) >= sum(doing != "post" for _, doing in doings)
    same(trace, shuttle, listen)


def test_what_programs_do_is_no_input() -> None:
    async def braking(run: MachineRun) -> None:
        run.inject("Y", Fault("drive_error"))
        await run.axes["X"].enable()
        run.axes["X"].move_absolute(100.0)
        await run.sleep(0.05)
        await run.emergency_stop().settled()

    run = Simulation(machine())
    run.run(braking(run))
    assert run.trace.inputs == ()
    same(run.trace, braking)


def test_threads_of_a_program_are_not_heard_in_a_replay_but_answered() -> None:
    ticks = []

    def told(run: MachineRun) -> None:
        if run.tick == 0:
            run.areas.add("n", 1, outside=True)
        if run.tick in {5, 20}:
            receipts.append(run.areas["n"].post(bytes([run.tick])))
        if run.areas["n"].view[0]:
            ticks.append((run.tick, run.areas["n"].view[0]))

    receipts: list[Any] = []
    with Simulation(machine()) as run:
        run.cyclic(told)
        run.step(40)
    before = ticks.copy()
    ticks.clear()
    same(run.trace, told)
    assert ticks == before
    assert [receipt.wait(0.0) for receipt in receipts] == [6, 21] * 2


def test_a_script_is_named_where_it_did_what_is_not_recorded() -> None:
    with Simulation(machine()) as run:
        run.step(5)
        run.axes["X"].enable()
        run.step(5)
    done = replay(run.trace)
    assert not done.same
    assert done.difference.startswith("tick 5 (0.005 s): the trace has the verbose X: 'enable()' (accepted)")
    assert "what a script does between the ticks of a run is not recorded" in done.difference
    run = Simulation(machine())
    run.run(shuttle(run), time=0.1)
    assert "programs are given in `replay(trace, programs=[...])`" in replay(run.trace).difference
    same(run.trace, shuttle)


def test_the_first_signal_that_differs_is_named() -> None:
    run = Simulation(machine())
    run.run(shuttle(run), time=0.5)
    values = run.trace["Y.lag"].copy()
    values[123:] = np.nextafter(values[123:], np.inf)
    changed = run.trace.replace({"Y.lag": values})
    done = replay(changed, [shuttle])
    assert not done.same
    assert done.difference.startswith("tick 123 (0.123 s): Y.lag is ")
    assert done.compared == "all that it holds: it has no hash"


def test_a_trace_without_signals_is_compared_by_its_hash(tmp_path: Path) -> None:
    run = Simulation(machine(trace={"signals": []}), trace=tmp_path / "run.trace")
    run.run(shuttle(run), time=0.3)
    trace = run.trace
    assert not len(trace)
    same(trace, shuttle)
    done = replay(trace, [])
    assert not done.same
    assert done.difference.startswith("the trace holds nothing beside its hash; hash ")
    trace.end = End(300, "interrupted", inside=True)
    with pytest.raises(ReplayError, match="no signals"):
        replay(trace, [shuttle])


def gapped(tmp_path: Path, *gaps: Gap) -> Trace:
    """A trace of 300 ticks of which rows are missing, with the warning of a recorder that does not wait."""

    async def warned(run: MachineRun) -> None:
        await run.sleep(0.05)
        run.mailbox.post("trace", b"rows are missing")
        await run.sleep(1.0)

    run = Simulation(machine())
    run.start(shuttle(run))
    run.run(warned(run), time=0.3)
    whole = run.trace
    writer = TraceWriter(tmp_path / "gaps.trace", whole.header)
    for what in whole.inputs:
        writer.input(what)
    for event in whole.events:
        writer.event(event)
    for plan in whole.plans:
        writer.plan(plan)
    for gap in gaps:
        writer.gap(gap)
    edges = [0] + [edge for gap in gaps for edge in (gap.first, gap.first + gap.ticks)] + [300]
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        writer.rows(start, np.array([whole[name][start:end] for name in whole]).T)
    writer.close(300 - sum(gap.ticks for gap in gaps), "", End(300, "time over"))
    same_programs.append(warned)
    return Trace.load(tmp_path / "gaps.trace")


same_programs: list[Any] = []


def test_a_trace_with_gaps_is_compared_outside_of_them(tmp_path: Path) -> None:
    trace = gapped(tmp_path, Gap(40, 20, 0), Gap(100, 100, 0))
    assert [event for event in trace.events if event.source == "trace"]
    done = replay(trace, [shuttle, same_programs[-1]])
    assert (done.same, done.difference, done.ticks) == (True, "", 300)
    assert done.compared == "all that it holds: it has gaps"


def test_records_that_are_missing_end_the_comparison(tmp_path: Path) -> None:
    done = replay(gapped(tmp_path, Gap(200, 10, 3)), [shuttle, same_programs[-1]])
    assert (done.same, done.ticks) == (True, 200)
    assert done.compared == "up to tick 200, where records are missing; inputs may be among them"


def test_a_trace_of_another_installation_says_so() -> None:
    run = Simulation(machine())
    run.run(shuttle(run), time=0.05)
    trace = run.trace
    trace.header["installation"] = trace.header["installation"] | {"numba": "0.1"}
    done = replay(trace, [shuttle])
    assert done.same
    (note,) = done.notes
    assert note.startswith("recorded with numba 0.1 (here ")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"machine": None}, "holds no machine"),
        ({"machine": {"format": 1, "name": "x"}}, "is none for this version"),
        ({"programs": [{"name": "p", "file": "", "sha256": ""}]}, "was no file but a function of a script"),
    ],
)
def test_headers_that_are_not_enough(change: dict[str, Any], said: str) -> None:
    with Simulation(machine()) as run:
        run.step(3)
    trace = run.trace
    trace.header.update(change)
    with pytest.raises(ReplayError, match=said):
        replay(trace)


def test_a_trace_that_does_not_begin_at_the_beginning() -> None:
    with Simulation(machine()) as run:
        run.step(30)
    trace = run.trace
    trace.ticks = trace.ticks[10:]
    with pytest.raises(ReplayError, match="begins at tick 10"):
        replay(trace)


def test_an_input_for_a_channel_that_a_script_has_opened() -> None:
    run = Simulation(machine())
    run.mailbox.register("mine", lambda _payload: run.events.add(_message(run.tick)))
    with run:
        run.mailbox.post("mine")
        run.step(3)
    with pytest.raises(ReplayError, match=r"no channel 'mine'.*a script has opened it"):
        replay(run.trace)


def _message(tick: int) -> Event:
    return Event(tick, Level.INFO, Kind.MESSAGE, "X", "mine")


def test_a_run_that_was_taken_back_is_replayed_as_it_went_in_the_end() -> None:
    def told(run: MachineRun) -> None:
        x = run.axes["X"]
        if run.tick == 0:
            run.areas.add("goal", 1, outside=True)
            x.enable()
        elif run.areas["goal"].view[0] and x.command is None:
            x.move_absolute(float(run.areas["goal"].view[0]))

    with Simulation(machine()) as run:
        run.cyclic(told)
        run.step(20)
        snapshot = run.snapshot()
        run.areas["goal"].post(b"\x30")
        run.step(50)
        run.emergency_stop()
        run.restore(snapshot)
        run.areas["goal"].post(b"\x50")
        run.step(200)
    assert [one.payload for one in run.trace.inputs] == [b"\x50"]
    same(run.trace, told)


def test_a_run_that_was_reset_is_replayed_with_its_new_seed(tmp_path: Path) -> None:
    (tmp_path / "p.py").write_text(
        "def main(run):\n"
        "    if run.tick == 0:\n"
        "        run.axes['Y'].enable()\n"
        "    elif run.tick == 5:\n"
        "        run.axes['Y'].move_absolute(50.0)\n"
    )
    with Simulation(machine(), programs=[load_program(parse_source(str(tmp_path / "p.py")))], seed=1) as run:
        run.step(100)
        run.reset(2)
        run.step(150)
    assert run.trace.header["seed"] == 2
    done = replay(run.trace)
    assert (done.same, done.ticks) == (True, 150)
