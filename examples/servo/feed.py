"""Feed parts, and go on after a fault: reset, switch on, feed again from where the axis stands."""

from motionlayer import CommandAborted, CommandError, Simulation, all_of

STROKE = 400.0  # mm
LIFT = 60.0  # mm
PARTS = 4


async def stroke(run: Simulation) -> None:
    """Feed one part, and lift it on the way."""
    feed, lift = run.axes["Feed"], run.axes["Lift"]
    out = feed.move_absolute(STROKE)
    await run.until(lambda: feed.actual_position > 0.5 * STROKE or not out.busy)
    if out.busy:
        await all_of(out, lift.move_absolute(LIFT))
    await out
    await all_of(feed.move_absolute(0.0), lift.move_absolute(0.0))


async def recover(run: Simulation) -> None:
    """Wait until everything rests, then reset what is in error and switch it on again."""
    for axis in run.axes.values():
        await run.until(lambda axis=axis: axis.set_velocity == 0.0)  # type: ignore[misc]
        if axis.error is not None:
            print(f"{run.time:.3f} s: {axis.error}")
            await axis.reset()
            await axis.enable()
            print(f"{run.time:.3f} s: {axis.name} goes on from {axis.actual_position:.3f} {axis.config.unit}")


async def feed(run: Simulation) -> None:
    """Feed all parts."""
    await all_of(*(axis.enable() for axis in run.axes.values()))
    fed = 0
    while fed < PARTS:
        try:
            await stroke(run)
            fed += 1
            print(f"{run.time:.3f} s: part {fed}, lag at rest {run.axes['Feed'].lag:+.3f} mm")
        except (CommandError, CommandAborted):
            await recover(run)
