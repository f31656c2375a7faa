"""The servo drive against closed forms."""

import math

import numpy as np
import pytest

from motionlayer.drive import ReferenceSwitch, Servo
from motionlayer.machine._drive_relations import highest_gain
from motionlayer.store import Q
from tests.drive.servos import DT, drives, powered, run

PLAIN = Servo("X", position_gain=50.0)


@pytest.mark.parametrize("constant", [0.0, 0.004])
def test_step_response_is_that_of_the_sampled_loop(constant: float) -> None:
    """x, v of every tick by the powers of its matrix; without a time constant x = 1 - (1 - Kv dt)^n."""
    gain = 50.0
    store, stage = powered(PLAIN._replace(time_constant=constant))
    rows = run(store, stage, lambda _: (1.0, 0.0), range(2, 200))
    e = math.exp(-DT / constant) if constant else 0.0
    glide = constant * (1.0 - e)
    matrix = np.array([[1.0 - gain * (DT - glide), glide], [-gain * (1.0 - e), e]])
    error = np.array([-1.0, 0.0])
    for row in rows:
        assert row[0] == pytest.approx(1.0 + error[0], abs=1e-13)
        error = matrix @ error
    if not constant:
        assert rows[7][0] == pytest.approx(1.0 - (1.0 - gain * DT) ** 7, abs=1e-13)


@pytest.mark.parametrize("constant", [0.0, 0.004])
@pytest.mark.parametrize("forward", [0.0, 0.6, 1.0])
@pytest.mark.parametrize("dead", [0, 1, 7])
def test_lag_at_constant_velocity(constant: float, forward: float, dead: int) -> None:
    servo = PLAIN._replace(time_constant=constant, feed_forward=forward, dead_time=dead)
    store, stage = powered(servo)
    rows = run(store, stage, lambda t: (200.0 * t, 200.0), range(2, 1500))
    assert rows[-1][1] == pytest.approx((1.0 - forward) * 200.0 / 50.0, abs=1e-9)
    set_p = 200.0 * DT * (1499 - dead)
    assert set_p - rows[-1][0] == pytest.approx(rows[-1][1], abs=1e-9)


@pytest.mark.parametrize("dead", [0, 1, 5, 100])
def test_the_dead_time_is_exact(dead: int) -> None:
    """Nothing moves before, and then the same happens as without it."""
    store, stage = powered(PLAIN)
    plain = run(store, stage, lambda _: (1.0, 0.0), range(2, 60))[:, 0]
    store, stage = powered(PLAIN._replace(dead_time=dead))
    late = run(store, stage, lambda _: (1.0, 0.0), range(2, 60 + dead))[:, 0]
    assert np.all(late[: dead + 1] == 0.0)
    assert np.array_equal(late[dead:], plain)


def test_the_torque_limits_the_acceleration() -> None:
    store, stage = powered(PLAIN._replace(max_acceleration=300.0))
    position = run(store, stage, lambda _: (100.0, 0.0), range(2, 102))[:, 0]
    n = np.arange(100)
    assert np.allclose(position, 0.5 * 300.0 * (n * DT) ** 2, atol=1e-12)


def test_backlash_holds_the_load_and_costs_half_of_itself() -> None:
    store, stage = powered(PLAIN._replace(backlash=0.2, feed_forward=1.0))
    forth = run(store, stage, lambda t: (10.0 * (t - 0.001), 10.0), range(2, 1002))
    assert forth[-1][1] == pytest.approx(0.1, abs=1e-9)
    turn = 10.0 * 1.0
    back = run(store, stage, lambda t: (turn - 10.0 * (t - 1.001), -10.0), range(1002, 2002))
    held = np.flatnonzero(back[:, 0] != back[0, 0])[0]
    assert held == pytest.approx(0.2 / (10.0 * DT), abs=2.0)
    assert back[-1][1] == pytest.approx(-0.1, abs=1e-9)


def test_the_encoder_shows_whole_steps_and_rounds() -> None:
    store, stage = powered(PLAIN._replace(resolution=0.25))
    rows = run(store, stage, lambda t: (30.0 * t, 30.0), range(2, 400))
    assert np.all(rows[:, 0] % 0.25 == 0.0)
    assert len(set(rows[:, 0].tolist())) > 30
    exact = powered(PLAIN)
    smooth = run(*exact, lambda t: (30.0 * t, 30.0), range(2, 400))
    assert np.all(np.abs(rows[:, 0] - smooth[:, 0]) <= 0.125 + 1e-12)


