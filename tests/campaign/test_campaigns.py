"""The short form of every campaign, and that each of them would notice."""

import json
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from motionlayer import Command, Machine, Simulation
from motionlayer._kernel import MODE
from motionlayer.bench.campaign import CAMPAIGNS, _life, _mutation, _planning, repeat
from motionlayer.bench.campaign._acts import CALLS, Act, from_data
from motionlayer.bench.campaign._calls import MOVING, OTHER, call
from motionlayer.bench.campaign._damage import Damage, resample
from motionlayer.bench.campaign._life import Life, life, live, violations
from motionlayer.bench.campaign._mutation import BATCH, OPERATORS, missed, mutation
from motionlayer.bench.campaign._problems import BLOCK, FAMILIES, KINDS, Problem, problems
from motionlayer.event import Kind
from motionlayer.nc import Axis, BufferMode
from motionlayer.profile import Profile
from motionlayer.record import Trace
from tests.effort import examples, quick, thinned

Operator = Callable[[np.random.Generator, Trace], Damage | None]
SEED = 1
SLOW = MODE == "plain"
SHORT = {
    "planning": BLOCK // 20 if SLOW else examples(4 * BLOCK),
    "life": 2 if SLOW else 5 if quick() else 40,
    "blocks": 1 if SLOW or quick() else 3,
    "contract": 1 if SLOW else 2 if quick() else 20,
    "mutation": 5 if SLOW else examples(4 * BATCH),
    "ads": examples(200),
    "siege": examples(10),
}


@pytest.mark.parametrize("name", thinned(CAMPAIGNS, 3))
def test_the_short_form_finds_nothing(name: str) -> None:
    campaign = CAMPAIGNS[name]
    for start in range(0, SHORT[name], campaign.batch):
        assert campaign.run(SEED, range(start, min(start + campaign.batch, SHORT[name]))) == []


@pytest.mark.parametrize(
    ("name", "case"),
    [("planning", 1234), ("life", 5), ("blocks", 7), ("contract", 3), ("mutation", 57), ("ads", 3), ("siege", 3)],
)
def test_a_case_is_made_from_seed_and_number_alone(name: str, case: int) -> None:
    campaign = CAMPAIGNS[name]
    text = campaign.describe(SEED, case)
    campaign.describe(SEED, case + 1)
    assert campaign.describe(SEED, case) == text
    assert campaign.describe(SEED + 1, case) != text
    assert campaign.describe(SEED, case + 1) != text


def test_planning_draws_every_family_and_kind() -> None:
    block = problems(SEED, 0)
    assert len(block) == BLOCK
    assert {problem.kind for problem in block} == set(KINDS)
    integers = [problem for problem in block if all(value == int(value) for value in problem.limits)]
    assert len(integers) == BLOCK // len(FAMILIES)
    assert any(abs(problem.v) > problem.limits.velocity for problem in block)
    assert max(problem.limits.jerk for problem in block[:: len(FAMILIES)]) <= 1e9


