import resource
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.event import Event, Input, Kind, Level
from motionlayer.record import Recorder, Signal, Trace, TraceError
from tests.effort import examples

from .samples import Floats, event, plan, received

HEADER = {"product": "test", "base_cycle_ns": 250_000}
ROWS, COLUMNS, TICKS = 6, 3, 50


def signals(*indices: int) -> list[Signal]:
    return [Signal(f"axis.{index}", "mm", index) for index in indices]


def tables(seed: int = 3) -> Floats:
    return np.random.default_rng(seed).normal(size=(TICKS, ROWS, COLUMNS))


def record(values: Floats, chosen: list[Signal], path: Path | None = None, events: int = 1, **options: int) -> Recorder:
    table = np.zeros(values.shape[1:])
    recorder = Recorder(table, chosen, HEADER, path, **options)  # type: ignore[arg-type]
    for tick, now in enumerate(values):
        table[...] = now
        recorder.plan(plan(tick=tick))
        for number in range(events):
            recorder.event(Event(tick, Level.INFO, Kind.MESSAGE, "X", f"tick {tick}", 0, number))
        recorder.capture(tick)
    return recorder


@settings(max_examples=examples(30), deadline=None)
@given(
    indices=st.lists(st.integers(0, ROWS * COLUMNS - 1), unique=True, min_size=1),
    block_ticks=st.integers(1, 70),
    hashing=st.booleans(),
)
def test_what_is_recorded_is_what_was_there(indices: list[int], block_ticks: int, hashing: bool) -> None:
    values = tables()
    trace = record(values, signals(*indices), block_ticks=block_ticks, hashing=hashing).trace()
    flat = values.reshape(TICKS, -1)
    for index in indices:
        assert trace[f"axis.{index}"].tobytes() == np.ascontiguousarray(flat[:, index]).tobytes()
    assert trace.ticks.tolist() == list(range(TICKS))
    assert [each.tick for each in trace.plans] == list(range(TICKS))
    assert [each.tick for each in trace.events] == list(range(TICKS))
    assert trace.complete
    assert bool(trace.hash) == hashing


@settings(max_examples=examples(20), deadline=None)
@given(indices=st.lists(st.integers(0, ROWS * COLUMNS - 1), unique=True), block_ticks=st.integers(1, 70))
def test_the_hash_knows_neither_blocks_nor_signals(indices: list[int], block_ticks: int) -> None:
    values = tables()
    reference = record(values, []).close()
    assert record(values, signals(*indices), block_ticks=block_ticks).close() == reference


def test_the_hash_does_not_know_whether_there_is_a_file(tmp_path: Path) -> None:
    values = tables()
    recorder = record(values, signals(0, 5), tmp_path / "x.trace")
    assert recorder.close() == record(values, []).close() == Trace.load(tmp_path / "x.trace").hash
    assert len(recorder.close()) == 32


@pytest.mark.parametrize("place", [(0, 0, 0), (49, 3, 2), (20, 1, 1)])
def test_the_hash_notices_one_bit(place: tuple[int, int, int]) -> None:
    values = tables()
    reference = record(values, []).close()
    values[place] = np.nextafter(values[place], np.inf)
    assert record(values, []).close() != reference


def test_the_hash_is_over_the_first_four_rows_only() -> None:
    values = tables()
    reference = record(values, []).close()
    values[:, 4:] += 1.0
    assert record(values, []).close() == reference


def test_the_hash_notices_events_and_ticks() -> None:
    values = tables()
    hashes = {record(values, [], events=count).close() for count in (0, 1, 2)}
    shorter = record(values[:-1], []).close()
    assert len({*hashes, shorter}) == 4


def test_the_hash_counts_ticks_even_without_coordinates() -> None:
    nothing = np.zeros((TICKS, 4, 0))
    assert record(nothing, [], events=0).close() != record(nothing[:-1], [], events=0).close()


@pytest.mark.parametrize(
    "other",
    [
        Event(1, Level.WARNING, Kind.ACCEPTED, "X", "text", 1, 1),
        Event(0, Level.ERROR, Kind.ACCEPTED, "X", "text", 1, 1),
        Event(0, Level.WARNING, Kind.DONE, "X", "text", 1, 1),
        Event(0, Level.WARNING, Kind.ACCEPTED, "Y", "text", 1, 1),
        Event(0, Level.WARNING, Kind.ACCEPTED, "X", "other", 1, 1),
        Event(0, Level.WARNING, Kind.ACCEPTED, "X", "text", 2, 1),
        Event(0, Level.WARNING, Kind.ACCEPTED, "X", "text", 1, 2),
        Event(0, Level.WARNING, Kind.ACCEPTED, "X", "text", 1, 1, 1),
        Event(0, Level.WARNING, Kind.ACCEPTED, "X", "text", 1, 1, 0, 1),
    ],
)
def test_the_hash_notices_every_field_of_an_event(other: Event) -> None:
    def digest(one: Event) -> str:
        recorder = Recorder(np.zeros((4, 1)), [], HEADER)
        recorder.event(one)
        return recorder.close()

    assert digest(other) != digest(Event(0, Level.WARNING, Kind.ACCEPTED, "X", "text", 1, 1))


