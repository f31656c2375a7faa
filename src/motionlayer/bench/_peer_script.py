"""Measure the peers. Runs with the interpreter of their environment, where motionlayer is not installed.

Reads a job and its work as JSON from stdin; prints the value. Whatever fails is told by the last line of stderr.
"""

import gc
import importlib
import json
import statistics
import sys
from collections.abc import Callable
from time import perf_counter_ns
from typing import Any


def pyplcopen(work: dict[str, Any]) -> float:
    """Return the time of a cycle of all axes, each moving at a velocity, one call per axis.

    Units of this package are per cycle. Its move_absolute() waits for the end of the move, so that endless motion
    is what many axes can do at once; no call cycles several axes.
    """
    package = importlib.import_module("pyplcopen")
    axes = [package.AxisSim(number) for number in range(work["axes"])]
    for axis in axes:
        axis.power_on()
        axis.move_velocity(0.1, 0.008, 0.008, 0.0001)
    start = [axis.command_position() for axis in axes]
    times = []
    for _ in range(work["cycles"] + 1):
        begin = perf_counter_ns()
        for axis in axes:
            axis.cycle()
        times.append(perf_counter_ns() - begin)
    if any(axis.command_position() <= before for axis, before in zip(axes, start, strict=True)):
        raise RuntimeError("not all axes move")
    return statistics.median(times[1:]) / 1e3


def ruckig(work: dict[str, Any]) -> float:
    """Return the time of a plan from motion to rest at a new target, its input being set included.

    Its tolerances are absolute: lengths are scaled by V²/A and times by V/A, so that both limits are 1.
    """
    package = importlib.import_module("ruckig")
    time = work["velocity"] / work["acceleration"]
    length = work["velocity"] * time
    planner, given, way = package.Ruckig(1), package.InputParameter(1), package.Trajectory(1)
    given.max_velocity, given.max_acceleration = [1.0], [1.0]
    given.max_jerk = [work["jerk"] * time / work["acceleration"]]
    state: tuple[list[float], list[float], list[float]] = ([0.0], [0.0], [0.0])
    times = []
    for target in work["targets"]:
        goal = [target / length]
        begin = perf_counter_ns()
        given.current_position, given.current_velocity, given.current_acceleration = state
        given.target_position = goal
        planner.calculate(given, way)
        times.append(perf_counter_ns() - begin)
        state = way.at_time(work["pause"] / time)
    return statistics.median(times) / 1e3


def longest_rest_to_rest(work: dict[str, Any]) -> float:
    """Return by how much the longest plan is over the optimum, relative; in units of the limits' V and A."""
    package = importlib.import_module("ruckig")
    planner, given, way = package.Ruckig(1), package.InputParameter(1), package.Trajectory(1)
    given.max_velocity, given.max_acceleration = [1.0], [1.0]
    longest = float("-inf")
    for distance, deceleration, jerk, optimum in work["cases"]:
        given.target_position, given.min_acceleration, given.max_jerk = [distance], [-deceleration], [jerk]
        planner.calculate(given, way)
        longest = max(longest, way.duration / optimum - 1.0)
    return longest


JOBS: dict[str, Callable[[dict[str, Any]], float | list[float]]] = {
    "cycle": pyplcopen,
    "cycle by axes": lambda work: [pyplcopen({**work, "axes": axes}) for axes in work["axes"]],
    "plan": ruckig,
    "rest to rest": longest_rest_to_rest,
}


def main() -> None:
    """Measure what is asked for."""
    work = json.load(sys.stdin)
    gc.disable()
    json.dump(JOBS[work.pop("job")](work), sys.stdout)


if __name__ == "__main__":
    main()
