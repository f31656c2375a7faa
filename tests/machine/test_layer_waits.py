"""Waiting on a control side: the answer is that of the command that was dropped, whatever number State still shows."""

import struct
from collections import deque
from collections.abc import Callable, Coroutine
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.effort import examples
from tests.layer.rig import Rig
from tests.machine.test_layer_loopback import control, motion

from motionlayer import MachineRun, Simulation, all_of
from motionlayer.command import CommandError
from motionlayer.event import Event
from motionlayer.layer import START, AxisCommand, ControlSide, LayerError, Progress
from motionlayer.layer._exchange import Exchange
from motionlayer.verify import assert_valid

C, P = AxisCommand, Progress
DELAY = 4
"""Cycles that a command is on its way, and an answer too."""


class Line:
    """Machines that are connected by something slow, which loses nothing."""

    def __init__(self, motion: Simulation, control: Simulation) -> None:
        self.motion, self.control = motion, control
        ways = [(control, motion, name) for name in control.areas if "_out." in name]
        ways += [(motion, control, name) for name in motion.areas if "_out." in name]
        self._ways = [(one.areas[name], other.areas[name.replace("_out.", "_in.")]) for one, other, name in ways]
        self._ways.append((motion.areas[START], control.areas[START]))
        self._under_way: deque[list[bytes | None]] = deque(maxlen=DELAY)

    def step(self) -> None:
        for run in (self.control, self.motion):
            run.step()
        side = self.control.layer
        assert isinstance(side, ControlSide)
        given = side.given is not None
        data = [bytes(one.view) if given or "Ctrl" not in one.name else None for one, _ in self._ways]
        if len(self._under_way) == DELAY:
            for (_, target), arrived in zip(self._ways, self._under_way[0], strict=True):
                if arrived is not None and arrived != bytes(target.view):
                    target.post(arrived)
        self._under_way.append(data)

    def run(self, program: Coroutine[Any, Any, None]) -> None:
        """Run a program of the control machine to its end."""
        running = self.control.start(program)
        while running.busy:
            self.step()
        if running.failure is not None:
            raise running.failure


@pytest.mark.parametrize("between", [C.NULL, C.HALT, C.PARAMETER_READ])
def test_a_command_that_is_repeated_before_the_answer_has_come_is_awaited_anew(between: AxisCommand) -> None:
    found: list[float] = []

    async def program(run: MachineRun) -> None:
        await run.layer.started()
        x = run.layer.axis["X"]
        x.ctrl.cmd = C.ENABLE
        await x.state.done(C.ENABLE)
        x.data.velocity = 200.0
        for target in (50.0, 20.0, 80.0):
            x.ctrl.cmd = between
            await run.sleep(0.001)  # State still tells of the move before
            x.data.position, x.ctrl.cmd = target, C.MOVE_POS
            await x.state.done(C.MOVE_POS)
            found.append(x.info.position)

    with Simulation(motion(axes="X")) as axes, Simulation(control("X")) as controller:
        Line(axes, controller).run(program(controller))
        assert found == pytest.approx([50.0, 20.0, 80.0])
        assert_valid(axes.trace)


def test_an_answer_to_the_command_before_takes_nobodys_place() -> None:
    async def program(run: MachineRun) -> None:
        await run.layer.started()
        x = run.layer.axis["X"]
        x.ctrl.cmd = C.ENABLE
        await run.sleep(0.001)
        x.ctrl.cmd = C.RESET
        await x.state.done(C.RESET)
        assert x.state.code == C.RESET + P.DONE

    with Simulation(motion(axes="X")) as axes, Simulation(control("X")) as controller:
        Line(axes, controller).run(program(controller))


def test_a_command_that_another_program_replaces_is_given_up() -> None:
    async def program(run: MachineRun) -> None:
        await run.layer.started()
        x = run.layer.axis["X"]
        x.ctrl.cmd = C.ENABLE
        wait = x.state.done(C.ENABLE)
        await run.sleep(0.001)
        x.ctrl.cmd = C.RESET
        with pytest.raises(LayerError, match="another command has taken its place"):
            await wait

    with Simulation(motion(axes="X")) as axes, Simulation(control("X")) as controller:
        Line(axes, controller).run(program(controller))


DROPS = st.lists(
    st.tuples(st.sampled_from([C.NULL, C.RESET, C.HALT, C.PARAMETER_READ, C.GEAR_IN, 99]), st.integers(0, 5)),
    min_size=2,
    max_size=10,
)


@settings(max_examples=examples(20), deadline=None)
@given(DROPS)
def test_a_wait_ends_with_the_state_of_its_own_command(dropped: list[tuple[int, int]]) -> None:
    """A command is counted as the layer counts it, by changes that it sees; its end is a State of that count."""
    ends: list[tuple[int, int, int]] = []

    async def one(run: MachineRun, number: int, command: int) -> None:
        wait = run.layer.axis["X"].state.done(command)
        try:
            code = await wait
        except LayerError as error:
            code = error.state if "has taken its place" not in str(error) else 0
        ends.append((number, command, code))

    async def program(run: MachineRun) -> None:
        await run.layer.started()
        last, number = int(C.INIT), 0
        for place, (command, gap) in enumerate(dropped):
            run.layer.axis["X"].ctrl.cmd = command
            replaced = gap == 0 and place + 1 < len(dropped)  # in the same cycle: nobody sees it
            if not replaced:
                number += command != last
                last = command
                run.start(one(run, number, command), f"wait {place}")
            if gap:
                await run.sleep(gap * 0.001)
        await run.sleep(0.04)

    with Simulation(motion(axes="X")) as axes, Simulation(control("X")) as controller:
        shown = watched(axes)
        Line(axes, controller).run(program(controller))
        assert not controller.failures
    for number, command, code in ends:
        assert code == 0 or (number, code) in shown, (number, command, code)
    assert ends[-1][2], "nothing replaces the last one"


