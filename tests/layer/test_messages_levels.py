"""How much is said, and where to (motion-layer 8.8, 9.6)."""

from pathlib import Path

import pytest

from motionlayer import Simulation
from motionlayer.event import Device, Level, Subdevice, device_of, list_of
from tests.layer.message_runs import AXIS, PREFIX, lines, opened, read, say, started

SECOND = device_of(Device.Axis, 2)


def write(run: Simulation, name: str, level: int) -> None:
    run.symbols.write(PREFIX + name, level, by="client")


def passed(run: Simulation, level: Level, device: int = AXIS) -> bool:
    """Tell whether a message of this level is written now."""
    before = read(run, "MessageMotionIndex")
    say(run, level=level, device=device)
    run.step()
    now = read(run, "MessageMotionIndex")
    run.step(20)
    return bool(now > before)


@pytest.mark.parametrize(
    ("layer", "log", "shown"),
    [
        ({}, None, 0),
        ({"test": True}, None, Level.VERBOSE),
        ({}, "info", Level.INFO),
        ({}, "error", 0),
        ({"test": True}, "warning", Level.VERBOSE),
    ],
)
def test_the_level_of_all_is_that_of_the_machine_file(
    tmp_path: Path, layer: dict[str, bool], log: str | None, shown: int
) -> None:
    with opened(tmp_path, layer=layer, level=log) if log else opened(layer=layer) as run:
        run.step()
        assert (read(run, "MessageLevel"), read(run, "MessageLevelAxisPtp[1]")) == (shown, Level.VERBOSE)
        run.step(50)
        assert (read(run, "MessageLevel"), read(run, "MessageLevelAxisPtp[1]")) == (shown, shown)


def test_while_the_axes_are_brought_up_they_say_everything(tmp_path: Path) -> None:
    with opened(tmp_path, level="error") as run:
        run.step(50)
        say(run, "later", Level.VERBOSE)
        run.step()
    found = {(columns[0], columns[5]) for columns in lines(tmp_path)}
    assert ("eMessageVerbose", "StartUp NcAxisId: 1") in found
    assert ("eMessageVerbose", "later") not in found


def test_an_object_has_a_level_of_its_own_from_the_next_tick_on() -> None:
    run = started(axes=2, layer={"test": True})
    write(run, "MessageLevelAxisPtp[1]", Level.ERROR)
    run.step()
    assert not passed(run, Level.INFO)
    assert passed(run, Level.INFO, SECOND)
    write(run, "MessageLevel", Level.WARNING)
    run.step()
    assert not passed(run, Level.INFO)
    assert not passed(run, Level.VERBOSE, SECOND)
    assert (read(run, "MessageLevelAxisPtp[1]"), read(run, "MessageLevelAxisPtp[2]")) == (Level.ERROR, Level.WARNING)


def test_a_level_that_a_client_gives_during_the_start_up_stays() -> None:
    run = opened(axes=2, layer={"test": True})
    run.step(5)
    write(run, "MessageLevelAxisPtp[2]", Level.ERROR)
    run.step(5000)
    assert (read(run, "MessageLevelAxisPtp[1]"), read(run, "MessageLevelAxisPtp[2]")) == (Level.VERBOSE, Level.ERROR)
    assert not passed(run, Level.INFO, SECOND)


def test_levels_of_one_object_and_of_all_may_be_written_in_one_tick() -> None:
    run = started(axes=2)
    write(run, "MessageLevel", Level.WARNING)
    write(run, "MessageLevelAxisPtp[2]", Level.VERBOSE)
    run.step()
    assert (read(run, "MessageLevelAxisPtp[1]"), read(run, "MessageLevelAxisPtp[2]")) == (Level.WARNING, Level.VERBOSE)
    assert passed(run, Level.VERBOSE, SECOND)
    assert not passed(run, Level.VERBOSE)


@pytest.mark.parametrize(("asked", "holds"), [(-3, Level.ERROR), (9, Level.SENTIENT)])
def test_a_level_that_there_is_not_is_told_once(asked: int, holds: Level) -> None:
    run = started()
    write(run, "MessageLevel", asked)
    run.step(5)
    told = [event.text for event in run.events.last(Level.WARNING) if "MessageLevel" in event.text]
    assert told == [
        f"GVL_MSG_AXIS.MessageLevel = {asked}, allowed: 0 (eMessageEmpty) to 6 (eMessageSentient); {holds.value} holds"
    ]
    assert run.log.levels.level is holds


