"""A control program: it knows commands and states, and nothing of axes, drives or setpoints."""

from motionlayer.layer import AxisCommand, AxisObject
from motionlayer.machine import MachineRun

PLACES = [(250.0, 400.0), (900.0, 100.0), (500.0, 550.0)]


async def command(axis: AxisObject, what: AxisCommand) -> None:
    """Drop a command, and wait until the state says that it is done."""
    axis.ctrl.cmd = AxisCommand.NULL  # the same command again is a change only if another one was between
    await axis.state.done(AxisCommand.NULL)
    axis.ctrl.cmd = what
    await axis.state.done(what)


async def move(axis: AxisObject, position: float, velocity: float) -> None:
    """Move to a position in mm, with a velocity in mm/s, and wait until the state says that it is there."""
    axis.data.position = position
    axis.data.velocity = velocity
    await command(axis, AxisCommand.MOVE_POS)


async def main(run: MachineRun) -> None:
    """Switch the axes on, visit all places with Z up on the way, switch them off."""
    layer = run.layer
    await layer.started()
    x, y, z = layer.axis
    for axis in (x, y, z):
        await command(axis, AxisCommand.ENABLE)
    for place in PLACES:
        await move(z, 0.0, 250.0)
        across = [run.start(move(axis, position, 500.0)) for axis, position in zip((x, y), place, strict=True)]
        for one in across:
            await one
        await move(z, -200.0, 150.0)
        print(f"{run.time:6.3f} s  at {x.info.position:.1f}, {y.info.position:.1f}")
    for axis in (z, x, y):
        await command(axis, AxisCommand.DISABLE)
