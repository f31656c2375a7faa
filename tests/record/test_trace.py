import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from motionlayer.event import Input
from motionlayer.record import Gap, Plan, Signal, Trace, TraceError, TraceWriter
from motionlayer.record._container import CHUNK_HEAD
from tests.effort import examples

from .samples import Floats, event, gantry, header, plan, received, write

NAMES = ["X.set_position", "X.set_velocity", "Y.set_position"]
SHAPES = st.tuples(st.integers(1, 40), st.just(len(NAMES)))
FLOATS = arrays.from_dtype(np.dtype(np.float64), allow_subnormal=True)  # nan and inf included
BLOCKS = arrays.arrays(np.float64, SHAPES, elements=FLOATS)


def bits(trace: Trace) -> list[bytes]:
    return [trace[name].tobytes() for name in trace]


@settings(max_examples=examples(100), deadline=None)
@given(block=BLOCKS, size=st.integers(1, 50))
def test_lossless_columns_come_back_bit_for_bit(block: Floats, size: int) -> None:
    trace = Trace.from_chunks(write(block, NAMES, size=size).chunks)
    assert bits(trace) == [column.tobytes() for column in block.T]
    assert trace.ticks.tolist() == list(range(len(block)))
    assert trace.complete
    assert trace.hash == "ab" * 16


@settings(max_examples=examples(100), deadline=None)
@given(
    block=BLOCKS,
    size=st.integers(1, 50),
    resolution=st.sampled_from([0.0, 5e-324, 1e-9, 0.1, 0.3, 1.0, 1e300]),
)
def test_saving_loses_nothing(
    tmp_path_factory: pytest.TempPathFactory, block: Floats, size: int, resolution: float
) -> None:
    trace = Trace.from_chunks(write(block, NAMES, resolution=resolution, size=size).chunks)
    path = tmp_path_factory.mktemp("trace") / "x.trace"
    trace.save(path)
    loaded = Trace.load(path)
    assert loaded == trace
    assert bits(loaded) == bits(trace)


@settings(max_examples=examples(100), deadline=None)
@given(
    steps=arrays.arrays(np.float64, st.tuples(st.integers(1, 60), st.just(1)), elements=st.floats(-1e9, 1e9)),
    resolution=st.floats(1e-9, 10.0),
    size=st.integers(1, 70),
)
def test_quantised_values_are_the_nearest_multiple(steps: Floats, resolution: float, size: int) -> None:
    trace = Trace.from_chunks(write(steps, ["X"], resolution=resolution, size=size).chunks)
    expected = np.rint(steps[:, 0] / resolution) * resolution
    fits = np.abs(steps[:, 0] / resolution) < 2.0**50
    np.testing.assert_array_equal(trace["X"][fits], expected[fits])
    np.testing.assert_array_equal(trace["X"][~fits], steps[~fits, 0])


@pytest.mark.parametrize(("step", "bytes_each"), [(1.0, 1), (127.0, 1), (128.0, 2), (32768.0, 4), (1e8, 4), (1e14, 8)])
def test_quantised_columns_take_the_smallest_integers(step: float, bytes_each: int) -> None:
    block = (np.arange(1000.0) % 2)[:, None] * step
    one = TraceWriter(None, header(["X"], 1.0))
    one.rows(0, block)
    assert len(one.chunks[1]) == CHUNK_HEAD + 16 + 1 + 8 + 999 * bytes_each
    np.testing.assert_array_equal(Trace.from_chunks(one.chunks)["X"], block[:, 0])


def test_constant_columns_take_one_value() -> None:
    writer = TraceWriter(None, header(["X"]))
    writer.rows(0, np.full((1000, 1), np.nan))
    assert len(writer.chunks[1]) == CHUNK_HEAD + 16 + 1 + 8


def test_the_written_block_is_left_as_it_was() -> None:
    block = np.array([[0.26], [0.74]])
    TraceWriter(None, header(["X"], 0.5)).rows(0, block)
    assert block.tolist() == [[0.26], [0.74]]


def test_minus_zero_is_not_zero() -> None:
    block = np.array([[0.0], [-0.0]])
    assert np.signbit(Trace.from_chunks(write(block, ["X"]).chunks)["X"]).tolist() == [False, True]


def test_file_and_memory_hold_the_same_bytes(tmp_path: Path) -> None:
    block = np.random.default_rng(1).normal(size=(30, 3))
    path = tmp_path / "x.trace"
    write(block, NAMES, path)
    assert path.read_bytes() == b"".join(write(block, NAMES).chunks)


