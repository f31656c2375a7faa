"""The ideal drive: lag exactly 0 while it has power, at rest without."""

import numpy as np
import pytest

from motionlayer.drive import IdealDrives, ReferenceSwitch
from motionlayer.store import Q, Store
from tests.machines import finish, ready


def test_lag_is_exactly_zero_in_every_tick() -> None:
    run, x = ready(home={"mode": "switch", "switch": -50.0, "velocity": 40.0, "position": 7.0})
    finish(run, x.move_absolute(300.0))
    finish(run, x.home())
    x.move_velocity(200.0)
    run.step(100)
    finish(run, x.stop())
    run.step(3)
    trace = run.trace
    assert np.array_equal(trace["X.set_position"], trace["X.actual_position"])
    assert np.ptp(trace["X.set_position"]) > 300.0


def drives(switch: ReferenceSwitch | None = None) -> tuple[Store, IdealDrives]:
    store = Store(2, dt=0.001, max_pieces=4)
    return store, IdealDrives(store, range(2), [None, switch])


def test_ready_follows_the_request_with_the_next_inputs_and_is_told_once() -> None:
    store, stage = drives()
    store.table[Q.ENABLE, 1] = 1.0
    stage.inputs(0)
    assert store.table[Q.READY].tolist() == [0.0, 1.0]
    assert store.status_changed == [1]
    stage.inputs(1)
    assert store.status_changed == [1]
    store.table[Q.ENABLE, 1] = 0.0
    stage.inputs(2)
    assert store.table[Q.READY].tolist() == [0.0, 0.0]
    assert store.status_changed == [1, 1]


def test_without_power_it_stays_and_with_power_it_follows() -> None:
    store, stage = drives()
    store.table[Q.ENABLE, 0] = 1.0
    stage.inputs(0)
    store.table[Q.SET_P] = 5.0
    stage.inputs(1)
    assert store.table[Q.ACTUAL_P].tolist() == [5.0, 0.0]


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_switch_is_on_from_its_edge_on_and_latches_it(side: float) -> None:
    store, stage = drives(ReferenceSwitch(3.0, side))
    store.table[Q.SHIFT, 1] = 10.0  # the coordinate was redefined: the drive stands at position - 10
    store.table[Q.ENABLE, 1] = 1.0
    seen = []
    for position in (12.0, 12.999, 13.0, 13.001, 14.0, 13.0, 12.0):
        store.table[Q.SET_P, 1] = position
        stage.inputs(0)
        stage.inputs(0)
        seen.append(store.table[Q.HOME_INPUT, 1])
    beyond = [0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0]
    below = [1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0]
    assert seen == (beyond if side > 0 else below)
    assert store.table[Q.HOME_LATCH, 1] == 3.0
    assert store.table[Q.HOME_INPUT, 0] == 0.0


def test_no_drives_at_all() -> None:
    store = Store(1, dt=0.001, max_pieces=4)
    IdealDrives(store, [], []).inputs(0)
    assert not store.status_changed
