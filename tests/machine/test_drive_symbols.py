"""Simulated drives fail by symbol, so that whoever is connected can try what happens then."""

from typing import Any

import pytest
from tests.machines import LINEAR

from motionlayer import AxisState, Machine, Simulation
from motionlayer.drive import Fault
from motionlayer.event import Level
from motionlayer.machine import DriveFault
from motionlayer.verify import assert_valid

SERVO: dict[str, Any] = LINEAR | {"drive": {"kind": "servo", "position_gain": 60.0}}


def moving() -> Simulation:
    """Return a run whose servo axis X moves, and whose Y has an ideal drive."""
    run = Simulation(
        Machine.from_dict({"format": 1, "name": "test", "axis": {"X": SERVO, "Y": LINEAR}, "layer": {}}), seed=1
    )
    run.axes["X"].enable()
    run.step(20)
    run.axes["X"].move_absolute(200.0)
    run.step(100)
    return run


def write(run: Simulation, member: str, value: object, axis: int = 1) -> None:
    run.symbols.write(f"GVL_SIMULATION.DriveFault[{axis}].{member}", value, by="client")


def warnings(run: Simulation) -> list[str]:
    return [event.text for event in run.events.last(Level.WARNING) if event.level is Level.WARNING]


def test_a_fault_comes_in_the_tick_after_it_was_asked_for_and_once() -> None:
    run = moving()
    write(run, "eFault", DriveFault.DRIVE_ERROR)
    run.step(2)
    assert run.axes["X"].state is AxisState.ERRORSTOP
    run.step(500)
    run.axes["X"].reset()
    run.step(500)
    assert run.axes["X"].error is None  # the symbol still holds the fault, but only a change is one
    write(run, "eFault", DriveFault.NONE)
    run.step()
    assert run.axes["X"].error is None
    assert_valid(run.trace)


@pytest.mark.parametrize("kind", [one for one in DriveFault if one is not DriveFault.NONE], ids=lambda one: one.name)
def test_a_symbol_does_what_inject_does(kind: DriveFault) -> None:
    by_symbol, by_call = moving(), moving()
    value = 3.0 if kind is DriveFault.ENCODER_JUMP else None
    duration = None if kind is DriveFault.ENCODER_JUMP else 0.05
    if value is not None:
        write(by_symbol, "rValue", value)
    if duration is not None:
        write(by_symbol, "rDuration", duration)
    write(by_symbol, "eFault", kind)
    by_call.inject("X", Fault(kind.name.lower(), value, duration), by_call.tick + 1)
    for run in (by_symbol, by_call):
        run.step(600)
    assert by_symbol.trace["X.actual_position"].tolist() == by_call.trace["X.actual_position"].tolist()
    assert_valid(by_symbol.trace)


def test_what_cannot_be_is_told_and_does_nothing() -> None:
    run = moving()
    write(run, "eFault", 9)
    run.step()
    write(run, "rValue", float("nan"))
    write(run, "eFault", DriveFault.ENCODER_JUMP)
    run.step()
    write(run, "eFault", DriveFault.BLOCKED, axis=2)
    run.step()
    assert warnings(run) == [
        (
            "GVL_SIMULATION.DriveFault[1]: eFault = 9, allowed: 0 (NONE), 1 (DRIVE_ERROR), 2 (ENCODER_JUMP), "
            "3 (LOST_ENABLE), 4 (LOST_COMMUNICATION), 5 (BLOCKED)"
        ),
        "GVL_SIMULATION.DriveFault[1]: fault encoder_jump: value = nan, must be a finite number",
        'GVL_SIMULATION.DriveFault[2]: the drive is ideal, and never has a fault; set kind = "servo"',
    ]
    run.step(500)
    assert run.axes["X"].set_position == 200.0


def test_a_fault_goes_back_with_the_run() -> None:
    run = moving()
    before = run.snapshot()
    for _ in range(2):
        write(run, "eFault", DriveFault.DRIVE_ERROR)
        run.step(2)
        assert run.axes["X"].state is AxisState.ERRORSTOP
        run.restore(before)
    run.step(500)
    assert run.axes["X"].error is None
