"""The rows `event.*`: what a message costs the cycle, and how many reach the files."""

import tempfile
import time
from pathlib import Path
from statistics import median
from time import perf_counter_ns
from typing import Final

from motionlayer.bench._row import Effort, Failed, Figure
from motionlayer.bench._timing import quiet
from motionlayer.event import Device, Event, EventLog, Kind, Level, Levels, Subdevice, device_of
from motionlayer.record.log import LocalTime, LogFolder, MessageLog

CYCLE: Final = 1_000_000
"""Base cycle, ns."""

FEW: Final = 1000
"""Messages of a sample; the thread that writes rests meanwhile, as it does nearly always in a run."""

MANY: Final = 100
"""Times the samples: messages written in a round."""

PER_TICK: Final = 10

_AXIS: Final = device_of(Device.Axis, 1)


def record(effort: Effort) -> Figure:
    """Time a message from making it to its place in the queue of the writer, mean of many; every one is written."""
    with tempfile.TemporaryDirectory() as folder:
        log, events = _opened(Path(folder))
        try:
            means = []
            with quiet():
                for _ in range(max(3, effort.samples // 50)):
                    start = perf_counter_ns()
                    _tell(events, FEW)
                    means.append((perf_counter_ns() - start) / FEW)
                    while log.backlog:
                        time.sleep(0.001)
        finally:
            log.close()
    return Figure(median(means) / 1e3)


def per_second(effort: Effort) -> Figure:
    """Count messages from making them to the file that is whole, as quickly as that goes on."""
    count = MANY * effort.samples
    rates = []
    for _ in range(effort.runs):
        with tempfile.TemporaryDirectory() as folder:
            start = perf_counter_ns()
            log, events = _opened(Path(folder))
            _tell(events, count)
            log.close()
            rates.append(count / ((perf_counter_ns() - start) * 1e-9))
            lines = sum(path.read_bytes().count(b"\n") for path in Path(folder).rglob("*.txt"))
            if lines != count:
                raise Failed(f"{lines} lines of {count} messages are in the files")
    return Figure(median(rates), "one thread makes the messages, the other one writes; both share a core's interpreter")


def _opened(folder: Path) -> tuple[MessageLog, EventLog]:
    log = MessageLog(LogFolder(folder), LocalTime(0, CYCLE, lambda _second: 0), Levels(Level.VERBOSE))
    events = EventLog()
    events.listen(log)
    return log, events


def _tell(events: EventLog, count: int) -> None:
    level, kind, part = Level.VERBOSE, Kind.DONE, Subdevice.fbMovePtP
    for number in range(count):
        events.add(Event(number // PER_TICK, level, kind, "X", "X.move_absolute", 0, number, _AXIS, part))
