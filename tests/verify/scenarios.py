"""Runs of one axis that hold everything a plan can do, in several units and sizes."""

from functools import cache

from motionlayer.record import Trace
from motionlayer.verify import assert_valid

from .bench import Bench
from .planner import Limits

SIZES = {
    "mm": ("mm", 1.0, 0.0),
    "µm": ("µm", 1e3, 0.0),
    "m": ("m", 1e-3, 0.0),
    "degree": ("degree", 0.36, 0.0),
    "far away": ("mm", 1.0, 1e6),
    "jerk 1e9": ("µm", 5e3, -1e6),
}


def axis(size: str, name: str = "X", first_command: int = 1) -> Bench:
    unit, scale, origin = SIZES[size]
    maxima = Limits(1000.0 * scale, 10_000.0 * scale, 12_000.0 * scale, 200_000.0 * scale)
    soft = (origin - 20.0 * scale, None)
    return Bench(name, unit, maxima, start=origin, soft=soft, first_command=first_command)


def everything(size: str) -> Bench:
    """Moves, a replacement in motion, a stop, an endless motion, homing, lowered limits, a fault."""
    bench, (_, scale, origin) = axis(size), SIZES[size]
    bench.enable()
    bench.move(origin + 12.0 * scale)
    bench.run()
    bench.run(3)
    bench.move(origin - 5.0 * scale)
    bench.run(30)
    bench.move(origin + 40.0 * scale)
    bench.run()
    bench.move_velocity(200.0 * scale)
    bench.run(80)
    bench.move_velocity(-100.0 * scale)
    bench.run(60)
    bench.stop()
    bench.run()
    bench.run(2)
    bench.home(origin + 3.0 * scale)
    bench.run()
    bench.run(1)
    bench.move(origin + 100.0 * scale)
    bench.run(60)
    bench.limit(velocity=250.0 * scale, jerk=150_000.0 * scale)
    bench.move(origin + 104.0 * scale)
    bench.run()
    bench.run(2)
    bench.move_velocity(15.0 * scale)
    bench.run(60)
    bench.fault()
    bench.run(40)
    return bench


@cache
def recorded(size: str) -> Trace:
    trace = everything(size).trace()
    assert_valid(trace)  # a mutant of what is wrong already would prove nothing
    return trace


@cache
def quantised() -> Trace:
    """A trace whose every number but the states is stored coarsely."""
    steps = {
        "set_position": 1e-5,
        "set_velocity": 1e-3,
        "set_acceleration": 0.5,
        "set_jerk": 10.0,
        "actual_position": 1e-4,
        "max_velocity": 0.1,
    }
    trace = everything("mm").trace(**steps)
    assert_valid(trace)
    return trace
