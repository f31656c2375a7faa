"""Monitors: what is watched on an axis, and what it finds."""

import math
from collections.abc import Mapping
from typing import Final, NamedTuple

import numpy as np

from motionlayer.command import ErrorId
from motionlayer.nc import _monitor_kernels as bits
from motionlayer.nc._monitor_kernels import IN_RANGE, IN_TARGET, Floats, look
from motionlayer.store import Q, Store

__all__ = ["IN_RANGE", "IN_TARGET", "MonitorConfig", "Monitors", "Seen"]

OFF: Final = math.inf


class MonitorConfig(NamedTuple):
    """What is watched on an axis; a limit or window of None is off. Times are in seconds, u is the unit of the axis.

    Attributes:
        lag: largest position lag, u.
        lag_time: for how long it may be larger.
        range_window: InPositionArea: distance of the actual position from the target, u.
        target_window: InTargetPosition: the same, for `target_time` without interruption, u.
        target_time: see there.
        target_timeout: how long after the setpoint has arrived this may take; None for ever.
        software_limits: the actual position is watched too, with the largest lag as margin.
        velocity_lag: largest velocity lag, u/s.
        velocity_lag_time: for how long it may be larger; a single cycle, as a redefined position makes one, never
            counts.
        motion_window: with a job whose setpoint moves, the actual position changes by more than this in at least one
            cycle, u,
        motion_time: within this time.
        torque: what the torque of the drive allows, u/s², where the axis may ask for more: named where it lags.
    """

    lag: float | None = None
    lag_time: float = 0.0
    range_window: float | None = None
    target_window: float | None = None
    target_time: float = 0.0
    target_timeout: float | None = None
    software_limits: bool = False
    velocity_lag: float | None = None
    velocity_lag_time: float = 0.0
    motion_window: float | None = None
    motion_time: float = 0.5
    torque: float | None = None

    @property
    def any(self) -> bool:
        """Something is watched."""
        watched = (self.lag, self.range_window, self.target_window, self.velocity_lag, self.motion_window)
        return self.software_limits or any(one is not None for one in watched)


class Seen(NamedTuple):
    """What a monitor found in a tick.

    Attributes:
        column: the axis.
        error: what it means; None if the actual position came to the target that was waited for.
        text: values and limits, without the unit.
        per: what follows the unit of the axis in that of the values.
        torque: what the torque of the drive allows, u/s², where that may be why; None where not.
    """

    column: int
    error: ErrorId | None
    text: str = ""
    per: str = ""
    torque: float | None = None

    @property
    def of_target(self) -> bool:
        """It concerns the arrival that is waited for, and nobody else."""
        return self.error is ErrorId.TARGET_TIMEOUT


_MOTION: Final = "moved by no more than {config.motion_window} in any cycle for {config.motion_time} s, at {actual:.9g}"

ERRORS: Final[tuple[tuple[int, ErrorId, str, str], ...]] = (
    (bits.LAG_ERROR, ErrorId.LAG, "lag = {lag:.9g}, allowed: {config.lag}", ""),
    (bits.RATE_ERROR, ErrorId.VELOCITY_LAG, "velocity lag = {rate:.9g}, allowed: {config.velocity_lag}", "/s"),
    (bits.MOTION_ERROR, ErrorId.NO_MOTION, _MOTION, ""),
    (bits.BELOW, ErrorId.MINIMUM_PASSED, "actual position = {actual:.9g}, limit {low}", ""),
    (bits.ABOVE, ErrorId.MAXIMUM_PASSED, "actual position = {actual:.9g}, limit {high}", ""),
    (bits.ALARM, ErrorId.TARGET_TIMEOUT, "actual position = {actual:.9g}, target {target:.9g}", ""),
)
"""Bits that are errors, the gravest first: id, how the message goes on, and what follows the unit there."""

_OF_TORQUE: Final = (ErrorId.LAG, ErrorId.VELOCITY_LAG)
"""Errors that a drive without enough torque brings about."""


