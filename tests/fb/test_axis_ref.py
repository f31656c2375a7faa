"""AXIS_REF in a run: flags follow commands, names are those of the interface, and looking changes no bit of it."""

from typing import Any

import pytest

from motionlayer import AxisState, Simulation
from motionlayer.fb import AXIS_REF, MC_Halt, MC_MoveAbsolute, MC_MoveVelocity, MC_Power, ST_AxisStatus
from motionlayer.nc import OpModeDWord, StateDWord
from tests.machines import machine

from .rig import Rig


def test_flags_follow_the_commands() -> None:
    rig = Rig(monitor={"range_window": 1.0, "target_window": 0.5, "target_time": 0.003})
    first, second, halt = MC_MoveAbsolute(rig.ref), MC_MoveAbsolute(rig.ref), MC_Halt(rig.ref)
    rig.cycle(1, lambda: first(Execute=True, Position=200.0, Velocity=200.0))
    rig.cycle(50, first)
    status = rig.ref.ReadStatus()
    assert (status.HasJob, status.NotMoving, status.Moving, status.PositiveDirection) == (True, False, True, True)
    assert (status.NewTargetPos, status.HasBeenStopped, status.PTPmode) == (False, False, True)
    assert rig.ref.NcToPlc.TargetPos == 200.0
    rig.cycle(3, first, lambda: second(Execute=True, Position=300.0, Velocity=200.0))
    assert rig.ref.ReadStatus().NewTargetPos
    rig.cycle(3, lambda: halt(Execute=True))
    status = rig.ref.ReadStatus()
    assert (status.HasBeenStopped, status.NewTargetPos) == (True, False)
    rig.until(lambda: halt.Done, halt)
    rig.cycle(10)
    status = rig.ref.ReadStatus()
    assert (status.HasJob, status.NotMoving, status.HasBeenStopped) == (False, True, True)
    assert (status.InPositionArea, status.InTargetPosition) == (True, True)
    assert rig.ref.NcToPlc.SetPos == rig.ref.axis.set_position
    rig.check()


def test_the_operating_mode_tells_the_monitors() -> None:
    rig = Rig(monitor={"range_window": 1.0, "target_window": 0.5, "target_timeout": 1.0, "lag": 3.0})
    assert rig.ref.ReadStatus().op_mode == (
        OpModeDWord.PositionAreaMonitoring
        | OpModeDWord.TargetPositionMonitoring
        | OpModeDWord.PEHTimeMonitoring
        | OpModeDWord.PositionLagMonitoring
        | OpModeDWord.SoftLimitMinMonitoring
        | OpModeDWord.SoftLimitMaxMonitoring
        | OpModeDWord.SimulationAxis
    )


@pytest.mark.parametrize("modulo", [False, True])
@pytest.mark.parametrize("servo", [False, True])
def test_the_image_shows_of_what_kind_the_axis_is(modulo: bool, servo: bool) -> None:
    """Every axis has a modulo view; a modulo axis is one whose description says so."""
    keys: dict[str, Any] = {"modulo": {"period": 360.0}} if modulo else {}
    keys |= {"drive": {"kind": "servo", "position_gain": 50.0}} if servo else {}
    rig = Rig(**keys)
    rig.cycle(3)
    status = rig.ref.ReadStatus()
    assert (status.Modulo, status.SimulationAxis) == (modulo, not servo)
    assert rig.ref.axis.config.modulo.period == 360.0


def test_the_image_shows_set_and_actual_value_of_one_tick() -> None:
    rig = Rig()
    move = MC_MoveVelocity(rig.ref)
    seen: list[tuple[float, float, float]] = []

    def calls() -> None:
        move(Execute=True, Velocity=100.0)
        image = rig.ref.NcToPlc
        seen.append((image.SetPos - rig.ref.axis.set_position, image.ActPos - image.SetPos, image.PosDiff))

    rig.cycle(200, calls)
    assert set(seen) == {(0.0, 0.0, 0.0)}


def test_a_status_knows_its_names_and_no_others() -> None:
    status = ST_AxisStatus(flags=StateDWord.HasJob, op_mode=OpModeDWord.Modulo)
    assert (status.HasJob, status.Homed, status.Modulo, status.LoopMode) == (True, False, True, False)
    with pytest.raises(AttributeError, match="ST_AxisStatus has no field Hased"):
        _ = status.Hased
    with pytest.raises(AttributeError, match="no field SetPoss; there are StateDWord"):
        _ = Rig().ref.NcToPlc.SetPoss


def test_axes_images_and_blocks_show_what_a_debugger_asks_for() -> None:
    rig = Rig()
    move = MC_MoveAbsolute(rig.ref)
    rig.cycle(2, lambda: move(Execute=True, Position=20.0, Velocity=100.0))
    assert repr(rig.ref) == "<AXIS_REF X>"
    shown = "Axis=<AXIS_REF X> Execute=True Position=20.0 Velocity=100.0 Busy=True Active=True"
    assert repr(move) == f"<MC_MoveAbsolute {shown}>"
    image = repr(rig.ref.NcToPlc)
    assert "TargetPos=20.0" in image
    assert "ActTorque" not in image  # 0, as much else
    assert "TargetPos" in dir(rig.ref.NcToPlc)
    move.Options.BlendingPosition = 3.0
    assert "BlendingPosition=3.0" in repr(move)


def test_names_of_axes_that_do_not_exist_are_told() -> None:
    with pytest.raises(KeyError, match="no axis 'x'; this machine has X, Y"):
        _ = Rig(2).run.axis_refs["x"]


def test_looking_changes_no_bit_of_the_run() -> None:
    hashes = []
    for looks in (False, True):
        run = Simulation(machine())
        ref: AXIS_REF | None = run.axis_refs["X"] if looks else None

        def main(run: Any, ref: AXIS_REF | None = ref) -> None:
            if run.tick == 0:
                run.axes["X"].enable()
            elif run.tick == 5:
                run.axes["X"].move_absolute(50.0)
            if ref is not None:
                assert ref.ReadStatus().MotionState is not AxisState.UNDEFINED

        run.cyclic(main)
        run.step(400)
        hashes.append(run.trace.hash)
    assert hashes[0] == hashes[1]


def test_blocks_and_images_go_back_with_a_snapshot() -> None:
    run = Simulation(machine())
    ref = run.axis_refs["X"]

    def main(run: Any, memory: Any) -> None:
        if run.tick == 0:
            memory.power, memory.move = MC_Power(ref), MC_MoveAbsolute(ref)
        memory.power(Enable=True, Enable_Positive=True, Enable_Negative=True)
        memory.move(Execute=memory.power.Status, Position=100.0, Velocity=200.0)

    program = run.cyclic(main)
    run.step(100)
    snapshot = run.snapshot()

    def seen() -> tuple[Any, ...]:
        run.step(200)
        move, image = program.memory.move, ref.NcToPlc
        return move.Busy, move.Done, image.SetPos, image.ActVelo, image.StateDWord

    first = seen()
    run.step(500)
    assert program.memory.move.Done
    run.restore(snapshot)
    assert seen() == first
