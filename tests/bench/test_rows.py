"""The rows of the group `core`, measured with next to no repetitions. Nothing here judges a time."""

import gc
import math
from pathlib import Path

import pytest

from motionlayer._kernel import MODE
from motionlayer.bench import GROUPS, Effort, Failed, Goal, Row, Skipped
from motionlayer.bench import _command as command
from motionlayer.bench import _load as load
from motionlayer.bench import _recording as recording
from motionlayer.bench._timing import median_us, quiet
from motionlayer.record import Trace

TINY = Effort(samples=3, runs=1)
PROCESSES = ("demo.", "start.", "help.")
INSIDE = [row for row in GROUPS["core"] if not row.name.startswith(PROCESSES)]
HEAVY = {"cycle.axes_6000"}


def test_the_core_group_has_these_rows() -> None:
    assert [(row.name, row.unit, str(row.goal)) for row in GROUPS["core"]] == [
        ("cycle.axes_10", "µs", "≤ 20"),
        ("cycle.axes_1000", "µs", "≤ 60"),
        ("cycle.axes_6000", "µs", "≤ 200"),
        ("sample.rows_1000", "µs", "≤ 5"),
        ("sample.rows_6000", "µs", "≤ 12"),
        ("plan.move", "µs", "≤ 25"),
        ("trace.signals_1000", "µs", "≤ 5"),
        ("demo.realtime_factor", "x", "≥ 50"),
        ("start.warm", "s", "≤ 1.5"),
        ("start.cold", "s", "≤ 20"),
        ("help.time", "s", "≤ 0.2"),
    ]


@pytest.mark.parametrize(
    "row",
    [pytest.param(row, marks=[pytest.mark.slow] if row.name in HEAVY else [], id=row.name) for row in INSIDE],
)
def test_every_row_inside_the_process_gives_a_number(row: Row) -> None:
    assert math.isfinite(row.measure(TINY).value)


def test_recording_says_what_waiting_for_the_writer_costs() -> None:
    row = next(row for row in INSIDE if row.name == "trace.signals_1000")
    assert "waits for the writer" in row.measure(TINY).note


def test_the_load_moves_every_axis() -> None:
    run = load.moving(load.machine(3))
    before = [axis.set_position for axis in run.axes.values()]
    run.step()
    assert all(axis.set_position > start for axis, start in zip(run.axes.values(), before, strict=True))


def test_the_recorded_signals_are_a_thousand_and_every_tick_is_kept(tmp_path: Path) -> None:
    machine, file = load.machine(recording.AXES, recording.SIGNALS), tmp_path / "t.trace"
    recording.measured(machine, 10, file)
    trace = Trace.load(file)
    assert len(trace) == 1000
    assert len(trace.ticks) >= 10
    assert trace.complete


def test_the_median_leaves_warm_up_and_the_time_between_out() -> None:
    calls: list[str] = []
    value = median_us(lambda: calls.append("timed"), 10, between=lambda: calls.append("between"))
    assert calls == ["timed", "between"] * 13
    assert value >= 0.0


def test_quiet_gives_the_collector_back() -> None:
    with quiet():
        inside = gc.isenabled()
    assert (inside, gc.isenabled()) == (False, True)


@pytest.mark.parametrize(
    ("goal", "value", "met"),
    [(Goal(5), 5.0, True), (Goal(5), 5.1, False), (Goal(50, at_least=True), 50.0, True),
     (Goal(50, at_least=True), 49.0, False)],
)  # fmt: skip
def test_a_goal_is_a_bound(goal: Goal, value: float, met: bool) -> None:
    assert goal.met(value) is met


def test_without_the_examples_the_demo_is_skipped(tmp_path: Path) -> None:
    with pytest.raises(Skipped, match="examples"):
        command.demo(TINY, tmp_path / "machine.toml")


def test_a_command_that_fails_names_itself_and_its_last_line(tmp_path: Path) -> None:
    with pytest.raises(Failed, match=r"motionlayer check ended with exit code \d+: .+"):
        command.seconds("check", tmp_path / "none.toml")


def test_help_is_measured() -> None:
    assert command.help_time(TINY).value > 0.0


@pytest.mark.slow
def test_starts_are_measured_and_a_cold_one_fills_an_empty_cache(monkeypatch: pytest.MonkeyPatch) -> None:
    filled: list[bool] = []

    def seconds(*arguments: str | Path, cache: Path | None = None) -> float:
        taken = plain(*arguments, cache=cache)
        if cache is not None:
            filled.append(any(cache.rglob("*.nbc")))
        return taken

    plain = command.seconds
    monkeypatch.setattr(command, "seconds", seconds)
    assert command.start_warm(TINY).value > 0.0
    assert filled == []
    assert command.start_cold(TINY).value > 0.0
    assert filled == [MODE != "plain"]


@pytest.mark.slow
def test_the_demo_is_measured() -> None:
    assert command.demo(TINY).value > 0.0
