"""Two machines in one process: the example runs, and the controller knows no axes."""

import runpy
from pathlib import Path

import pytest

from motionlayer import Loopback, Machine, Simulation
from motionlayer.layer import Progress
from motionlayer.verify import assert_valid

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "loopback"


def test_the_script_runs(capsys: pytest.CaptureFixture[str]) -> None:
    runpy.run_path(str(FOLDER / "loopback.py"), run_name="__main__")
    places = [line.partition("at ")[2] for line in capsys.readouterr().out.splitlines()[:-1]]
    assert places == ["250.0, 400.0", "900.0, 100.0", "500.0, 550.0"]


def test_x_and_y_move_together_and_all_axes_end_without_power() -> None:
    motion, control = (Machine.load(FOLDER / name) for name in ("motion.toml", "control.toml"))
    with Simulation(motion) as axes, Simulation(control) as controller:
        assert Loopback(axes, controller).run(time=60.0)
        assert not controller.failures
        assert [axis.enabled for axis in axes.axes.values()] == [False] * 3
        assert [axis.state.split().progress for axis in controller.layer.axis] == [Progress.DONE] * 3
        trace = axes.trace
    assert_valid(trace)
    moving = [trace[f"{axis}.set_velocity"] != 0.0 for axis in "XYZ"]
    assert (moving[0] & moving[1]).sum() > 1000
    assert not (moving[2] & (moving[0] | moving[1])).any()
