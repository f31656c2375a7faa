"""A module included twice: what docs/machine-file.md says of it holds."""

from pathlib import Path

import pytest

from motionlayer import Machine, Simulation
from motionlayer.verify import assert_valid

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "examples" / "stations"


def test_both_presses_press_three_parts_each_at_its_own_speed(capsys: pytest.CaptureFixture[str]) -> None:
    with Simulation(Machine.load(FOLDER / "machine.toml")) as run:
        assert run.run()
    assert not run.failures
    trace = run.trace
    assert_valid(trace)
    printed = capsys.readouterr().out.splitlines()
    assert [line.split(": ")[1] for line in printed] == [
        f"{name} has pressed part {part}" for part in (1, 2, 3) for name in ("S1_Ram", "S2_Ram")
    ]
    assert trace["Belt.set_position"][-1] == 300.0
    assert abs(trace["S1_Ram.set_velocity"]).max() > 200.0 >= abs(trace["S2_Ram.set_velocity"]).max()


def test_the_page_shows_the_files() -> None:
    page = (ROOT / "docs" / "machine-file.md").read_text(encoding="utf-8")
    for name in ("press.toml", "press.py"):
        assert (FOLDER / name).read_text(encoding="utf-8") in page
    modules = (FOLDER / "machine.toml").read_text(encoding="utf-8").partition("[[module]]")
    assert "".join(modules[1:]) in page
