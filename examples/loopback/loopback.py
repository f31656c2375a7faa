"""Two machines in one process: what one writes into its output images the other finds in its input images."""

from pathlib import Path

from motionlayer import Loopback, Machine, Simulation
from motionlayer.verify import assert_valid

HERE = Path(__file__).parent


def main() -> None:
    """Run both machines in one process, and judge what the axes did."""
    motion, control = Machine.load(HERE / "motion.toml"), Machine.load(HERE / "control.toml")
    with Simulation(motion) as axes, Simulation(control) as controller:
        Loopback(axes, controller).run(time=60.0)
        assert_valid(axes.trace)
        print(f"{axes.time:6.3f} s  done: hash {axes.trace.hash}")


if __name__ == "__main__":
    main()