def test_a_planning_failure_can_be_pasted(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(_problem: Problem) -> Profile:
        raise ArithmeticError("out of order")

    monkeypatch.setattr(Problem, "plan", fails)
    (failure,) = repeat(CAMPAIGNS["planning"], SEED, 3)
    assert failure.case == 3
    assert "out of order" in failure.text
    call = failure.text.splitlines()[-1]
    assert call == _planning.describe(SEED, 3)
    assert call.startswith("plan_")


def test_a_life_that_breaks_a_rule_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """A jump of the set position that nobody planned."""
    plain = Axis.set_override

    def jumps(axis: Axis, factor: float) -> None:
        axis._store.table[0, axis._column] += 1.0
        plain(axis, factor)

    monkeypatch.setattr(Axis, "set_override", jumps)
    found = [failure for case in range(6) for failure in repeat(CAMPAIGNS["life"], SEED, case)]
    assert found


def test_an_exception_inside_is_a_failure_of_its_case(monkeypatch: pytest.MonkeyPatch) -> None:
    def breaks(*_: object) -> None:
        raise ZeroDivisionError("inside")

    monkeypatch.setattr(_life, "verify", breaks)
    (failure,) = repeat(CAMPAIGNS["life"], SEED, 4)
    assert failure.case == 4
    assert failure.text.splitlines()[-1] == "ZeroDivisionError: inside"


def test_a_command_that_says_what_its_events_do_not_is_found() -> None:
    trace, commands = live(life(SEED, 0))
    assert violations(trace, commands) == []
    done = next(command for command in commands if command.done)
    done.done = False
    assert any(f"command {done.number} " in fault for fault in violations(trace, commands))


def test_lives_hold_every_kind_of_end() -> None:
    kinds: set[Kind] = set()
    moved = 0
    for case in range(12):
        trace, _ = live(life(SEED, case))
        kinds |= {event.kind for event in trace.events}
        moved += sum(bool((trace[name] != 0.0).any()) for name in trace if name.endswith("set_velocity"))
    assert kinds == set(Kind)
    assert moved >= 12


def test_every_call_is_known() -> None:
    """And each gives a command, but for what is none."""
    run = Simulation(Machine.from_dict(life(SEED, 0).machine), trace=None)
    axis = next(iter(run.axes.values()))
    assert CALLS.keys() == MOVING.keys() | OTHER.keys() | {"override", "sweep"}
    for name in CALLS.keys() - {"sweep"}:
        act = Act(1, axis.name, name, 0.5, (1.0, 1.0, 1.0, 1.0), awaits=False, choice=1)
        given: Command[Any] | None = call(axis, act, (0.0, 1.0))
        assert (given is None) == (name in {"override", "fault"})


@pytest.mark.slow
def test_lives_hold_every_call() -> None:
    """Accepted, not only tried; in every buffer mode, and with every way to end a hold."""
    texts: set[str] = set()
    for case in range(60):
        texts |= {event.text for event in live(life(SEED, case))[0].events if event.kind == Kind.ACCEPTED}
    names = {text.partition("(")[0] for text in texts}
    calls = ("absolute", "relative", "additive", "modulo", "velocity", "continuous_absolute", "continuous_relative")
    assert names >= {f"move_{call}" for call in calls}
    assert names >= {"jog", "halt", "stop", "emergency_stop", "home", "define_position", "enable", "disable", "reset"}
    modes = {mode for mode in BufferMode if any(f"buffer_mode={mode.name}" in text for text in texts)}
    assert modes == set(BufferMode) - {BufferMode.ABORTING}
    assert any("blending_position=" in text for text in texts)


@cache
def some_traces() -> list[Trace]:
    return [live(life(SEED, case))[0] for case in range(36)]


@pytest.mark.parametrize("operator", OPERATORS, ids=lambda operator: operator.__name__)
def test_every_kind_of_damage_finds_a_place(operator: Operator) -> None:
    """And the text of each tells what was done."""
    drawn = [operator(np.random.default_rng(number), trace) for trace in some_traces() for number in range(3)]
    damages = [damage for damage in drawn if damage is not None]
    assert len(damages) > 5
    assert len({damage.text for damage in damages}) > 3
    assert {damage.axis for damage in damages} <= {f"A{number}" for number in range(4)}


def test_first_and_last_samples_are_changed_too() -> None:
    trace, _ = live(life(SEED, 0))
    ticks = {mutation(SEED, case, trace).tick for case in range(300)}
    assert {None, 0, len(trace.ticks) - 1} <= ticks


def test_a_change_that_is_not_found_is_a_failure() -> None:
    trace, _ = live(life(SEED, 0))
    (fault,) = missed(resample(trace, "A0.set_position", 7, 0.1))
    assert fault.startswith("not found: A0.set_position in row 7: 0.1 tolerances, from ")
    assert missed(Damage("another axis", resample(trace, "A0.set_position", 7, 100.0).trace, "A1")) != []
    assert missed(resample(trace, "A0.set_position", 7, 100.0)) == []


def test_a_trace_that_is_not_valid_before_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    def spoilt(case: _life.Life) -> tuple[Trace, list[Command[Any]]]:
        trace, commands = live(case)
        values = trace["A0.set_position"].copy()
        values[5] += 1.0
        return trace.replace({"A0.set_position": values}), commands

    monkeypatch.setattr(_mutation, "live", spoilt)
    (failure,) = repeat(CAMPAIGNS["mutation"], SEED, 3)
    assert "the trace itself (NAME=life CASE=0) is not valid" in failure.text


ONCE = sorted((Path(__file__).parent / "lives").glob("*.json"))


@pytest.mark.parametrize("file", thinned(ONCE, 3), ids=lambda file: file.stem)
def test_lives_that_broke_a_rule_once(file: Path) -> None:
    """Kept as they were, whatever the campaign draws now.

    A stop in homing past a limit, a halt of a turning move, a sliver of a piece, drives that come back by
    themselves, a swing on the way back from outside, a reset before the error, a drive at rest that is not
    heard for a while. Since moves are buffered: what follows a halt under override 0, a joint that an axis is too near
    to be slowed down for, a follower that is replaced in the first cycle it moves in, a reset while an axis in error
    brakes and waits for power, an enable that fails when the error is cleared, a position redefined in motion so that
    the software limit comes too near. Since goals, brakes and joints are judged: a jog to a multiple in the tick of a
    shift, a command that was replaced in the tick it became active in, an override that rises before an end velocity
    that could not be braked, a joint on the edge of what can be passed, a turn that comes back just as far, a way that
    begins with a sliver, a drive that is not heard from the beginning. A joint that cannot be rested before any more
    when the override changes, power that comes back while a brake runs, a homing and a shift in one tick, a shift
    behind a passed target, a target on a software limit, a start outside that begins with a sliver. An override that
    rises when a hold has carried the axis too near to a joint for its acceleration to be taken back, and
    one that changes in the tick in which an error ends a motion at rest. An override that rises before a joint behind
    which an end velocity could not be braked before the software limit. A position redefined at rest, an additive move
    and a shift of it in one tick. A shift before the turn behind which a joint is passed, whose place already lies
    behind the axis. A position redefined in the tick in which a homing has redefined it.
    """
    data = json.loads(file.read_text())
    assert violations(*live(Life(data["machine"], from_data(data["parts"])))) == []
