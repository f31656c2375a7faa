"""Namespaces that control programs declare themselves: the same rules as those that are built in (motion-layer 5)."""

import enum
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer import Machine, Simulation
from motionlayer.command import ErrorId
from motionlayer.event import Device, Level, Subdevice
from motionlayer.iec import UINT, USINT, Enumeration, Field, Struct
from motionlayer.layer import (
    JobTable,
    LayerError,
    Namespace,
    Progress,
    Schedule,
    after,
)
from tests.effort import examples
from tests.layer.message_runs import opened
from tests.layer.tanks import E_TANK_CTRL, JOBS, TANK, Command, TankCtrl, TankState, codes, tank, told

P = Progress


def test_the_answer_comes_in_the_same_cycle_and_each_progress_a_cycle_after_its_call() -> None:
    run, one = tank()
    assert codes(run, one, 2) == [10000, 10000]
    one.ctrl.cmd = Command.FILL
    assert codes(run, one, 3) == [1030, 2030, 2030]
    one.ctrl.level = 1.0
    # The condition holds in the first of these cycles, and is shown in the next one; then 5 ms.
    assert codes(run, one, 8) == [2030, *[5030] * 5, 10030, 10030]


def test_a_command_is_repeated_by_way_of_null() -> None:
    run, one = tank()
    for _ in range(2):
        one.ctrl.cmd = Command.EMPTY
        assert codes(run, one, 3) == [1031, 1031, 10031]
        one.ctrl.cmd = Command.EMPTY
        assert codes(run, one, 2) == [10031, 10031]
        one.ctrl.cmd = Command.NULL
        assert codes(run, one, 1) == [10000]


def test_an_exception_ends_the_job_and_nothing_else() -> None:
    run, one = tank()
    one.ctrl.cmd = Command.BROKEN
    assert codes(run, one, 3) == [1033, 9033, 9033]
    assert one.state.view.error_id == ErrorId.PROGRAM_FAILED
    *_, failed, shown = told(run)
    assert failed[:2] == (Level.ERROR, ErrorId.PROGRAM_FAILED)
    assert failed[2].startswith("TANK_BROKEN: ZeroDivisionError: float division by zero (tanks.py:")
    assert failed[2].endswith(" in divide)")
    assert shown == (Level.ERROR, ErrorId.PROGRAM_FAILED, "TANK_BROKEN: PROGRESS_ERROR")
    one.ctrl.level, one.ctrl.cmd = 1.0, Command.NULL
    run.step()
    one.ctrl.cmd = Command.BROKEN
    assert codes(run, one, 2) == [1033, 10033]


@pytest.mark.parametrize("before", [Command.NULL, Command.FAIL])
def test_an_exception_of_the_preparation_is_answered_in_the_same_cycle(before: Command) -> None:
    run, one = tank()
    one.ctrl.cmd = before
    run.step(5)
    one.ctrl.cmd = Command.UNPREPARED
    assert codes(run, one, 3) == [9039, 9039, 9039]
    assert one.state.view.error_id == ErrorId.PROGRAM_FAILED
    one.ctrl.level, one.ctrl.cmd = 1.0, Command.NULL
    run.step()
    one.ctrl.cmd = Command.UNPREPARED
    assert codes(run, one, 2) == [1039, 10039]


@pytest.mark.parametrize("name", ["", "1T", "GVL TANK", "GVL_AXIS.Ctrl", "GVL_TÄNK"])
def test_the_name_of_a_namespace_is_one_identifier(name: str) -> None:
    with pytest.raises(ValueError, match=r"letters, digits and underscores"):
        Namespace(name, TankCtrl, TankState, JOBS)


def test_another_command_takes_the_place_of_one_that_is_under_way() -> None:
    run, one = tank()
    one.ctrl.cmd = Command.FILL
    codes(run, one, 5)
    one.ctrl.cmd = Command.EMPTY
    assert codes(run, one, 3) == [1031, 1031, 10031]


def test_an_error_shows_its_number_until_the_next_command() -> None:
    run, one = tank()
    one.ctrl.cmd = Command.FAIL
    assert codes(run, one, 3) == [1032, 9032, 9032]
    assert one.state.view.error_id == one.state.error_id == 7
    one.ctrl.cmd = Command.EMPTY
    codes(run, one, 1)
    assert one.state.view.error_id == 0


@pytest.mark.parametrize(("command", "code"), [(Command.LATER, 140), (77, 9077), (999, 9999), (1000, 9000)])
def test_what_does_not_exist_is_answered_as_by_an_axis(command: int, code: int) -> None:
    run, one = tank()
    one.ctrl.cmd = command
    assert codes(run, one, 2) == [code, code]
    assert one.state.view.error_id == ErrorId.FUNCTION_UNSUPPORTED


