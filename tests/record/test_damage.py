from pathlib import Path

import numpy as np
import pytest

from motionlayer.record import Trace, TraceError
from motionlayer.record._container import HEAD, chunks, pack_chunk, pack_head

from .samples import header, write


def test_every_truncation_is_refused_or_read_up_to_its_last_chunk(tmp_path: Path) -> None:
    block = np.arange(12.0).reshape(12, 1)
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
        found = [chunk for chunk in chunks(memoryview(whole[:length]), head) if chunk is not None]
        rows = sum(tag == b"ROWS" for tag, _ in found)
        assert not trace.complete
        assert trace.hash == ""
        assert trace["X"].tolist() == block[: min(5 * rows, 12), 0].tolist()
        assert len(trace.plans) == sum(tag == b"PLAN" for tag, _ in found)


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
            assert trace["X"].tolist() == block[: len(trace.ticks), 0].tolist()


def test_bytes_behind_the_tail_make_it_incomplete(tmp_path: Path) -> None:
    path = tmp_path / "x.trace"
    for rest in (b"x", pack_chunk(b"NOTE", b"")):
        path.write_bytes(b"".join(write(np.zeros((3, 1)), ["X"]).chunks) + rest)
        assert not Trace.load(path).complete


def test_a_chunk_that_proves_itself_but_makes_no_sense_ends_the_reading() -> None:
    writer = write(np.zeros((3, 1)), ["X"])
    for tag in (b"ROWS", b"PLAN", b"EVNT", b"TAIL"):
        chunks_read = [*writer.chunks[:-1], pack_chunk(tag, b"[1]"), writer.chunks[-1]]
        trace = Trace.from_chunks(chunks_read)
        assert not trace.complete
        assert len(trace.ticks) == 3


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