class Monitors:
    """The monitors of all axes that have some.

    Args:
        store: where the values are.
        configs: per column.
    """

    def __init__(self, store: Store, configs: Mapping[int, MonitorConfig]) -> None:
        self._store = store
        self._configs: dict[int, MonitorConfig] = {}
        self._index: dict[int, int] = {}
        self._columns = np.zeros(0, dtype=np.int64)
        self._parameters: Floats = np.zeros((bits.PARAMETERS, 0))
        self._states: Floats = np.zeros((bits.STATES, 0))
        self._done = np.zeros(0, dtype=np.int64)
        self._events = np.zeros((0, 2), dtype=np.int64)
        self._add(list(configs))
        for column, config in configs.items():
            self._put(column, config)
        store.table[Q.TARGET, self._columns] = math.nan

    def configure(self, column: int, config: MonitorConfig) -> None:
        """Watch an axis as it says from now on."""
        if column not in self._index:
            if not config.any:
                return
            self._add([column])
        self._put(column, config)

    def _add(self, columns: list[int]) -> None:
        """Make room for more axes."""
        count = len(columns)
        self._index |= {column: k for k, column in enumerate(columns, len(self._columns))}
        self._columns = np.concatenate([self._columns, np.array(columns, dtype=np.int64)])
        self._parameters = np.concatenate([self._parameters, np.zeros((bits.PARAMETERS, count))], axis=1)
        fresh = np.zeros((bits.STATES, count))
        fresh[bits.WAITING] = -1.0
        fresh[bits.LAST_P] = self._store.table[Q.ACTUAL_P, columns] - self._store.table[Q.SHIFT, columns]
        fresh[bits.LAST_LAG] = self._store.table[Q.LAG, columns]
        self._states = np.concatenate([self._states, fresh], axis=1)
        self._done = np.concatenate([self._done, np.zeros(count, dtype=np.int64)])
        self._events = np.zeros((len(self._columns), 2), dtype=np.int64)

    def _put(self, column: int, config: MonitorConfig) -> None:
        k = self._index[column]
        self._configs[column] = config
        self._parameters[:, k] = _parameters(config, self._store.dt)
        self._done[k] = _done(config)

    def look(self) -> list[Seen]:
        """Return what happened in this tick, one thing per axis."""
        if not self._configs:
            return []
        count = look(self._store.table, self._columns, self._parameters, self._states, self._done, self._events)
        return [self._seen(int(self._columns[k]), found) for k, found in self._events[:count].tolist()]

    def _seen(self, column: int, found: int) -> Seen:
        for bit, error, text, per in ERRORS:
            if found & bit:
                rows = [Q.LAG, Q.ACTUAL_P, Q.MIN_P, Q.MAX_P, Q.TARGET]
                values = zip(("lag", "actual", "low", "high", "target"), self._store.table[rows, column], strict=True)
                rate = float(self._states[bits.RATE, self._index[column]]) / self._store.dt
                told = {name: float(value) for name, value in values}
                config = self._configs[column]
                torque = config.torque if error in _OF_TORQUE else None
                return Seen(column, error, text.format(**told, rate=rate, config=config), per, torque)
        return Seen(column, None)

    def waits_for_target(self, column: int) -> bool:
        """Tell whether a positioning is done only when the actual position has arrived."""
        k = self._index.get(column)
        return k is not None and bool(self._done[k])

    def wait(self, column: int) -> None:
        """From now on look for the actual position to arrive."""
        self._states[bits.WAITING, self._index[column]] = 0.0

    def flag(self, column: int, flag: int) -> bool:
        """Return a flag of the last look; False where it is not watched."""
        k = self._index.get(column)
        return k is not None and bool(int(self._states[bits.FLAGS, k]) & flag)


def _done(config: MonitorConfig) -> int:
    """Return the flag that a positioning waits for, 0 for none (function-blocks 2.7)."""
    if config.target_window is not None:
        return bits.IN_TARGET
    return bits.IN_RANGE if config.range_window is not None else 0


def _parameters(config: MonitorConfig, dt: float) -> list[float]:
    """Return the parameters of one axis in the order of their rows."""

    def ticks(seconds: float | None) -> float:
        return OFF if seconds is None else float(math.ceil(seconds / dt - 1e-6))

    margin = (config.lag or 0.0) if config.software_limits else OFF
    return [
        OFF if config.lag is None else config.lag,
        ticks(config.lag_time),
        -1.0 if config.range_window is None else config.range_window,
        -1.0 if config.target_window is None else config.target_window,
        ticks(config.target_time),
        ticks(config.target_timeout),
        margin,
        OFF if config.velocity_lag is None else config.velocity_lag * dt,
        max(1.0, ticks(config.velocity_lag_time)),
        OFF if config.motion_window is None else config.motion_window,
        OFF if config.motion_window is None else max(1.0, ticks(config.motion_time)),
    ]