def test_plans_events_inputs_and_gaps_come_back() -> None:
    trace = Trace.from_chunks(write(np.zeros((20, 3)), NAMES, size=7).chunks)
    assert trace.plans == tuple(plan(tick=n, pieces=np.full((2, 5), n + 0.1)) for n in (0, 7, 14))
    assert trace.events == tuple(event(n) for n in (0, 7, 14))
    assert trace.inputs == tuple(received(n) for n in (0, 7, 14))
    assert trace.gaps == tuple(Gap(n, 0, 2) for n in (0, 7, 14))


@settings(max_examples=examples(100), deadline=None)
@given(tick=st.integers(-(2**63), 2**63 - 1), channel=st.text(max_size=20), payload=st.binary(max_size=300))
def test_inputs_are_any_bytes_on_any_channel(tick: int, channel: str, payload: bytes) -> None:
    writer = TraceWriter(None, header(["X"]))
    writer.input(Input(tick, channel, payload))
    assert Trace.from_chunks(writer.chunks).inputs == (Input(tick, channel, payload),)


@pytest.mark.parametrize("other", [Input(1, "c", b"p"), Input(0, "d", b"p"), Input(0, "c", b"q"), Input(0, "", b"cp")])
def test_traces_differ_by_one_field_of_an_input(other: Input) -> None:
    def trace(what: Input) -> Trace:
        writer = TraceWriter(None, header(["X"]))
        writer.input(what)
        return Trace.from_chunks(writer.chunks)

    assert trace(Input(0, "c", b"p")) == trace(Input(0, "c", b"p"))
    assert trace(Input(0, "c", b"p")) != trace(other)


def test_a_plan_differs_by_one_bit() -> None:
    pieces = np.ones((2, 5))
    other = pieces.copy()
    other[1, 4] = np.nextafter(1.0, 2.0)
    assert plan(pieces=pieces) == plan(pieces=pieces)
    assert plan(pieces=pieces) != plan(pieces=other)
    assert plan(command=0) == plan(command=0)  # nan as target


def test_a_plan_copies_its_pieces() -> None:
    pieces = np.ones((1, 5))
    kept = plan(pieces=pieces)
    pieces[:] = 2.0
    assert kept.pieces.tolist() == [[1.0] * 5]
    with pytest.raises(ValueError, match="read-only"):
        kept.pieces[0, 0] = 3.0


@pytest.mark.parametrize("shape", [(0, 5), (3, 4), (5,)])
def test_pieces_of_a_wrong_shape_are_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match="X: pieces of shape"):
        plan(pieces=np.zeros(shape))


def test_an_unknown_kind_of_plan_is_refused() -> None:
    with pytest.raises(ValueError, match="'jump'; possible are position, velocity, stop, set"):
        Plan("X", 0, 0.0, 0, "jump", 0.0, 1.0, 1.0, 1.0, 1.0, np.zeros((1, 5)))  # type: ignore[arg-type]


@pytest.mark.parametrize("resolution", [-1.0, np.nan, np.inf])
def test_a_resolution_that_is_none_is_refused(resolution: float) -> None:
    with pytest.raises(ValueError, match="X: resolution"):
        Signal("X", "mm", 0, resolution)


def test_signals_recorded_twice_are_refused() -> None:
    with pytest.raises(ValueError, match=r"twice: X$"):
        TraceWriter(None, header(["X", "Y", "X"]))


def test_a_trace_is_a_mapping_in_header_order() -> None:
    block = np.arange(9.0).reshape(3, 3)
    trace = Trace.from_chunks(write(block, ["b", "a", "c"]).chunks)
    assert list(trace) == list(trace.keys()) == ["b", "a", "c"]
    assert len(trace) == 3
    assert "a" in trace
    assert "d" not in trace
    assert trace.time.tolist() == [0.0, 0.001, 0.002]
    assert trace.base_cycle == 0.001
    assert [(signal.name, signal.unit, signal.index) for signal in trace.signals] == [
        ("b", "mm", 0),
        ("a", "mm", 1),
        ("c", "mm", 2),
    ]
    assert repr(trace) == "<Trace in memory: 3 signals x 3 ticks of 0.001 s, 1 plans, 1 events, 1 inputs, 1 gaps>"
    with pytest.raises(ValueError, match="read-only"):
        trace["a"][0] = 1.0
    with pytest.raises(KeyError, match="no signal 'd' in the trace"):
        trace["d"]
    assert trace.get("d") is None


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("Ram.set_postion", "no signal 'Ram.set_postion' in the trace; nearest: Ram.set_position, "),
        ("Rma.state", "no axis 'Rma' in the trace; nearest: Ram.state, "),
        ("state", "no signal 'state' in the trace; nearest: "),
    ],
)
def test_unknown_signals_are_refused_with_the_nearest_ones(name: str, said: str) -> None:
    trace = Trace.from_chunks(write(np.zeros((1, 3)), ["Ram.set_velocity", "Ram.set_position", "Ram.state"]).chunks)
    for ask in (trace.__getitem__, lambda key: trace.replace({key: [0.0]})):
        with pytest.raises(KeyError) as caught:
            ask(name)
        assert caught.value.args[0].startswith(said)