def test_every_progress_is_a_line() -> None:
    run, one = tank()
    one.ctrl.cmd, one.ctrl.level = Command.FILL, 1.0
    run.step(20)
    one.ctrl.cmd = Command.FAIL
    run.step(3)
    one.ctrl.cmd = Command.LATER
    run.step()
    one.ctrl.cmd = 77
    run.step()
    assert told(run) == [
        (Level.INFO, 30, "TANK_FILL: PROGRESS_INIT"),
        (Level.INFO, 30, "TANK_FILL: PROGRESS_CHECK"),
        (Level.INFO, 30, "TANK_FILL: PROGRESS_DONE"),
        (Level.INFO, 32, "TANK_FAIL: PROGRESS_INIT"),
        (Level.ERROR, 7, "TANK_FAIL: PROGRESS_ERROR"),
        (Level.INFO, 40, "TANK_LATER: PROGRESS_NOT_EXIST"),
        (Level.ERROR, 77, "77: PROGRESS_INVALID"),
        (Level.ERROR, ErrorId.FUNCTION_UNSUPPORTED, "77: PROGRESS_ERROR"),
    ]


def test_a_short_command_is_told_each_time() -> None:
    run, one = tank()
    for command in (Command.FAIL, Command.NULL, Command.FAIL):
        one.ctrl.cmd = command
        run.step(3)
    assert [text for _, _, text in told(run)] == [
        "TANK_FAIL: PROGRESS_INIT",
        "TANK_FAIL: PROGRESS_ERROR",
        "TANK_NULL: PROGRESS_DONE",
        "TANK_FAIL: PROGRESS_INIT",
        "TANK_FAIL: PROGRESS_ERROR",
    ]


def test_it_can_be_awaited() -> None:
    run, one = tank()
    found: list[Any] = []

    async def program() -> None:
        one.ctrl.cmd = Command.EMPTY
        found.append(await one.state.done(Command.EMPTY))
        one.ctrl.cmd = Command.FAIL
        with pytest.raises(LayerError, match=r"GVL_TANK: FAIL: the state is 9032, PROGRESS_ERROR; error 0x0007"):
            await one.state.done(Command.FAIL)

    run.run(program())
    assert found == [10031]


def test_objects_of_an_array_are_alone() -> None:
    run = opened(layer={"test": True})
    many = Namespace("GVL_TANK", TankCtrl, TankState, JOBS, source="Brewery", device=Device.Application)
    tanks = run.namespaces.add_array(many, ["north", "south"])
    run.step()
    tanks["south"].ctrl.cmd = Command.FAIL
    run.step(2)
    assert [one.state.code for one in tanks] == [10000, 9032]
    assert run.symbols.read("GVL_TANK.State[2].eState") == 9032
    (first, *_) = (event for event in run.events.last() if event.source == "Brewery")
    assert (first.device, first.subdevice) == (Device.Application + 2, Subdevice.General)


def test_a_schedule_says_when_commands_are_seen() -> None:
    run, one = tank(schedule=Schedule(10, phase=3))
    run.step(20)
    one.ctrl.cmd = Command.EMPTY
    assert codes(run, one, 15) == [*[10000] * 3, *[1031] * 10, *[1031] * 2]
    assert codes(run, one, 10)[-1] == 10031


def test_its_symbols_are_those_of_the_run() -> None:
    run, one = tank()
    run.symbols.write("gvl_tank.ctrl.ecmd", Command.EMPTY, by="client")
    run.step(3)
    assert one.ctrl.cmd is Command.EMPTY
    assert run.symbols.read("GVL_TANK.State.eState") == 10031
    assert run.symbols.find("GVL_TANK.Ctrl.eCmd").type is E_TANK_CTRL


def test_a_mapped_command_belongs_to_its_image() -> None:
    run, one = tank(mapped=True)
    run.step()
    with pytest.raises(PermissionError, match=r"GVL_TANK\.Ctrl belongs to the image GVL_TANK_in\.Ctrl"):
        one.ctrl.cmd = Command.EMPTY
    assert one.ctrl.cmd == Command.NULL
    run.areas["GVL_TANK_in.Ctrl"].post(bytes(TankCtrl(cmd=Command.EMPTY)))
    run.step(3)
    assert TankState.from_bytes(run.areas["GVL_TANK_out.State"].read()).state == 10031


