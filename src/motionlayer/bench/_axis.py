"""The group `axis`: what moves, blocks and the cyclic interface of axes cost, and how exact a blended chain is."""

import itertools
import math
import statistics
from collections.abc import Sequence
from typing import Final

from motionlayer.bench import _load
from motionlayer.bench._row import MICRO, Effort, Failed, Figure, Goal, Row
from motionlayer.bench._timing import median_us, times_us
from motionlayer.fb import MC_MoveAbsolute
from motionlayer.nc import ActualMotion, AxisRefs, BufferMode
from motionlayer.profile import MAX_PIECES, Limits, plan_velocity
from motionlayer.store import Store

AXES: Final = 1000

WAY: Final = 20.0
"""Length of each move of the chain, mm; long enough to start and stop within."""


def moves(effort: Effort) -> list[float]:
    """Time complete cycles of 1000 axes, each with a new move every second, in microseconds each.

    In every cycle one axis is given a move, mostly while its last one still runs.
    """
    with _load.enabled(_load.machine(AXES)) as run:
        axes = list(run.axes.values())
        goals = itertools.cycle(_load.targets(AXES - 1))

        def one_move(_run: object) -> None:
            command = axes[run.tick % AXES].move_absolute(next(goals))
            if command.error is not None:
                raise Failed(f"a move was refused: {command.error}")

        run.cyclic(one_move)
        run.step(AXES)
        times = times_us(run.step, effort.samples)
        if run.failures:
            raise Failed(str(run.failures[0].failure))
        return times


def moves_median(effort: Effort) -> Figure:
    """Return the median of those cycles."""
    return Figure(statistics.median(moves(effort)))


def moves_p99(effort: Effort) -> Figure:
    """Return the 99th percentile of those cycles."""
    times = sorted(moves(effort))
    return Figure(times[math.ceil(0.99 * len(times)) - 1])


def busy_blocks(effort: Effort, *, count: int = 64) -> Figure:
    """Time the calls of busy blocks in one cycle, with inputs, as a program calls them."""
    with _load.enabled(_load.machine(count)) as run:
        blocks = [MC_MoveAbsolute(ref) for ref in run.axis_refs.values()]

        def call() -> None:
            for block in blocks:
                block(Execute=True, Position=1e6, Velocity=100.0)

        call()
        run.step(5)
        figure = Figure(median_us(call, effort.samples))
        if not all(block.Active for block in blocks):
            raise Failed("not all blocks are busy")
        return figure


def image(effort: Effort) -> Figure:
    """Time the filling of `NcToPlc` of 1000 moving axes."""
    limits = Limits(_load.VELOCITY, _load.ACCELERATION, _load.ACCELERATION, _load.JERK)
    store = Store(AXES, dt=_load.BASE_CYCLE, max_pieces=MAX_PIECES)
    for column in range(AXES):
        store.adopt(column, plan_velocity(0.0, 0.0, 0.0, 100.0 + column % 7, limits).pieces)
    for tick in range(1, 500):
        store.sample(tick)
    actual, ticks = ActualMotion(store, AXES), itertools.count(500)
    refs = AxisRefs(store, actual, [360.0] * AXES, [0] * AXES)

    def call() -> None:
        actual.follow()
        refs.fill(next(ticks))

    return Figure(median_us(call, effort.samples))


def chain(effort: Effort) -> Figure:
    """Move in a chain of up to 1000 blended moves fed one at a time; return the relative error of its time."""
    speeds = [200.0 + k % 7 for k in range(min(AXES, effort.samples))]
    with _load.enabled(_load.machine(1)) as run:
        axis, start = run.axes["A0"], run.time
        for speed in speeds:
            while axis.buffered is not None:
                run.step()
            command = axis.move_relative(WAY, velocity=speed, buffer_mode=BufferMode.BLENDING_LOW)
            if command.error is not None:
                raise Failed(f"a move was refused: {command.error}")
        while command.busy:
            run.step()
        assert command.end_time is not None
        expected = chain_time(speeds)
        return Figure(abs(command.end_time - start - expected) / expected, f"{len(speeds)} moves in {expected:.1f} s")


def chain_time(speeds: Sequence[float]) -> float:
    """Return the time of a chain in closed form: every joint is passed with the lower velocity of both moves.

    Velocities are near each other, so that a change by d never reaches the acceleration limit: it takes 2 sqrt(d / J)
    at the mean of both velocities.
    """
    joints = [0.0, *map(min, itertools.pairwise(speeds)), 0.0]
    total = 0.0
    for speed, (entry, leaving) in zip(speeds, itertools.pairwise(joints), strict=True):
        ramps = [(2.0 * math.sqrt((speed - slow) / _load.JERK), 0.5 * (speed + slow)) for slow in (entry, leaving)]
        total += sum(time for time, _ in ramps) + (WAY - sum(time * mean for time, mean in ramps)) / speed
    return total


ROWS: Final = (
    Row("moves.axes_1000", MICRO, Goal(150), moves_median),
    Row("moves.axes_1000_p99", MICRO, Goal(600), moves_p99),
    Row("blocks.busy_64", MICRO, Goal(120), busy_blocks),
    Row("image.axes_1000", MICRO, Goal(40), image),
    Row("blend.chain_1000", "relative", Goal(1e-9), chain),
)
