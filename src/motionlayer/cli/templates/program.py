"""What the machine does. A program runs in the time of the machine: it awaits commands, and goes on in a later tick."""

from motionlayer import Simulation, all_of


async def main(run: Simulation) -> None:
    """Enable both axes, then move them: one after the other, and at the same time."""
    x, y = run.axes["X"], run.axes["Y"]
    await all_of(x.enable(), y.enable())

    await x.move_absolute(300.0)  # awaiting a command waits for its end
    print(f"{run.time:.3f} s: X stands at {x.set_position:g} mm")

    turn = y.move_relative(90.0, velocity=180.0)  # this goes on beside what follows
    await x.move_absolute(50.0)
    await turn
    print(f"{run.time:.3f} s: Y stands at {y.actual_position:.2f}°, {y.set_position:g}° were asked for")

    await run.sleep(0.1)
    y.move_absolute(0.0)
    await run.until(lambda: y.set_position < 45.0)
    await x.move_absolute(0.0)
    print(f"{run.time:.3f} s: done")
