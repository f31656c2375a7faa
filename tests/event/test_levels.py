import pytest

from motionlayer.event import Device, Event, Kind, Level, Levels, Subdevice, device_of

AXIS = device_of(Device.Axis, 1)
PROBE = device_of(Device.XfcTouchProbe, 3)
ALL = tuple(Level)


def message(level: Level, device: int = AXIS, part: int = Subdevice.AxisControl) -> Event:
    return Event(0, level, Kind.MESSAGE, "X", "text", 0, 0, device, part)


@pytest.mark.parametrize(
    ("said", "device", "least"),
    [
        (Level.BATCH, AXIS, Level.BATCH),
        (Level.ERROR, AXIS, Level.BATCH),
        (Level.WARNING, AXIS, Level.WARNING),
        (Level.INFO, AXIS, Level.WARNING),
        (Level.VERBOSE, AXIS, Level.VERBOSE),
        (Level.SENTIENT, AXIS, Level.SENTIENT),
        (Level.ERROR, PROBE, Level.BATCH),
        (Level.WARNING, PROBE, Level.INFO),
        (Level.INFO, PROBE, Level.INFO),
        (Level.VERBOSE, PROBE, Level.VERBOSE),
    ],
)
def test_a_message_is_written_from_the_level_of_its_gate_on(said: Level, device: int, least: Level) -> None:
    written = [level for level in ALL if Levels(level).passes(message(said, device))]
    assert written == [level for level in ALL if level >= least]


@pytest.mark.parametrize("part", [Subdevice.MainInit, Subdevice.fbGearIn, Subdevice.fbGearInMultiMaster])
def test_information_of_start_up_and_gearing_has_no_gate(part: Subdevice) -> None:
    assert Levels(Level.ERROR).passes(message(Level.INFO, part=part))
    assert not Levels(Level.ERROR).passes(message(Level.WARNING, part=part))
    assert not Levels(Level.INFO).passes(message(Level.VERBOSE, part=part))


def test_an_object_has_a_level_of_its_own_until_it_is_taken_back() -> None:
    levels = Levels(Level.ERROR)
    levels.set_level(AXIS, Level.VERBOSE)
    assert levels.level_of(AXIS) is Level.VERBOSE
    assert levels.level_of(AXIS + 1) is Level.ERROR
    assert levels.passes(message(Level.VERBOSE))
    assert not levels.passes(message(Level.VERBOSE, AXIS + 1))
    levels.set_level(AXIS, None)
    assert not levels.passes(message(Level.VERBOSE))


def test_a_single_program_is_found_by_its_member_and_by_its_number() -> None:
    levels = Levels(Level.ERROR)
    levels.set_level(Device.Device_Main, Level.VERBOSE)
    assert levels.passes(message(Level.VERBOSE, int(Device.Device_Main)))
    assert levels.passes(message(Level.VERBOSE, Device.Device_Main))
