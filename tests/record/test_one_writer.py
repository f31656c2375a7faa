"""A trace file has one writer at a time."""

import os
import threading
from pathlib import Path

import numpy as np
import pytest

from motionlayer.record import Trace, TraceError
from motionlayer.record._writer import TraceWriter
from tests.record.samples import header, write


def test_a_second_writer_is_refused_and_destroys_nothing(tmp_path: Path) -> None:
    path = tmp_path / "run.trace"
    first = TraceWriter(path, header(["X"]))
    first.rows(0, np.ones((3, 1)))
    with pytest.raises(TraceError, match=r"run\.trace: another run still writes this trace; wait for its end"):
        TraceWriter(path, header(["X"]))
    first.close(3, "ab" * 16)
    assert Trace.load(path).complete
    np.testing.assert_array_equal(Trace.load(path)["X"], np.ones(3))


@pytest.mark.parametrize("how", ["closed", "abandoned"])
def test_a_file_is_free_when_its_writer_has_ended_and_is_replaced(tmp_path: Path, how: str) -> None:
    path = tmp_path / "run.trace"
    first = TraceWriter(path, header(["X"]))
    first.rows(0, np.ones((1000, 1)))
    first.close(1000, "ab" * 16) if how == "closed" else first.abandon()
    write(np.zeros((2, 1)), ["X"], path)
    assert Trace.load(path).complete
    np.testing.assert_array_equal(Trace.load(path)["X"], np.zeros(2))


def test_a_pipe_has_no_lock(tmp_path: Path) -> None:
    path = tmp_path / "pipe"
    os.mkfifo(path)
    read: list[bytes] = []
    reader = threading.Thread(target=lambda: read.append(path.read_bytes()))
    reader.start()
    write(np.zeros((2, 1)), ["X"], path)
    reader.join(timeout=60.0)
    (tmp_path / "run.trace").write_bytes(read[0])
    assert Trace.load(tmp_path / "run.trace").complete
