"""Every input of every block, from their tables: bad values, wrong types, and changes while the block is busy."""

import math
from typing import Any, Final

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer import fb
from motionlayer.bench.campaign._block_inputs import HUGE
from motionlayer.bench.campaign._observer import Observer
from motionlayer.command import ERRORS, ErrorId
from motionlayer.fb import MC_AxisParameter
from motionlayer.fb._block import ExecuteBlock
from motionlayer.nc import TRANSITIONS
from tests.effort import examples, thinned

from .rig import Rig

NAMES: Final = [name for name in fb.__all__ if name.startswith("MC_")]
BLOCKS: Final[dict[str, Any]] = {name: getattr(fb, name) for name in NAMES if isinstance(getattr(fb, name), type)}
EXECUTE: Final = {name: one for name, one in BLOCKS.items() if issubclass(one, ExecuteBlock)}
GOOD: Final = {"Velocity": 50.0, "EndVelocity": 20.0, "Position": 10.0, "Distance": 10.0, "ParameterNumber": 1004}
"""Inputs that a block needs so that nothing but the one under test is bad; `AxisAcc` for parameters."""

BAD: Final = (math.nan, math.inf, -math.inf, -1.0, 0.0, HUGE, -0.0)
REALS: Final = [
    (name, one) for name, block in EXECUTE.items() for one, entry in block.INPUTS.items() if entry.type == "LREAL"
]
ENUMS: Final = [
    (name, one)
    for name, block in EXECUTE.items()
    for one, entry in block.INPUTS.items()
    if entry.type.startswith("MC_")
]
NO_MEMBERS: Final = [
    (name, one, bad)
    for name, one in ENUMS
    for bad in (-1, 6, 77, 2**31)
    if not (one == "ParameterNumber" and bad == MC_AxisParameter.EnablePosLagMonitoring)
]
"""What an enumeration does not have."""


def started(rig: Rig, name: str, **inputs: Any) -> Any:
    """Start a block with inputs that are good but for those given; return it after two calls."""
    block = BLOCKS[name](rig.ref)
    good = {one: value for one, value in GOOD.items() if one in block.INPUTS}
    observer = Observer(endless=True)
    rig.cycle(2, lambda: block(Execute=True, **(good | inputs)), lambda: observer.look(block))
    return block


@pytest.mark.parametrize(("name", "one"), REALS)
def test_a_number_that_is_none_is_refused_and_changes_nothing(name: str, one: str) -> None:
    for bad in (math.nan, math.inf, -math.inf):
        rig = Rig()
        before = (rig.ref.axis.state, rig.ref.axis.config, rig.ref.axis.command)
        block = started(rig, name, **{one: bad})
        if bad == -math.inf and one in ("Deceleration", "Jerk") and name in ("MC_Halt", "MC_Stop"):
            assert not block.Error, "0 and less ask for those of the running command"
            continue
        assert block.Error, (name, one, bad)
        assert ErrorId(block.ErrorID) in ERRORS
        assert (rig.ref.axis.state, rig.ref.axis.config, rig.ref.axis.command) == before


@pytest.mark.parametrize(("name", "one", "bad"), NO_MEMBERS)
def test_a_member_that_does_not_exist_is_refused(name: str, one: str, bad: int) -> None:
    rig = Rig()
    block = started(rig, name, **{one: bad})
    assert block.Error
    assert ErrorId(block.ErrorID) in ERRORS


@pytest.mark.parametrize("name", EXECUTE)
def test_wrong_types_raise_and_say_which(name: str) -> None:
    rig = Rig()
    for one, entry in EXECUTE[name].INPUTS.items():
        if entry.type == "BOOL" or entry.type.startswith("ST_"):
            continue
        with pytest.raises(TypeError, match=r"must be|give|is not of"):
            started(rig, name, **{one: "fast"})


@settings(max_examples=examples(150), deadline=None)
@given(st.sampled_from(sorted(EXECUTE)), st.data())
def test_random_bad_inputs_end_in_a_known_way(name: str, data: st.DataObject) -> None:
    inputs = {}
    for one, entry in EXECUTE[name].INPUTS.items():
        if entry.type == "LREAL" and data.draw(st.booleans()):
            inputs[one] = data.draw(st.one_of(st.sampled_from(BAD), st.floats(1e-3, 1e9)))
        elif entry.type.startswith(("MC_", "E_")) and data.draw(st.booleans()):
            inputs[one] = data.draw(st.integers(-2, 200))
    rig = Rig()
    block = started(rig, name, **inputs)
    assert block.Error or block.Busy or block.Done
    assert rig.ref.axis.state in TRANSITIONS
    rig.check()


@pytest.mark.parametrize("name", sorted(EXECUTE))
def test_inputs_that_change_while_the_block_is_busy_mean_nothing(name: str) -> None:
    hashes = []
    for changes in (False, True):
        rig = Rig()
        block = started(rig, name)
        call = {one: math.nan for one, entry in block.INPUTS.items() if entry.type == "LREAL" and changes}
        for _ in range(50):
            if block.Busy:
                block(**call)
            rig.run.step()
        hashes.append(rig.run.trace.hash)
    assert hashes[0] == hashes[1]


@pytest.mark.parametrize("first", thinned(sorted(EXECUTE), 3))
@pytest.mark.parametrize("second", ["MC_MoveAbsolute", "MC_MoveVelocity", "MC_Stop", "MC_Reset", "MC_SetPosition"])
def test_two_blocks_that_fight_for_an_axis_both_come_to_an_end(first: str, second: str) -> None:
    rig = Rig()
    blocks = [BLOCKS[first](rig.ref), BLOCKS[second](rig.ref)]
    observers = [Observer(endless=True), Observer(endless=True)]

    def calls() -> None:
        for block, observer in zip(blocks, observers, strict=True):
            good = {one: value for one, value in GOOD.items() if one in block.INPUTS}
            block(Execute=rig.run.tick % 40 < 30, **good)
            observer.look(block)

    rig.cycle(400, calls)
    rig.check()


@pytest.mark.parametrize("name", [name for name, block in EXECUTE.items() if "Options" in block.INPUTS])
def test_another_object_for_a_structure_raises_and_says_which(name: str) -> None:
    for other in (None, {"ClearPositionLag": True}, fb.ST_AxisStatus()):
        with pytest.raises(TypeError, match=rf"{name}: Options is .*; it must be of ST_"):
            started(Rig(), name, Options=other)


@pytest.mark.parametrize(("name", "one"), [("MC_SetOverride", "VelFactor"), ("MC_Power", "Override")])
@pytest.mark.parametrize("bad", ["1", None, True])
def test_an_override_that_is_no_number_raises_and_says_so(name: str, one: str, bad: object) -> None:
    block = BLOCKS[name](Rig().ref)
    block(Enable=True, **{one: 0.5})
    with pytest.raises(TypeError, match=f"{name}: {one} is {bad!r}; it must be a number"):
        block(**{one: bad})


def test_a_target_beyond_what_can_be_planned_is_refused() -> None:
    rig = Rig(software_limit_min=None, software_limit_max=None)
    move = fb.MC_MoveAbsolute(rig.ref)
    rig.cycle(1, lambda: move(Execute=True, Position=1e300, Velocity=10.0))
    assert move.ErrorID == ErrorId.SET_POSITION_RANGE
