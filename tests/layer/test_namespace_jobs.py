"""Conditions and actions are the user's code: who writes and who has failed is told by the name of the object."""

from typing import Any

import pytest

from motionlayer.event import Device, Level, Subdevice
from motionlayer.layer import AxisCommand, JobTable, Namespace, Progress, Transition, always
from motionlayer.runtime import ProgramStuck
from tests.layer.message_runs import opened
from tests.layer.tanks import Command, TankCtrl, TankState, codes, tank

P = Progress


def plant(action: Any, names: tuple[str, ...] = (), **options: Any) -> Any:
    """Return a run, and the objects of a namespace whose command does something; one without names."""
    run = opened(layer={"test": True}, **options)
    table = JobTable[Any]("EMPTY", [Transition(P.INIT, always, lambda job: action(run, job), P.DONE)])
    declared = Namespace("GVL_PLANT", TankCtrl, TankState, {Command.EMPTY: table}, device=Device.Application)
    if names:
        return run, list(run.namespaces.add_array(declared, names))
    return run, run.namespaces.add(declared)


def test_two_writers_of_a_command_are_told_by_their_names() -> None:
    def enable(run: Any, _job: Any) -> None:
        run.layer.axis[1].ctrl.cmd = AxisCommand.ENABLE

    run, (north, _) = plant(enable, ("north", "south"))
    run.step(50)

    def supervisor(_run: object) -> None:
        run.layer.axis[1].ctrl.cmd = AxisCommand.HALT

    north.ctrl.cmd = Command.EMPTY
    run.cyclic(supervisor)
    run.step(2)
    told = [event.text for event in run.events.last(Level.WARNING)]
    both = "program supervisor and program GVL_PLANT[1] write it in the same tick; the last one counts"
    assert told == [f"GVL_AXIS.Ctrl[1]: {both}"]


def test_a_failure_is_one_of_the_run_told_once() -> None:
    run, one = tank()
    for command in (Command.BROKEN, Command.NULL, Command.BROKEN):
        one.ctrl.cmd = command
        run.step(2)
    (failure,) = run.failures
    assert failure.name == "GVL_TANK"
    assert isinstance(failure.failure, ZeroDivisionError)


def test_it_cannot_run_ticks_itself() -> None:
    run, one = plant(lambda run, _job: run.step())
    one.ctrl.cmd = Command.EMPTY
    assert codes(run, one, 2) == [1031, 9031]
    (failure,) = run.failures
    assert str(failure.failure).startswith("a program cannot run ticks itself")


def test_a_wait_that_does_nothing_is_told_with_its_line() -> None:
    def forget(run: Any, _job: Any) -> None:
        run.sleep(1.0)

    run, one = plant(forget)
    one.ctrl.cmd = Command.EMPTY
    run.step(2)
    (told,) = (event for event in run.events.last(Level.WARNING) if event.subdevice == Subdevice.General)
    assert told.source == "program GVL_PLANT"
    assert "is not awaited, so it does nothing: a job cannot wait; let a condition of its table hold later" in told.text
    assert "test_namespace_jobs.py" in told.text


def test_what_it_commands_is_its_own() -> None:
    found: list[Any] = []

    def enable(run: Any, _job: Any) -> None:
        found.append(run.axes["X"].enable())

    run, one = plant(enable)
    one.ctrl.cmd = Command.EMPTY
    run.step(2)
    (command,) = found
    assert command.owner.name == "GVL_PLANT"
    assert run.axes["X"].enabled


def test_a_job_that_does_not_return_is_named_by_the_watchdog() -> None:
    run, one = plant(lambda _run, _job: hang(), patience=0.2)
    one.ctrl.cmd = Command.EMPTY
    with pytest.raises(ProgramStuck, match=r"program GVL_PLANT has not yielded for .* in tick 0"):
        run.run(time=0.01)


def hang() -> None:
    while True:
        pass


def test_a_run_without_failures_has_none() -> None:
    run, one = tank()
    one.ctrl.cmd = Command.FAIL  # ends in error by its table, which is no failure of the program
    run.step(3)
    assert run.failures == []
