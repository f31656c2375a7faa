"""The tables `[layer]` and `[control]`: what they accept, and what they say about what they do not."""

from collections.abc import Callable
from pathlib import Path

import pytest

from motionlayer.machine import MachineError, check_description, load_description

Write = Callable[[str], Path]

HEAD = 'format = 1\nname = "m"\n'
AXES = "".join(f"[axis.{name}]\nmax_velocity = 10.0\nmax_acceleration = 10.0\nmax_jerk = 10.0\n" for name in "XYZ")
MAP = '[layer.map.A]\ngroup = "axis"\n'
CONTROL = '[control]\naxes = ["X"]\n'


def messages(write: Write, text: str) -> list[str]:
    with pytest.raises(MachineError) as caught:
        load_description(write(text))
    return [str(finding).partition(": ")[2] for finding in caught.value.findings]


# text → what the messages begin with, and what they contain
BAD = [
    ("[layer]\nnci = true\n", "layer.nci = true: must be false: this version does not carry out channels (GVL_NCI)"),
    ("[layer]\ncam = true\n", "layer.cam = true: must be false: this version does not carry out cams"),
    ("[layer]\nxfc = true\n", "layer.xfc = true: must be false: this version does not carry out touch probes"),
    ("[layer]\nsaw = true\n", "layer.saw = true: must be false: this version does not carry out flying saws"),
    ("[layer]\nnci = 1\n", "layer.nci = 1: must be true or false"),
    ('[layer]\npaths = "mac"\n', 'layer.paths = "mac": must be one of "windows", "bsd"'),
    ("[layer]\ntimeout = 0\n", "layer.timeout = 0: must be greater than 0 (s)"),
    ("[layer]\nmax_touch_probe = 0\n", "layer.max_touch_probe = 0: must be from 1 to 999"),
    ("[layer]\nmax_touch_prob = 2\n", "layer.max_touch_prob: unknown key; did you mean max_touch_probe?"),
    ("[layer.divisor]\naxis = 0\n", "layer.divisor.axis = 0: must be from 1 to 1_000"),
    ("[layer.phase]\naxis = 1\n", "layer.phase.axis = 1: must be less than layer.divisor.axis = 1"),
    (
        "[layer.divisor]\nfunctions = 4\n[layer.phase]\nfunctions = 4\n",
        "layer.phase.functions = 4: must be less than layer.divisor.functions = 4",
    ),
    ('[layer.map.A]\ngroup = "axes"\n', 'layer.map.A.group = "axes": must be one of "axis", "nci", "cam"'),
    (MAP + "objects = []\n", "layer.map.A.objects = []: must be"),
    (MAP + "objects = [1.5]\n", "layer.map.A.objects[0] = 1.5: must be an index, or the name of an axis"),
    (MAP + "objects = [true]\n", "layer.map.A.objects[0] = true: must be an index, or the name of an axis"),
    (MAP + "objects = [0]\n", "layer.map.A.objects[0] = 0: must be an index from 1 to 3"),
    (MAP + "objects = [4]\n", "layer.map.A.objects[0] = 4: must be an index from 1 to 3"),
    (MAP + 'objects = ["Q"]\n', 'layer.map.A.objects[0] = "Q": no such axis; axes are X, Y, Z'),
    (MAP + 'objects = ["X", 1]\n', "layer.map.A.objects[1]: axis 1 belongs to layer.map.A.objects[0] already"),
    ('[layer.map.A]\ngroup = "nci"\nobjects = [2]\n', "layer.map.A.objects[0] = 2: must be an index from 1 to 1"),
    ('[layer.map.A]\ngroup = "nci"\nobjects = ["X"]\n', 'layer.map.A.objects[0] = "X": must be an index from 1 to 1'),
    ('[layer.map.A]\ngroup = "cam"\nselector = true\n', "layer.map.A = {…}: must be false: the parameter selector"),
    ('[layer.map.A]\ngroup = "cam"\nswitches = true\n', "layer.map.A = {…}: must be false: limit switches go"),
    (MAP.replace(".A]", ".1A]"), "layer.map.1A: not a name of a map; must be letters, digits"),
    (MAP.replace(".A]", ".mapping_axis]"), "layer.map.mapping_axis: not a name of a map"),
    (MAP + MAP.replace(".A]", ".B]"), "layer.map.B: axis 1 belongs to layer.map.A already"),
    (
        MAP + "objects = [1, 2]\n" + MAP.replace(".A]", ".B]") + "objects = [3, 2]\n",
        "layer.map.B.objects[1]: axis 2 belongs to layer.map.A.objects[1] already",
    ),
    (
        MAP + "objects = [1]\nselector = true\n" + MAP.replace(".A]", ".B]") + "objects = [2]\nselector = true\n",
        "layer.map.B.selector: the parameter selector belongs to layer.map.A.selector already",
    ),
    (
        MAP + "objects = [1]\n" + MAP.replace(".A]", ".a]") + "objects = [2]\n",
        "layer.map.a: differs from layer.map.A only in upper and lower case",
    ),
    ("[layer]\n" + CONTROL, "control: a machine has a motion layer of its own, or commands that of another one"),
    ("[control]\n", "control.axes: missing; must be a list"),
    ("[control]\naxes = []\n", "control.axes = []: must be"),
    ('[control]\naxes = ["X", "x"]\n', 'control.axes[1] = "x": the same name as control.axes[0]'),
    (CONTROL + 'groups = ["axes"]\n', 'control.groups[0] = "axes": must be one of "axis", "nci"'),
]


@pytest.mark.parametrize(("text", "begin"), BAD, ids=[begin for _, begin in BAD])
def test_every_mistake_is_named_once_with_its_place(write: Write, text: str, begin: str) -> None:
    found = messages(write, HEAD + AXES + text)
    assert len(found) == 1, found
    assert begin in found[0]


def test_a_machine_without_axes_has_a_control_side() -> None:
    head = {"format": 1, "name": "m"}
    assert check_description({**head, "control": {"axes": ["X", "Y"]}}).axis == {}
    with pytest.raises(MachineError, match="axis: missing; must be a table with at least one entry"):
        check_description(head)


def test_what_is_left_out_is_as_in_the_original() -> None:
    axis = {"max_velocity": 1, "max_acceleration": 1, "max_jerk": 1}
    layer = check_description({"format": 1, "name": "m", "axis": {"X": axis}, "layer": {}}).layer
    assert layer is not None
    sizes = (layer.max_nci_channels, layer.max_trigger_box, layer.max_touch_probe, layer.max_r_para)
    assert sizes == (1, 12, 12, 10)
    assert (layer.max_trigger_count, layer.max_motion_function_points, layer.max_message) == (4, 10, 200)
    assert layer.map == {}
    assert not any((layer.nci, layer.cam, layer.xfc, layer.saw, layer.test))


def test_groups_of_axes_for_two_controllers(write: Write) -> None:
    """Axes 1 and 2 belong to one controller, axis 3 to the other; cams and trigger boxes are maps of their own."""
    text = """
[layer.map.A]
group = "axis"
objects = ["X", 2]
[layer.map.B]
group = "axis"
objects = ["Z"]
selector = true
[layer.map.C]
group = "cam"
[layer.map.T]
group = "trigger"
objects = [1, 12]
"""
    layer = load_description(write(HEAD + AXES + text)).layer
    assert layer is not None
    assert [(name, one.group, one.objects) for name, one in layer.map.items()] == [
        ("A", "axis", ("X", 2)),
        ("B", "axis", ("Z",)),
        ("C", "cam", None),
        ("T", "trigger", (1, 12)),
    ]
