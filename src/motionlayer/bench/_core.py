"""The group `core`: cycle, sampling, planning, recording, and the command itself."""

import itertools
from functools import partial
from typing import Final

from motionlayer.bench import _command, _load, _peers, _recording
from motionlayer.bench._row import MICRO, Effort, Failed, Figure, Goal, Peer, Row
from motionlayer.bench._timing import median_us
from motionlayer.event import Kind
from motionlayer.profile import MAX_PIECES, Limits, plan_velocity
from motionlayer.store import Store


def cycle(effort: Effort, *, axes: int) -> Figure:
    """Time a complete tick; all axes move, none gets a command."""
    with _load.moving(_load.machine(axes)) as run:
        return Figure(median_us(run.step, effort.samples))


def sample(effort: Effort, *, rows: int) -> Figure:
    """Time the sampling of one tick; all rows move."""
    limits = Limits(_load.VELOCITY, _load.ACCELERATION, _load.ACCELERATION, _load.JERK)
    store = Store(rows, dt=_load.BASE_CYCLE, max_pieces=MAX_PIECES)
    for column in range(rows):
        store.adopt(column, plan_velocity(0.0, 0.0, 0.0, 100.0 + column % 7, limits).pieces)
    for tick in range(1, 500):
        store.sample(tick)
    ticks = itertools.count(500)
    return Figure(median_us(lambda: store.sample(next(ticks)), effort.samples))


def plan(effort: Effort) -> Figure:
    """Time a move command on a moving axis, from the call to its return.

    In the call it is checked, planned, the plan is checked and taken over, and the running command ends.
    """
    with _load.enabled(_load.machine(1)) as run:
        axis = run.axes["A0"]
        goals = itertools.cycle(_load.targets(effort.samples))
        figure = Figure(
            median_us(
                lambda: axis.move_absolute(next(goals)),
                effort.samples,
                between=lambda: run.step(_load.MOVE_TICKS),
            )
        )
        refused = [event for event in run.events.last() if event.kind is Kind.REFUSED]
        if refused:
            raise Failed(f"a move was refused: {refused[0].text}")
        return figure


AXES_IN_PYTHON: Final = Peer("pyplcopen", "1000 x AxisSim.cycle()", "cycle", _peers.axes)

ROWS: Final = (
    Row("cycle.axes_10", MICRO, Goal(20), partial(cycle, axes=10)),
    Row("cycle.axes_1000", MICRO, Goal(60), partial(cycle, axes=1000), AXES_IN_PYTHON),
    Row("cycle.axes_6000", MICRO, Goal(200), partial(cycle, axes=6000)),
    Row("sample.rows_1000", MICRO, Goal(5), partial(sample, rows=1000), AXES_IN_PYTHON),
    Row("sample.rows_6000", MICRO, Goal(12), partial(sample, rows=6000)),
    Row("plan.move", MICRO, Goal(25), plan, Peer("ruckig", "calculate() alone", "plan", _peers.moves)),
    Row("trace.signals_1000", MICRO, Goal(5), _recording.trace),
    Row("demo.realtime_factor", "x", Goal(50, at_least=True), _command.demo),
    Row("start.warm", "s", Goal(1.5), _command.start_warm),
    Row("start.cold", "s", Goal(20), _command.start_cold),
    Row("help.time", "s", Goal(0.2), _command.help_time),
)
