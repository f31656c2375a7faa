import pytest

from motionlayer.event import BLOCK, Device, Subdevice, device_of


def test_the_number_of_a_device_is_that_of_its_block_and_its_id() -> None:
    assert device_of(Device.Axis, 1) == 14_001
    assert device_of(Device.DataProduct, 999) == 40_999
    assert device_of(Device.NciChannel, 0) == Device.NciChannel


@pytest.mark.parametrize("number", [-1, 1000, 70_000])
def test_an_id_never_falls_into_another_block(number: int) -> None:
    with pytest.raises(ValueError, match=f"Axis: id {number} is outside of its block; ids go from 0 to 999"):
        device_of(Device.Axis, number)


def test_a_single_program_has_no_ids() -> None:
    with pytest.raises(ValueError, match="Device_Main is a single program"):
        device_of(Device.Device_Main, 1)


def test_blocks_are_whole_and_singles_stand_before_them() -> None:
    assert all(device < BLOCK or device % BLOCK == 0 for device in Device)
    assert len(Device) == len({int(device) for device in Device}) == 36
    assert max(device for device in Device if device < BLOCK) == Device.Device_Utilities


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("General", 0),
        ("fbPower", 2),
        ("fbMoveVelo", 15),
        ("fbSendToPos", 44),
        ("fbGearInVelo", 54),
        ("fbSetOnlineChangeMode", 89),
        ("fbWriteParameterPersistent", 104),
        ("Get_Error", 215),
        ("XfcWaitForPosition", 318),
        ("AxisIdle", 1004),
        ("NciIdle", 2003),
        ("FlyingSawStartUp", 2101),
        ("StationState", 4001),
        ("TransportUnit_StationClearOutfeed", 7013),
        ("CamCycle", 8002),
        ("Process_LinkedList_Com_GetTail", 11208),
        ("Ticket_LinkedList_Com_GetTail", 12108),
        ("Application_Work", 13009),
    ],
)
def test_the_last_of_every_group_of_subdevices_has_its_number(name: str, value: int) -> None:
    assert Subdevice[name] == value


def test_no_number_of_a_subdevice_is_used_twice() -> None:
    assert len(Subdevice) == len(Subdevice.__members__)