def test_without_signals_and_file_only_the_hash_is_kept() -> None:
    recorder = record(tables(), [])
    assert recorder.close()
    with pytest.raises(TraceError, match="nothing was recorded but the hash"):
        recorder.trace()


def test_a_file_without_signals_holds_plans_and_events(tmp_path: Path) -> None:
    trace = record(tables(), [], tmp_path / "x.trace").trace()
    assert (len(trace), len(trace.plans), len(trace.events)) == (0, TICKS, TICKS)


def test_closing_twice_gives_the_same_and_more_ticks_are_refused() -> None:
    recorder = record(tables(), signals(1))
    assert recorder.close() == recorder.close()
    with pytest.raises(ValueError, match="closed"):
        recorder.capture(TICKS)


def test_a_with_block_closes(tmp_path: Path) -> None:
    path = tmp_path / "x.trace"
    with Recorder(np.zeros((4, 1)), signals(0), HEADER, path) as recorder:
        recorder.event(event())
        recorder.capture(0)
    assert Trace.load(path).complete


def test_a_jump_of_the_ticks_is_a_gap() -> None:
    recorder = Recorder(np.zeros((4, 1)), signals(0), HEADER, block_ticks=4)
    for tick in (5, 6, 7, 20, 21):
        recorder.capture(tick)
    assert recorder.trace().ticks.tolist() == [5, 6, 7, 20, 21]


def test_a_recording_that_went_back_is_like_one_that_never_left() -> None:
    values = tables()
    table = np.zeros((ROWS, COLUMNS))
    recorder = Recorder(table, signals(0, 5), HEADER, block_ticks=16)

    def go_on(first: int, rows: Floats) -> None:
        for tick, now in enumerate(rows, first):
            table[...] = now
            recorder.plan(plan(tick=tick))
            recorder.event(Event(tick, Level.INFO, Kind.MESSAGE, "X", f"tick {tick}"))
            recorder.capture(tick)

    start = recorder.mark()
    go_on(0, values[::-1])
    recorder.go_back(start)
    go_on(0, values[:20])
    middle = recorder.mark()
    go_on(20, values[:5])
    other = recorder.mark()
    recorder.go_back(middle)  # and from there to one that was taken on the way that is left
    recorder.go_back(other)
    recorder.go_back(middle)
    go_on(20, values[20:])
    again, once = recorder.trace(), record(values, signals(0, 5), block_ticks=16).trace()
    assert again == once
    assert again.hash == once.hash


def test_the_header_changes_where_a_recording_went_back() -> None:
    recorder = record(tables(4), signals(0))
    start = recorder.mark()
    recorder.go_back(start, {"seed": 7})
    kept = recorder.mark()
    recorder.go_back(start, {"seed": 8})
    recorder.go_back(kept)
    trace = recorder.trace()
    assert (trace.header["seed"], len(trace.ticks)) == (7, TICKS)


def test_a_hash_that_went_back_is_that_of_a_new_run() -> None:
    recorder = Recorder(np.zeros((ROWS, COLUMNS)), [], HEADER)
    start = recorder.mark()
    recorder.event(event())
    recorder.capture(0)
    recorder.go_back(start)
    assert recorder.close() == Recorder(np.zeros((ROWS, COLUMNS)), [], HEADER).close()


def test_a_recording_that_drops_rows_goes_back_too() -> None:
    table = np.zeros((4, 1))
    recorder = Recorder(table, signals(0), HEADER, block_ticks=2, lossless=False)
    for tick in range(200):
        recorder.capture(tick)
    mark = recorder.mark()
    recorder.capture(200)
    recorder.go_back(mark)
    recorder.capture(200)
    recorder.capture(201)
    trace = recorder.trace()
    assert trace.ticks.tolist()[-2:] == [200, 201]


def test_what_cannot_go_back_is_refused(tmp_path: Path) -> None:
    recorder = record(tables(), signals(0), tmp_path / "x.trace")
    mark = recorder.mark()
    with pytest.raises(TraceError, match=r"x\.trace: a trace that is written to a file cannot go back"):
        recorder.go_back(mark)
    assert len(recorder.trace().ticks) == TICKS
    closed = record(tables(), signals(0))
    closed.close()
    for action in (closed.mark, lambda: closed.go_back(mark)):
        with pytest.raises(ValueError, match="closed"):
            action()


def test_inputs_are_kept_and_no_part_of_the_hash() -> None:
    recorder = Recorder(np.zeros((4, 1)), signals(0), HEADER)
    recorder.input(received(0))
    recorder.input(received(3, b""))
    assert recorder.trace().inputs == (received(0), received(3, b""))
    assert recorder.trace().hash == Recorder(np.zeros((4, 1)), [], HEADER).close()


