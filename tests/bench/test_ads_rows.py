"""The rows of the group `ads`, measured with next to no repetitions. Nothing here judges a time."""

import math
import struct
import sys
from pathlib import Path

import pytest

from motionlayer.bench import GROUPS, Effort, Environment, Failed, Row, Skipped
from motionlayer.bench import _ads_load as load
from motionlayer.bench._ads_reader import Client, missing

HERE = Environment(Path(sys.executable))
TINY = Effort(samples=30, runs=1, peers=HERE)
ROWS = {row.name: row for row in GROUPS["ads"]}


def test_the_ads_group_has_these_rows() -> None:
    assert [(row.name, row.unit, str(row.goal)) for row in GROUPS["ads"]] == [
        ("read.paused", "ratio", "≥ 1"),
        ("read.running", "ratio", "≥ 0.5"),
        ("by_name", "ratio", "≥ 1"),
        ("sum_50", "ratio", "≥ 1"),
        ("struct_write", "ratio", "≥ 1"),
        ("latency.p99", "cycles", "≤ 3"),
        ("notify.delivered", "share", "≥ 1"),
        ("notify.server_core", "cores", "≤ 0.5"),
        ("cycle.compute_p99", "ratio", "≤ 1.2"),
        ("cycle.late_p99", "µs", "≤ 200"),
        ("upload.symbols_10000", "ms", "≤ 300"),
    ]


@pytest.mark.slow
@pytest.mark.parametrize("row", GROUPS["ads"], ids=lambda row: row.name)
def test_every_row_gives_a_number(row: Row) -> None:
    assert math.isfinite(row.measure(TINY).value)


@pytest.mark.slow
def test_without_pyads_the_row_is_skipped(tmp_path: Path) -> None:
    with pytest.raises(Skipped, match="no pyads: "):
        ROWS["read.paused"].measure(TINY._replace(peers=Environment(tmp_path / "no" / "python")))


@pytest.mark.slow
def test_a_server_that_refuses_is_a_failure() -> None:
    with load.served(1, lambda _symbols: None) as run, pytest.raises(Failed, match="ADSError"):
        load.paused(run, lambda: load.ask(TINY, "latencies", run, calls=1))


def notified(ticks: list[int]) -> Client:
    """Return a client that was sent samples of notification 7 at these ticks; time has slipped after the second."""
    client = Client.__new__(Client)
    client.stamps, client.ticks, client._clock = {}, {}, 7
    for number, tick in enumerate(ticks):
        stamp = tick * 10_000 + (700_000 if number > 1 else 0)
        samples = struct.pack("<QI2Id", stamp, 1, 7, 8, float(tick))
        client._count(struct.pack("<2I", 4 + len(samples), 1) + samples)
    return client


@pytest.mark.parametrize(
    ("ticks", "lost"),
    [
        ([0, 3, 13, 23], 0),
        ([0, 10, 21, 30], 0),  # a look that was a tick late
        ([0, 10, 40, 50], 2),
        ([0, 100, 110, 120], 0),  # the first sample comes when it likes
    ],
)
def test_the_reader_finds_what_is_missing_between_samples(ticks: list[int], lost: int) -> None:
    client = notified(ticks)
    assert len(client.stamps[7]) == len(ticks)
    assert missing(client.stamps[7], client.ticks, 10) == lost


def test_the_structure_has_the_size_that_the_peer_has() -> None:
    assert load.Sample.type.size == 32
