"""Images: what is copied when, sizes, and what an image that nobody has written does (motion-layer 7, D49 to D52)."""

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.event import Level
from motionlayer.fb import E_EncoderReferenceMode
from motionlayer.iec import InputArray
from motionlayer.layer._inputs import overwrite
from motionlayer.layer._mapping import MapOptions
from motionlayer.layer._mapping_table import INPUTS, OUTPUTS
from motionlayer.layer.types import AxisCommand, AxisCtrl, Homing, LimitSwitches, MoveData, Progress
from tests.layer.mapped import Mapped
from tests.layer.rig import Rig

ALL = MapOptions("M", "axis", selector=True)
A, B = MapOptions("A", "axis", (1, 3)), MapOptions("B", "axis", (2,))


def ctrl(*commands: int) -> bytes:
    return b"".join(struct.pack("<2H", command, 0) for command in commands)


def test_a_map_of_all_axes_has_the_images_of_the_original_with_their_sizes() -> None:
    """The sizes of motion-layer 7, for 6 axes; those of the types that are numbers here stand in the type tests."""
    areas = Mapped(ALL, axes=6).run.areas
    assert [name for name in areas if name.startswith("MAPPING_AXIS_in.")] == [
        f"MAPPING_AXIS_in.{row.image}" for row in INPUTS if row.group in {"axis", "selector"}
    ]
    assert [name for name in areas if name.startswith("MAPPING_AXIS_out.")] == [
        f"MAPPING_AXIS_out.{row.image}" for row in OUTPUTS if row.group in {"axis", "selector"}
    ]
    sizes = {"in.AxisCtrl": 24, "in.AxisMoveData": 300, "out.AxisState": 36, "out.AxisInfo": 228}
    assert {name: areas[f"MAPPING_AXIS_{name}"].size for name in sizes} == sizes
    assert areas["MAIN_AXIS.eInit"].size == 4


def test_what_is_posted_reaches_its_objects_before_programs_run() -> None:
    mapped = Mapped(ALL)
    mapped.post("MAPPING_AXIS_in.AxisCtrl", ctrl(1, 12, 0))
    seen: list[list[int]] = []
    mapped.run.cyclic(lambda _run: seen.append(mapped.commands()))
    mapped.run.step(1)
    assert seen == [[1, 12, 0]]
    assert mapped.arrays["GVL_AXIS.Ctrl"].touched == [1, 2]  # type: ignore[attr-defined]


def test_states_are_in_their_image_at_the_end_of_the_tick() -> None:
    mapped = Mapped(ALL)
    mapped.arrays["GVL_AXIS.State"][2].state = AxisCommand.MOVE_POS + Progress.DONE
    mapped.run.step(1)
    assert mapped.run.areas["MAPPING_AXIS_out.AxisState"].read()[6:8] == bytes.fromhex("1C27")


def test_only_elements_that_have_changed_are_decoded() -> None:
    mapped = Mapped(ALL)
    data = mapped.arrays["GVL_AXIS.Data"]
    assert isinstance(data, InputArray)
    mapped.post("MAPPING_AXIS_in.AxisMoveData", b"".join(bytes(MoveData(position=p)) for p in (1.0, 2.0, 3.0)))
    mapped.run.step(1)
    assert data.take() == [1, 2, 3]
    mapped.post("MAPPING_AXIS_in.AxisMoveData", b"".join(bytes(MoveData(position=p)) for p in (1.0, 2.5, 3.0)))
    mapped.run.step(5)
    assert data.take() == [2]
    assert [one.position for one in data] == [1.0, 2.5, 3.0]


def test_d52_an_image_that_nobody_has_written_overwrites_no_start_values() -> None:
    mapped = Mapped(ALL)
    mapped.run.step(3)
    assert [one.override for one in mapped.arrays["GVL_AXIS.Data"]] == [100.0] * 3
    mapped.post("MAPPING_AXIS_in.AxisMoveData", bytes(150))  # zeros, but written
    mapped.run.step(1)
    assert [one.override for one in mapped.arrays["GVL_AXIS.Data"]] == [0.0] * 3


