"""Homing to what the drive latches behind the cam: overflow of the count, edges of the latch input."""

from typing import Any, Final

import pytest

from motionlayer.command import ErrorId
from motionlayer.nc import Direction, HomingMode
from motionlayer.store import Q
from motionlayer.verify import assert_valid
from tests.machines import SWITCH, error_of, finish, ready
from tests.nc.servos import ready_servos

CAM: Final[dict[str, Any]] = {"mode": "cam", "switch": -50.0, "velocity": 40.0, "sync_velocity": 5.0, "position": 7.0}
SIGNALS: Final = CAM | {"pulse": 1.25, "pulse_period": 10.0, "turn": 8.0, "latch": -45.0, "latch_width": 0.5}

PLACES: Final = {
    HomingMode.CAM: -50.0,
    HomingMode.INDEX: -48.75,
    HomingMode.SOFTWARE_SYNC: -48.0,
    HomingMode.LATCH_POSITIVE: -45.0,
    HomingMode.LATCH_NEGATIVE: -44.5,
    HomingMode.SOFT_LATCH_POSITIVE: -45.0,
    HomingMode.SOFT_LATCH_NEGATIVE: -44.5,
}
"""Drive positions of the reference in each mode, behind the cam at -50."""

LATE: Final = {HomingMode.SOFT_LATCH_POSITIVE: 0.005, HomingMode.SOFT_LATCH_NEGATIVE: 0.005}
"""Way of a cycle while the cam is left."""


def reference(axis: Any) -> float:
    """Return the drive position of the reference of an axis that stands somewhere."""
    return float(7.0 - axis._store.table[Q.SHIFT, 0])


@pytest.mark.parametrize("mode", list(PLACES))
def test_the_reference_is_what_the_drive_latches_behind_the_cam(mode: HomingMode) -> None:
    run, x = ready(home=SIGNALS)
    finish(run, x.home(method=mode))
    late = reference(x) - PLACES[mode]
    assert -1e-12 < late <= LATE.get(mode, 0.0) + 1e-12
    finish(run, x.home(method=mode))
    assert -1e-12 < reference(x) - PLACES[mode] <= LATE.get(mode, 0.0) + 1e-12
    run.step(2)
    assert_valid(run.trace)


@pytest.mark.parametrize("mode", list(PLACES))
def test_a_described_mode_is_that_of_a_plain_homing(mode: HomingMode) -> None:
    """With a servo: the reference is where the drive was, however far it lags."""
    run, (x,) = ready_servos(home=SIGNALS | {"mode": mode.value})
    finish(run, x.home(), 60_000)
    assert -1e-9 < reference(x) - PLACES[mode] <= LATE.get(mode, 0.0) + 1e-9
    run.step(500)
    assert_valid(run.trace)


@pytest.mark.parametrize(
    ("mode", "direction", "place"),
    [(HomingMode.LATCH_POSITIVE, "negative", -60.0), (HomingMode.LATCH_NEGATIVE, "negative", -60.5)],
)
def test_an_edge_is_that_of_the_direction_of_the_motion(mode: HomingMode, direction: str, place: float) -> None:
    """Crossing a cam of a width downwards: the input rises at its upper end."""
    home = SIGNALS | {"switch_width": 4.0, "sync_direction": direction, "latch": -60.5, "latch_width": 0.5}
    run, x = ready(home=home)
    finish(run, x.home(method=mode))
    assert reference(x) == pytest.approx(place, abs=1e-12)
    run.step(2)
    assert_valid(run.trace)


@pytest.mark.parametrize(
    ("mode", "error"),
    [(HomingMode.LATCH_POSITIVE, None), (HomingMode.SOFT_LATCH_POSITIVE, ErrorId.SYNC_PULSE_NOT_FOUND)],
)
def test_a_short_signal_is_caught_by_hardware_alone(mode: HomingMode, error: ErrorId | None) -> None:
    run, x = ready(home=SIGNALS | {"latch": -44.9985, "latch_width": 0.001, "travel": 70.0})
    command = x.home(method=mode)
    finish(run, command)
    assert (command.error.id if command.error else None) is error
    run.step(2)
    assert_valid(run.trace)


@pytest.mark.parametrize("mode", [one for one in PLACES if one is not HomingMode.CAM])
def test_what_comes_too_near_to_the_cam_is_an_error(mode: HomingMode) -> None:
    run, x = ready(home=SIGNALS | {"pulse_distance": 6.0})
    command = x.home(method=mode)
    finish(run, command)
    assert error_of(command) is ErrorId.LATCH_TOO_CLOSE
    run.step(2)
    assert_valid(run.trace)


@pytest.mark.parametrize("mode", [one for one in PLACES if one is not HomingMode.CAM])
def test_a_mode_for_which_the_drive_has_no_signal_is_refused(mode: HomingMode) -> None:
    run, x = ready(home=SWITCH)
    command = x.home(method=mode)
    assert error_of(command) is ErrorId.REFERENCE_MODE
    assert f"method = {mode.name}, allowed: DIRECT, SWITCH, CAM; the drive has no signal" in str(command.error)
    run.step(10)
    assert (x.set_velocity, x.command) == (0.0, None)


def test_a_homing_that_is_stopped_leaves_no_latch_armed() -> None:
    run, x = ready(home=SIGNALS | {"turn": 1000.0})
    home = x.home(method=HomingMode.SOFTWARE_SYNC, search_direction=Direction.NEGATIVE)
    while x._store.table[Q.LATCH_ASKED, 0] == 0.0:
        run.step()
    finish(run, x.stop())
    assert home.aborted
    assert x._store.table[Q.LATCH_ASKED, 0] == 0.0
    finish(run, x.home(method=HomingMode.INDEX))
    assert reference(x) == pytest.approx(PLACES[HomingMode.INDEX], abs=1e-12)
    run.step(2)
    assert_valid(run.trace)
