from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.record import Trace, TraceError
from motionlayer.record._container import CHUNK, HEAD, Chunk, chunks, pack_chunk, pack_head
from tests.effort import examples

from .samples import header, write


def test_every_truncation_is_refused_or_read_up_to_its_last_chunk(tmp_path: Path) -> None:
    block = np.arange(8.0).reshape(8, 1)
    whole = b"".join(write(block, ["X"], size=5).chunks)
    path = tmp_path / "x.trace"
    head = HEAD.size + HEAD.unpack_from(whole)[1]
    for length in range(len(whole)):
        path.write_bytes(whole[:length])
        if length < head:
            with pytest.raises(TraceError, match=r"x\.trace: .*offset"):
                Trace.load(path)
            continue
        trace = Trace.load(path)
        found = [chunk.tag for chunk in chunks(memoryview(whole[:length]), head) if isinstance(chunk, Chunk)]
        rows = found.count(b"ROWS")
        assert not trace.complete
        assert (trace.hash, trace.damage) == ("", "")
        assert trace["X"].tolist() == block[: min(5 * rows, 8), 0].tolist()
        counts = len(trace.plans), len(trace.events), len(trace.inputs), len(trace.gaps)
        assert counts == tuple(map(found.count, (b"PLAN", b"EVNT", b"INPT", b"GAP ")))


def test_every_damaged_byte_is_noticed(tmp_path: Path) -> None:
    block = np.arange(8.0).reshape(8, 1)
    whole = bytearray(b"".join(write(block, ["X"], size=5).chunks))
    path = tmp_path / "x.trace"
    head = HEAD.size + HEAD.unpack_from(whole)[1]
    for place in range(len(whole)):
        broken = bytearray(whole)
        broken[place] ^= 0x41
        path.write_bytes(broken)
        if place < head:
            with pytest.raises(TraceError):
                Trace.load(path)
        else:
            trace = Trace.load(path)
            assert not trace.complete
            assert f"{len(trace.ticks)} ticks were read" in trace.damage
            assert trace["X"].tolist() == block[: len(trace.ticks), 0].tolist()


def offsets(data: bytes) -> list[tuple[bytes, int]]:
    found = chunks(memoryview(data), HEAD.size + HEAD.unpack_from(data)[1])
    return [(chunk.tag, chunk.offset) for chunk in found if isinstance(chunk, Chunk)]


def damage(data: bytes) -> str:
    trace = Trace.from_chunks([data])
    assert not trace.complete
    assert trace.hash == ""
    return trace.damage


@pytest.mark.parametrize("wrong", [4, 0, 10**6, 2**63])
def test_damage_is_named_with_its_place_and_size(wrong: int) -> None:
    whole = b"".join(write(np.arange(12.0).reshape(12, 1), ["X"], size=5).chunks)
    number, (tag, start) = next(found for found in enumerate(offsets(whole), 1) if found[1][0] == b"ROWS")
    size = len(whole)
    lost = f"; 0 ticks were read, {size - start} of {size} bytes were not"
    flipped = bytearray(whole)
    flipped[start + 40] ^= 1
    assert (
        damage(bytes(flipped)) == f"chunk {number} at offset {start}: the checksum of the ROWS chunk does not fit{lost}"
    )
    long = whole[:start] + CHUNK.pack(tag, wrong) + whole[start + CHUNK.size :]
    what = "length" if wrong > size else "checksum"
    assert damage(long) == f"chunk {number} at offset {start}: the {what} of the ROWS chunk does not fit{lost}"
    zeroed = whole[:start] + bytes(50) + whole[start + 50 :]
    nothing = bytes(4)
    assert damage(zeroed) == f"chunk {number} at offset {start}: no chunk begins with {nothing!r}{lost}"


@settings(max_examples=examples(200), deadline=None)
@given(data=st.data())
def test_whatever_is_overwritten_in_the_middle_is_damage(data: st.DataObject) -> None:
    whole = b"".join(write(np.arange(12.0).reshape(12, 1), ["X"], size=5).chunks)
    first = offsets(whole)[0][1]
    start = data.draw(st.integers(first, len(whole) - 1))
    new = data.draw(st.binary(min_size=1, max_size=len(whole) - start))
    broken = whole[:start] + new + whole[start + len(new) :]
    trace = Trace.from_chunks([broken])
    assert trace.complete == (broken == whole)
    # Where nothing whole follows, nobody can tell a wrong length from a cut.
    assert trace.damage or broken == whole or start + len(new) > offsets(whole)[-1][1]


