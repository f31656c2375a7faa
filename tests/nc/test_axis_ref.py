"""The cyclic interface: bytes where the interface says they are, values that a plain reference finds too."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.nc._actual import ActualMotion
from motionlayer.nc._axis_ref import NCTOPLC_AXIS_REF, PLCTONC_AXIS_REF, OpModeDWord, StateDWord
from motionlayer.nc._axis_refs import AxisRefs
from motionlayer.store import Q, Status, Store
from tests.effort import examples
from tests.machines import ready

DT = 0.001
NC_TO_PLC = {
    "ActPos": 40, "ModuloActPos": 48, "ActiveControlLoopIndex": 56, "ControlLoopIndex": 58, "ModuloActTurns": 60,
    "ActVelo": 64, "PosDiff": 72, "SetPos": 80, "SetVelo": 88, "SetAcc": 96, "TargetPos": 104, "ModuloSetPos": 112,
    "ModuloSetTurns": 120, "CmdNo": 124, "CmdState": 126, "SetJerk": 128, "SetTorque": 136, "ActTorque": 144,
    "StateDWord2": 152, "StateDWord3": 156, "TouchProbeState": 160, "TouchProbeCounter": 164, "CamCouplingState": 168,
    "CamCouplingTableID": 176, "ActTorqueDerivative": 192, "SetTorqueDerivative": 200, "AbsPhasingPos": 208,
    "TorqueOffset": 216, "ActPosWithoutPosCorrection": 224, "ActAcc": 232, "DcTimeStamp": 240, "UserData": 248,
}  # fmt: skip
"""Offsets as the interface description states them (function-blocks 3.1)."""


def refs(count: int = 1, modulo: float = 360.0) -> tuple[Store, AxisRefs]:
    store = Store(count, dt=DT, max_pieces=20)
    store.table[Q.MIN_P], store.table[Q.MAX_P], store.table[Q.TARGET] = -math.inf, math.inf, math.nan
    return store, AxisRefs(store, ActualMotion(store, count), [modulo] * count, [0] * count)


@pytest.mark.parametrize(("name", "offset"), NC_TO_PLC.items())
def test_offsets_are_those_of_the_interface(name: str, offset: int) -> None:
    assert NCTOPLC_AXIS_REF.fields is not None
    assert NCTOPLC_AXIS_REF.fields[name][1] == offset


def test_sizes_are_those_of_the_interface() -> None:
    assert (NCTOPLC_AXIS_REF.itemsize, PLCTONC_AXIS_REF.itemsize) == (256, 128)
    assert PLCTONC_AXIS_REF.fields is not None
    assert PLCTONC_AXIS_REF.fields["ExtTorque"][1] == 112


def test_no_two_fields_share_a_byte() -> None:
    for dtype in (NCTOPLC_AXIS_REF, PLCTONC_AXIS_REF):
        assert dtype.fields is not None
        spans = sorted((entry[1], entry[1] + entry[0].itemsize) for entry in dtype.fields.values())
        assert all(end <= start for (_, end), (start, _) in pairwise(spans))


finite = st.floats(-1e6, 1e6)


@settings(max_examples=examples(300), deadline=None)
@given(st.lists(finite, min_size=6, max_size=6), st.floats(1e-3, 1e4), st.integers(0, 2**40))
def test_positions_and_turns_fit_together(values: list[float], modulo: float, tick: int) -> None:
    store, _ = refs(1, modulo)
    actual, before, p, v, a, lag = values
    store.table[Q.ACTUAL_P] = before
    moved = ActualMotion(store, 1)
    image = AxisRefs(store, moved, [modulo], [0])
    store.table[[Q.ACTUAL_P, Q.SET_P, Q.SET_V, Q.SET_A, Q.LAG], 0] = actual, p, v, a, lag
    moved.follow()
    image.fill(tick)
    one = image.nc_to_plc[0]
    assert (one["ActPos"], one["SetPos"], one["SetVelo"], one["SetAcc"], one["PosDiff"]) == (actual, p, v, a, lag)
    assert one["TargetPos"] == p
    assert one["ActVelo"] == (actual - before) * 1000.0
    for position, rest, turns in (
        (actual, one["ModuloActPos"], one["ModuloActTurns"]),
        (p, one["ModuloSetPos"], one["ModuloSetTurns"]),
    ):
        assert 0.0 <= rest < modulo
        assert math.isclose(rest + int(turns) * modulo, position, rel_tol=1e-12, abs_tol=1e-12 * modulo)
    assert one["DcTimeStamp"] == tick * 1_000_000 % 2**32
    assert one["OpModeDWord"] >> 24 == tick % 256


@pytest.mark.parametrize(
    ("row", "value", "bits"),
    [
        (Q.READY, 1.0, StateDWord.Operational | StateDWord.ControlLoopClosed | StateDWord.NotMoving),
        (Q.SET_V, 2.0, StateDWord.PositiveDirection | StateDWord.ConstantVelocity),
        (Q.SET_V, -2.0, StateDWord.NegativeDirection | StateDWord.ConstantVelocity),
        (Q.STATE, 5.0, StateDWord.HomingBusy | StateDWord.NotMoving),
        (Q.STATE, 7.0, StateDWord.ContinuousMotion | StateDWord.NotMoving),
        (Q.STATE, 3.0, StateDWord.Error | StateDWord.NotMoving),
        (Q.STATUS, float(Status.DRIVE_ERROR), StateDWord.DriveDeviceError | StateDWord.NotMoving),
        (Q.STATUS, float(Status.LOST), StateDWord.IoDataInvalid | StateDWord.NotMoving),
        (Q.FLAGS, float(StateDWord.HasJob), StateDWord.HasJob),
        (Q.FLAGS, float(StateDWord.Homed), StateDWord.Homed | StateDWord.NotMoving),
        (Q.WINDOWS, 3.0, StateDWord.InPositionArea | StateDWord.InTargetPosition | StateDWord.NotMoving),
        (Q.MIN_P, 1.0, StateDWord.SoftLimitMinExceeded | StateDWord.NotMoving),
        (Q.MAX_P, -1.0, StateDWord.SoftLimitMaxExceeded | StateDWord.NotMoving),
    ],
)
def test_each_cause_sets_its_bits_and_no_others(row: int, value: float, bits: StateDWord) -> None:
    store, image = refs()
    store.table[row, 0] = value
    image.fill(0)
    assert StateDWord(int(image.nc_to_plc[0]["StateDWord"])) == bits


@pytest.mark.parametrize(
    ("v", "a", "job", "override", "state"),
    [
        (0.0, 0.0, False, 1.0, 0),
        (0.0, 0.0, True, 1.0, 1),
        (0.0, 0.0, True, 0.0, 2),
        (5.0, 0.0, True, 1.0, 3),
        (-5.0, -1.0, True, 1.0, 4),
        (0.0, 1.0, True, 1.0, 4),
        (5.0, -1.0, True, 1.0, 5),
    ],
)
def test_axis_state_tells_the_phase(v: float, a: float, job: bool, override: float, state: int) -> None:
    store, image = refs()
    store.table[[Q.SET_V, Q.SET_A, Q.OVERRIDE], 0] = v, a, override
    store.table[Q.FLAGS, 0] = float(StateDWord.HasJob) if job else 0.0
    image.fill(0)
    assert image.nc_to_plc[0]["AxisState"] == state


def test_axes_do_not_mix_and_modes_stay() -> None:
    store = Store(3, dt=DT, max_pieces=20)
    image = AxisRefs(
        store, ActualMotion(store, 3), [360.0, 10.0, 1.0], [0, int(OpModeDWord.Modulo), int(OpModeDWord.SimulationAxis)]
    )
    store.table[Q.SET_P] = 365.0, 25.0, -0.25
    store.table[Q.ERROR] = 0.0, float(0x4550), 0.0
    image.fill(258)
    assert image.nc_to_plc["AxisId"].tolist() == [1, 2, 3]
    assert image.nc_to_plc["ModuloSetPos"].tolist() == [5.0, 5.0, 0.75]
    assert image.nc_to_plc["ModuloSetTurns"].tolist() == [1, 2, -1]
    assert image.nc_to_plc["ErrorCode"].tolist() == [0, 0x4550, 0]
    assert (image.nc_to_plc["OpModeDWord"] & 0xFFFFFF).tolist() == [0, OpModeDWord.Modulo, OpModeDWord.SimulationAxis]
    assert np.all(image.nc_to_plc["OpModeDWord"] >> 24 == 2)


def test_the_actual_velocity_does_not_depend_on_when_somebody_first_looks() -> None:
    shown = []
    for first_look in (0, 60):
        run, axis = ready()
        axis.move_absolute(300.0, velocity=200.0)
        for tick in range(60):
            if tick >= first_look:
                assert run.axis_refs["X"].NcToPlc.ActPos >= 0.0
            run.step()
        ref = run.axis_refs["X"].NcToPlc
        shown.append((ref.ActVelo, ref.ActAcc))
        assert ref.ActVelo > 100.0
    assert shown[0] == shown[1]


def test_a_redefinition_of_the_position_is_no_motion() -> None:
    run, axis = ready()
    ref = run.axis_refs["X"].NcToPlc
    axis.define_position(50.0)
    for _ in range(5):
        run.step()
        assert (ref.ActVelo, ref.ActAcc) == (0.0, 0.0)
    assert ref.ActPos == 50.0