def test_d52_memory_of_a_bus_counts_from_its_first_change() -> None:
    mapped, bus = Mapped(ALL), bytearray(150)
    mapped.mapping.attach("MAPPING_AXIS_in.AxisMoveData", bus)
    mapped.run.step(2)
    assert mapped.arrays["GVL_AXIS.Data"][1].override == 100.0
    struct.pack_into("<d", bus, 0, 5.0)
    mapped.run.step(1)
    assert mapped.arrays["GVL_AXIS.Data"][1] == MoveData(position=5.0, override=0.0)
    bus[:] = bytes(150)  # written by now: zeros count
    mapped.run.step(1)
    assert mapped.arrays["GVL_AXIS.Data"][1].position == 0.0


def test_memory_of_a_bus_that_its_partner_has_written_counts_at_once() -> None:
    mapped = Mapped(ALL)
    mapped.mapping.attach("MAPPING_AXIS_in.AxisMoveData", bytearray(150), written=True)
    mapped.run.step(1)
    assert mapped.arrays["GVL_AXIS.Data"][1].override == 0.0


def test_a_bus_reads_states_and_writes_commands_in_memory_of_its_own() -> None:
    mapped, commands, states = Mapped(ALL), bytearray(12), bytearray(18)
    mapped.mapping.attach("MAPPING_AXIS_in.AxisCtrl", commands)
    mapped.mapping.attach("MAPPING_AXIS_out.AxisState", states)
    commands[:] = ctrl(3, 0, 12)
    mapped.arrays["GVL_AXIS.State"][3].state = 1012
    mapped.run.step(1)
    assert mapped.commands() == [3, 0, 12]
    assert struct.unpack_from("<H", states, 12) == (1012,)
    mapped.mapping.detach("MAPPING_AXIS_in.AxisCtrl")
    commands[:] = ctrl(0, 0, 0)
    mapped.run.step(1)
    assert mapped.commands() == [3, 0, 12]


def test_what_a_bus_brings_is_recorded_as_an_input_of_its_area() -> None:
    mapped, bus = Mapped(ALL), bytearray(12)
    heard: list[tuple[int, str, bytes]] = []
    mapped.run.mailbox.listen(lambda one: heard.append((one.tick, one.channel, one.payload)))
    mapped.mapping.attach("MAPPING_AXIS_in.AxisCtrl", bus)
    mapped.run.step(3)
    bus[:] = ctrl(1, 0, 0)
    mapped.run.step(3)
    assert heard == [(3, "area.MAPPING_AXIS_in.AxisCtrl", ctrl(1, 0, 0))]


@pytest.mark.parametrize("size", [11, 13, 24])
def test_an_image_of_another_size_holds_up_its_program_with_one_message(size: int) -> None:
    """`sMappingCheck` names the first one, and no group is copied, neither this image nor another."""
    mapped = Mapped(ALL)
    mapped.mapping.attach("MAPPING_AXIS_in.AxisCtrl", bytearray(b"\1" * size), written=True)
    mapped.post("MAPPING_AXIS_in.AxisMoveData", bytes(150))
    mapped.run.step(4)
    program = mapped.mapping.inputs["MAPPING_AXIS_in"]
    assert program.check.text == "AxisCtrl CHECK_ERROR"
    assert mapped.commands() == [0, 0, 0]
    assert mapped.arrays["GVL_AXIS.Data"][1].override == 100.0
    (message,) = mapped.messages
    assert message.level is Level.ERROR
    told = f"AxisCtrl CHECK_ERROR: {size} bytes attached, must be 12; nothing is copied"
    assert message.text == f"MAPPING_AXIS_in.sMappingCheck: {told}"
    assert list(program.images[0].sizes) == [size, 12], "szAxisCtrl tells the size that is wrong"
    mapped.mapping.detach("MAPPING_AXIS_in.AxisCtrl")
    mapped.run.step(1)
    assert program.check.text == "CHECK_DONE"
    assert list(program.images[0].sizes) == [12, 12]
    assert mapped.arrays["GVL_AXIS.Data"][1].override == 0.0


def test_another_wrong_size_is_another_result() -> None:
    mapped = Mapped(ALL)
    for size in (11, 13):
        mapped.mapping.attach("MAPPING_AXIS_in.AxisCtrl", bytearray(size), written=True)
        mapped.run.step(3)
        mapped.mapping.detach("MAPPING_AXIS_in.AxisCtrl")
    assert [event.text.split()[3] for event in mapped.messages] == ["11", "13"]


@pytest.mark.parametrize("image", [row.image for row in OUTPUTS if row.group in {"axis", "selector"}])
def test_d50_every_image_is_checked_and_by_its_own_name(image: str) -> None:
    mapped = Mapped(ALL)
    name = f"MAPPING_AXIS_out.{image}"
    mapped.mapping.attach(name, bytearray(mapped.run.areas[name].size + 1))
    mapped.run.step(1)
    assert mapped.mapping.outputs["MAPPING_AXIS_out"].check.text == f"{image} CHECK_ERROR"


