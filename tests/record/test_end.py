"""How a run ended, and the end of a trace."""

from pathlib import Path

import numpy as np
import pytest

from motionlayer.record import End, Gap, Recorder, Signal, Trace, TraceWriter

HEADER = {"base_cycle_ns": 1_000_000}


def recorded(path: Path | None, end: End | None, ticks: int = 10) -> Trace:
    table = np.zeros((4, 1))
    with Recorder(table, [Signal("X.set_position", "mm", 0)], HEADER, path, block_ticks=4) as recorder:
        for tick in range(ticks):
            table[0, 0] = tick
            recorder.capture(tick)
        return recorder.trace(end)


@pytest.mark.parametrize("end", [None, End(10, "time over"), End(11, "a program did not yield", inside=True)])
def test_the_end_is_kept_in_memory_in_a_file_and_in_a_copy(tmp_path: Path, end: End | None) -> None:
    trace = recorded(None, end)
    assert trace.end == end
    assert recorded(tmp_path / "a.trace", end) == trace
    trace.save(tmp_path / "b.trace")
    assert Trace.load(tmp_path / "b.trace") == trace
    assert trace != recorded(None, End(10, "something else"))


def test_a_trace_that_broke_off_has_no_end(tmp_path: Path) -> None:
    recorded(tmp_path / "a.trace", End(10, "time over"))
    data = (tmp_path / "a.trace").read_bytes()
    (tmp_path / "a.trace").write_bytes(data[:-1])
    assert Trace.load(tmp_path / "a.trace").end is None


@pytest.mark.parametrize(("ticks", "first"), [(1, 8), (2, 8), (3, 8), (5, 8), (6, 4), (9, 4), (10, 0), (99, 0)])
def test_the_tail_begins_with_a_block(ticks: int, first: int) -> None:
    tail = recorded(None, None).tail(ticks)
    assert tail.ticks.tolist() == list(range(first, 10))
    assert tail["X.set_position"].tolist() == list(range(first, 10))


def test_the_tail_of_a_trace_with_a_gap(tmp_path: Path) -> None:
    writer = TraceWriter(tmp_path / "a.trace", {**HEADER, "signals": [{"name": "p", "unit": "mm", "resolution": 0.0}]})
    writer.rows(0, np.zeros((5, 1)))
    writer.gap(Gap(5, 5, 0))
    for first in (10, 15):
        writer.rows(first, np.zeros((5, 1)))
    writer.close(15, "")
    trace = Trace.load(tmp_path / "a.trace")
    assert trace.tail(8).ticks.tolist() == list(range(15, 20))
    assert trace.tail(12).ticks.tolist() == list(range(10, 20))
    assert trace.tail(20).ticks.tolist() == trace.ticks.tolist()
