"""The packer: six axes by Ctrl and State alone, a drive that fails, and what the log tells of it."""

import re
import shutil
from pathlib import Path

import pytest

from motionlayer import Machine, Simulation
from motionlayer.event import Level
from motionlayer.verify import assert_valid

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "control_layer"
AXES = ("Infeed", "Outfeed", "Lift", "Pusher", "Gripper", "Turner")

LINE = re.compile(
    r"eMessage(Info|Verbose|Error)\t2025-10-24-13:00:\d\d\.\d{3}\t"
    r"(Axis_ID_[1-6]|Device_Main_ID_1|Device_MainAxis_ID_2)\t[A-Za-z]+\t\d+\t.+"
)

LIFT = """\
new command: E_AXIS_CTRL.AXIS_MOVE_POS
E_AXIS_CTRL.AXIS_MOVE_POS: PROGRESS_OCCUPIED
E_AXIS_CTRL.AXIS_MOVE_POS: PROGRESS_ERROR
new command: E_AXIS_CTRL.AXIS_RESET
E_AXIS_CTRL.AXIS_RESET: PROGRESS_OCCUPIED
E_AXIS_CTRL.AXIS_RESET: PROGRESS_DONE
new command: E_AXIS_CTRL.AXIS_ENABLE
E_AXIS_CTRL.AXIS_ENABLE: PROGRESS_OCCUPIED
E_AXIS_CTRL.AXIS_ENABLE: PROGRESS_DONE
new command: E_AXIS_CTRL.AXIS_NULL
new command: E_AXIS_CTRL.AXIS_MOVE_POS
E_AXIS_CTRL.AXIS_MOVE_POS: PROGRESS_OCCUPIED
E_AXIS_CTRL.AXIS_MOVE_POS: PROGRESS_DONE
""".splitlines()
"""What the lift says of its failure, and of what follows."""


@pytest.fixture(scope="module")
def ran(tmp_path_factory: pytest.TempPathFactory) -> tuple[Simulation, list[str]]:
    """Run a copy of the example; return the run, and the lines of its message file."""
    folder = tmp_path_factory.mktemp("run") / "packer"
    shutil.copytree(FOLDER, folder, ignore=shutil.ignore_patterns("messages"))
    with Simulation(Machine.load(folder / "machine.toml")) as run:
        assert run.run(time=20.0)
    assert not run.failures
    (file,) = folder.rglob("*_MSG_PLC_*.txt")
    return run, file.read_text().splitlines()


def said(lines: list[str], axis: int) -> list[str]:
    """Return what the command field of an axis has said."""
    return [line.split("\t")[5] for line in lines if f"\tAxis_ID_{axis}\tAxisControl\t{axis}\t" in line]


def test_the_log_looks_as_that_of_the_slides(ran: tuple[Simulation, list[str]]) -> None:
    _, lines = ran
    assert [line for line in lines if not LINE.fullmatch(line)] == []
    times = [line.split("\t")[1] for line in lines]
    assert times == sorted(times)
    for axis in range(1, 7):
        done = [text for text in said(lines, axis) if text.endswith("PROGRESS_DONE")]
        names = {re.findall(r"AXIS_(\w+):", text)[0] for text in done}
        assert names >= {"INIT", "ENABLE", "HOME", "MOVE_POS", "DISABLE"}
    buffered = [axis for axis in range(1, 7) if "E_AXIS_CTRL.AXIS_MOVE_BUFFER: PROGRESS_DONE" in said(lines, axis)]
    assert buffered == [1, 2, 3, 4, 6]


def test_the_lift_fails_recovers_and_does_it_again(ran: tuple[Simulation, list[str]]) -> None:
    run, lines = ran
    texts = said(lines, 3)
    begins = texts.index("E_AXIS_CTRL.AXIS_MOVE_POS: PROGRESS_ERROR") - 2
    assert texts[begins : begins + len(LIFT)] == LIFT
    assert {event.source for event in run.events.last(Level.ERROR)} <= {"Lift", "GVL_AXIS.Ctrl[3]"}


def test_every_axis_goes_to_its_positions_and_comes_back(ran: tuple[Simulation, list[str]]) -> None:
    trace = ran[0].trace
    assert_valid(trace)
    most = dict(zip(AXES, (900.0, 700.0, 300.0, 250.0, 40.0, 360.0), strict=True))
    for axis in AXES:
        positions = trace[f"{axis}.set_position"]
        assert positions[-1] == 0.0
        assert abs(positions.max() - most[axis]) < 1e-9
    # Between buffered moves the infeed does not come to rest.
    passes = (trace["Infeed.set_position"] >= 600.0).argmax()
    assert trace["Infeed.set_velocity"][passes] > 100.0