def test_noise_has_its_deviation_and_comes_from_seed_and_name() -> None:
    def shown(name: str, seed: int) -> np.ndarray:
        store, stage = drives(Servo(name, 50.0, noise=0.01), seed=seed)
        return run(store, stage, lambda _: (0.0, 0.0), range(20_000))[:, 0]

    first = shown("X", 1)
    assert np.array_equal(first, shown("X", 1))
    assert not np.array_equal(first, shown("X", 2))
    other = shown("Y", 1)
    assert abs(first.mean()) < 4.0 * 0.01 / math.sqrt(20_000)
    assert first.std() == pytest.approx(0.01, rel=0.02)
    assert np.abs(first).max() <= 0.035
    for lag in (1, 2, 3):
        assert abs(np.corrcoef(first[:-lag], first[lag:])[0, 1]) < 0.03
    assert abs(np.corrcoef(first, other)[0, 1]) < 0.03


@pytest.mark.parametrize("brake", [500.0, 333.0])
def test_without_power_the_brake_takes_the_velocity(brake: float) -> None:
    store, stage = powered(PLAIN._replace(feed_forward=1.0, brake=brake))
    run(store, stage, lambda t: (100.0 * t, 100.0), range(2, 1000))
    store.table[Q.ENABLE] = 0.0
    begin = run(store, stage, lambda t: (100.0 * t, 100.0), range(1000, 1001))[0]
    assert begin[2] == 0.0
    rows = run(store, stage, lambda t: (100.0 * t, 100.0), range(1001, 1400))
    assert rows[-1][0] - begin[0] == pytest.approx(100.0**2 / (2.0 * brake), rel=1e-12)
    assert rows[-1][0] == rows[-2][0]


def test_readiness_waits_for_its_delay_and_for_rest() -> None:
    store, stage = drives(PLAIN._replace(ready_delay=5, brake=100.0), start=3.0)
    store.table[Q.ENABLE] = 1.0
    ready = run(store, stage, lambda _: (3.0, 0.0), range(10))[:, 2]
    assert ready.tolist() == [0.0] * 5 + [1.0] * 5
    run(store, stage, lambda t: (3.0 + 20.0 * (t - 0.01), 20.0), range(10, 500))
    store.table[Q.ENABLE] = 0.0
    run(store, stage, lambda _: (0.0, 0.0), range(500, 501))
    store.table[Q.ENABLE] = 1.0
    rows = run(store, stage, lambda _: (0.0, 0.0), range(501, 900))
    on = int(np.flatnonzero(rows[:, 2])[0])
    rest = int(np.flatnonzero(np.diff(rows[:, 0]) == 0.0)[0])
    assert rest + 4 <= on <= rest + 7
    assert rows[on][1] == 0.0  # it holds what its encoder shows


def test_the_drive_knows_nothing_of_a_redefined_coordinate() -> None:
    store, stage = powered(PLAIN._replace(dead_time=3))
    plain = run(store, stage, lambda t: (20.0 * t, 20.0), range(2, 300))
    store, stage = powered(PLAIN._replace(dead_time=3))
    run(store, stage, lambda t: (20.0 * t, 20.0), range(2, 100))
    store.table[Q.SHIFT] = 512.0
    shifted = run(store, stage, lambda t: (512.0 + 20.0 * t, 20.0), range(100, 300))
    assert np.allclose(shifted[:, 0] - 512.0, plain[98:, 0], atol=1e-12)
    assert np.allclose(shifted[:, 1], plain[98:, 1], atol=1e-12)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_switch_is_on_from_its_edge_on(side: float) -> None:
    store, stage = powered(PLAIN._replace(feed_forward=1.0, switch=ReferenceSwitch(3.0, side)))
    assert store.table[Q.HOME_INPUT, 0] == (0.0 if side > 0.0 else 1.0)
    store.status_changed.clear()
    run(store, stage, lambda t: (10.0 * t, 10.0), range(2, 600))
    assert store.table[Q.HOME_INPUT, 0] == (1.0 if side > 0.0 else 0.0)
    assert store.table[Q.HOME_LATCH, 0] == 3.0
    assert store.status_changed == [0]


@pytest.mark.parametrize("constant", [0.0, 0.0003, 0.002, 0.05])
def test_the_highest_gain_is_where_the_loop_begins_to_swing(constant: float) -> None:
    highest = highest_gain(DT, constant)
    ends = []
    for share in (0.99, 1.01):
        store, stage = powered(PLAIN._replace(position_gain=share * highest, time_constant=constant))
        ends.append(np.abs(run(store, stage, lambda _: (1.0, 0.0), range(2, 6000))[-200:, 1]).max())
    assert ends[0] < 0.9
    assert ends[1] > 1.1


def test_far_out_and_long_it_stays_exact() -> None:
    store, stage = powered(PLAIN._replace(feed_forward=1.0, dead_time=2), start=1e6)
    for tick in (2**33, 2**33 + 1, 2**33 + 2, 2**33 + 3):
        rows = run(store, stage, lambda _: (1e6, 0.0), range(tick, tick + 1))
        assert rows[0][:2].tolist() == [1e6, 0.0]


def test_no_drives_at_all() -> None:
    store, stage = drives()
    stage.inputs(0)
    assert not store.status_changed
