"""On a real terminal, in a time that the test makes."""

import os
import select
from collections.abc import Iterator
from typing import TextIO

import pytest

from motionlayer.cli._progress import DELAY, PERIOD, Progress


class Terminal:
    def __init__(self) -> None:
        self.master, slave = os.openpty()
        self.stream: TextIO = os.fdopen(slave, "w")
        self.now = 0.0

    def read(self) -> str:
        self.stream.flush()
        text = b""
        while select.select([self.master], [], [], 0.0)[0]:
            text += os.read(self.master, 4096)
        return text.decode()


@pytest.fixture
def terminal() -> Iterator[Terminal]:
    terminal = Terminal()
    yield terminal
    terminal.stream.close()
    os.close(terminal.master)


def progress(terminal: Terminal, ticks: int | None) -> Progress:
    return Progress(ticks, 0.001, terminal.stream, lambda: terminal.now)


def test_a_short_run_shows_nothing(terminal: Terminal) -> None:
    with progress(terminal, 10_000) as watch:
        terminal.now = DELAY - 0.01
        watch(9_000)
    assert terminal.read() == ""


def test_a_long_run_shows_share_and_time(terminal: Terminal) -> None:
    with progress(terminal, 10_000) as watch:
        terminal.now = DELAY
        watch(2_500)
        shown = terminal.read()
        assert "simulating" in shown
        assert "25%" in shown
        assert "2.5 s of the run" in shown
        terminal.now += PERIOD / 2
        watch(3_000)
        assert terminal.read() == ""
        terminal.now += PERIOD
        watch(5_000)
        assert "50%" in terminal.read()
    assert "\n" in terminal.read()


def test_without_a_known_end_the_time_is_shown(terminal: Terminal) -> None:
    with progress(terminal, None) as watch:
        terminal.now = DELAY
        watch(2_500)
        shown = terminal.read()
    assert "2.5 s of the run" in shown
    assert "%" not in shown


def test_nothing_is_shown_where_nobody_looks(terminal: Terminal) -> None:
    reader, writer = os.pipe()
    with os.fdopen(writer, "w") as stream, Progress(10_000, 0.001, stream, lambda: terminal.now) as watch:
        terminal.now = DELAY
        watch(5_000)
    with os.fdopen(reader) as read:
        assert read.read() == ""
