"""The belt between the stations: three strokes, and time for the presses after each."""

from motionlayer import Simulation


async def main(run: Simulation) -> None:
    """Move the belt on three times by 100 mm."""
    belt = run.axes["Belt"]
    await belt.enable()
    for _ in range(3):
        await belt.move_relative(100.0)
        await run.sleep(0.8)  # the presses work
