"""The rows of the group `layer`, measured with next to no repetitions. Nothing here judges a time."""

import math

import pytest
from tests.effort import thinned

from motionlayer.bench import GROUPS, Effort, Failed, Row
from motionlayer.bench import _layer_load as load
from motionlayer.bench._layer import PHASES, SPREAD
from motionlayer.layer import AxisCommand, Progress

TINY = Effort(samples=3, runs=1)


def test_the_layer_group_has_these_rows() -> None:
    assert [(row.name, row.unit, str(row.goal)) for row in GROUPS["layer"]] == [
        ("layer.idle_64", "µs", "≤ 5"),
        ("layer.busy_64", "µs", "≤ 150"),
        ("layer.off", "µs", "≤ 0.1"),
        ("layer.spread", "ratio", "≤ 1.5"),
        ("mapping.axes_64", "µs", "≤ 100"),
        ("layer.same_cycle", "share", "≥ 1"),
        ("layer.contract", "violations", "≤ 0"),
    ]


@pytest.mark.parametrize("row", thinned(GROUPS["layer"]), ids=lambda row: row.name)
def test_every_row_gives_a_number(row: Row) -> None:
    assert math.isfinite(row.measure(TINY).value)


def test_a_busy_layer_has_a_job_on_every_axis_and_the_other_machine_the_same_motion() -> None:
    with load.pair({}) as (layered, bare):
        load.set_off(layered, bare)
        assert all(one.state.split().progress not in (Progress.DONE, Progress.ERROR) for one in layered.layer.axis)
        speeds = [[axis.set_velocity for axis in run.axes.values()] for run in (layered, bare)]
        assert speeds[0] == speeds[1]
        assert min(speeds[0]) > 0.0


def test_a_job_that_ends_while_it_is_measured_is_a_failure() -> None:
    with load.pair({}) as (layered, bare):
        load.set_off(layered, bare)
        layered.layer.axis[3].ctrl.cmd = AxisCommand.STOP
        layered.step(500)
        with pytest.raises(Failed, match="1 of 64 jobs have ended, that of A2 first"):
            load.require_jobs(layered)


@pytest.mark.slow
def test_the_namespaces_take_turns() -> None:
    row = next(row for row in GROUPS["layer"] if row.name == "layer.spread")
    assert row.measure(TINY).note.count(",") == PHASES - 1
    assert sorted(SPREAD["phase"].values()) == list(range(PHASES))
