"""The life of an Execute block: the table of phases, and the rules of PLCopen under random calls."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer import fb
from motionlayer.bench.campaign._observer import Observer
from motionlayer.command import Command, ErrorId, MotionError
from motionlayer.fb import MC_Jog, MC_MoveAbsolute
from motionlayer.fb._block import Built, ExecuteBlock
from motionlayer.fb._inputs import lreal
from motionlayer.fb._phase import NEXT, Phase

from .rig import Rig


class Issuing(ExecuteBlock):
    """A block whose commands the test ends as it likes."""

    Position = lreal(0.0, "target, u")

    def __init__(self) -> None:
        super().__init__()
        self.issued: list[Command[Any]] = []
        self.latched: list[float] = []
        self.refuse: ErrorId | None = None

    def _issue(self) -> Command[Any]:
        if self.refuse is not None:
            refused: Command[Any] = Command("test")
            refused.fail(MotionError(self.refuse, "X"))
            return refused
        self.latched.append(self.Position)
        self.issued.append(Command("test"))
        return self.issued[-1]


def outputs(block: ExecuteBlock) -> tuple[bool, bool, bool, bool, bool, int]:
    return block.Busy, block.Active, block.Done, block.CommandAborted, block.Error, block.ErrorID


IDLE = (False, False, False, False, False, 0)
BUSY = (True, False, False, False, False, 0)
DONE = (False, False, True, False, False, 0)


def test_done_is_shown_as_long_as_execute() -> None:
    block = Issuing()
    block(Execute=True)
    assert outputs(block) == BUSY
    block.issued[0].activate()
    block()
    assert outputs(block) == (True, True, False, False, False, 0)
    block.issued[0].finish(None)
    for _ in range(3):
        block()
        assert outputs(block) == DONE
    block(Execute=False)
    assert outputs(block) == IDLE


def test_what_ends_after_the_falling_edge_is_shown_in_one_call() -> None:
    block = Issuing()
    block(Execute=True)
    block(Execute=False)
    assert outputs(block) == BUSY
    block.issued[0].abort()
    block()
    assert outputs(block) == (False, False, False, True, False, 0)
    block()
    assert outputs(block) == IDLE


def test_an_edge_while_busy_is_ignored() -> None:
    block = Issuing()
    for execute in (True, False, True, False, True):
        block(Execute=execute, Position=float(len(block.issued)))
    assert len(block.issued) == 1
    assert block.latched == [0.0]


def test_an_edge_in_the_call_that_shows_the_end_is_swallowed() -> None:
    block = Issuing()
    block(Execute=True)
    block(Execute=False)
    block.issued[0].finish(None)
    block(Execute=True)
    assert outputs(block) == DONE
    block()
    assert outputs(block) == DONE
    assert len(block.issued) == 1


def test_an_edge_right_after_starts_anew() -> None:
    block = Issuing()
    block(Execute=True)
    block(Execute=False)
    block.issued[0].finish(None)
    block()
    block(Execute=True)
    assert outputs(block) == BUSY
    assert len(block.issued) == 2


def test_a_refused_command_is_an_error_in_the_same_call() -> None:
    block = Issuing()
    block.refuse = ErrorId.VELOCITY
    block(Execute=True)
    assert outputs(block) == (False, False, False, False, True, 0x4221)
    block(Execute=False)
    assert outputs(block) == IDLE


def test_inputs_keep_their_values() -> None:
    block = Issuing()
    block(Position=7.0)
    block(Execute=True)
    assert block.latched == [7.0]


def test_an_unknown_input_is_named_and_nothing_taken() -> None:
    block = Issuing()
    with pytest.raises(TypeError, match=r"Issuing has no input Positon; did you mean Position\?"):
        block(Execute=True, Positon=3.0)
    assert not block.Execute
    assert not block.issued


@pytest.mark.parametrize("before", Phase)
@pytest.mark.parametrize("after", Phase)
def test_no_phase_follows_that_the_table_does_not_name(before: Phase, after: Phase) -> None:
    block = Issuing()
    block._phase = before
    if after in NEXT[before]:
        block._enter(after)
    else:
        with pytest.raises(AssertionError):
            block._enter(after)


def test_inputs_stand_in_the_order_of_the_interface() -> None:
    assert list(MC_MoveAbsolute.INPUTS)[:4] == ["Axis", "Execute", "Position", "Velocity"]
    assert list(MC_Jog.INPUTS)[:3] == ["Axis", "JogForward", "JogBackwards"]


def end(command: Command[Any], act: str) -> None:
    match act:
        case "activate":
            command.activate()
        case "done":
            command.finish(None)
        case "abort":
            command.abort()
        case _:
            command.fail(MotionError(ErrorId.LAG, "X"))


acts = st.sampled_from(["high", "low", "activate", "done", "abort", "fail", "refuse", "accept"])


@given(st.lists(acts, max_size=80))
def test_the_rules_hold_under_random_calls(sequence: list[str]) -> None:
    block, observer = Issuing(), Observer()
    for act in sequence:
        command = block.issued[-1] if block.issued and block.issued[-1].busy else None
        if act in ("high", "low"):
            block.Execute = act == "high"
        elif act in ("refuse", "accept"):
            block.refuse = ErrorId.NOT_ENABLED if act == "refuse" else None
        elif command is not None:
            end(command, act)
        block()
        observer.look(block)
    assert len(block.issued) == len(block.latched)


@pytest.mark.parametrize(
    ("name", "hint"),
    [("Positon", r"did you mean Position\?"), ("Zzz", "it has Execute, Position"), ("_phse", "it has")],
)
def test_an_attribute_that_there_is_not_cannot_be_set(name: str, hint: str) -> None:
    block = Issuing()
    with pytest.raises(AttributeError, match=f"Issuing has no input {name}; {hint}"):
        setattr(block, name, 1.0)
    assert not hasattr(block, name)
    block.Position, block.refuse = 2.0, None
    assert block.Position == 2.0


@pytest.mark.parametrize("name", [name for name in fb.__all__ if name != "Block" and isinstance(vars(fb)[name], Built)])
def test_no_block_takes_a_misspelt_input(name: str) -> None:
    """Nor in the calls of a run: whatever a block keeps, it has from the beginning."""
    rig = Rig()
    kind = getattr(fb, name)
    block = kind(*{"MC_OverrideFilter": [rig.run], "MC_CalcDynamicsByRampTime": []}.get(name, [rig.ref]))
    before = set(vars(block))
    rig.cycle(3, block)
    rig.cycle(3, lambda: block(**{one: True for one in ("Execute", "Enable") if one in block.INPUTS}))
    assert set(vars(block)) == before
    with pytest.raises(AttributeError, match=f"{name} has no input Exekute"):
        block.Exekute = True
