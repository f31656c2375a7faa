"""Plans of an axis: from a job to a profile, and into the store."""

import math
from typing import Final

from motionlayer.command import ErrorId, Ledger
from motionlayer.event import EventLog
from motionlayer.nc._axis_ref import BEEN_STOPPED, HAS_JOB, NEW_TARGET
from motionlayer.nc._base import AxisBase
from motionlayer.nc._config import AxisConfig
from motionlayer.nc._limits import bad_target, missing_feed, overrun, too_long, too_weak
from motionlayer.nc._motion import BOUNDED, SCALED, Job, JobKind, Refusal
from motionlayer.nc._through import Point, Way
from motionlayer.nc._ways import limit_ahead, way_of
from motionlayer.profile import MAX_PIECES, Limits, PlanError
from motionlayer.store import JOB_COMPOUND, JOB_OTHER, JOB_POSITION, JOB_VELOCITY, Q, Store

ROW_PIECES: Final = 4 * MAX_PIECES
"""Most pieces of what an axis follows: a running and a buffered motion of two plans each."""


class AxisPlanning(AxisBase):
    """What an axis follows; the arguments are those of `AxisBase`."""

    def __init__(self, config: AxisConfig, column: int, store: Store, ledger: Ledger, events: EventLog) -> None:
        super().__init__(config, column, store, ledger, events)
        self._job: Job | None = None
        self._ran: Limits | None = None
        self._commanded: float | None = None
        """The last commanded target, reached or not; None in endless motion and where it means nothing any more."""
        self._heading = 1.0
        """Direction of the present motion, or of the last one."""
        self._feed = (True, True)
        """Motion is released in positive and in negative direction."""

    @property
    def _held(self) -> bool:
        """Override 0 keeps the job from coming to its end."""
        in_force = self._values[Q.OVERRIDE]
        return self._job is not None and self._job.kind in SCALED and (self.override == 0.0 or in_force == 0.0)

    @property
    def _here(self) -> Point:
        values = self._values  # past the properties: every command asks several times
        return Point(values[Q.SET_P], values[Q.SET_V], values[Q.SET_A])

    def _planned(self, job: Job) -> Way:
        """Plan a job from the present setpoint, with the override.

        Raises:
            PlanError: the plan failed its check.
        """
        return way_of(self.config, job, self._here, self.override)

    def _checked(self, job: Job, start: Point) -> Way | Refusal:
        """Plan a job, or tell why it must not begin at `start`; how long it takes is judged at 1 where 0 holds it."""
        refusal = bad_target(self.config, job, start.p) or too_weak(job, abs(start.v), self.config.unit)
        if refusal is not None:
            return refusal
        factor = self.override
        try:
            held = too_long(job, way_of(self.config, job, start, 1.0).profile, 1.0) if factor == 0.0 else None
            way = way_of(self.config, job, start, factor)
        except PlanError as error:
            return Refusal(ErrorId.INTERNAL, str(error))
        return held or self._objection(job, way, start.p) or way

    def _objection(self, job: Job, way: Way, start: float) -> Refusal | None:
        """Tell why a way that begins at `start` is not taken."""
        profile = way.profile
        refusal = overrun(self.config, job, profile, start) or missing_feed(job, profile, start, self._feed)
        return refusal or too_long(job, profile, self.override or 1.0)

    def _adopt(self, job: Job, way: Way) -> None:
        """Hand a profile to the store, and put its job in force."""
        if self._values[Q.TICK] != self._store.tick:  # else the job was replaced without having moved
            self._ran = self._job.limits if self._job is not None else None
        self._store.adopt(self._column, way.profile.pieces)
        self._put_in_force(job, way)

    def _put_in_force(self, job: Job, way: Way) -> None:
        """Note a job as the one that moves the axis, and leave in the store what a change of override needs."""
        values = self._values
        self._job = job
        self._show_job(job)
        self._set_limits(way.limits)
        values[Q.OVERRIDE] = self.override
        values[Q.JOB_KIND], values[Q.JOB_TARGET] = self._scalable(job)
        values[Q.JOB_V] = job.limits.velocity
        values[Q.COMMAND] = job.command.number if job.command is not None else 0
        pieces, to_position = way.profile.pieces, job.kind is JobKind.POSITION
        start, place, speed = pieces.item(0, 1), pieces.item(-1, 1), pieces.item(-1, 2)
        if math.isnan(job.start):  # else it is planned anew
            job.start = start
        values[Q.TARGET] = job.target if to_position else place if speed == 0.0 else math.nan
        if job.kind in SCALED:
            self._commanded = job.target if to_position else None
            forward = speed if speed != 0.0 else place - start
            self._heading = math.copysign(1.0, forward) if forward != 0.0 else self._heading

    def _show_job(self, job: Job) -> None:
        """Show in the flags of the interface that a job begins."""
        if job.kind not in SCALED:
            shown = HAS_JOB | BEEN_STOPPED
        else:
            shown = HAS_JOB | NEW_TARGET if self.set_velocity != 0.0 else HAS_JOB
        self._flag(shown, off=BEEN_STOPPED | NEW_TARGET)

    def _scalable(self, job: Job) -> tuple[int, float]:
        """Return how the override scales a job: a kind of `store.JOB_*`, and its target."""
        if job.kind is JobKind.POSITION:
            return JOB_POSITION, job.target
        if job.kind not in SCALED:
            return JOB_OTHER, 0.0
        if job.kind is JobKind.CONTINUOUS:
            return JOB_COMPOUND, 0.0
        end = limit_ahead(self.config, job.target)
        if job.kind in BOUNDED and math.isfinite(end):
            return JOB_POSITION, end
        return JOB_VELOCITY, job.target

    def _running(self) -> Limits:
        """Return the dynamics that a brake must not fall short of: those of the job that moves the axis."""
        if self._job is None:
            return self.config.default
        limits = self._job.limits
        if self._ran is None or self._values[Q.TICK] != self._store.tick:
            return limits
        return Limits(*(max(pair) for pair in zip(limits, self._ran, strict=True)))

    def _redefine(self, position: float) -> None:
        """Give the place where the axis stands another position: set, actual and drive stay where they are."""
        lag = self.set_position - self.actual_position
        self._values[Q.SHIFT] += position - self.set_position
        self._values[Q.ACTUAL_P] = position - lag  # so that no lag stays none, to the last bit
        self._set_plan(position)

    def _set_plan(self, position: float) -> None:
        """Let the setpoint of the resting axis be `position`, from this very tick on."""
        self._store.place(self._column, position)
        self._commanded = None
        self._values[Q.TARGET] = position
        self._set_limits(self.config.maximum)

    def _set_limits(self, limits: Limits) -> None:
        """Note the limits that are in force."""
        values = self._values
        values[Q.MAX_V], values[Q.MAX_A], values[Q.MAX_D], values[Q.MAX_J] = limits
