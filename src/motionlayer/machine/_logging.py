"""The message files of a run: what the machine description says about them, and who is told of trouble."""

import contextlib
import time
from collections.abc import Callable
from pathlib import Path
from typing import Final

from motionlayer.command import Ledger
from motionlayer.event import EventLog, Level, Levels
from motionlayer.machine._log_description import LogDescription
from motionlayer.machine._machine import Machine
from motionlayer.machine._outside import Told
from motionlayer.record.log import LocalTime, LogFolder, MessageLog, local_offset
from motionlayer.runtime import Mailbox, MailboxFull

CHANNEL: Final = "log"
"""The channel of the mailbox by which trouble with the files enters the run: when it comes depends on the computer."""


class Logging:
    """The message files of a run, or none.

    Args:
        machine: what runs; its folder is what a relative folder starts from.
        choice: the table `[log]`; True takes that of the machine, False writes no files.
        lossless: the run waits for the writer; otherwise messages that find no room are left out, and counted.
        wall_clock_ns: the time of day, ns since 1970 UTC.

    Attributes:
        levels: which messages are written; they may change during the run.
        folder: the root folder, None without files.

    Raises:
        LogError: the folder is in use by another run, or cannot be written.
    """

    def __init__(
        self,
        machine: Machine,
        choice: LogDescription | bool,
        *,
        lossless: bool,
        wall_clock_ns: Callable[[], int] = time.time_ns,
    ) -> None:
        self.levels = Levels()
        self.folder: Path | None = None
        self._log: MessageLog | None = None
        self._cycle = machine.description.base_cycle_ns
        self._epoch = 0
        self._mailbox: Mailbox | None = None
        self._wall_clock = wall_clock_ns
        self._fixed = False
        self._clock = LocalTime(0, self._cycle, _no_offset)
        description = machine.description.log if choice is True else choice
        if isinstance(description, LogDescription):
            self._open(description, machine.folder, lossless=lossless)

    def attach(self, events: EventLog, mailbox: Mailbox, ledger: Ledger) -> None:
        """Write the events of a run from now on, and tell it of trouble."""
        self._mailbox = mailbox
        mailbox.register(CHANNEL, Told(events, ledger, CHANNEL))  # also without files: a replay needs it
        if self._log is not None:
            events.listen(self._log)

    @property
    def missing(self) -> int:
        """Messages that should be in a file and never will be."""
        return self._log.missing if self._log is not None else 0

    @property
    def trouble(self) -> str:
        """Why messages could not be written the last time that was so; "" if it never was."""
        return self._log.trouble if self._log is not None else ""

    def time(self, tick: int) -> str:
        """Return the local time of a tick as messages show it; without files that of a run which begins in 1970 (D40).

        Time only goes on: ask for ticks in their order.
        """
        return self._clock.text(tick)

    def slip(self, ns: int) -> None:
        """Let the messages from now on be later: the run was held up by `ns`."""
        self._epoch += ns
        self._clock.slip(ns)
        if self._log is not None:
            self._log.slip(ns)

    def align(self, tick: int) -> None:
        """Let a tick that begins now be at the time of day; never earlier than the one before it."""
        behind = self._wall_clock() - (self._epoch + tick * self._cycle)
        if behind > 0 and not self._fixed:
            self.slip(behind)

    def close(self) -> None:
        """Write everything and give the folder back.

        Raises:
            LogError: the writer failed.
        """
        if self._log is not None:
            self._log.close()

    def _open(self, description: LogDescription, base: Path, *, lossless: bool) -> None:
        self.levels.level = Level[description.level.upper()]
        self.folder = base / description.folder
        fixed = description.start_ns
        self._fixed = fixed is not None
        self._epoch = self._wall_clock() if fixed is None else fixed
        # A start that is given is the local time everywhere, so that files compare from computer to computer.
        offset = local_offset if fixed is None else _no_offset
        local, self._clock = (LocalTime(self._epoch, self._cycle, offset) for _ in range(2))
        folder = LogFolder(self.folder, port=description.port, size=description.size, on_trouble=self._tell)
        self._log = MessageLog(folder, local, self.levels, lossless=lossless)

    def _tell(self, text: str) -> None:
        """Hand trouble to the next tick; called by the thread that writes."""
        if self._mailbox is not None:
            with contextlib.suppress(MailboxFull):  # it stays readable in `trouble`
                self._mailbox.post(CHANNEL, text.encode())


def _no_offset(_second: int) -> int:
    return 0
