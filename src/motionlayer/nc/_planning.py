"""Plans of an axis: from a job to a profile, and into the store."""

import math

from motionlayer.command import Ledger
from motionlayer.event import EventLog
from motionlayer.nc._base import AxisBase
from motionlayer.nc._config import AxisConfig
from motionlayer.nc._motion import SCALED, Job, JobKind
from motionlayer.profile import Limits, Profile, plan_position, plan_stop, plan_velocity
from motionlayer.store import JOB_OTHER, JOB_POSITION, JOB_VELOCITY, Q, Store


class AxisPlanning(AxisBase):
    """What an axis follows; the arguments are those of `AxisBase`."""

    def __init__(self, config: AxisConfig, column: int, store: Store, ledger: Ledger, events: EventLog) -> None:
        super().__init__(config, column, store, ledger, events)
        self._job: Job | None = None
        self._ran: Limits | None = None

    def _planned(self, job: Job) -> Profile:
        """Plan a job from the present setpoint, with the override.

        Raises:
            PlanError: the plan failed its check.
        """
        state = (self.set_position, self.set_velocity, self.set_acceleration)
        limits = self._scaled(job)
        if job.kind not in SCALED or self.override == 0.0:
            return plan_stop(*state, limits)
        if job.kind is JobKind.POSITION:
            return plan_position(*state, job.target, limits)
        end = self._limit_ahead(job)
        if job.kind is JobKind.VELOCITY and math.isfinite(end):
            return plan_position(*state, end, limits)
        return plan_velocity(*state, math.copysign(limits.velocity, job.target), limits)

    def _scaled(self, job: Job) -> Limits:
        factor = self.override
        if job.kind not in SCALED or factor in {0.0, 1.0}:
            return job.limits
        return job.limits._replace(velocity=job.limits.velocity * factor)

    def _adopt(self, job: Job, profile: Profile) -> None:
        """Hand a profile to the store, put its limits in force, and leave there what a change of override needs."""
        table, column = self._table, self._column
        if table[Q.TICK, column] != self._store.tick:  # else the job was replaced without having moved
            self._ran = self._job.limits if self._job is not None else None
        self._job = job
        self._store.adopt(column, profile.pieces)
        table[Q.MAX_V : Q.MAX_J + 1, column] = self._scaled(job)
        table[Q.OVERRIDE, column] = self.override
        kind, target = JOB_OTHER, 0.0
        if job.kind in SCALED:
            bounded = job.kind is JobKind.VELOCITY and math.isfinite(self._limit_ahead(job))
            kind = JOB_POSITION if bounded or job.kind is JobKind.POSITION else JOB_VELOCITY
            target = self._limit_ahead(job) if bounded else job.target
        end = profile.pieces[-1]
        table[Q.TARGET, column] = job.target if job.kind is JobKind.POSITION else end[1] if end[2] == 0.0 else math.nan
        command = job.command.number if job.command is not None else 0
        table[Q.JOB_KIND : Q.COMMAND + 1, column] = (kind, target, job.limits.velocity, command)

    def _running(self) -> Limits:
        """Return the dynamics that a brake must not fall short of: those of the job that moves the axis."""
        if self._job is None:
            return self.config.default
        limits = self._job.limits
        if self._ran is None or self._table[Q.TICK, self._column] != self._store.tick:
            return limits
        return Limits(*(max(pair) for pair in zip(limits, self._ran, strict=True)))

    def _limit_ahead(self, job: Job) -> float:
        """Return the software limit that an endless motion goes towards."""
        return self.config.limit_max if job.target > 0.0 else self.config.limit_min

    def _redefine(self, position: float) -> None:
        """Give the place where the axis stands another position: set, actual and drive stay where they are."""
        lag = self.set_position - self.actual_position
        self._table[Q.SHIFT, self._column] += position - self.set_position
        self._table[Q.ACTUAL_P, self._column] = position - lag  # so that no lag stays none, to the last bit
        self._set_plan(position)

    def _set_plan(self, position: float) -> None:
        """Let the setpoint of the resting axis be `position`, from this very tick on."""
        self._store.place(self._column, position)
        self._table[Q.TARGET, self._column] = position
        self._table[Q.MAX_V : Q.MAX_J + 1, self._column] = self.config.maximum
