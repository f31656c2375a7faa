"""`Simulation`: wrong use gets one clear error."""

import numpy as np
import pytest
from tests.machines import finish, machine, one_axis, ready

from motionlayer import Simulation


def test_an_unknown_axis_is_named_with_the_nearest_one() -> None:
    run, _ = one_axis()
    with pytest.raises(KeyError, match=r"no axis 'x'; this machine has X"):
        run.axes["x"]


def test_a_path_is_no_machine() -> None:
    with pytest.raises(TypeError, match=r"Machine\.load\('cell\.toml'\)"):
        Simulation("cell.toml")  # type: ignore[arg-type]


def test_a_run_whose_trace_was_taken_is_over() -> None:
    run, _ = ready()
    assert len(run.trace.ticks) == run.tick
    with pytest.raises(RuntimeError, match="new Simulation"):
        run.step()


def test_a_simulation_that_is_never_run_closes_its_programs() -> None:
    async def program() -> None:
        raise AssertionError

    with Simulation(machine(), trace=False) as run:
        started = run.start(program())
    assert started.aborted  # and no warning of a coroutine that was never awaited


@pytest.mark.parametrize("kind", [np.float32, np.float64, np.int64, int])
def test_numbers_of_numpy_are_numbers(kind: type) -> None:
    run, x = ready()
    finish(run, x.move_absolute(kind(10)))
    assert x.set_position == 10.0


def test_machine_run_axis_and_task_show_themselves() -> None:
    run, x = ready()
    name, count = run.machine.name, len(run.axes)
    assert repr(x) == "<Axis X: StandStill at 0 mm>"
    assert repr(run.machine) == f"<Machine {name}: {count} axes>"
    assert repr(run) == f"<Simulation of {name} at {run.time:g} s>"
    assert repr(run.tasks["main"]) == "<Task main: every 1 ticks, 0 programs>"
