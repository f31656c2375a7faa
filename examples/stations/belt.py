from motionlayer import Simulation


async def main(run: Simulation) -> None:
    belt = run.axes["Belt"]
    await belt.enable()
    for _ in range(3):
        await belt.move_relative(100.0)
        await run.sleep(0.8)  # the presses work
