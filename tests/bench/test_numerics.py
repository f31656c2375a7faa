"""The rows of the group `numerics`, with next to no repetitions, and the optima that they are held against."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

from motionlayer.bench import GROUPS, Effort, Environment, Row, Skipped
from motionlayer.bench import _numerics as numerics
from motionlayer.bench._optimum import asymmetric_cases, rest_to_rest
from motionlayer.bench.campaign import CAMPAIGNS, Failure

TINY = Effort(samples=3, runs=1, peers=Environment(Path(sys.executable)))
ROWS = {row.name: row for row in GROUPS["numerics"]}
HEAVY = {"drive.axes_1000"}


def test_the_numerics_group_has_these_rows() -> None:
    assert [(row.name, row.unit, str(row.goal)) for row in ROWS.values()] == [
        ("plan.failed", "per 10^6", "≤ 0"),
        ("plan.unit_spread", "relative", "≤ 1e-12"),
        ("plan.rest_to_rest", "relative", "≤ 1e-12"),
        ("plan.asymmetric", "ratio", "≤ 1.01"),
        ("override.axes_64", "µs", "≤ 150"),
        ("drive.axes_1000", "µs", "≤ 30"),
        ("life.violations", "cases", "≤ 0"),
    ]


@pytest.mark.parametrize(
    "row",
    [
        pytest.param(row, marks=[pytest.mark.slow] if name in HEAVY else [], id=name)
        for name, row in ROWS.items()
        if name != "plan.asymmetric"
    ],
)
def test_every_row_gives_a_number(row: Row) -> None:
    figure = row.measure(TINY)
    assert math.isfinite(figure.value)
    assert figure.note


def test_without_servo_drives_their_row_is_skipped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(numerics, "SERVO", {"drive": {"kind": "none of these"}})
    with pytest.raises(Skipped, match="no servo drives"):
        numerics.drives(TINY)


@pytest.mark.parametrize("name", ["plan.failed", "plan.unit_spread", "plan.rest_to_rest", "life.violations"])
def test_what_is_promised_holds_in_the_short_form(name: str) -> None:
    row = ROWS[name]
    assert row.goal.met(row.measure(TINY).value)


def test_a_failure_is_counted_and_named(monkeypatch: pytest.MonkeyPatch) -> None:
    planning = CAMPAIGNS["planning"]
    found = planning._replace(run=lambda _seed, cases: [Failure(cases.start + 7, "wrong")])
    monkeypatch.setitem(CAMPAIGNS, "planning", found)
    figure = numerics.failed(TINY)
    assert figure.value == pytest.approx(1e6 / (numerics.STATES * 3))
    assert figure.note.endswith("make campaign NAME=planning SEED=1 CASE=7")


def test_without_scipy_there_is_no_value(tmp_path: Path) -> None:
    with pytest.raises(Skipped, match="no linear program"):
        numerics.asymmetric(TINY._replace(peers=Environment(tmp_path / "python")))


@pytest.mark.slow
def test_the_linear_program_agrees_with_the_closed_form_and_the_plans() -> None:
    cases = asymmetric_cases(6)
    optima = TINY.peers.run(numerics.OPTIMUM, {"cases": [case._asdict() for case in cases], "steps": 90})
    for case, optimum in zip(cases, optima, strict=True):
        assert 1.0 - 1e-4 <= optimum / case.guess <= 1.005
    # It finds the optimum, not the guess.
    lazy = [case._replace(guess=1.2 * case.guess)._asdict() for case in cases[:2]]
    assert TINY.peers.run(numerics.OPTIMUM, {"cases": lazy, "steps": 90}) == pytest.approx(optima[:2], rel=1e-4)


@pytest.mark.parametrize(
    ("distance", "expected"),
    [
        (20.0, 20.0 / 2.0 + (2.0 / 1.0 + 1.0 / 4.0 + 2.0 / 0.5 + 0.5 / 4.0) / 2.0),  # every limit is reached
        (1e-6, 2.0 * 2.0 * (1e-6 / (2.0 * 4.0)) ** (1.0 / 3.0)),  # none is: d = 2 J t³
    ],
)
def test_the_closed_form(distance: float, expected: float) -> None:
    d, vel, acc, dec, jerk = (np.array([value]) for value in (distance, 2.0, 1.0, 0.5, 4.0))
    assert float(rest_to_rest(d, vel, acc, dec, jerk)[0]) == pytest.approx(expected, rel=1e-15)


def test_cases_start_at_rest_moving_and_moving_away() -> None:
    cases = asymmetric_cases(30)
    assert [np.sign(case.v) for case in cases[:3]] == [0.0, 1.0, -1.0]
    assert all((case.turn > 0.0) == (case.v < 0.0) for case in cases)
    assert all(0.0 <= case.turn < case.guess for case in cases)
