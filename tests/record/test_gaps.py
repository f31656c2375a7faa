"""A recorder that must not wait: its writer is held up by a pipe that nobody reads."""

import os
import threading
from io import BufferedReader
from pathlib import Path

import numpy as np
import pytest

from motionlayer.event import Event, Input, Kind, Level
from motionlayer.record import Gap, Recorder, Signal, Trace, TraceWriter
from motionlayer.record._block import MOST_RECORDS, Block
from motionlayer.record._dimensions import LOSSY_BLOCKS
from motionlayer.record.plot import write_page
from motionlayer.record.plot._series import state_runs
from motionlayer.record.plot._time import time_chart

from .samples import header, plan, received

HEADER = {"product": "test", "base_cycle_ns": 1_000_000}
SIGNALS = 100
BLOCK = 64
HELD_UP = BLOCK * (LOSSY_BLOCKS + 4)
"""Ticks that do not fit into the blocks and a pipe: each block is nearly as large as the pipe's buffer."""


class Pipe:
    """A disk that stands still until it is told to go on; what it got can be read then."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / "pipe.trace"
        self._copy = folder / "copy.trace"
        os.mkfifo(self.path)
        self._end = os.open(self.path, os.O_RDONLY | os.O_NONBLOCK)
        self._thread: threading.Thread | None = None

    def go_on(self) -> None:
        os.set_blocking(self._end, True)
        self._thread = threading.Thread(target=self._drain, args=(os.fdopen(self._end, "rb"),), daemon=True)
        self._thread.start()

    def _drain(self, end: BufferedReader) -> None:
        with end, self._copy.open("wb") as copy:
            while data := end.read1(1 << 16):
                copy.write(data)

    def trace(self) -> Trace:
        assert self._thread is not None
        self._thread.join(60.0)
        return Trace.load(self._copy)


@pytest.fixture
def pipe(tmp_path: Path) -> Pipe:
    return Pipe(tmp_path)


class Cycle:
    """Captures ticks with random values; every tick has a plan, an event and an input."""

    def __init__(self, path: Path) -> None:
        self.table = np.zeros((4, SIGNALS // 4))
        self.told: list[str] = []
        signals = [Signal(f"signal.{index}", "mm", index) for index in range(SIGNALS)]
        self.recorder = Recorder(
            self.table, signals, HEADER, path, block_ticks=BLOCK, lossless=False, warn=self.told.append
        )
        self.values: list[float] = []
        self._rng = np.random.default_rng(5)

    def run(self, ticks: int) -> None:
        for tick in range(len(self.values), len(self.values) + ticks):
            self.table[...] = self._rng.normal(size=self.table.shape)
            self.values.append(float(self.table[0, 0]))
            self.recorder.plan(plan(tick=tick))
            self.recorder.event(Event(tick, Level.INFO, Kind.MESSAGE, "X", "tick"))
            self.recorder.input(received(tick))
            self.recorder.capture(tick)


def test_rows_are_dropped_until_the_writer_goes_on_and_nothing_else_is(pipe: Pipe) -> None:
    cycle = Cycle(pipe.path)
    cycle.run(HELD_UP)
    pipe.go_on()
    while cycle.recorder.dropping:
        cycle.run(1)
    cycle.run(10)
    assert cycle.recorder.close() == ""
    trace, total = pipe.trace(), len(cycle.values)
    (gap,) = trace.gaps
    assert gap.ticks > 0
    assert gap.records == 0
    missing = range(gap.first, gap.first + gap.ticks)
    assert trace.ticks.tolist() == [tick for tick in range(total) if tick not in missing]
    assert trace["signal.0"].tolist() == [cycle.values[tick] for tick in trace.ticks]
    for records in (trace.plans, trace.events, trace.inputs):
        assert [each.tick for each in records] == list(range(total))
    assert (trace.complete, trace.hash) == (True, "")


def test_the_beginning_of_the_first_gap_is_told_once(pipe: Pipe) -> None:
    cycle = Cycle(pipe.path)
    cycle.run(2 * HELD_UP)
    pipe.go_on()
    cycle.recorder.close()
    first = pipe.trace().gaps[0].first
    (told,) = cycle.told
    assert told == (
        f"rows of the trace are missing from tick {first} on: its writer does not keep up; "
        "record fewer signals or write to a faster disk"
    )


def test_a_gap_at_the_end_is_in_the_trace(pipe: Pipe) -> None:
    cycle = Cycle(pipe.path)
    cycle.run(HELD_UP)
    pipe.go_on()
    cycle.recorder.close()
    trace = pipe.trace()
    (gap,) = trace.gaps
    assert gap.first == len(trace.ticks)
    assert gap.first + gap.ticks == HELD_UP
    assert trace.inputs[-1].tick == HELD_UP - 1


def test_in_memory_nothing_is_ever_dropped_that_the_writer_keeps_up_with() -> None:
    recorder = Recorder(np.zeros((4, 1)), [Signal("X", "mm", 0)], HEADER, lossless=False)
    other = Recorder(np.zeros((4, 1)), [Signal("X", "mm", 0)], HEADER)
    for tick in range(100):
        recorder.capture(tick)
        other.capture(tick)
    assert (recorder.trace().hash, recorder.trace().gaps) == (other.close(), ())


def test_records_beyond_the_room_of_a_block_are_counted_and_cost_the_hash() -> None:
    recorder = Recorder(np.zeros((4, 1)), [Signal("X", "mm", 0)], HEADER, lossless=False)
    recorder.capture(7)
    for number in range(MOST_RECORDS + 3):
        recorder.input(Input(8, "c", str(number).encode()))
    recorder.capture(8)
    trace = recorder.trace()
    assert trace.gaps == (Gap(7, 0, 3),)
    assert len(trace.inputs) == MOST_RECORDS
    assert trace.ticks.tolist() == [7, 8]
    assert trace.hash == ""


def test_a_block_counts_rows_and_records_apart() -> None:
    block = Block(0, 1, 0, most_records=1)
    assert Block(0, 1, 0, most_records=1).gap is None
    block.keep(block.events, Event(5, Level.INFO, Kind.MESSAGE, "X", "kept"))
    block.keep(block.events, Event(5, Level.INFO, Kind.MESSAGE, "X", "lost"))
    block.drop(6)
    block.drop(7)
    assert block.gap == Gap(6, 2, 1)
    other = Block(1, 1, 0, most_records=1)
    other.take_over(block)
    assert [each.gap for each in (other, block)] == [Gap(6, 2, 1), None]
    assert [event.text for event in other.events] == ["kept"]


def test_gaps_are_saved_and_compared(tmp_path: Path) -> None:
    def trace(*gaps: Gap) -> Trace:
        writer = TraceWriter(None, header(["X"]))
        writer.rows(0, np.zeros((2, 1)))
        for gap in gaps:
            writer.gap(gap)
        writer.rows(9, np.zeros((2, 1)))
        writer.close(4, "")
        return Trace.from_chunks(writer.chunks)

    one = trace(Gap(2, 7, 0))
    one.save(tmp_path / "x.trace")
    assert Trace.load(tmp_path / "x.trace") == one
    assert one != trace()
    assert one != trace(Gap(2, 7, 1))
    assert repr(one).endswith("0 inputs, 1 gaps>")


def test_a_block_in_real_time_is_bounded_in_time(tmp_path: Path) -> None:
    """A cycle of 10 ms: what is on the disk is at most a fifth of a second old, and what is still being written."""
    path = tmp_path / "x.trace"
    recorder = Recorder(np.zeros((4, 1)), [Signal("X", "mm", 0)], {"base_cycle_ns": 10_000_000}, path, lossless=False)
    for tick in range(101):
        recorder.capture(tick)
    recorder.close()
    assert path.read_bytes().count(b"ROWS") == 6


def test_stretches_are_the_parts_between_jumps_and_have_all_records() -> None:
    writer = TraceWriter(None, header(["X"]))
    writer.input(received(4))
    writer.plan(plan(tick=2))
    for first, count in ((3, 2), (5, 1), (9, 2), (12, 1)):
        writer.rows(first, np.arange(first, first + count, dtype=np.float64)[:, None])
    writer.close(6, "ab")
    trace = Trace.from_chunks(writer.chunks)
    replaced = trace.replace({"X": -trace["X"]})
    for whole, sign in ((trace, 1.0), (replaced, -1.0), (Trace.from_chunks(writer.chunks), 1.0)):
        parts = whole.stretches()
        assert [part.ticks.tolist() for part in parts] == [[3, 4, 5], [9, 10], [12]]
        for part in parts:
            assert part["X"].tolist() == (sign * part.ticks).tolist()
            assert part.time.tolist() == (part.ticks / 1000).tolist()
            assert (part.plans, part.inputs, part.hash) == (trace.plans, trace.inputs, "")


def test_a_trace_without_jumps_is_one_stretch() -> None:
    for rows in (0, 3):
        writer = TraceWriter(None, header(["X"]))
        writer.rows(0, np.zeros((rows, 1)))
        trace = Trace.from_chunks(writer.chunks)
        assert trace.stretches() == (trace,)


def test_the_plots_break_off_where_ticks_are_missing(tmp_path: Path) -> None:
    writer = TraceWriter(None, header(["X.set_position", "X.state"], machine={"axis": {"X": {"unit": "mm"}}}))
    values = np.array([np.arange(100.0), np.full(100, 2.0)]).T
    writer.rows(0, values[:40])
    writer.gap(Gap(40, 20, 0))
    writer.rows(60, values[60:])
    writer.close(80, "")
    trace = Trace.from_chunks(writer.chunks)
    assert [(run.start, run.end) for run in state_runs(trace, "X", 10)] == [(0.0, 0.04), (0.06, 0.1)]
    chart = time_chart(trace)
    assert chart is not None
    for line in (line for line in chart.figure.data if line.type == "scatter" and line.mode == "lines"):
        (hole,) = np.flatnonzero(np.isnan(line.x))
        assert np.isnan(line.y[hole])
        assert line.x[[hole - 1, hole + 1]].tolist() == pytest.approx([0.039, 0.06])
    write_page(trace, tmp_path / "page.html")
    assert "20 ticks are missing, from tick 40 on" in (tmp_path / "page.html").read_text()