def watched(axes: Simulation) -> set[tuple[int, int]]:
    """Return where it is noted from now on which command State answers, counted after the start-up, and its code."""
    shown: set[tuple[int, int]] = set()
    seen = 0

    def count(event: Event) -> None:
        nonlocal seen
        seen += event.text.startswith("new command: ") and axes.layer.ready

    def note(run: MachineRun) -> None:
        shown.add((seen, run.layer.axis["X"].state.code))

    axes.events.listen(count)
    axes.cyclic(note)
    return shown


# -- commands that fail, and nobody catches it ----------------------------------------------------------------------


async def beyond(run: MachineRun) -> None:
    await run.layer.started()
    x = run.layer.axis["X"]
    x.ctrl.cmd = C.ENABLE
    await x.state.done(C.ENABLE)
    x.data.position, x.data.velocity, x.ctrl.cmd = 9000.0, 100.0, C.MOVE_POS
    await x.state.done(C.MOVE_POS)


async def too_early(run: MachineRun) -> None:
    x = run.layer.axis["X"]
    x.ctrl.cmd = C.ENABLE
    await x.state.done(C.ENABLE)


async def replaced(run: MachineRun) -> None:
    await run.layer.started()
    x = run.layer.axis["X"]
    x.ctrl.cmd = C.RESET
    wait = x.state.done(C.RESET)
    x.ctrl.cmd = C.NULL
    await wait


async def by_a_child(run: MachineRun) -> None:
    await run.start(beyond(run), "child")


async def in_time(run: MachineRun) -> None:
    with run.fail_after(10.0):
        await beyond(run)


async def all_at_once(run: MachineRun) -> None:
    await run.layer.started()
    x = run.layer.axis["X"]
    x.ctrl.cmd = C.MOVE_POS
    await all_of(x.state.done(C.MOVE_POS), run.sleep(0.1))


@pytest.mark.parametrize(
    ("program", "error", "text"),
    [
        (beyond, 0x4222, "X: MOVE_POS: the state is 9012, PROGRESS_ERROR; error 0x4222"),
        (by_a_child, 0x4222, "0x4222"),
        (in_time, 0x4222, "X: MOVE_POS: the state is 9012, PROGRESS_ERROR; error 0x4222"),
        (all_at_once, 0x4221, "0x4221"),
        (too_early, 0x4B09, "X: ENABLE: the state is 9009, PROGRESS_ERROR; error 0x4B09"),
        (replaced, 0xF001, "X: RESET: another command has taken its place"),
    ],
)
def test_a_failure_that_nobody_catches_is_that_of_the_program(
    program: Callable[[MachineRun], Coroutine[Any, Any, None]], error: int, text: str
) -> None:
    with Simulation(motion({}, axes="X")) as run:
        with pytest.raises(CommandError, match=text) as caught:
            run.run(program(run), time=5.0)
        assert caught.value.error.id == error
        assert_valid(run.trace)


# -- counting ----------------------------------------------------------------------------------------------------------


def test_a_command_that_is_lost_on_the_way_is_answered_with_the_next_one() -> None:
    exchange = Exchange(C.INIT)
    for asked in (C.HALT, C.ENABLE, C.RESET):
        exchange.give(asked)
    assert exchange.number(C.RESET) == 3
    exchange.take(C.INIT + P.DONE)
    exchange.take(C.ENABLE + P.OCCUPIED)
    assert exchange.answered == 2


async def twice(run: MachineRun) -> list[float]:
    """Give the same command three times; the second one has nothing to do with what State shows of the first."""
    axis = run.layer.axis[1]
    await run.layer.started()
    await axis.do(C.ENABLE)
    found = []
    for target in (10.0, 20.0, 5.0):
        axis.data.position, axis.data.velocity = target, 100.0
        await axis.do(C.MOVE_POS)
        found.append(axis.info.position)
    axis.data.position = 1e6
    with pytest.raises(LayerError, match="MOVE_POS"):
        await axis.do(C.MOVE_POS)
    return found


def test_a_command_that_is_done_twice_is_given_twice() -> None:
    rig = Rig()
    program = rig.run.start(twice(rig.run))
    rig.until(lambda: program.done)
    assert program.result == pytest.approx([10.0, 20.0, 5.0], abs=1e-6)
    rig.check()


def test_a_command_that_is_done_twice_is_given_twice_at_the_other_end() -> None:
    found: list[float] = []

    async def program(run: MachineRun) -> None:
        found.extend(await twice(run))

    with Simulation(motion()) as axes, Simulation(control()) as controller:
        Line(axes, controller).run(program(controller))
        assert found == pytest.approx([10.0, 20.0, 5.0], abs=1e-6)
        assert_valid(axes.trace)


def test_what_is_counted_goes_back_with_the_run() -> None:
    with Simulation(control("X")) as controller:
        controller.areas[START].post(struct.pack("<H", P.DONE))
        controller.step(2)
        x = controller.layer.axis["X"]
        exchange = x.state.exchange
        assert exchange is not None
        before = controller.snapshot()
        x.ctrl.cmd = C.ENABLE
        controller.step()
        assert exchange.number(C.HALT) == 2
        controller.restore(before)
        assert exchange.number(C.HALT) == 1