def test_d50_without_maps_nothing_is_active_and_a_map_of_saws_alone_is() -> None:
    idle, saws = Mapped().mapping, Mapped(MapOptions("S", "saw")).mapping
    assert idle.inputs["MAPPING_AXIS_in"].check.text == "NO_MAPPING_ACTIVE"
    assert idle.outputs["MAPPING_AXIS_out"].check.text == "NO_MAPPING_ACTIVE"
    assert saws.outputs["MAPPING_AXIS_out"].check.text == "CHECK_DONE"


def test_d49_the_output_image_of_r_parameters_shows_what_was_read() -> None:
    mapped = Mapped(MapOptions("N", "nci"))
    mapped.arrays["GVL_NCI.R_ParameterRead"][1] = 4711
    mapped.arrays["GVL_NCI.R_ParameterWrite"].accept(1, struct.pack("<i", 1147))  # type: ignore[attr-defined]
    mapped.run.step(1)
    shown = mapped.run.areas["MAPPING_AXIS_out.NciRparameters"].read()
    assert struct.unpack_from("<i", shown) == (4711,)


def test_blocked_images_are_not_copied_in_and_states_still_out() -> None:
    mapped = Mapped(ALL)
    program = mapped.mapping.inputs["MAPPING_AXIS_in"]
    program.blocked.value = True
    mapped.post("MAPPING_AXIS_in.AxisCtrl", ctrl(1, 1, 1))
    mapped.arrays["GVL_AXIS.State"][1].state = 9000
    mapped.run.step(1)
    assert mapped.commands() == [0, 0, 0]
    assert mapped.run.areas["MAPPING_AXIS_out.AxisState"].read()[:2] == struct.pack("<H", 9000)
    program.blocked.value = False
    mapped.run.step(1)
    assert mapped.commands() == [1, 1, 1]


def test_what_the_layer_writes_itself_gives_way_to_the_image_in_the_next_cycle() -> None:
    """As INIT at start-up (motion-layer 1.6): it holds in its own cycle, then the client's command is back."""
    mapped = Mapped(ALL)
    mapped.post("MAPPING_AXIS_in.AxisCtrl", ctrl(3, 3, 3))
    mapped.run.step(1)
    overwrite(mapped.arrays["GVL_AXIS.Ctrl"], 2, cmd=AxisCommand.INIT)  # type: ignore[arg-type]
    assert mapped.commands() == [3, 1, 3]
    mapped.run.step(1)
    assert mapped.commands() == [3, 3, 3]


def test_two_controllers_have_the_objects_of_their_maps_in_the_order_of_these() -> None:
    mapped = Mapped(MapOptions("A", "axis", (3, 1)), B)
    mapped.post("A_in.AxisCtrl", ctrl(12, 3))
    mapped.run.step(1)
    assert mapped.commands() == [3, 0, 12]
    mapped.post("B_in.AxisCtrl", ctrl(2))
    for index in (1, 2, 3):
        mapped.arrays["GVL_AXIS.State"][index].state = index
    mapped.run.step(1)
    assert mapped.commands() == [3, 2, 12]
    assert struct.unpack("<HIHI", mapped.run.areas["A_out.AxisState"].read()) == (3, 0, 1, 0)
    assert struct.unpack("<HI", mapped.run.areas["B_out.AxisState"].read()) == (2, 0)


def test_a_wrong_image_of_one_controller_does_not_hold_up_the_other() -> None:
    mapped = Mapped(A, B)
    mapped.mapping.attach("A_in.AxisMoveData", bytearray(3))
    mapped.post("A_in.AxisCtrl", ctrl(1, 1))
    mapped.post("B_in.AxisCtrl", ctrl(2))
    mapped.run.step(1)
    assert mapped.commands() == [0, 2, 0]


def test_attaching_tells_what_is_wrong() -> None:
    mapping = Mapped(A).mapping
    with pytest.raises(KeyError, match=r"no image 'A_in.AxisCtl'; this run has A_in.AxisCtrl, A_in.AxisMoveData"):
        mapping.attach("A_in.AxisCtl", bytearray(8))
    with pytest.raises(ValueError, match="the memory is read-only"):
        mapping.attach("A_out.AxisState", memoryview(bytes(12)))
    mapping.attach("A_in.AxisCtrl", bytearray(8))
    with pytest.raises(ValueError, match="memory is attached already"):
        mapping.attach("A_in.AxisCtrl", bytearray(8))


