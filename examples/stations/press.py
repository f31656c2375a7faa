"""One press of the cell: it waits for the belt and presses each part. The machine file includes it twice."""

from functools import partial

from motionlayer import Simulation


async def main(run: Simulation, prefix: str) -> None:
    """Press three parts, each as soon as the belt has brought it; the prefix names the station."""
    ram, belt = run.axes[prefix + "Ram"], run.axes["Belt"]

    def brought(part: int) -> bool:
        """Tell whether a part lies under the ram."""
        return belt.set_position >= 100.0 * part

    await ram.enable()
    for part in range(1, 4):
        await run.until(partial(brought, part))
        await ram.move_absolute(-50.0)
        await ram.move_absolute(0.0)
        print(f"{run.time:.3f} s: {prefix}Ram has pressed part {part}")
