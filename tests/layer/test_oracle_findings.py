"""What the campaign `contract` has found once, as examples: what the layer did wrong, or the oracle that judges it."""

from itertools import pairwise
from typing import Any, Final

import pytest

from motionlayer.bench.campaign import _contract_words as words
from motionlayer.bench.campaign._contract import LIMITS, SERVO
from motionlayer.bench.campaign._contract_acts import CTRL, DURATION, ENDS, FAULT, Act, Sequence
from motionlayer.bench.campaign._contract_oracle import judge
from motionlayer.bench.campaign._contract_play import PATIENCE, Contract, play
from motionlayer.bench.campaign._contract_recording import Recording
from motionlayer.bench.campaign._contract_watch import Watch, watches
from motionlayer.command import ErrorId
from motionlayer.event import Kind
from motionlayer.layer import AxisCommand
from motionlayer.verify import assert_valid
from tests.effort import thinned
from tests.layer.rig import Rig
from tests.machines import SWITCH

POSITION: Final = "GVL_AXIS.Data[{}].rSetPos"
SPEED: Final = "GVL_AXIS.Data[{}].rSetVelo"
DIRECTION: Final = "GVL_AXIS.Data[{}].iDirection"
UNKNOWN: Final = 999


def played(*clients: Sequence) -> Recording:
    """Return the recording of clients, each with an axis of its own."""
    axes: dict[str, Any] = {f"A{number}": LIMITS | SERVO for number, _ in enumerate(clients, 1)}
    machine = {"format": 1, "name": "contract", "axis": axes, "layer": {"timeout": PATIENCE * 1e-3}}
    recording = play(Contract(machine, [[client] for client in clients], []))
    assert_valid(recording.trace)
    return recording


def test_a_buffered_velocity_with_wrong_mode_and_direction_is_refused_once() -> None:
    rig = Rig().ready()
    rig.x.options.buffer_mode, rig.x.data.velocity, rig.x.data.direction = 99, 50.0, 128
    rig.drop(AxisCommand.MOVE_BUFFER_VELO)
    rig.until(lambda: rig.x.state.code == 9031)
    (refused,) = [event for event in rig.messages if event.kind is Kind.REFUSED]
    assert (refused.code, rig.x.info.error_id) == (ErrorId.MODE_INVALID, ErrorId.MODE_INVALID)
    assert refused.text.startswith("X.move_velocity: ")
    rig.check()


def test_a_default_written_while_an_axis_is_homed_holds_from_the_next_leg_on() -> None:
    """The judge held every leg against the defaults of the tick in which the homing was accepted."""
    rig = Rig(home=SWITCH).ready()
    rig.drop(AxisCommand.HOME)
    rig.cycle(3)
    asked = rig.layer.globals.axis.selector_ctrl.value
    asked.axis, asked.data.number, asked.data.value = 1, 1004, 2500.0
    asked.control.cmd = AxisCommand.PARAMETER_WRITE
    rig.until(lambda: rig.x.state.code == 10011)
    assert rig.run.axes["X"].config.default.acceleration == 2500.0
    rig.check()


# -- the oracle --------------------------------------------------------------------------------------------------------


def replaced(clearing: int, wait: int, fault: int) -> Sequence:
    """Return a client whose AXIS_INIT or AXIS_IDLE clears an error, and is replaced after `wait` cycles.

    After `fault` cycles of it the drive fails.
    """
    (first, one), (second, other) = sorted([(wait, (CTRL, words.DISABLE)), (fault, (FAULT, 3))])
    begin = [Act(1, DURATION, 0.02), Act(1, CTRL, UNKNOWN), Act(2, CTRL, clearing)]
    meanwhile = [Act(first, *one), Act(second - first, *other)]
    return Sequence("StandStill", 0.0, [*begin, *meanwhile, Act(60, CTRL, words.NULL)])


def hidden(watch: Watch, clearing: int) -> bool:
    """Tell whether the end of the command was never shown, and bError not either, because the axis was in error."""
    for tick, (before, now) in enumerate(pairwise(watch.command)):
        if before == clearing and now == words.DISABLE:
            following = words.STEPS[clearing].get(watch.state[tick] - clearing, ())
            return words.DONE in following and bool(watch.bits[tick] & words.IN_ERROR and watch.errors[tick])
    return False


@pytest.mark.parametrize("clearing", thinned(words.CLEARING, 2))
def test_an_error_may_be_cleared_by_a_command_that_is_replaced_before_it_shows_its_end(clearing: int) -> None:
    """The oracle held the error for pending, where an error of the axis hid that it was cleared."""
    recording = played(*(replaced(clearing, wait, fault) for wait in range(2, 8) for fault in range(1, 8)))
    assert any(hidden(watch, clearing) for watch in watches(recording))
    assert judge(recording) == []
    place = next(place for place, watch in enumerate(watches(recording)) if hidden(watch, clearing))
    bits = recording.info["bits"]
    info = recording.info.copy()
    info["bits"][-1, place] = int(bits[-1, place]) ^ words.IN_ERROR
    assert [fault.rule for fault in judge(recording._replace(info=info))] == ["bError"]


def test_a_buffered_move_that_waits_for_a_halt_leaves_no_room_for_the_next_one() -> None:
    """The oracle counted moves alone, and asked for a change that the axis had no room for."""
    acts = [
        *(Act(1, "GVL_AXIS.MotionOptions[{}].eBufferMode", 1), Act(1, CTRL, words.HALT), Act(2, POSITION, 60.0)),
        *(Act(0, CTRL, words.MOVE_BUFFER), Act(2, POSITION, 30.0), Act(200, ENDS, words.DONE)),
    ]
    recording = played(Sequence("ContinuousMotion", 0.0, acts))
    (watch,) = watches(recording)
    halt = next(one for one in watch.given if one.method == "halt")
    first, second = [one for one in watch.given if one.method == "move_absolute"]
    assert halt.start < first.start < halt.end - 5, "the change waits long enough to be missed"
    assert halt.end <= second.start <= halt.end + 2
    assert judge(recording) == []
    without = tuple(event for event in recording.events if "position=30.0" not in event.text)
    found = judge(recording._replace(events=without))
    assert found[0].rule == "goes on"
    assert found[0].tick > halt.end


@pytest.mark.parametrize(
    ("command", "speed"), [(words.HALT, 497.5), (words.STOP, 497.5), (words.DISABLE, 495.0)], ids=str
)
def test_an_axis_that_is_stopped_while_it_turns_passes_through_zero_and_does_not_set_off(
    command: int, speed: float
) -> None:
    """The oracle took a set velocity of exactly zero for a standstill."""
    acts = [
        *(Act(1, SPEED, speed), Act(0, DIRECTION, 3), Act(1, CTRL, words.MOVE_VELO), Act(-250, CTRL, words.NULL)),
        *(Act(1, DIRECTION, 1), Act(0, CTRL, words.MOVE_VELO), Act(14, CTRL, command), Act(40, CTRL, words.NULL)),
    ]
    recording = played(Sequence("StandStill", 0.0, acts))
    (watch,) = watches(recording)
    stopped = watch.command.index(command, watch.command.index(words.MOVE_VELO))
    before, through, after = watch.velocity[stopped : stopped + 3]
    assert before < through == 0.0 < after
    assert not watch.rests(stopped + 1)
    assert judge(recording) == []
    shown = watch.state[stopped : stopped + 3]
    assert command + words.DONE not in shown, "it is not at rest yet"