def test_a_trace_without_signals_has_no_nearest() -> None:
    with pytest.raises(KeyError, match="the trace has no signals"):
        Trace.from_chunks([*TraceWriter(None, header([])).chunks])["X.state"]


def test_replace_gives_another_trace(tmp_path: Path) -> None:
    block = np.arange(9.0).reshape(3, 3)
    trace = Trace.from_chunks(write(block, NAMES).chunks)
    other = trace.replace({NAMES[1]: [5, 6, 7]})
    assert other[NAMES[1]].tolist() == [5.0, 6.0, 7.0]
    assert trace[NAMES[1]].tolist() == [1.0, 4.0, 7.0]
    assert other[NAMES[0]].tolist() == trace[NAMES[0]].tolist()
    assert (trace.hash, other.hash) == ("ab" * 16, "")
    assert other != trace
    other.save(tmp_path / "x.trace")
    assert Trace.load(tmp_path / "x.trace") == other


def test_replaced_values_are_rounded_like_recorded_ones() -> None:
    trace = Trace.from_chunks(write(np.zeros((2, 1)), ["X"], resolution=0.5).chunks)
    assert trace.replace({"X": [0.7, 0.8]})["X"].tolist() == [0.5, 1.0]


def test_replace_checks_name_and_shape() -> None:
    trace = Trace.from_chunks(write(np.zeros((3, 3)), NAMES).chunks)
    with pytest.raises(KeyError, match="no signal 'Z'"):
        trace.replace({"Z": np.zeros(3)})
    with pytest.raises(ValueError, match=r"shape \(4,\); \(3,\) is expected"):
        trace.replace({NAMES[0]: np.zeros(4)})


def test_an_incomplete_trace_is_saved_as_such(tmp_path: Path) -> None:
    writer = write(np.zeros((9, 1)), ["X"], size=4)
    trace = Trace.from_chunks(writer.chunks[:-1])
    trace.save(tmp_path / "x.trace")
    assert Trace.load(tmp_path / "x.trace") == trace
    assert not trace.complete


def test_a_gap_stays_a_gap(tmp_path: Path) -> None:
    writer = TraceWriter(None, header(["X"]))
    writer.rows(3, np.zeros((2, 1)))
    writer.rows(9, np.ones((2, 1)))
    trace = Trace.from_chunks(writer.chunks)
    trace.save(tmp_path / "x.trace")
    assert trace.ticks.tolist() == Trace.load(tmp_path / "x.trace").ticks.tolist() == [3, 4, 9, 10]


def test_a_trace_without_signals_keeps_plans_and_events() -> None:
    writer = TraceWriter(None, header([]))
    writer.plan(plan())
    writer.event(event())
    writer.close(5, "00")
    trace = Trace.from_chunks(writer.chunks)
    assert (len(trace), trace.plans, trace.events, trace.complete) == (0, (plan(),), (event(),), True)


def test_nothing_is_written_where_nothing_can_be(tmp_path: Path) -> None:
    with pytest.raises(TraceError, match=r"nowhere/x\.trace: the trace cannot be written: No such file"):
        TraceWriter(tmp_path / "nowhere" / "x.trace", header(["X"]))


@settings(max_examples=examples(20), deadline=None)
@given(data=st.recursive(st.none() | st.floats() | st.text(), lambda inner: st.dictionaries(st.text(), inner)))
def test_the_header_is_kept_as_json_says(data: object) -> None:
    trace = Trace.from_chunks(TraceWriter(None, header(["X"], machine=data)).chunks)
    assert json.dumps(trace.header["machine"]) == json.dumps(data)


def test_the_gantry_survives(tmp_path: Path) -> None:
    trace = gantry(4)
    trace.save(tmp_path / "gantry.trace")
    assert Trace.load(tmp_path / "gantry.trace") == trace
