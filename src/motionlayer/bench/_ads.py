"""The group `ads`: what real ADS clients see of a run, and what the run feels of them.

The client is pyads, in a process of its own, and so is the server that it is compared with: the test server that pyads
brings. Both hold the same variables. Round trips of ours and of the peer take turns on two connections of one client,
so that whatever slows the computer down meets both.

The peer answers out of a dictionary, in one thread per client; it publishes nothing and runs no cycle. A write of ours
goes on to the process of the run, and is answered once all variables have been published with it. With axes that
move, it shares the cores with our cycle as our server does: a core that never sleeps wakes either of them sooner.
"""

import statistics
import time
from collections.abc import Callable
from functools import cache
from typing import Final, NamedTuple

from motionlayer.bench._ads_load import AXES, ask, count, declare, moving, paused, processor_time, served
from motionlayer.bench._row import MICRO, Effort, Failed, Figure, Goal, Row
from motionlayer.iec import DINT, InputArray, SymbolTable
from motionlayer.machine import RealTime

CLIENTS: Final = 20
NOTIFICATIONS: Final = 50
"""Of each client."""

NOTIFIED: Final = 0.01
"""Seconds between two samples of a notification."""

EVERY: Final = 10
"""The same in ticks."""

PER_TURN: Final = 10
"""Samples of the effort for each call in a turn: 200 calls of 2000 samples."""

DURATION: Final = 0.01
"""Seconds for each sample of the effort: 20 s of 2000."""

SYMBOLS: Final = 10_000
CYCLE_NS: Final = 1_000_000


Beside = Callable[[RealTime, Callable[[], dict[str, float]]], dict[str, float]]
"""`paused` or `moving`."""


def _over(act: str, axes: int, beside: Beside) -> Callable[[Effort], Figure]:
    """Return what compares an act of pyads with a run, and the same with the peer, in turns.

    Args:
        act: of `_ads_client`.
        axes: of the machine.
        beside: what the run does meanwhile.
    """

    def measure(effort: Effort) -> Figure:
        calls = max(1, effort.samples // PER_TURN)
        with served(axes) as run:
            found = beside(run, lambda: ask(effort, "rates", run, act=act, calls=calls))
        ours, peer = found["ours"], found["peer"]
        return Figure(ours / peer, f"{ours:.4g} over {peer:.4g} calls a second")

    return measure


def latency(effort: Effort) -> Figure:
    """Return how many cycles go by until a write is acknowledged, while all axes move."""
    with served(AXES) as run:
        times = moving(run, lambda: ask(effort, "latencies", run, calls=effort.samples))
    cycles = sorted(one * 1e9 / CYCLE_NS for one in times)
    median, longest = statistics.median(cycles), cycles[-1]
    return Figure(cycles[int(0.99 * (len(cycles) - 1))], f"median {median:.3g}, max {longest:.3g} cycles of 1 ms")


class _Loaded(NamedTuple):
    """What a run with notifications was like, and the same without.

    Attributes:
        samples: that came.
        lost: that were to come between them.
        core: share of a core that the server took.
        compute: p99 with and without, ns.
        late: the same of the lateness.
    """

    samples: int
    lost: int
    core: float
    compute: tuple[int, int]
    late: tuple[int, int]


@cache
def _loaded(effort: Effort) -> _Loaded:
    """Run with notifications and without; done once for all rows that tell of it."""
    duration = DURATION * effort.samples
    with served(AXES) as run:
        moving(run, lambda: time.sleep(duration))
        alone = _p99(run)
    with served(AXES) as run:
        found, core = moving(run, lambda: _counted(run, duration))
        loaded = _p99(run)
    return _Loaded(found["samples"], found["lost"], core, (loaded[0], alone[0]), (loaded[1], alone[1]))


def _counted(run: RealTime, duration: float) -> tuple[dict[str, int], float]:
    """Return what the reader has counted, and the share of a core that the server took meanwhile."""
    pid = run.ads.pid
    if pid is None:
        raise Failed("the server runs in no process of its own")
    begin, used = time.perf_counter(), processor_time(pid)
    found = count(run, clients=CLIENTS, notifications=NOTIFICATIONS, cycle=NOTIFIED, every=EVERY, duration=duration)
    core = (processor_time(pid) - used) / (time.perf_counter() - begin)
    if found["silent"]:
        raise Failed(f"{found['silent']} of {CLIENTS * NOTIFICATIONS} notifications never came")
    return found, core


def _p99(run: RealTime) -> tuple[int, int]:
    found = run.statistics
    return found.compute.spread.p99, found.lateness.spread.p99


def delivered(effort: Effort) -> Figure:
    """Return the share of the samples that the raw reader has got, of those that the ticks say there must be."""
    found = _loaded(effort)
    due = found.samples + found.lost
    return Figure(found.samples / due, f"{found.samples} of {due} samples")


def server_core(effort: Effort) -> Figure:
    """Return the share of a core that the server takes meanwhile."""
    return Figure(_loaded(effort).core)


def compute(effort: Effort) -> Figure:
    """Compare the 99th percentile of the time of a cycle with that load and without."""
    loaded, alone = _loaded(effort).compute
    return Figure(loaded / alone, f"{loaded / 1e3:.3g} over {alone / 1e3:.3g} µs")


def late(effort: Effort) -> Figure:
    """Return by how much the 99th percentile of the lateness grows with that load."""
    loaded, alone = _loaded(effort).late
    return Figure((loaded - alone) / 1e3, f"{loaded / 1e3:.3g} less {alone / 1e3:.3g} µs")


def upload(effort: Effort) -> Figure:
    """Time the upload of all symbols by pyads, with the objects it makes of them."""
    with served(1, _many) as run:
        *times, found = paused(run, lambda: ask(effort, "upload", run, calls=effort.runs))
    if found < SYMBOLS:
        raise Failed(f"{found} symbols came, {SYMBOLS} were declared")
    return Figure(statistics.median(times) * 1e3, f"{found} symbols")


def _many(symbols: SymbolTable) -> None:
    declare(symbols)
    for number in range(SYMBOLS):
        name = f"GVL.Number{number}"
        symbols.add(name, InputArray(DINT, None, None, name))


def _least(bound: float) -> Goal:
    return Goal(bound, at_least=True)


ROWS: Final = (
    Row("read.paused", "ratio", _least(1.0), _over("read", 1, paused)),
    Row("read.running", "ratio", _least(0.5), _over("read", AXES, moving)),
    Row("by_name", "ratio", _least(1.0), _over("by_name", 1, paused)),
    Row("sum_50", "ratio", _least(1.0), _over("sum_50", 1, paused)),
    Row("struct_write", "ratio", _least(1.0), _over("struct_write", 1, paused)),
    Row("latency.p99", "cycles", Goal(3), latency),
    Row("notify.delivered", "share", _least(1.0), delivered),
    Row("notify.server_core", "cores", Goal(0.5), server_core),
    Row("cycle.compute_p99", "ratio", Goal(1.2), compute),
    Row("cycle.late_p99", MICRO, Goal(200), late),
    Row("upload.symbols_10000", "ms", Goal(300), upload),
)
