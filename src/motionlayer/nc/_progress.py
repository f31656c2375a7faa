"""How far an axis has come with what it executes."""

import math
from typing import TYPE_CHECKING

from motionlayer.command import Ledger
from motionlayer.event import EventLog
from motionlayer.nc._buffer import AxisBuffer
from motionlayer.nc._config import AxisConfig
from motionlayer.nc._monitors import IN_RANGE, IN_TARGET
from motionlayer.nc._motion import AxisCommand, JobKind
from motionlayer.store import Store

if TYPE_CHECKING:
    from motionlayer.nc._homing import Homing


class AxisProgress(AxisBuffer):
    """What can be read of the motion; the arguments are those of `AxisBase`."""

    def __init__(self, config: AxisConfig, column: int, store: Store, ledger: Ledger, events: EventLog) -> None:
        super().__init__(config, column, store, ledger, events)
        self._homing: Homing | None = None

    @property
    def command(self) -> AxisCommand | None:
        """The command that the axis works on."""
        return self._job.command if self._job is not None else None

    @property
    def remaining_time(self) -> float:
        """Seconds until the present profile comes to its last piece; infinite in homing and held by override 0."""
        store = self._store
        if self._homing is not None or self._held:
            return math.inf
        return max(0.0, float(store.end_of(self._column)[0]) - store.since(self._column))

    @property
    def in_velocity(self) -> bool:
        """The setpoint moves at the commanded velocity times the override, without acceleration; False at 0 %."""
        job = self._job
        if job is None or job.kind is not JobKind.VELOCITY or self.set_acceleration != 0.0 or self._held:
            return False
        return math.isclose(self.set_velocity, job.target * self.override, rel_tol=1e-12)

    @property
    def in_end_velocity(self) -> bool:
        """A continuous motion has passed its target and moves at its end velocity times the override; False at 0 %."""
        job = self._job
        if job is None or job.end_speed == 0.0 or self.set_acceleration != 0.0 or self._held:
            return False
        passed = job.passed != 0.0 or self._reached(job)
        return passed and math.isclose(abs(self.set_velocity), job.end_speed * self.override, rel_tol=1e-12)

    @property
    def in_target(self) -> bool:
        """InTargetPosition: inside the target window for its time; False without such a window."""
        return self._monitors is not None and self._monitors.flag(self._column, IN_TARGET)

    @property
    def in_position_area(self) -> bool:
        """InPositionArea: inside the range window; False without such a window."""
        return self._monitors is not None and self._monitors.flag(self._column, IN_RANGE)
