"""The campaign `contract` brings axes to every state, and finds a layer that does not keep its contract."""

from collections.abc import Callable
from typing import Any

import pytest

from motionlayer.bench.campaign import CAMPAIGNS, repeat
from motionlayer.bench.campaign._contract import contract, violations
from motionlayer.bench.campaign._contract_acts import STARTS, Act, Sequence
from motionlayer.bench.campaign._contract_oracle import judge
from motionlayer.bench.campaign._contract_play import SETTLING, Contract, play
from motionlayer.layer import (
    AXIS_JOBS,
    AxisCommand,
    Choice,
    JobTable,
    Progress,
    Transition,
    _axes,
    _buffer_jobs,
    _move_jobs,
    always,
)
from motionlayer.layer._axis import AxisController
from motionlayer.layer._axis_job import late, lost
from motionlayer.layer._buffer_jobs import POSITIONS
from motionlayer.layer._move_jobs import is_active, start_move
from motionlayer.nc import AxisState

SEED = 1
CASES = 4
Patch = pytest.MonkeyPatch
Change = Callable[[Patch], object]

REACHED = {
    "not initialised": AxisState.STANDSTILL,
    "Disabled": AxisState.DISABLED,
    "StandStill": AxisState.STANDSTILL,
    "ErrorStop": AxisState.ERRORSTOP,
    "Stopping": AxisState.STOPPING,
    "Homing": AxisState.HOMING,
    "DiscreteMotion": AxisState.DISCRETE_MOTION,
    "ContinuousMotion": AxisState.CONTINUOUS_MOTION,
}
AXIS: dict[str, Any] = {
    "max_velocity": 600.0,
    "max_acceleration": 60_000.0,
    "max_jerk": 1e7,
    "drive": {"kind": "servo", "position_gain": 100.0},
    "home": {"mode": "switch", "switch": -50.0, "velocity": 200.0, "position": 7.0},
}


@pytest.mark.parametrize("start", list(STARTS))
def test_every_state_is_reached(start: str) -> None:
    machine = {"format": 1, "name": "one", "axis": {"A1": AXIS}, "layer": {"timeout": 0.03}}
    case = Contract(machine, [[Sequence(start, 60.0, [])]], [])
    recording = play(case)
    assert violations(case, recording) == []
    assert REACHED[start] in recording.trace["A1.state"][-SETTLING - 3 : -SETTLING + 1]
    initialising = 1 in recording.state["state"][-SETTLING - 3 : -SETTLING, 0] % 1000
    assert initialising is (start == "not initialised")


def test_a_case_ends_where_the_start_up_stands_at_an_axis_that_nobody_initialises() -> None:
    """Seed 2719, case 271: the last client of the axis had ended before."""
    fault = {"axis": "A1", "kind": "drive_error", "time": 0.0, "duration": 1000.0}
    machine = {"format": 1, "name": "one", "axis": {"A1": AXIS}, "layer": {"timeout": 0.03}, "fault": [fault]}
    case = Contract(machine, [[]], [])
    assert violations(case, play(case)) == []


def test_a_change_that_is_taken_back_at_once_starts_the_next_motion_all_the_same() -> None:
    """Seed 3201, case 1463: the position is another for one cycle, the one before the job acts on it."""
    machine = {"format": 1, "name": "one", "axis": {"A1": AXIS}, "layer": {"timeout": 0.03}}
    position = "GVL_AXIS.Data[{}].rSetPos"
    acts = [
        Act(1, position, 50.0),
        Act(1, "GVL_AXIS.Ctrl[{}].eCmd", AxisCommand.MOVE_BUFFER),
        Act(20, position, 30.0),
        Act(20, position, -20.0),
        Act(1, position, 30.0),
        Act(100, "GVL_AXIS.Ctrl[{}].eProgress", Progress.DONE),
    ]
    case = Contract(machine, [[Sequence("StandStill", 0.0, acts)]], [])
    recording = play(case)
    assert sum("move_absolute(position=30.0" in one.text for one in recording.events) == 2
    assert violations(case, recording) == []


def test_a_case_repeats_bit_by_bit() -> None:
    first, second = (play(contract(SEED, 2)) for _ in range(2))
    assert first.trace.hash == second.trace.hash
    for name in ("ctrl", "data", "state", "info", "selector_state"):
        assert getattr(first, name).tobytes() == getattr(second, name).tobytes()


