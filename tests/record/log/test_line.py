import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.event import Device, Event, Kind, Level, MessageList, Subdevice, device_of, list_of
from motionlayer.record.log._line import WIDTH, Lines, device_name
from tests.record.log.support import AXIS, local, message

SAMPLE = """\
eMessageInfo	2025-10-24-13:00:18.408	Axis_ID_1	AxisControl	1	new command: E_AXIS_CTRL.AXIS_ENABLE
eMessageInfo	2025-10-24-13:00:18.409	Axis_ID_1	AxisControl	1	E_AXIS_CTRL.AXIS_ENABLE: PROGRESS_OCCUPIED
eMessageError	2025-10-24-13:00:19.120	Axis_ID_1	fbMovePtP	17510	 : PROGRESS_ERROR
"""
"""Motion-layer 8.6, to the byte."""


def line_of(event: Event) -> str:
    return Lines(local()).line(event)


def test_the_sample_of_the_specification() -> None:
    lines = Lines(local())
    written = [
        lines.line(message(18_408, "new command: E_AXIS_CTRL.AXIS_ENABLE", code=1)),
        lines.line(message(18_409, "E_AXIS_CTRL.AXIS_ENABLE: PROGRESS_OCCUPIED", code=1)),
        lines.line(message(19_120, " : PROGRESS_ERROR", Level.ERROR, code=17_510, part=Subdevice.fbMovePtP)),
    ]
    assert "".join(written) == SAMPLE


@pytest.mark.parametrize(
    ("device", "name"),
    [
        (device_of(Device.Axis, 1), "Axis_ID_1"),
        (device_of(Device.NciChannel, 2), "NciChannel_ID_2"),
        (Device.General, "General_ID_0"),
        (Device.Device_MainAxis, "Device_MainAxis_ID_2"),
        (Device.Device_Null, "Device_Null_ID_0"),
        (device_of(Device.XfcAxis, 999), "XfcAxis_ID_999"),
        (19_007, "FlyingSaw_ID_1007"),  # no block of its own: searched from the largest base downwards
        (99_999, "DataProduct_ID_59999"),
        (500, "500_ID_500"),
    ],
)
def test_the_column_of_a_device(device: int, name: str) -> None:
    assert device_name(device) == name


@pytest.mark.parametrize("level", Level)
def test_the_column_of_the_type(level: Level) -> None:
    assert line_of(message(level=level)).split("\t")[0] == f"eMessage{level.name.title()}"


def test_a_number_is_unsigned_and_an_unknown_subdevice_a_number() -> None:
    columns = line_of(message(code=-1, part=77)).split("\t")
    assert columns[3:5] == ["77", str(2**64 - 1)]


def test_a_step_of_a_command_is_led_by_its_kind() -> None:
    event = Event(0, Level.VERBOSE, Kind.DONE, "X", "X.move_absolute", 0, 1, AXIS, Subdevice.fbMovePtP)
    assert line_of(event).split("\t")[3:] == ["fbMovePtP", "0", "done: X.move_absolute\n"]


def test_what_the_device_does_not_tell_leads_the_text() -> None:
    for device, led in [(Device.Device_Main, True), (Device.Axis, True), (AXIS, False)]:
        text = line_of(message(device=device)).split("\t")[5]
        assert text == ("X: text\n" if led else "text\n")


def test_a_line_has_255_characters_at_most_with_its_end() -> None:
    fixed = len(line_of(message(text="")))
    whole, cut = "ä" * (WIDTH - fixed), "ä" * (WIDTH - fixed + 1)
    assert line_of(message(text=whole)).endswith(f"\t{whole}\n")
    assert line_of(message(text=cut)) == line_of(message(text=whole))


@given(st.text(alphabet=st.characters(), max_size=300), st.text(max_size=20))
def test_no_text_makes_two_lines_or_columns_or_bytes_that_are_no_utf_8(text: str, source: str) -> None:
    line = line_of(Event(0, Level.INFO, Kind.MESSAGE, source, text, 0, 0, Device.Device_Main, 0))
    assert len(line) <= WIDTH
    assert line.encode().decode() == line
    assert line.endswith("\n")
    assert line[:-1].replace("\t", "").isprintable()
    assert line.count("\t") == 5
    shown = text if text.startswith(source) else f"{source}: {text}"
    for found, given_ in zip(line[:-1].split("\t")[5], shown, strict=False):
        assert found == given_ or (found == " " and not given_.isprintable())


def test_d45_lists_are_those_of_the_table_and_of_what_nobody_wrote() -> None:
    motion = {"XfcTriggerBox", "XfcTouchProbe", "Camming", "NciChannel", "NciChannelCtrl", "Axis", "XfcAxis"}
    motion |= {"Device_MainAxis", "Device_Nci", "Device_Cam", "Device_Functions", "Device_FlyingSaw"}
    motion |= {"Device_ParameterSelector"}
    corrected = {"FlyingSaw", "Device_Main", "Device_Null", "General"}
    assert {one.name for one in Device if list_of(one) is MessageList.MOTION} == motion | corrected
    assert {one.name for one in Device if list_of(one) is MessageList.METRICS} == {"MetricsAxis"}
    assert list_of(AXIS) is MessageList.MOTION
    assert list_of(device_of(Device.Process, 3)) is None
