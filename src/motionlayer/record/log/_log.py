"""`MessageLog`: from the cycle to the files, by way of a thread."""

import atexit
import time
from collections import deque
from threading import Event as Signal
from threading import Thread
from typing import Final, NamedTuple

from motionlayer.event import Event, Level, Levels, Lists, MessageList
from motionlayer.record.log._errors import LogError
from motionlayer.record.log._line import Lines, note
from motionlayer.record.log._writer import LogFolder
from motionlayer.record.log._zone import LocalTime, Shift

INTERVAL: Final = 0.1
"""Seconds of wall time between two looks at the queue: what a killed process loses."""

SYNC: Final = 5.0
"""Seconds of wall time between two calls of fsync: what a power cut loses."""

CAPACITY: Final = 1 << 16
"""Messages that may wait for the thread."""

BATCH: Final = 4096
"""Messages that become one write."""


class _Slip(NamedTuple):
    """From here on the run is later by `ns`."""

    ns: int


class _Lost(NamedTuple):
    """Messages that found no room, from a tick on."""

    tick: int
    number: int


class MessageLog:
    """A listener of events that writes those of interest into files.

    Its methods belong to the cycle thread. It closes itself at the exit of the interpreter at the latest.

    Args:
        folder: the files; its lock is held until `close`.
        local: the time of ticks.
        levels: which messages are written; may be changed during the run.
        lossless: the run waits when the queue is full; otherwise messages are left out and counted.
        capacity: messages that may wait for the thread.

    Raises:
        LogError: the first file cannot be written.
    """

    def __init__(
        self,
        folder: LogFolder,
        local: LocalTime,
        levels: Levels,
        *,
        lossless: bool = True,
        capacity: int = CAPACITY,
    ) -> None:
        folder.probe(local.date)
        self._passes = levels.passes
        self._folder = folder
        self._local = local
        self._lines = Lines(local)
        self._lists = Lists()
        self._lossless = lossless
        self._capacity = capacity
        self._queue: deque[Event | _Slip | _Lost] = deque()
        self._limit = capacity  # 0 while messages are left out, so that one comparison does
        self._gap = _Lost(0, 0)
        self._overflowed = 0
        self._wake, self._room = Signal(), Signal()
        self._closing = False
        self._fault: BaseException | None = None
        # A daemon: a process that ends without closing must not hang; `close` comes by way of atexit then.
        self._thread = Thread(target=self._work, name="message log", daemon=True)
        self._thread.start()
        atexit.register(self.close)

    @property
    def missing(self) -> int:
        """Messages of interest that are in no file and will never be."""
        return self._overflowed + self._folder.missing

    @property
    def trouble(self) -> str:
        """Why lines could not be written the last time that was so; "" if it never was."""
        return self._folder.trouble

    @property
    def backlog(self) -> int:
        """Messages that wait for the thread."""
        return len(self._queue)

    def __call__(self, event: Event) -> None:
        """Take in a message.

        Raises:
            LogError: the thread failed.
        """
        if self._passes(event) and (len(self._queue) < self._limit or self._has_room(event.tick)):
            self._queue.append(event)

    def slip(self, ns: int) -> None:
        """Let the messages from now on be later by `ns`: the run was held up.

        Raises:
            ValueError: negative: the order of lines would be lost.
        """
        if ns < 0:
            raise ValueError(f"slip({ns}): time never goes back (ns)")
        self._queue.append(_Slip(ns))

    def close(self) -> None:
        """Write everything, end the thread and give the folder back.

        Raises:
            LogError: the thread failed; this is a fault of its own.
        """
        if self._closing:
            return
        self._closing = True
        atexit.unregister(self.close)
        if self._gap.number:
            self._queue.append(self._gap)
        self._wake.set()
        self._thread.join()
        self._check()

    def _check(self) -> None:
        if self._fault is not None:
            raise LogError("the thread that writes messages failed; please report it") from self._fault

    def _has_room(self, tick: int) -> bool:
        """Wait for room, or count what finds none."""
        self._wake.set()
        if self._lossless:
            while len(self._queue) > self._capacity // 2:
                self._check()
                self._room.clear()
                self._room.wait(INTERVAL)
            return True
        # Half empty first, so that an overload gives few long gaps and not many short ones.
        if len(self._queue) > self._capacity // 2:
            self._gap = _Lost(self._gap.tick if self._gap.number else tick, self._gap.number + 1)
            self._overflowed += 1
            self._limit = 0
            return False
        self._queue.append(self._gap)
        self._gap, self._limit = _Lost(0, 0), self._capacity
        return True

    def _work(self) -> None:
        synced = time.monotonic()
        try:
            while not self._closing:
                self._wake.wait(INTERVAL)
                self._wake.clear()
                self._drain()
                self._folder.retry()
                if time.monotonic() - synced >= SYNC:
                    self._folder.sync()
                    synced = time.monotonic()
            self._drain()
        except BaseException as error:  # noqa: BLE001 - it is raised in the cycle thread
            self._fault = error
        finally:
            self._folder.close()

    def _drain(self) -> None:
        while self._queue:
            self._batch(min(len(self._queue), BATCH))
            self._room.set()

    def _batch(self, count: int) -> None:
        """Write the next messages, those of one date at a time."""
        lines: dict[MessageList, list[str]] = {one: [] for one in MessageList}
        local, take, line_of, lists = self._local, self._queue.popleft, self._lines.line, self._lists
        date, midnights = local.date, local.midnights
        for _ in range(count):
            item = take()
            if type(item) is Event:
                of, line = lists[item.device], line_of(item)
            elif type(item) is _Lost:
                of, line = MessageList.MOTION, _gap(local.text(item.tick), item.number)
            else:
                local.slip(item[0])
                continue
            if local.midnights != midnights:
                self._flush(lines, date)
                date, midnights = local.date, local.midnights
                if local.shift is not None:
                    lines[MessageList.MOTION].append(_shifted(line, local.shift))
            if of is not None:
                lines[of].append(line)
        self._flush(lines, date)

    def _flush(self, lines: dict[MessageList, list[str]], date: str) -> None:
        for of, some in lines.items():
            if some:
                self._folder.write(of, date, "".join(some).encode())
                some.clear()


def _gap(at: str, count: int) -> str:
    return note(at, Level.WARNING, count, f"{count} messages are missing here: the writer could not keep up")


def _shifted(line: str, shift: Shift) -> str:
    """Return a note, with the time of `line`, that the local time jumped."""
    text = f"local time is UTC{_hours(shift.after)} from here on, UTC{_hours(shift.before)} before"
    return note(line.split("\t", 2)[1], Level.INFO, 0, text)


def _hours(offset: int) -> str:
    hours, seconds = divmod(abs(offset), 3600)
    return f"{'-' if offset < 0 else '+'}{hours:02d}:{seconds // 60:02d}"