@pytest.mark.parametrize("rest", [b"x", bytes(1000), pack_chunk(b"NOTE", b"")])
def test_bytes_behind_the_end_are_told_from_damage_before_it(tmp_path: Path, rest: bytes) -> None:
    whole = b"".join(write(np.zeros((3, 1)), ["X"]).chunks)
    path = tmp_path / "x.trace"
    path.write_bytes(whole + rest)
    trace = Trace.load(path)
    assert not trace.complete
    assert trace.damage == (
        f"the trace ends at offset {len(whole)} with all of its 3 ticks; "
        f"the {len(rest)} bytes behind its end do not belong to it"
    )
    assert repr(trace).endswith(", damaged>")


def test_a_chunk_that_proves_itself_but_makes_no_sense_ends_the_reading() -> None:
    writer = write(np.zeros((3, 1)), ["X"])
    for tag in (b"ROWS", b"PLAN", b"EVNT", b"INPT", b"GAP ", b"TAIL"):
        chunks_read = [*writer.chunks[:-1], pack_chunk(tag, b"[1]"), writer.chunks[-1]]
        trace = Trace.from_chunks(chunks_read)
        assert not trace.complete
        assert f"the {tag.decode().rstrip()} chunk makes no sense: " in trace.damage
        assert f"offset {sum(map(len, writer.chunks[:-1]))}: " in trace.damage
        assert len(trace.ticks) == 3


def test_rows_that_are_missing_as_a_whole_are_noticed_at_the_end() -> None:
    writer = write(np.zeros((12, 1)), ["X"], size=5)
    data = b"".join(writer.chunks)
    at = [place for tag, place in offsets(data) if tag == b"ROWS"][-1]
    end = next(place for _, place in offsets(data) if place > at)
    assert "the TAIL chunk makes no sense: it counts 12 ticks, the rows before it hold 10; 10 ticks" in damage(
        data[:at] + data[end:]
    )


def test_damage_stays_when_values_are_replaced_and_is_no_part_of_the_comparison(tmp_path: Path) -> None:
    data = b"".join(write(np.zeros((3, 1)), ["X"]).chunks) + b"x"
    trace = Trace.from_chunks([data])
    assert trace.replace({"X": np.ones(3)}).damage == trace.damage
    trace.save(tmp_path / "x.trace")
    saved = Trace.load(tmp_path / "x.trace")
    assert saved == trace
    assert (saved.complete, saved.damage) == (False, "")


def test_unknown_chunks_are_passed_over() -> None:
    writer = write(np.zeros((3, 1)), ["X"])
    trace = Trace.from_chunks([writer.chunks[0], pack_chunk(b"NEWS", b"?"), *writer.chunks[1:]])
    assert trace.complete


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04 something else", b"\x93mltrac"])
def test_a_foreign_file_is_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "x.zip"
    path.write_bytes(content)
    with pytest.raises(TraceError, match=r"x\.zip: not a trace of motionlayer: offset 0 .*motionlayer run --trace"):
        Trace.load(path)


@pytest.mark.parametrize("name", ["missing.trace", "."])
def test_a_file_that_cannot_be_read_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(TraceError, match="cannot be read"):
        Trace.load(tmp_path / name)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"format": 2}, "says format 2; this version reads format 1"),
        ({"signals": [{"name": "X"}]}, "lacks or garbles"),
        ({"base_cycle_ns": None}, "lacks or garbles"),
        ({"signals": [{"name": "X", "unit": "mm", "resolution": -1}]}, "lacks or garbles"),
    ],
)
def test_a_header_that_is_not_understood_is_refused(change: dict[str, object], message: str) -> None:
    with pytest.raises(TraceError, match=message):
        Trace.from_chunks([pack_head({**header(["X"]), **change})])