@pytest.mark.parametrize(
    ("array", "device"),
    [
        ("Station", device_of(Device.XtsStation, 1)),
        ("Mover", device_of(Device.Mover, 1)),
        ("Process", device_of(Device.Process, 1)),
    ],
)
def test_objects_of_the_sister_project_have_levels_too(array: str, device: int) -> None:
    run = started()
    name = f"GVL_MSG.MessageLevel{array}[1]"
    assert run.symbols.read(name) == 0
    of = "Application" if array == "Process" else "Transport"
    for level, index in ((Level.WARNING, 0), (Level.VERBOSE, 1)):
        run.symbols.write(name, level, by="client")
        run.step()
        say(run, level=Level.VERBOSE, device=device)
        run.step()
        assert run.symbols.read(f"GVL_MSG.Message{of}Index") == index


def test_levels_go_back_with_the_run() -> None:
    run = started()
    before = run.snapshot()
    write(run, "MessageLevel", Level.VERBOSE)
    run.step()
    assert passed(run, Level.VERBOSE)
    run.restore(before)
    assert not passed(run, Level.VERBOSE)


# -- defects of the original (9.6) -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "array", ["AxisPtp", "AxisCam", "AxisFly", "NciChn", "TriggerBox", "TouchProbe"], ids=lambda name: name
)
def test_d42_d43_every_gate_is_the_right_way_round(array: str) -> None:
    """More is written at a finer level, never less; verbose messages at Sentient too."""
    devices = {
        "AxisPtp": [Device.Axis],
        "AxisCam": [Device.Camming],
        "AxisFly": [Device.FlyingSaw],
        "NciChn": [Device.NciChannel, Device.NciChannelCtrl],
        "TriggerBox": [Device.XfcTriggerBox],
        "TouchProbe": [Device.XfcTouchProbe],
    }[array]
    run = started()
    for device in devices:
        for said in (Level.ERROR, Level.WARNING, Level.INFO, Level.VERBOSE):
            found = []
            for level in range(Level.SENTIENT + 1):
                write(run, f"MessageLevel{array}[1]", level)
                run.step()
                found.append(passed(run, said, device_of(device, 1)))
            least = {Level.ERROR: 0, Level.WARNING: 3, Level.INFO: 3, Level.VERBOSE: 5}[said]
            if device in {Device.XfcTriggerBox, Device.XfcTouchProbe} and least == 3:
                least = 4
            assert found == [level >= least for level in range(Level.SENTIENT + 1)]


def test_d44_all_objects_have_one_source_of_levels() -> None:
    run = started()
    write(run, "MessageLevel", Level.VERBOSE)
    run.step()
    everyone = [Device.Camming, Device.FlyingSaw, Device.NciChannel, Device.XfcTriggerBox, Device.XfcTouchProbe]
    assert all(passed(run, Level.VERBOSE, device_of(device, 1)) for device in everyone)
    assert passed(run, Level.VERBOSE, Device.Device_ParameterSelector)


@pytest.mark.parametrize("device", [device_of(Device.FlyingSaw, 1), Device.Device_Main, 0, Device.General])
def test_d45_what_nobody_wrote_goes_into_the_motion_list_and_its_file(tmp_path: Path, device: int) -> None:
    with started(tmp_path) as run:
        say(run, "heard", device=int(device))
        run.step()
        assert read(run, "MotionMessages[1].sText").endswith("heard")
    assert sum(columns[5].endswith("heard") for columns in lines(tmp_path)) == 1


def test_d47_an_id_never_falls_into_the_next_block() -> None:
    with pytest.raises(ValueError, match=r"Axis: id 1000 is outside of its block; ids go from 0 to 999"):
        device_of(Device.Axis, 1000)
    assert list_of(device_of(Device.Axis, 999)) is list_of(device_of(Device.Axis, 1))


def test_d47_a_message_of_an_axis_tells_its_index_and_its_number(tmp_path: Path) -> None:
    with started(tmp_path, axes=2) as run:
        run.layer.axis[2].ctrl.cmd = 998
        run.step(3)
    told = next(columns for columns in lines(tmp_path) if columns[5] == "new command: E_AXIS_CTRL.998")
    assert told[2:5] == ["Axis_ID_2", Subdevice.AxisControl.name, "2"]
