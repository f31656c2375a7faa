"""Message lists and their writers (motion-layer 8.2, 8.4)."""

from pathlib import Path

import pytest

from motionlayer.event import Device, Level, device_of
from tests.effort import examples, thinned
from tests.layer.message_runs import lines, opened, read, say, started

SIZE = 200


def cycles(folder: Path, ticks: int) -> list[tuple[int, int]]:
    """Return command and state of the writer in the first ticks of a run that says nothing."""
    with opened(folder, level="error") as run:
        seen = []
        for _ in range(ticks):
            run.step()
            seen.append((int(read(run, "MetricMessageCtrl.Cmd")), int(read(run, "MetricMessageState.State"))))
    return seen


def test_a_message_takes_the_first_free_slot_at_the_end_of_its_tick() -> None:
    run = started(layer={"test": True})
    say(run, "first", code=7)
    say(run, "second", Level.VERBOSE)
    run.step()
    assert read(run, "MessageMotionIndex") == 2
    first = run.symbols.read("GVL_MSG_AXIS.MotionMessages[1]")
    assert (first.kind, first.device, first.number, first.text) == (Level.INFO, device_of(Device.Axis, 1), 7, "first")
    assert first.time == "1970-01-01-00:00:05.100"
    assert read(run, "MotionMessages[2].sText") == "second"
    assert read(run, "MotionMessages[3].eType") == 0


def test_counters_go_into_a_list_of_their_own() -> None:
    run = started()
    say(run, "count", Level.BATCH, device=device_of(Device.MetricsAxis, 1))
    run.step()
    assert (read(run, "MessageMotionIndex"), read(run, "MessageMetricIndex")) == (0, 1)
    assert read(run, "MetricMessages[1].sText") == "count"


def test_the_writer_is_initialised_and_goes_by_its_commands(tmp_path: Path) -> None:
    seen = cycles(tmp_path, 5030)
    assert list(dict.fromkeys(seen[:20])) == [(10, 1010), (10, 2010), (10, 3010), (10, 10010), (0, 0)]
    assert (50, 1050) not in seen[:5000]
    # After 5 s without a message a WRITE is done at once: there is nothing to write.
    assert list(dict.fromkeys(seen[5000:])) == [(0, 0), (50, 1050), (50, 10050)]


def test_an_error_is_written_at_once_and_shows_every_step() -> None:
    run = started()
    say(run, "wrong", Level.ERROR)
    run.step()
    assert (read(run, "MessageMotionIndex"), read(run, "MessageMotionError")) == (1, 1)
    seen = [int(read(run, "MotionMessageState.State"))]
    for _ in range(8):
        run.step()
        seen.append(int(read(run, "MotionMessageState.State")))
    assert list(dict.fromkeys(seen)) == [1050, 2050, 7050, 10050, 0]
    assert (read(run, "MessageMotionIndex"), read(run, "MessageMotionError")) == (0, 0)
    assert read(run, "MotionMessages[1].eType") == 0


def test_a_single_message_is_written_after_five_seconds() -> None:
    run = started(layer={"test": True})
    run.step(100)
    say(run)
    run.step(4700)
    assert (read(run, "MotionMessageState.State"), read(run, "MessageMotionIndex")) == (0, 1)
    run.step(400)
    assert (read(run, "MotionMessageState.State"), read(run, "MessageMotionIndex")) == (0, 0)


@pytest.mark.parametrize(("size", "waits"), [(200, 2), (50, 1), (1000, 10)])
def test_d38_the_threshold_follows_the_size_of_the_list(size: int, waits: int) -> None:
    run = started(layer={"test": True, "max_message": size})
    for _ in range(waits):
        say(run)
    run.step(20)
    assert read(run, "MessageMotionIndex") == waits
    say(run)
    run.step(20)
    assert read(run, "MessageMotionIndex") == 0


def test_d38_a_full_list_takes_nothing_more_and_counts_what_is_lost() -> None:
    run = started(layer={"test": True})
    for number in range(SIZE + 30):
        say(run, f"message {number}", Level.ERROR if number % 2 else Level.INFO)
    run.step()
    assert read(run, "MessageMotionIndex") == SIZE
    assert read(run, f"MotionMessages[{SIZE}].sText") == f"message {SIZE - 1}"
    assert (read(run, "MessageMotionError"), read(run, "MessageMotionLost")) == ((SIZE + 30) // 2, 30)
    run.step(20)
    assert (read(run, "MessageMotionIndex"), read(run, "MessageMotionLost")) == (0, 30)


def test_the_file_is_complete_after_a_burst_that_no_list_can_hold(tmp_path: Path) -> None:
    count = examples(100_000)
    with started(tmp_path, level="info") as run:
        for number in range(count):
            say(run, f"message {number}")
        run.step(20)
        assert read(run, "MessageMotionLost") == count - SIZE
    texts = [columns[5] for columns in lines(tmp_path) if columns[5].startswith("message ")]
    assert texts == [f"message {number}" for number in range(count)]
    assert run.log.missing == 0


OTHERS = {
    device_of(Device.Process, 1): "Application",
    device_of(Device.Application, 2): "Application",
    int(Device.Device_XmlData): "Application",
    device_of(Device.XtsStation, 1): "Transport",
    int(Device.Device_MoverSelector): "Transport",
    device_of(Device.MetricsXts, 1): "Metrics",
    device_of(Device.DataProduct, 1): "Product",
}


@pytest.mark.parametrize("device", thinned(OTHERS, 3))
def test_what_is_not_of_this_project_fills_a_list_that_nobody_writes(device: int, tmp_path: Path) -> None:
    """Motion-layer 8.2; errors of the mover selector are not counted there."""
    with opened(tmp_path, layer={"test": True, "max_other_message": 3}) as run:
        for number in range(5):
            say(run, f"text {number}", Level.ERROR, device=device)
        run.step(5100)
        name = OTHERS[device]
        found = {key: run.symbols.read(f"GVL_MSG.Message{name}{key}") for key in ("Index", "Error", "Lost")}
        assert found == {"Index": 3, "Error": 0 if device == Device.Device_MoverSelector else 5, "Lost": 2}
        assert run.symbols.read(f"GVL_MSG.{name}Messages[3].sText").endswith("text 2")
        assert run.symbols.read(f"GVL_MSG.{name}MessageState.State") == 0
    assert not [columns for columns in lines(tmp_path) if "text" in columns[5]]


def test_a_text_is_cut_and_keeps_to_its_characters() -> None:
    run = started(layer={"test": True})
    say(run, "Ω" + 200 * "ä")
    run.step()
    assert read(run, "MotionMessages[1].sText") == "?" + 126 * "ä"


def test_the_local_time_is_that_of_the_lines(tmp_path: Path) -> None:
    with opened(tmp_path) as run:
        run.step(1501)
        assert read(run, "sLocalTime") == "2025-10-24-13:00:01.500"
        assert read(run, "dtLocalTime") == 1761310801


def test_lists_go_back_with_the_run() -> None:
    run = started(layer={"test": True})
    say(run, "kept")
    run.step()
    before = run.snapshot()
    say(run, "gone")
    run.step()
    assert read(run, "MessageMotionIndex") == 2
    run.restore(before)
    assert read(run, "MessageMotionIndex") == 1
    run.step(2)
    assert (read(run, "MessageMotionIndex"), read(run, "MotionMessages[1].sText")) == (1, "kept")
