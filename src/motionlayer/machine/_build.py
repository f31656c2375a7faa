"""From a checked description to the parts of a run."""

import math
from typing import NamedTuple

from motionlayer.command import Ledger
from motionlayer.drive import Fault, IdealDrives, Latches, LatchSignals, ReferenceSwitch, Servo, ServoDrives
from motionlayer.event import EventLog
from motionlayer.machine._axis_description import AxisDescription, ModuloDescription
from motionlayer.machine._description import Description
from motionlayer.machine._home_description import LATCH_KEYS, HomeDescription
from motionlayer.nc import (
    ROW_PIECES,
    Axis,
    AxisConfig,
    AxisStage,
    ErrorGroup,
    GroupReaction,
    HomeConfig,
    HomingMode,
    ManualConfig,
    ModuloConfig,
    MonitorConfig,
)
from motionlayer.profile import Limits
from motionlayer.runtime import Stage, Step
from motionlayer.store import Q, Store

SIGN = {"positive": 1.0, "negative": -1.0}


class Parts(NamedTuple):
    """What a run is made of."""

    store: Store
    ledger: Ledger
    events: EventLog
    axes: dict[str, Axis]
    servos: ServoDrives
    stage: AxisStage
    stages: list[Stage]


def build(description: Description, seed: int = 0) -> Parts:
    """Build all parts of a machine, at rest and without power, before tick 0; noise comes from the seed."""
    entries = description.axis
    store = Store(len(entries), dt=description.base_cycle_ns * 1e-9, max_pieces=ROW_PIECES)
    starts = [entry.start_position for entry in entries.values()]
    store.table[Q.SET_P] = store.table[Q.ACTUAL_P] = starts
    ideals, servos = _ideal_drives(store, description), _servo_drives(store, description, seed)
    ledger, events = Ledger(), EventLog()
    axes = {
        name: Axis(_axis_config(name, entry), column, store, ledger, events)
        for column, (name, entry) in enumerate(entries.items())
    }
    stage = AxisStage(list(axes.values()), store, _groups(description))
    stages = [
        Stage(Step.INPUTS, "ideal drives", ideals.inputs),
        Stage(Step.INPUTS, "servo drives", servos.inputs),
        Stage(Step.INPUTS, "axes", stage.inputs),
        Stage(Step.ACCEPT, "axes", stage.accept),
        Stage(Step.MOTION, "axes", stage.motion),
    ]
    kinds = {entry.drive.kind for entry in entries.values()}
    stages = [one for one in stages if not one.name.endswith(" drives") or one.name.split()[0] in kinds]
    latches = _latches(store, description)
    if latches is not None:
        stages.insert(len(stages) - 3, Stage(Step.INPUTS, "latches", latches.inputs))
    return Parts(store, ledger, events, axes, servos, stage, stages)


def _axis_config(name: str, entry: AxisDescription) -> AxisConfig:
    return AxisConfig(
        name=name,
        unit=entry.unit,
        maximum=Limits(entry.max_velocity, entry.max_acceleration, entry.max_deceleration, entry.max_jerk),
        default=Limits(entry.velocity, entry.acceleration, entry.deceleration, entry.jerk),
        limit_min=-math.inf if entry.software_limit_min is None else entry.software_limit_min,
        limit_max=math.inf if entry.software_limit_max is None else entry.software_limit_max,
        home=_home_config(entry),
        manual=ManualConfig(
            0.05 * entry.max_velocity if entry.manual.slow is None else entry.manual.slow,
            0.3 * entry.max_velocity if entry.manual.fast is None else entry.manual.fast,
            entry.manual.forward,
            entry.manual.backward,
        ),
        monitor=MonitorConfig(**dict(entry.monitor), torque=entry.weak_torque),
        modulo=_modulo_config(entry.modulo),
        simulated=entry.drive.kind == "ideal",
    )


def _modulo_config(entry: ModuloDescription | None) -> ModuloConfig:
    return ModuloConfig() if entry is None else ModuloConfig(entry.period, entry.tolerance, described=True)


