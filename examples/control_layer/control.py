"""The control program of the packer: six axes, each with a step chain of its own, by Ctrl and State alone.

A command is dropped, and the state tells what has become of it; every reaction is a case of state = command + progress.
Nothing here waits, and nothing here knows how an axis is moved. So the chain also works at the other end of a fieldbus,
where an answer takes some cycles: as long as the state speaks of another command, there is nothing to react to.
"""

from collections import deque
from typing import NamedTuple

from motionlayer import Simulation
from motionlayer.layer import AxisCommand, AxisObject, Progress
from motionlayer.layer.types import BufferMode
from motionlayer.machine import DriveFault

VELOCITIES = {"Infeed": 600.0, "Outfeed": 600.0, "Lift": 300.0, "Pusher": 400.0, "Gripper": 150.0, "Turner": 270.0}


class Task(NamedTuple):
    """What an axis has to do: go to positions, one after the other; all but a single one without a stop between them.

    Attributes:
        positions: where to.
        fault: on the way there the drive is made to fail.
    """

    positions: tuple[float, ...]
    fault: bool = False


TASKS = {
    "Infeed": [Task((200.0,)), Task((400.0, 600.0, 900.0)), Task((0.0,))],
    "Outfeed": [Task((300.0,)), Task((450.0, 700.0)), Task((0.0,))],
    "Lift": [Task((150.0,)), Task((300.0,), fault=True), Task((200.0, 100.0, 0.0))],
    "Pusher": [Task((100.0, 180.0, 250.0)), Task((0.0,))],
    "Gripper": [Task((40.0,)), Task((10.0,)), Task((40.0,)), Task((0.0,))],
    "Turner": [Task((90.0, 180.0, 270.0, 360.0)), Task((0.0,))],
}


class AxisChain:
    """The step chain of one axis.

    Attributes:
        finished: all is done, and the axis is switched off.
    """

    def __init__(self, run: Simulation, axis: AxisObject) -> None:
        self.finished = False
        self._run = run
        self._axis = axis
        self._tasks = deque(TASKS[axis.name])
        self._path: deque[float] = deque()
        self._taken: int | None = None

    def cycle(self) -> None:  # noqa: C901 - one case per answer
        """React to the state."""
        command, progress = self._axis.state.split()
        if command != self._axis.ctrl.cmd:
            return  # the answer is still on its way
        match command, progress:
            case AxisCommand.INIT, Progress.DONE:
                self._drop(AxisCommand.ENABLE)
            case AxisCommand.ENABLE, Progress.DONE if not self._axis.info.referenced:
                self._drop(AxisCommand.HOME)
            case AxisCommand.ENABLE | AxisCommand.HOME, Progress.DONE:
                self._drop(AxisCommand.NULL)  # a command is repeated by way of NULL
            case AxisCommand.NULL, Progress.DONE:
                self._begin()
            case AxisCommand.MOVE_POS, Progress.OCCUPIED:
                self._watch()
            case AxisCommand.MOVE_BUFFER, Progress.PREPARE | Progress.OCCUPIED:
                self._feed(progress)
            case AxisCommand.MOVE_POS | AxisCommand.MOVE_BUFFER, Progress.DONE:
                self._end()
            case AxisCommand.RESET, Progress.DONE:
                self._drop(AxisCommand.ENABLE)
            case AxisCommand.DISABLE, Progress.DONE:
                self.finished = True
            case _, Progress.ERROR:
                self._recover()

    def _drop(self, command: AxisCommand) -> None:
        self._axis.ctrl.cmd = command

    def _begin(self) -> None:
        """Take up the next task, or the one again that has failed; switch off when there is none."""
        if not self._tasks:
            self._drop(AxisCommand.DISABLE)
            return
        data = self._axis.data
        first, *others = self._tasks[0].positions
        data.position, data.velocity = first, VELOCITIES[self._axis.name]
        self._path, self._taken = deque(others), None
        self._axis.options.buffer_mode = BufferMode.BLENDING_LOW
        self._axis.ctrl.progress = Progress.INVALID
        self._drop(AxisCommand.MOVE_BUFFER if others else AxisCommand.MOVE_POS)

    def _feed(self, progress: int) -> None:
        """Hand over the next position as soon as the one before was taken; the state changes with each that is."""
        axis = self._axis
        if progress != self._taken and self._path:
            self._taken = progress
            axis.data.position = self._path.popleft()
        elif progress != self._taken and axis.info.standstill and abs(axis.info.position - axis.data.position) < 0.5:
            axis.ctrl.progress = Progress.DONE

    def _end(self) -> None:
        self._tasks.popleft()
        self._drop(AxisCommand.NULL)

    def _watch(self) -> None:
        """Let the drive fail half way, once."""
        axis, task = self._axis, self._tasks[0]
        if task.fault and axis.info.position > 0.75 * task.positions[0]:
            self._tasks[0] = Task(task.positions)
            provoke(self._run, axis)

    def _recover(self) -> None:
        """Clear the error; the reference is not lost, so the chain goes on where it was."""
        axis = self._axis
        print(f"{self._run.time:.3f} s: {axis.name}: state {axis.state.code}, error 0x{axis.info.error_id:04X}")
        self._drop(AxisCommand.RESET)


def provoke(run: Simulation, axis: AxisObject) -> None:
    """Let a simulated drive fail: a symbol does it, which can be written from anywhere, by ADS as well."""
    run.symbols.write(f"GVL_SIMULATION.DriveFault[{axis.index}].eFault", DriveFault.DRIVE_ERROR, by="control")


async def main(run: Simulation) -> None:
    """Call all chains in every cycle, as soon as the motion layer is ready, until they have ended."""
    await run.layer.started()
    chains = [AxisChain(run, axis) for axis in run.layer.axis]
    while not all(chain.finished for chain in chains):
        for chain in chains:
            chain.cycle()
        await run.sleep(0)
    print(f"{run.time:.3f} s: all axes are back and switched off")
