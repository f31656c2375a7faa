"""What is right is found right."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.event import Event, Kind
from motionlayer.verify import assert_valid, verify
from tests.effort import examples

from .bench import Bench, changed, join
from .scenarios import SIZES, axis, everything, quantised, recorded

OPERATIONS = st.lists(
    st.tuples(
        st.sampled_from(["move", "move_velocity", "stop", "limit"]),
        st.floats(-1.0, 1.0),
        st.one_of(st.none(), st.integers(0, 60)),
    ),
    min_size=1,
    max_size=8,
)


@pytest.mark.parametrize("size", SIZES)
def test_a_sound_trace_is_valid(size: str) -> None:
    report = verify(recorded(size))
    assert report.ok, str(report)
    assert report.axes == ("X",)
    assert (report.ticks, report.plans, report.commands) == (len(recorded(size).ticks), 12, 11)
    assert report.notes == ()


def test_a_quantised_trace_is_valid() -> None:
    assert_valid(quantised())


def test_two_axes_are_judged_side_by_side() -> None:
    x = everything("mm")
    y = axis("µm", name="Y", first_command=100)
    y.enable()
    y.run(x.tick - y.tick)
    report = verify(join([x, y]))
    assert report.ok, str(report)
    assert report.axes == ("X", "Y")


def test_an_incomplete_trace_is_judged_and_named() -> None:
    bench = everything("mm")
    trace = join([bench], whole=False)
    report = verify(trace)
    assert (report.ok, report.complete) == (True, False)
    last = len(trace.ticks) - 1
    note = f"the trace is incomplete, its writer was cut short; judged up to tick {last} ({last / 1000:.6f} s)"
    assert report.notes == (note,)
    assert str(report).startswith("INCOMPLETE: 1 axes (X), ")
    with pytest.raises(AssertionError, match="its writer was cut short"):
        assert_valid(trace)
    assert_valid(trace, partial=True)
    bench.rows[100][0] += 1e-6
    wrong = join([bench], whole=False)
    assert verify(wrong).findings
    with pytest.raises(AssertionError, match="NOT VALID"):
        assert_valid(wrong, partial=True)


def test_a_damaged_trace_is_refused_unless_a_part_is_enough() -> None:
    trace = changed(recorded("mm"), complete=False, damage="chunk 7: broken")
    report = verify(trace)
    assert (report.ok, report.axes, report.notes) == (False, (), ())
    assert report.refused == ("the file is damaged: chunk 7: broken",)
    with pytest.raises(AssertionError, match="REFUSED"):
        assert_valid(trace)
    part = verify(trace, partial=True)
    assert (part.ok, part.complete, part.axes) == (True, False, ("X",))
    assert part.notes[0].startswith("the file is damaged: chunk 7: broken; judged up to tick ")
    assert_valid(trace, partial=True)


def _drive(bench: Bench, operation: str, share: float, ticks: int | None) -> None:
    maxima = bench.maxima
    if operation == "limit":
        factor = 0.05 + abs(share)
        bench.limit(
            velocity=maxima.velocity * min(1.0, factor),
            acceleration=maxima.acceleration * min(1.0, 2 * factor),
            jerk=maxima.jerk * min(1.0, factor),
        )
    elif operation == "stop":
        bench.stop(state=6)  # a halt, which does not lock
    elif operation == "move":
        bench.move(bench.start + share * maxima.velocity * 0.1)
    else:
        # A velocity is not 0, and what the axis rounds to 0 is none.
        bench.move_velocity(math.copysign(max(abs(share), 1e-3), share) * bench.limits.velocity)
    bench.run(ticks if ticks is not None or operation != "limit" else 0)


@settings(max_examples=examples(60), deadline=None)
@given(OPERATIONS, st.sampled_from(sorted(SIZES)))
def test_any_sound_run_is_valid(operations: list[tuple[str, float, int | None]], size: str) -> None:
    bench = axis(size)
    bench.soft = (None, None)
    bench.enable()
    bench.run(1)
    for operation, share, ticks in operations:
        _drive(bench, operation, share, ticks)
    bench.run(2)
    assert_valid(bench.trace())


def test_the_plan_covers_times_beyond_its_last_piece() -> None:
    bench = axis("mm")
    bench.enable()
    bench.run(1)
    bench.move_velocity(10.0)
    bench.run(5_000)
    trace = bench.trace()
    assert np.ptp(trace["X.set_position"]) > 40.0
    assert_valid(trace)


def test_a_plan_recorded_again_on_its_way_is_valid() -> None:
    trace = recorded("mm")
    plan = trace.plans[1]
    again = replace(plan, tick=plan.tick + 37, offset=37 * trace.base_cycle)
    assert_valid(changed(trace, plans=(*trace.plans[:2], again, *trace.plans[2:])))


def test_a_plan_that_takes_over_inside_a_cycle_is_valid() -> None:
    trace = recorded("mm")
    plan, k = trace.plans[1], len(trace.plans[1].pieces) - 1  # where it comes to its end, and nowhere else
    time = float(plan.pieces[k, 0])
    cycles = int(time / trace.base_cycle)
    rest = plan.pieces[k:] - [time, 0.0, 0.0, 0.0, 0.0]
    later = replace(plan, tick=plan.tick + cycles, offset=cycles * trace.base_cycle - time, pieces=rest)
    assert later.offset < 0.0
    waited = tuple(_buffered(event) if event.command == plan.command else event for event in trace.events)
    plans = (*trace.plans[:2], later, *trace.plans[2:])
    assert_valid(changed(trace, plans=plans, events=waited))
    (finding,) = verify(changed(trace, plans=plans)).findings
    assert finding.message.startswith(f"command {plan.command} begins inside a cycle: move_absolute(")
    beside = replace(later, pieces=later.pieces + np.array([0.0, 1e-9, 0.0, 0.0, 0.0]))
    plans = (*trace.plans[:2], beside, *trace.plans[2:])
    assert not verify(changed(trace, plans=plans, events=waited)).ok


def _buffered(event: Event) -> Event:
    return event._replace(text=f"{event.text[:-1]}, buffer_mode=BUFFERED)") if event.kind == Kind.ACCEPTED else event
