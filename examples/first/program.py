from motionlayer import Simulation, all_of


async def main(run: Simulation) -> None:
    x, y = run.axes["X"], run.axes["Y"]
    await all_of(x.enable(), y.enable())
    x.move_absolute(800.0, velocity=1000.0)
    await run.until(lambda: x.set_position > 300.0)
    await y.move_absolute(50.0)
    await x.move_absolute(0.0)  # X still moves: this takes over without a jump
    print(f"{run.time:.3f} s: X at {x.set_position}, Y at {y.set_position}")