def test_quantised_signals_do_not_touch_the_hash() -> None:
    values = tables()
    coarse = [Signal("axis.0", "mm", 0, 0.5)]
    recorder = record(values, coarse)
    assert recorder.close() == record(values, []).close()
    np.testing.assert_array_equal(recorder.trace()["axis.0"], np.rint(values[:, 0, 0] / 0.5) * 0.5)


@pytest.mark.parametrize(
    ("table", "chosen", "options", "message"),
    [
        (np.zeros((6, 4))[:, ::2], [], {}, "contiguous float64"),
        (np.zeros((6, 4), np.float32), [], {}, "contiguous float64"),
        (np.zeros((3, 4)), [], {}, "first 4"),
        (np.zeros((6, 2)), signals(12), {}, r"axis\.12: index 12 is outside"),
        (np.zeros((6, 2)), signals(1, 1), {}, "twice"),
        (np.zeros((6, 2)), [], {"block_ticks": 0}, "at least 1"),
    ],
)
def test_what_cannot_be_recorded_is_refused(
    table: Floats, chosen: list[Signal], options: dict[str, int], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        Recorder(table, chosen, HEADER, **options)  # type: ignore[arg-type]


def test_a_file_that_cannot_be_opened_is_refused_at_once(tmp_path: Path) -> None:
    with pytest.raises(TraceError, match="cannot be written"):
        Recorder(np.zeros((4, 1)), signals(0), HEADER, tmp_path)


@pytest.fixture
def _small_files() -> Iterator[None]:
    """Let no file grow beyond 8 kB: the disk that is full, for this process."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (8192, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.usefixtures("_small_files")
def test_a_full_disk_surfaces_in_the_cycle_and_does_not_hang(tmp_path: Path) -> None:
    path = tmp_path / "x.trace"
    table = np.zeros((4, 1))
    recorder = Recorder(table, signals(0), HEADER, path, block_ticks=16)

    def run() -> None:
        for tick in range(100_000):
            table[0, 0] = tick
            recorder.capture(tick)

    with pytest.raises(TraceError, match=r"x\.trace: the trace cannot be written: File too large"):
        run()
    for _ in range(2):
        with pytest.raises(TraceError, match="File too large"):
            recorder.close()
    trace = Trace.load(path)
    assert not trace.complete
    assert len(trace.ticks) > 100
    assert trace["axis.0"].tolist() == trace.ticks.tolist()


@pytest.mark.usefixtures("_small_files")
def test_a_full_disk_in_real_time_is_one_message_and_the_run_goes_on(tmp_path: Path) -> None:
    path, told = tmp_path / "x.trace", list[str]()
    table = np.zeros((4, 1))
    recorder = Recorder(table, signals(0), HEADER, path, block_ticks=16, lossless=False, warn=told.append)
    tick = 0
    while not any("has ended" in text for text in told):
        table[0, 0] = tick
        recorder.capture(tick)
        tick += 1
    for later in range(tick, tick + 1000):
        recorder.capture(later)
    (ended,) = [text for text in told if "has ended" in text]
    assert ended == (
        f"the run goes on, its trace has ended: {path}: the trace cannot be written: File too large; "
        "free space or name another file with --trace"
    )
    with pytest.raises(TraceError, match="File too large"):
        recorder.close()
    trace = Trace.load(path)
    assert (trace.complete, trace.damage, trace.hash) == (False, "", "")
    assert trace["axis.0"].tolist() == trace.ticks.tolist()
    assert len(trace.ticks) > 100


@pytest.mark.usefixtures("_small_files")
def test_a_disk_that_is_full_at_the_end_surfaces_at_close(tmp_path: Path) -> None:
    values = np.random.default_rng(0).normal(size=(2000, 4, 1))
    recorder = record(values, signals(0), tmp_path / "x.trace", block_ticks=4000)
    with pytest.raises(TraceError, match="File too large"):
        recorder.close()


def test_any_other_failure_surfaces_too() -> None:
    recorder = Recorder(np.zeros((4, 1)), signals(0), HEADER)
    recorder.event("no event")  # type: ignore[arg-type]
    with pytest.raises(TraceError, match="the trace writer failed: AttributeError"):
        recorder.close()


def test_events_and_inputs_are_kept_without_signals_where_that_is_asked_for() -> None:
    """A machine without axes has no signals, and its run can be repeated all the same."""
    recorder = Recorder(np.zeros((4, 0)), [], {"base_cycle_ns": 1_000_000}, keep=True)
    recorder.input(Input(0, "area.a", b"12"))
    recorder.capture(0)
    trace = recorder.trace()
    assert [(one.tick, one.channel, one.payload) for one in trace.inputs] == [(0, "area.a", b"12")]
    assert trace.signals == ()
    assert trace.hash
