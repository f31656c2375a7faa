"""The texts of the motion layer (motion-layer 8.7): all are in docs/layer-messages.md, and each one there comes."""

import re
from collections.abc import Callable
from typing import Any, NamedTuple

import pytest

from motionlayer.drive import Fault
from motionlayer.event import Event, Level, Subdevice
from motionlayer.layer import AxisCommand, Progress
from motionlayer.layer.types import BufferMode, HomingMode
from tests.layer.rig import SERVO, Rig, aim
from tests.scripts import ROOT

C, P = AxisCommand, Progress
PAGE = (ROOT / "docs" / "layer-messages.md").read_text(encoding="utf-8")
ROW = re.compile(r"^\| (\w+)(?: !)? \| (Info|Verbose|Warning|Error) \| (\w+) \| (?:`(.*)`|\u2013) \|", re.MULTILINE)
OURS = ("GVL_AXIS.", "MAIN_AXIS")
BREAKS: dict[str, Any] = SERVO | {"home": {"mode": "switch", "switch": -50.0, "velocity": 100.0}}


class Text(NamedTuple):
    """A row of the table; `number` is 0, an error, the index or the number of axes."""

    part: str
    level: Level
    number: str
    text: str

    def matches(self, event: Event) -> bool:
        """Tell whether a message is one of this row."""
        pattern = re.sub(r"<\w+>", "(.+)", re.escape(self.text).replace("\\<", "<").replace("\\>", ">"))
        numbered = self.number not in ("0", "error") or (event.code != 0) is (self.number == "error")
        return (
            (event.subdevice.name if isinstance(event.subdevice, Subdevice) else "") == self.part
            and event.level == self.level
            and re.fullmatch(pattern, event.text) is not None
            and numbered
        )


def table() -> list[Text]:
    return [Text(part, Level[level.upper()], number, text or "") for part, level, number, text in ROW.findall(PAGE)]


# -- what makes the layer speak ----------------------------------------------------------------------------------------


def starts() -> Rig:
    return Rig(2)


def start_fails() -> Rig:
    rig = Rig(up=False, options={"timeout": 0.05}, **SERVO)
    rig.run.inject("X", Fault("drive_error", duration=1.0), 1)
    rig.cycle(200)
    return rig


def unknown_command() -> Rig:
    rig = Rig()
    rig.drop(998)
    return rig


def switches() -> Rig:
    rig = Rig(**SERVO).ready()
    for command in (C.ENABLE, C.DISABLE):
        rig.run.inject("X", Fault("drive_error", duration=0.003), rig.run.tick + 1)
        rig.cycle(10)
        assert rig.do(command)[-1] == P.DONE
    rig.do(C.RESET)
    return rig


def cannot_switch() -> Rig:
    rig = Rig(options={"timeout": 0.05}, **SERVO)
    rig.run.inject("X", Fault("drive_error", duration=5.0), rig.run.tick + 1)
    rig.cycle(3)
    for command in (C.ENABLE, C.RESET, C.IDLE):
        assert rig.do(command)[-1] == P.ERROR
    return rig


def moves() -> Rig:
    rig = Rig().ready(home=True)
    aim(rig, 20.0)
    rig.x.options.distance = 5.0
    for command in (C.MOVE_POS, C.MOVE_VELO, C.HALT, C.SEND_TO_POS):
        assert rig.do(command)[-1] == P.DONE
    return rig


def held() -> Rig:
    rig = Rig().ready()
    aim(rig, 20.0, override=0.0)
    rig.drop(C.MOVE_POS)
    rig.cycle(10)
    return rig


def moves_refused() -> Rig:
    rig = Rig(software_limit_max=100.0).ready()
    aim(rig, 500.0)
    rig.x.home.parameters.mode = HomingMode.BLOCK
    for command in (C.MOVE_POS, C.SEND_TO_POS, C.HOME):
        assert rig.do(command)[-1] == P.ERROR
    aim(rig, 0.0, 0.0)
    assert rig.do(C.MOVE_VELO)[-1] == P.ERROR
    return rig


