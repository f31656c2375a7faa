import time
from datetime import datetime
from pathlib import Path
from typing import Any

import pytest
from tests.machines import LINEAR
from tests.record.log.support import at, files, small_disk, texts, times
from tests.runtime.clock import MS, FakeClock

from motionlayer import Machine, MachineError, RealTime, Simulation
from motionlayer.command import Ledger
from motionlayer.event import Event, EventLog, Kind, Level
from motionlayer.machine import LogDescription
from motionlayer.machine._logging import Logging
from motionlayer.record.log import LogError
from motionlayer.runtime import Mailbox
from motionlayer.verify import assert_valid

FILE = "2025_10_24/851_MSG_PLC_2025_10_24.txt"
START = "2025-10-24T13:00:00"


def logged(place: Path, **changes: Any) -> Machine:
    table = {"folder": str(place), "level": "verbose", "start": START, **changes}
    return Machine.from_dict({"format": 1, "name": "test", "axis": {"X": LINEAR, "Y": LINEAR}, "log": table})


async def work(run: Simulation) -> None:
    x, y = run.axes["X"], run.axes["Y"]
    await x.enable()
    await y.enable()
    await x.move_absolute(100.0)
    y.move_velocity(50.0)
    await run.sleep(0.1)
    await y.halt()
    await y.move_absolute(1e9).settled()


def play(machine: Machine, **changes: Any) -> Simulation:
    with Simulation(machine, **changes) as run:
        run.run(work(run))
    assert_valid(run.trace)
    return run


def test_every_event_of_the_trace_is_a_line_in_order(tmp_path: Path) -> None:
    run = play(logged(tmp_path))
    lines = files(tmp_path)[FILE]
    events = run.trace.events
    assert len(lines) == len(events) > 10
    for line, event in zip(lines, events, strict=True):
        assert line.split("\t")[1] == f"2025-10-24-13:00:{event.tick // 1000:02d}.{event.tick % 1000:03d}"
        assert line.endswith(event.text)


def test_lines_of_a_run(tmp_path: Path) -> None:
    play(logged(tmp_path))
    columns = [tuple(line.split("\t")[2:5]) for line in files(tmp_path)[FILE]]
    assert columns[0] == ("Device_Main_ID_1", "General", "0")
    assert columns[1:3] == [("Axis_ID_1", "fbPower", "0")] * 2
    assert ("Axis_ID_1", "fbMovePtP", "0") in columns
    assert ("Axis_ID_2", "fbMoveVelo", "0") in columns
    assert ("Axis_ID_2", "fbHalt", "0") in columns
    assert ("Axis_ID_2", "fbMovePtP", str(0x4222)) in columns


def test_two_runs_with_a_start_that_is_given_write_the_same_bytes(tmp_path: Path) -> None:
    for name in ("one", "two"):
        play(logged(tmp_path / name))
    assert (tmp_path / "one" / FILE).read_bytes() == (tmp_path / "two" / FILE).read_bytes()


def test_a_log_changes_nothing_in_the_run(tmp_path: Path) -> None:
    machine = logged(tmp_path)
    assert play(machine).trace.hash == play(machine, log=False).trace.hash
    assert len(files(tmp_path)[FILE]) == len(play(machine, log=False).trace.events)


def test_the_level_is_that_of_the_machine_file_and_may_change_in_the_run(tmp_path: Path) -> None:
    with Simulation(logged(tmp_path, level="error")) as run:
        x = run.axes["X"]
        x.enable()
        run.step(5)
        run.log.levels.level = Level.VERBOSE
        x.disable()
        run.step(5)
    assert texts(files(tmp_path)[FILE])[0] == "accepted: disable()"


def test_a_folder_is_relative_to_the_machine_file(tmp_path: Path) -> None:
    path = tmp_path / "machine.toml"
    dynamics = "max_velocity = 1.0\nmax_acceleration = 1.0\nmax_jerk = 1.0\n"
    path.write_text(f'format = 1\nname = "a"\n[axis.X]\n{dynamics}[log]\nfolder = "messages"\nport = 852\n')
    with Simulation(Machine.load(path)) as run:
        run.step()
    assert run.log.folder == tmp_path / "messages"
    ((name, lines),) = files(tmp_path).items()
    assert name.startswith("messages/")
    assert "/852_MSG_PLC_" in name
    assert lines == []


def test_without_the_table_nothing_is_written(tmp_path: Path) -> None:
    machine = Machine.from_dict({"format": 1, "name": "test", "axis": {"X": LINEAR, "Y": LINEAR}})
    assert play(machine).log.folder is None
    run = play(machine, log=LogDescription(folder=str(tmp_path), start=START, level="verbose"))
    assert len(files(tmp_path)[FILE]) == len(run.trace.events)