def test_a_run_that_goes_back_takes_the_image_again_and_leaves_the_bus_alone() -> None:
    mapped, bus, states = Mapped(ALL), bytearray(12), bytearray(18)
    mapped.mapping.attach("MAPPING_AXIS_in.AxisCtrl", bus)
    mapped.mapping.attach("MAPPING_AXIS_out.AxisState", states)
    pinned = mapped.run._pinned
    mapped.run._pinned = lambda: (*pinned(), *mapped.mapping.ports)  # type: ignore[method-assign]
    start = mapped.run.snapshot()
    bus[:] = ctrl(1, 2, 3)
    mapped.run.step(2)
    bus[:] = ctrl(4, 5, 6)
    mapped.run.restore(start)
    assert mapped.commands() == [0, 0, 0]
    assert bus == ctrl(4, 5, 6)
    mapped.run.step(1)
    assert mapped.commands() == [4, 5, 6]


def test_d51_limit_switches_can_be_mapped() -> None:
    """By images alone, an axis is homed at a switch that the controller reads."""
    home = {"mode": "direct", "velocity": 40.0, "sync_velocity": 5.0, "direction": "negative"}
    rig = Rig(options={"map": {"all": {"group": "axis", "switches": True}}}, home=home)
    areas = rig.run.areas
    homing = Homing()
    homing.parameters.home_on_limit_min = True
    homing.parameters.options.reference_mode = E_EncoderReferenceMode.PLCCAM
    areas["MAPPING_AXIS_in.AxisHoming"].post(bytes(homing))
    for command in (AxisCommand.ENABLE, AxisCommand.HOME):
        areas["MAPPING_AXIS_in.AxisCtrl"].post(bytes(AxisCtrl(cmd=command)))
        while rig.x.state.code != command + Progress.DONE:
            minimum = rig.run.axes["X"].actual_position < -20.0
            areas["MAPPING_AXIS_in.AxisLimitSwitches"].post(bytes(LimitSwitches(minimum=minimum)))
            rig.cycle()
            assert rig.x.state.split().progress != Progress.ERROR
    assert rig.x.info.referenced
    with pytest.raises(PermissionError, match=r"belongs to the image MAPPING_AXIS_in\.AxisLimitSwitches"):
        rig.x.limit_switches.minimum = False
    rig.check()


def test_limit_switches_are_mapped_only_where_that_is_asked_for() -> None:
    rig = Rig(options={"map": {"all": {"group": "axis"}}})
    assert "MAPPING_AXIS_in.AxisLimitSwitches" not in rig.run.areas
    rig.x.limit_switches.minimum = True


@given(st.lists(st.tuples(st.sampled_from("AB"), st.integers(0, 2), st.integers(0, 0xFFFF)), max_size=20))
def test_after_each_cycle_the_objects_are_what_their_images_say(writes: list[tuple[str, int, int]]) -> None:
    mapped = Mapped(MapOptions("A", "axis", (4, 1, 2)), MapOptions("B", "axis", (3, 6, 5)), axes=6)
    images = {"A": bytearray(12), "B": bytearray(12)}
    places = {"A": (4, 1, 2), "B": (3, 6, 5)}
    expected = [0] * 6
    for which, row, command in writes:
        struct.pack_into("<H", images[which], 4 * row, command)
        expected[places[which][row] - 1] = command
        mapped.post(f"{which}_in.AxisCtrl", bytes(images[which]))
        mapped.run.step(1)
        assert mapped.commands() == expected


def test_a_control_side_shows_states_and_sends_commands() -> None:
    control = Mapped(ALL, control=True)
    control.arrays["GVL_AXIS.Ctrl"][2] = AxisCtrl(cmd=AxisCommand.ENABLE)
    control.arrays["GVL_AXIS.Ctrl"].publish()  # type: ignore[attr-defined]
    control.post("MAPPING_AXIS_in.AxisState", struct.pack("<HIHIHI", 10000, 0, 6003, 1, 0, 0))
    control.run.step(1)
    assert control.run.areas["MAPPING_AXIS_out.AxisCtrl"].read() == ctrl(0, 3, 0)
    assert [int(one.state) for one in control.arrays["GVL_AXIS.State"]] == [10000, 6003, 0]