def _home_config(entry: AxisDescription) -> HomeConfig:
    home, direction = entry.home, SIGN[entry.home.direction]
    return HomeConfig(
        mode=HomingMode(home.mode),
        position=home.position,
        velocity=home.velocity,
        direction=direction,
        sync_velocity=home.velocity if home.sync_velocity is None else home.sync_velocity,
        sync_direction=-direction if home.sync_direction is None else SIGN[home.sync_direction],
        travel=entry.longest_search,
        pulse_distance=home.pulse_distance,
        latches=tuple(HomingMode(mode) for mode, key in LATCH_KEYS.items() if getattr(home, key) is not None),
    )


def _latches(store: Store, description: Description) -> Latches | None:
    signals = {column: _signals(entry.home) for column, entry in enumerate(description.axis.values())}
    there = {column: one for column, one in signals.items() if one != LatchSignals()}
    return Latches(store, there) if there else None


def _signals(home: HomeDescription) -> LatchSignals:
    """Return what the drive of an axis can latch."""
    none = LatchSignals()
    return LatchSignals(
        pulse=none.pulse if home.pulse_period is None else home.pulse,
        period=none.period if home.pulse_period is None else home.pulse_period,
        turn=none.turn if home.turn is None else home.turn,
        low=none.low if home.latch is None else home.latch,
        high=none.high if home.latch is None or home.latch_width is None else home.latch + home.latch_width,
    )


def _columns(description: Description, kind: str) -> dict[int, tuple[str, AxisDescription]]:
    """Return name and description of the axes with a kind of drive, by column."""
    entries = enumerate(description.axis.items())
    return {column: (name, entry) for column, (name, entry) in entries if entry.drive.kind == kind}


def _ideal_drives(store: Store, description: Description) -> IdealDrives:
    chosen = _columns(description, "ideal")
    return IdealDrives(store, list(chosen), [_switch(entry) for _, entry in chosen.values()])


def _servo_drives(store: Store, description: Description, seed: int) -> ServoDrives:
    chosen = _columns(description, "servo")
    drives = ServoDrives(store, list(chosen), [_servo(name, entry, store.dt) for name, entry in chosen.values()], seed)
    columns = {name: column for column, name in enumerate(description.axis)}
    for one in description.fault:
        tick = one.tick if one.tick is not None else whole_cycles(one.time or 0.0, store.dt)
        drives.inject(columns[one.axis], Fault(one.kind, one.value, one.duration), tick)
    return drives


def whole_cycles(seconds: float, dt: float) -> int:
    """Return a time in base cycles, rounded up; a rounding error of a millionth cycle is none."""
    return math.ceil(seconds / dt - 1e-6)


def _servo(name: str, entry: AxisDescription, dt: float) -> Servo:
    drive = entry.drive
    assert drive.position_gain is not None
    # Twice the largest velocity, beside what noise and quantisation do, is no motion any more.
    leap = 2.0 * entry.max_velocity * dt + 8.0 * drive.noise + 2.0 * drive.encoder_resolution + 2.0 * drive.backlash
    return Servo(
        name=name,
        position_gain=drive.position_gain,
        feed_forward=drive.velocity_feed_forward,
        time_constant=drive.time_constant,
        dead_time=round(drive.dead_time / dt),
        max_acceleration=math.inf if drive.max_acceleration is None else drive.max_acceleration,
        backlash=drive.backlash,
        resolution=drive.encoder_resolution,
        noise=drive.noise,
        brake=entry.max_deceleration if drive.brake_deceleration is None else drive.brake_deceleration,
        ready_delay=whole_cycles(drive.ready_delay, dt),
        patience=drive.patience,
        leap=leap,
        switch=_switch(entry),
    )


def _groups(description: Description) -> list[ErrorGroup]:
    columns = {name: column for column, name in enumerate(description.axis)}
    return [
        ErrorGroup(frozenset(columns[name] for name in group.axes), GroupReaction(group.reaction))
        for group in description.group.values()
    ]


def _switch(entry: AxisDescription) -> ReferenceSwitch | None:
    if entry.home.switch is None:
        return None
    width = math.inf if entry.home.switch_width is None else entry.home.switch_width
    return ReferenceSwitch(entry.home.switch, SIGN[entry.home.direction], width)