def test_a_second_run_is_refused_until_the_first_is_closed(tmp_path: Path) -> None:
    machine = logged(tmp_path)
    first = Simulation(machine)
    with pytest.raises(LogError, match=r"another run of this process writes there; close\(\) it before"):
        Simulation(machine)
    first.close()
    Simulation(machine).close()


def test_a_run_that_cannot_begin_gives_the_folder_back(tmp_path: Path) -> None:
    machine = logged(tmp_path)
    with pytest.raises(Exception, match="No such file"):
        Simulation(machine, trace=tmp_path / "no" / "folder.trace")
    Simulation(machine).close()


def test_the_time_of_day_is_that_of_the_beginning(tmp_path: Path) -> None:
    play(logged(tmp_path, start=None))
    (lines,) = files(tmp_path).values()
    assert times(lines) == sorted(times(lines))
    assert not times(lines)[0].startswith("2025-10-24-13:00:00")


@pytest.mark.parametrize("start", ["noon", "2025-10-24T13:00:00+02:00", "1969-12-31T23:59:59", "2025-13-01T00:00:00"])
def test_a_start_that_is_no_local_time(tmp_path: Path, start: str) -> None:
    with pytest.raises(MachineError, match=r"log.start = .*must be a local time from 1970 on without a zone, as"):
        logged(tmp_path, start=start)


@pytest.mark.parametrize(
    ("key", "value", "allowed"),
    [
        ("level", "loud", 'one of "error", "warning"'),
        ("port", 0, "from 1 to 65_535"),
        ("size", 9_999, "at least 10_000"),
        ("folder", "", "a text that is not empty"),
    ],
)
def test_keys_out_of_range(tmp_path: Path, key: str, value: object, allowed: str) -> None:
    with pytest.raises(MachineError, match=rf"log\.{key} = .*must be {allowed}"):
        logged(tmp_path, **{key: value})


@pytest.mark.slow
def test_a_full_disk_enters_the_run_as_an_input_that_a_replay_is_given(tmp_path: Path) -> None:
    def tick(run: Simulation) -> None:
        for number in range(500):
            run.events.add(Event(run.tick, Level.INFO, Kind.MESSAGE, "", f"{run.tick} {number}"))
        run.step()

    def told(run: Simulation) -> list[str]:
        return [event.text for event in run.events.last() if event.source == "log"]

    with small_disk(tmp_path / "disk") as disk, Simulation(logged(disk)) as run:
        begin = time.monotonic()
        while not told(run):
            assert time.monotonic() < begin + 60.0, "nobody was told"
            tick(run)
    (text,) = told(run)
    assert text.startswith(f"messages cannot be written into {disk}: No space left on device; free space")
    with Simulation(logged(disk), log=False) as again:
        again.mailbox.feed(run.trace.inputs)
        while again.tick < run.tick:
            tick(again)
    assert told(again) == [text]
    assert again.trace.hash == run.trace.hash


def test_in_real_time_a_slip_moves_the_lines_after_it(tmp_path: Path) -> None:
    clock = FakeClock()
    machine = logged(tmp_path, start=START, level="info")
    quiet = machine.description.realtime.model_copy(update={"priority": 0, "lock_memory": False})
    machine = Machine(machine.description.model_copy(update={"realtime": quiet}), machine.folder)

    async def program() -> None:
        await run.sleep(0.010)
        clock.work(3_600_000 * MS)  # the computer slept for an hour
        await run.sleep(0.010)

    with RealTime(machine, clock=clock) as run:
        run.run(program())
    lines = files(tmp_path)["2025_10_24/851_MSG_PLC_2025_10_24.txt"]
    assert times(lines)[0] == "2025-10-24-13:00:00.000"
    assert times(lines)[-1].startswith("2025-10-24-14:00:00.02")
    assert times(lines) == sorted(times(lines))
    assert run.time == pytest.approx(0.021, abs=0.002)


def test_setting_the_clock_of_the_computer_never_moves_lines_back(tmp_path: Path) -> None:
    day = iter([at("2025-10-24T13:00:00"), at("2025-10-24T12:00:00"), at("2025-10-24T13:05:00")])
    log = Logging(logged(tmp_path, start=None), True, lossless=False, wall_clock_ns=lambda: next(day))
    ledger, events = Ledger(), EventLog()
    log.attach(events, Mailbox(ledger, events), ledger)
    for tick in (0, 1):
        log.align(1000 * tick)  # a clock that was set back by an hour, then one that is five minutes ahead
        events.add(Event(1000 * tick, Level.INFO, Kind.MESSAGE, "", str(tick)))
    log.close()
    first, second = (datetime.strptime(text, "%Y-%m-%d-%H:%M:%S.%f") for text in times(lines_below(tmp_path)))  # noqa: DTZ007
    assert (second - first).total_seconds() == 300.0


def lines_below(folder: Path) -> list[str]:
    (lines,) = files(folder).values()
    return lines