def test_it_goes_back_with_the_run() -> None:
    run, one = tank()
    run.step()
    one.ctrl.cmd = Command.FILL
    run.step(3)
    one.ctrl.level = 1.0
    before = run.snapshot()
    first = codes(run, one, 10)
    run.restore(before)
    assert one.state.code == 2030
    assert codes(run, one, 10) == first


def test_a_control_side_has_them_too() -> None:
    run = Simulation(Machine.from_dict({"format": 1, "name": "plc", "control": {"axes": ["X"]}}))
    one = run.namespaces.add(TANK)
    one.ctrl.cmd = Command.EMPTY
    assert codes(run, one, 3) == [1031, 1031, 10031]


@settings(max_examples=examples(40), deadline=None)
@given(st.lists(st.tuples(st.sampled_from([0, 30, 31, 32, 33, 40, 77]), st.integers(1, 9)), max_size=12))
def test_the_state_always_speaks_of_the_command_of_the_same_cycle(dropped: list[tuple[int, int]]) -> None:
    run, one = tank()
    run.step()
    before = 0
    for command, ticks in dropped:
        one.ctrl.cmd = command
        seen = codes(run, one, ticks)
        assert all(one % 1000 - (100 if command == 40 else 0) == command for one in seen)
        if command != before and command in JOBS:
            assert seen[0] == command + P.INIT
        before = command


# -- declarations that mean nothing ------------------------------------------------------------------------------------


class Bare(Struct, iec="ST_BARE"):
    number = Field("nNumber", UINT)


class Narrow(Struct, iec="ST_NARROW"):
    state = Field("eState", USINT)


class Far(enum.IntEnum):
    NULL = 0
    FAR = 1000


class Zeroless(enum.IntEnum):
    GO = 1


class FarCtrl(Struct, iec="ST_FAR_CTRL"):
    cmd = Field("eCmd", Enumeration("E_FAR", UINT, Far))


class ZerolessCtrl(Struct, iec="ST_ZEROLESS_CTRL"):
    cmd = Field("eCmd", Enumeration("E_ZEROLESS", UINT, Zeroless))


@pytest.mark.parametrize(
    ("ctrl", "state", "jobs", "error", "text"),
    [
        (Bare, TankState, {}, TypeError, "GVL_TANK: Bare needs a member `cmd` of an Enumeration"),
        (TankCtrl, Bare, {}, TypeError, "GVL_TANK: Bare needs a member `state` of 16 bits or more, as UINT"),
        (TankCtrl, Narrow, {}, TypeError, "GVL_TANK: Narrow needs a member `state` of 16 bits or more, as UINT"),
        (
            FarCtrl,
            TankState,
            {},
            ValueError,
            "GVL_TANK: FAR = 1000, allowed: 0 to 999, so that a state tells command and progress",
        ),
        (
            ZerolessCtrl,
            TankState,
            {},
            ValueError,
            "GVL_TANK: E_ZEROLESS needs a member 0 that is no command, as NULL = 0",
        ),
        (
            TankCtrl,
            TankState,
            {34: JOBS[30]},
            ValueError,
            "GVL_TANK: there is a job for 34, which is no command of E_TANK_CTRL",
        ),
    ],
)
def test_a_declaration_that_means_nothing_is_refused(
    ctrl: type[Struct], state: type[Struct], jobs: dict[int, JobTable[Any]], error: type[Exception], text: str
) -> None:
    with pytest.raises(error) as caught:
        Namespace("GVL_TANK", ctrl, state, jobs)
    assert str(caught.value) == text


def test_it_is_declared_once_and_before_the_end_of_the_first_tick() -> None:
    run, _ = tank()
    with pytest.raises(ValueError, match="namespace GVL_TANK: there is one already"):
        run.namespaces.add(TANK)
    with pytest.raises(ValueError, match=r"names \['a', 'a'\]: give at least one, and none twice"):
        run.namespaces.add_array(Namespace("GVL_MORE", TankCtrl, TankState, JOBS), ["a", "a"])
    run.step()
    with pytest.raises(RuntimeError, match="namespace GVL_MORE: declare it before the end of the first tick"):
        run.namespaces.add(Namespace("GVL_MORE", TankCtrl, TankState, JOBS))
    with pytest.raises(KeyError, match=r"no namespace 'GVL_TNK'; this run has GVL_TANK"):
        run.namespaces["GVL_TNK"]


@pytest.mark.parametrize("seconds", [-0.1, float("nan"), float("inf")])
def test_a_time_that_never_comes_is_refused(seconds: float) -> None:
    with pytest.raises(ValueError, match=r"after\(.*\): must be a finite time from 0 on \(s\)"):
        after(seconds)
