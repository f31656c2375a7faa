"""From a checked description to the parts of a run."""

import math
from typing import NamedTuple

from motionlayer.command import Ledger
from motionlayer.drive import IdealDrives, ReferenceSwitch
from motionlayer.event import EventLog
from motionlayer.machine._description import AxisDescription, Description
from motionlayer.nc import Axis, AxisConfig, AxisStage, HomeConfig, HomingMode
from motionlayer.profile import MAX_PIECES, Limits
from motionlayer.runtime import Stage, Step
from motionlayer.store import Q, Store

SIGN = {"positive": 1.0, "negative": -1.0}


class Parts(NamedTuple):
    """What a run is made of."""

    store: Store
    ledger: Ledger
    events: EventLog
    axes: dict[str, Axis]
    stages: list[Stage]


def build(description: Description) -> Parts:
    """Build all parts of a machine, at rest and without power, before tick 0."""
    entries = description.axis
    store = Store(len(entries), dt=description.base_cycle_ns * 1e-9, max_pieces=MAX_PIECES)
    starts = [entry.start_position for entry in entries.values()]
    store.table[Q.SET_P] = store.table[Q.ACTUAL_P] = starts
    drives = IdealDrives(store, range(len(entries)), [_switch(entry) for entry in entries.values()])
    ledger, events = Ledger(), EventLog()
    axes = {
        name: Axis(_axis_config(name, entry), column, store, ledger, events)
        for column, (name, entry) in enumerate(entries.items())
    }
    stage = AxisStage(list(axes.values()), store)
    stages = [
        Stage(Step.INPUTS, "drives", drives.inputs),
        Stage(Step.INPUTS, "axes", stage.inputs),
        Stage(Step.ACCEPT, "axes", stage.accept),
        Stage(Step.MOTION, "axes", stage.motion),
    ]
    return Parts(store, ledger, events, axes, stages)


def _axis_config(name: str, entry: AxisDescription) -> AxisConfig:
    return AxisConfig(
        name=name,
        unit=entry.unit,
        maximum=Limits(entry.max_velocity, entry.max_acceleration, entry.max_deceleration, entry.max_jerk),
        default=Limits(entry.velocity, entry.acceleration, entry.deceleration, entry.jerk),
        limit_min=-math.inf if entry.software_limit_min is None else entry.software_limit_min,
        limit_max=math.inf if entry.software_limit_max is None else entry.software_limit_max,
        home=HomeConfig(
            HomingMode(entry.home.mode), entry.home.position, entry.home.velocity, SIGN[entry.home.direction]
        ),
    )


def _switch(entry: AxisDescription) -> ReferenceSwitch | None:
    if entry.home.switch is None:
        return None
    return ReferenceSwitch(entry.home.switch, SIGN[entry.home.direction])