def brakes_refused() -> Rig:
    rig = Rig(**BREAKS).ready()
    for command in (C.HALT, C.STOP):
        rig.drop(C.HOME)
        rig.cycle(5)
        if command == C.STOP:
            rig.x.data.deceleration = -1.0
        assert rig.do(command)[-1] == P.ERROR
    return rig


def taken_over() -> Rig:
    rig = Rig().ready()
    aim(rig, 100.0, 100.0)
    axis = rig.run.axes["X"]
    for command, ticks in ((C.MOVE_POS, 20), (C.MOVE_VELO, 5), (C.HALT, 3)):
        rig.drop(command)
        rig.cycle(ticks)
        axis.move_absolute(-100.0, velocity=100.0)
        rig.cycle(50)
        rig.do(C.NULL)
    return rig


def buffered(command: AxisCommand, instance: int) -> Callable[[], Rig]:
    """Let an instance of a buffered job come to its end, be taken over, and be refused."""

    def begin(rig: Rig) -> None:
        """Let the instance take over."""
        rig.x.options.buffer_mode = BufferMode.ABORTING
        aim(rig, 100.0, 100.0)
        rig.drop(command)
        for change in range(1, instance):
            rig.cycle(50)
            aim(rig, 100.0 + change, 100.0 + change)
        rig.cycle(20)

    def run() -> Rig:
        rig = Rig().ready()
        begin(rig)
        rig.cycle(2000)  # it arrives
        aim(rig, 120.0, 120.0)
        rig.cycle(50)
        aim(rig, 0.0, 50.0)
        rig.drop(C.MOVE_POS)
        rig.cycle(2500)
        begin(rig)
        rig.run.axes["X"].move_velocity(30.0)
        rig.cycle(50)
        rig.drop(C.NULL)
        for mode in (BufferMode.ABORTING, 99)[2 - instance :]:
            rig.x.options.buffer_mode = mode
            aim(rig, 10.0 + mode, 10.0 + mode)
            rig.drop(command)
            rig.cycle(50)
        return rig

    return run


def parameters() -> Rig:
    rig = Rig()
    rig.x.nc_parameter_in.number = 1051
    rig.do(C.PARAMETER_READ)
    selector = rig.layer.globals.axis.selector_ctrl.value
    selector.axis, selector.data.number, selector.control.cmd = 1, 1051, C.PARAMETER_READ
    rig.cycle(10)
    rig.x.nc_parameter_in.number = -5
    for command in (C.PARAMETER_READ, C.PARAMETER_WRITE, C.PARAMETER_WRITE_PERSISTENT):
        rig.do(C.NULL)
        assert rig.do(command)[-1] == P.ERROR
    return rig


SCENES: list[Callable[[], Rig]] = [
    starts,
    start_fails,
    unknown_command,
    switches,
    cannot_switch,
    moves,
    held,
    moves_refused,
    brakes_refused,
    taken_over,
    *(buffered(command, instance) for command in (C.MOVE_BUFFER, C.MOVE_BUFFER_VELO) for instance in (1, 2)),
    parameters,
]


@pytest.fixture(scope="module")
def said() -> list[Event]:
    """Return all messages of the layer in all scenes; each run is judged."""
    found: list[Event] = []
    for scene in SCENES:
        rig = scene()
        found += [
            event for event in rig.messages if event.command == 0 and event.source.startswith(("GVL_AXIS", "MAIN"))
        ]
        rig.check()
    return found


@pytest.mark.parametrize("row", table(), ids=lambda row: f"{row.part} {row.level.name} {row.text}")
def test_a_text_of_the_table_comes(said: list[Event], row: Text) -> None:
    assert any(row.matches(event) for event in said)


def test_there_is_no_other_text(said: list[Event]) -> None:
    rows = table()
    assert len(rows) == 69
    strange = {event.text: event for event in said if not any(row.matches(event) for row in rows)}
    assert strange == {}
