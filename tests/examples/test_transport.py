"""The transport: the command of its own program says what the slides' example says, line by line."""

import re
import shutil
from pathlib import Path

import pytest

from motionlayer import Machine, Simulation
from motionlayer.verify import assert_valid

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "transport"

SLIDE = """\
eMessageInfo
               2025-10-24-13:00:18.408 General ID 0
                                                       General 30 ExampleEvalMachine: TRANSPORT GROUP CLEAR: PROGRESS INIT
eMessageInfo
               2025-10-24-13:00:18.418 General ID 0
                                                       General 30 ExampleEvalMachine: TRANSPORT GROUP CLEAR: PROGRESS BUSY
eMessageInfo
               2025-10-24-13:00:18.458 General ID 0
                                                       General 30 ExampleEvalMachine :TRANSPORT GROUP CLEAR: PROGRESS PREPARE
eMessageInfo
               2025-10-24-13:00:18.658 General ID 0
                                                       General 30 ExampleEvalMachine :TRANSPORT GROUP CLEAR: PROGRESS STARTUP
eMessageInfo
                                                                   ExampleEvalMachine : TRANSPORT GROUP CLEAR: PROGRESS CHECK
               2025-10-24-13:00:18.858 General ID 0
                                                       General 30
eMessageInfo
               2025-10-24-13:00:18.888 General ID 0
                                                                   ExampleEvalMachine :TRANSPORT GROUP CLEAR: PROGRESS OCCUPIED
                                                       General 30
eMessageInfo
                                                       General 30 ExampleEvalMachine : TRANSPORT GROUP CLEAR: PROGRESS DONE
               2025-10-24-13:00:18.908 General ID 0
"""  # noqa: E501 - as it was typeset
"""The log of the introduction slides; typesetting has taken underscores away, and moved words and spaces."""


def set_lines(slide: str) -> list[str]:
    """Return the lines as they were before somebody typeset them (motion-layer 1.7)."""
    lines = []
    for record in slide.split("eMessageInfo\n")[1:]:
        (time,) = re.findall(r"\d{4}-\d\d-\d\d-\S+", record)
        ((who, what, progress),) = re.findall(
            r"(ExampleEvalMachine) ?: ?(TRANSPORT [A-Z ]+): (PROGRESS [A-Z]+)", record
        )
        assert re.search(r"General ID 0\s", record)
        assert re.search(r"General 30\s", record)
        text = f"{who}: {what.replace(' ', '_')}: {progress.replace(' ', '_')}"
        lines.append(f"eMessageInfo\t{time}\tGeneral_ID_0\tGeneral\t30\t{text}")
    return lines


@pytest.fixture(scope="module")
def ran(tmp_path_factory: pytest.TempPathFactory) -> tuple[Simulation, list[str]]:
    """Run a copy of the example; return the run, and the lines of its message file."""
    folder = tmp_path_factory.mktemp("run") / "transport"
    shutil.copytree(FOLDER, folder, ignore=shutil.ignore_patterns("messages"))
    with Simulation(Machine.load(folder / "machine.toml")) as run:
        assert run.run(time=10.0)
    assert not run.failures
    (file,) = folder.rglob("*_MSG_PLC_*.txt")
    return run, file.read_text().splitlines()


def test_the_log_is_that_of_the_slides_line_by_line(ran: tuple[Simulation, list[str]]) -> None:
    expected = set_lines(SLIDE)
    assert len(expected) == 7
    assert [line for line in ran[1] if "\tGeneral_ID_0\t" in line] == expected


def test_the_steps_are_those_of_the_axes(ran: tuple[Simulation, list[str]]) -> None:
    run, lines = ran
    text = "\n".join(line.partition("13:00:")[2] for line in lines)
    for axis, command, begins, ends in (
        (1, "HALT", "18.418", "18.453"),
        (2, "MOVE_POS", "18.458", "18.652"),
        (1, "MOVE_POS", "18.658", "18.851"),
        (1, "DISABLE", "18.888", "18.889"),
    ):
        lead = f"Axis_ID_{axis}\tAxisControl\t{axis}\t"
        assert f"{begins}\t{lead}new command: E_AXIS_CTRL.AXIS_{command}" in text
        assert f"{ends}\t{lead}E_AXIS_CTRL.AXIS_{command}: PROGRESS_DONE" in text
    trace = run.trace
    assert_valid(trace)
    assert trace["Stopper.set_position"][-1] == -37.0
    assert trace["Belt.set_velocity"][-1] == 0.0
    assert abs(trace["Belt.set_velocity"][300] - 200.0) < 1e-9


def test_the_page_shows_the_table_and_the_lines() -> None:
    page = (FOLDER.parents[1] / "docs" / "namespaces.md").read_text(encoding="utf-8")
    rows = [
        line for line in (FOLDER / "transport.py").read_text(encoding="utf-8").splitlines() if "Transition(" in line
    ]
    assert len(rows) == 9
    assert "\n".join(rows) in page
    for line in set_lines(SLIDE):
        assert f"# → {line}".replace("\t", " ") in page