# -- layers that do not keep it ----------------------------------------------------------------------------------------


def null_halts(patch: Patch) -> None:
    plain = AxisController.choose

    def choose(controller: AxisController, command: int) -> Choice:
        if command == AxisCommand.NULL and controller.memory.axis.under_way:
            controller.memory.axis.halt()
        return plain(controller, command)

    patch.setattr(AxisController, "choose", choose)


def errors_stay(patch: Patch) -> None:
    plain = AxisController._flag
    patch.setattr(AxisController, "_flag", lambda controller, on=0, *, off=0: plain(controller, on, off=off & ~2))


def states_come_a_cycle_late(patch: Patch) -> None:
    plain = AxisController.publish
    waiting: dict[AxisController, tuple[int, Progress]] = {}

    def publish(controller: AxisController, state: int, result: Progress) -> None:
        plain(controller, *waiting.get(controller, (state, result)))
        waiting[controller] = state, result

    patch.setattr(AxisController, "publish", publish)


def unknown_commands_are_ignored(patch: Patch) -> None:
    plain = AxisController.choose

    def choose(controller: AxisController, command: int) -> Choice:
        known = command in AXIS_JOBS or command == AxisCommand.NULL
        return plain(controller, command) if known else Choice(Progress.DONE)

    patch.setattr(AxisController, "choose", choose)


def what_is_no_number_is_a_target(patch: Patch) -> None:
    for module in (_move_jobs, _buffer_jobs):
        patch.setattr(module, "target_of", lambda job: job.inputs.data.position)


def what_is_no_number_stays(patch: Patch) -> None:
    patch.setattr(_axes, "check_data", lambda *_: None)


def moves_are_done_when_they_begin(patch: Patch) -> None:
    rows = [
        Transition(Progress.INIT, always, start_move, Progress.OCCUPIED),
        Transition(Progress.OCCUPIED, is_active, lambda _job: None, Progress.DONE),
    ]
    patch.setitem(AXIS_JOBS, AxisCommand.MOVE_POS, JobTable("MOVE_POS", rows))


def never(_job: object) -> bool:
    return False


def without(*conditions: Callable[..., bool], of: AxisCommand) -> Change:
    """Return the change after which conditions of a job never hold."""

    def change(patch: Patch) -> None:
        table = AXIS_JOBS[of]
        rows = [row._replace(when=never) if row.when in conditions else row for row in table.rows]
        shows = {step: progress for step, progress in table.shown.items() if progress is not step}
        patch.setitem(AXIS_JOBS, of, JobTable(table.name, rows, shows=shows))

    return change


CHANGES: dict[str, Change] = {
    "NULL halts": null_halts,
    "errors stay": errors_stay,
    "states come a cycle late": states_come_a_cycle_late,
    "unknown commands are ignored": unknown_commands_are_ignored,
    "what is no number stays": what_is_no_number_stays,
    "what is no number is a target": what_is_no_number_is_a_target,
    "moves are done when they begin": moves_are_done_when_they_begin,
    "D6: enabling does not see what fails": without(lost, late, of=AxisCommand.ENABLE),
    "D11: no other position is taken up": without(POSITIONS.other_values, of=AxisCommand.MOVE_BUFFER),
}


LATER = ("NULL halts", "states come a cycle late", *(name for name in CHANGES if name.startswith("D")))
"""Those that take many lives to be found; the quick suite damages what was recorded instead (`test_oracle`)."""


@pytest.mark.parametrize(
    "change",
    [pytest.param(one, id=name, marks=[pytest.mark.slow] * (name in LATER)) for name, one in CHANGES.items()],
)
def test_a_layer_that_does_not_keep_its_contract_is_found(change: Change, monkeypatch: Patch) -> None:
    change(monkeypatch)
    assert any(repeat(CAMPAIGNS["contract"], SEED, case) for case in range(CASES))


def test_a_failure_shows_where_it_was_and_what_was_written() -> None:
    case = contract(SEED, 0)
    recording = play(case)
    state = recording.state.copy()
    state["state"][100, 3] += 1
    changed = recording._replace(state=state)
    fault = judge(changed)[0]
    (text, *_) = violations(case, changed)
    assert text.startswith(f"A4, tick 100: {fault.rule}")
    assert "State around it: [" in text
    assert str(case.lives[3][0].acts[0].symbol) in text
