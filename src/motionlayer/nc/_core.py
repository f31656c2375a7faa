"""The inside of an axis: its job, and what the cycle brings to it."""

import math
from collections.abc import Callable

from motionlayer.command import ErrorId, Ledger, MotionError
from motionlayer.event import EventLog, Kind, Level
from motionlayer.nc._axis_ref import HAS_JOB, NEW_TARGET
from motionlayer.nc._config import AxisConfig
from motionlayer.nc._cycle import AxisCycle
from motionlayer.nc._limits import limit_text
from motionlayer.nc._monitors import Monitors, Seen
from motionlayer.nc._motion import BOUNDED, AxisCommand, HeldCommand, Job, JobKind
from motionlayer.nc._progress import AxisProgress
from motionlayer.nc._reaction import REACTIONS, Reaction, status_error
from motionlayer.nc._states import AxisEvent, AxisState
from motionlayer.profile import PlanError
from motionlayer.store import JOB_OTHER, Ended, Q, Store, Watch


class AxisCore(AxisProgress):
    """Job of one axis; `Axis` adds the commands.

    Args:
        config: what the machine description says.
        column: the coordinate in the store.
        store: setpoints and actual values.
        ledger: numbers and owners of commands.
        events: where the life of commands and errors is told.
    """

    def __init__(self, config: AxisConfig, column: int, store: Store, ledger: Ledger, events: EventLog) -> None:
        super().__init__(config, column, store, ledger, events)
        self._bound: Watch | None = None
        self._power: AxisCommand | None = None
        self._reset: AxisCommand | None = None
        self._faulted: list[int] | None = None
        self.cycle = AxisCycle(
            self._attach, self._drive_changed, self._monitored, self._profile_ended, self._override_changed
        )
        """For the stage of the axes alone."""
        self._set_plan(self.set_position)

    # -- what the cycle brings -----------------------------------------------------------------------------------

    def _attach(self, monitors: Monitors, faulted: list[int] | None, configured: Callable[[int], None]) -> None:
        """Take over what the axes of a machine share."""
        self._monitors, self._faulted, self._configured = monitors, faulted, configured

    def _drive_changed(self) -> None:
        """Take up a change of the drive's readiness, status or inputs."""
        trouble = status_error(int(self._values[Q.STATUS]))
        if trouble is not None and self._state is not AxisState.ERRORSTOP:
            self.fault(*trouble)
        elif self.enabled and self._state is AxisState.DISABLED:
            self._set_plan(self.actual_position)
            self._enter(self._step(AxisEvent.READY))
        elif self.enabled and self._state is AxisState.ERRORSTOP and self._enabling and self._job is None:
            self._set_plan(self.actual_position)
        elif not self.enabled and self._missed:
            self.fault(ErrorId.NOT_ENABLED, "the drive lost its enable")
        elif not self.enabled:
            # Set and actual position part (decision 0013); who waits for power asks again at rest.
            if self._state is AxisState.ERRORSTOP and (self._job is not None or not self._enabling):
                self._values[Q.ENABLE] = 0.0
            self._enter(self._step(AxisEvent.OFF))
        if self._power is not None and bool(self._values[Q.ENABLE]) == self.enabled and not self._job:
            self._power_switched()
        if self._reset is not None and (self._job is None or self._state is not AxisState.ERRORSTOP):
            self._finish_reset()
        if self._homing is not None:
            self._homing.input_changed()

    @property
    def _enabling(self) -> bool:
        """Somebody waits for power."""
        return self._power is not None and self._power.name.endswith(".enable")

    @property
    def _missed(self) -> bool:
        """Power that is gone was needed."""
        wanted = self._job is not None or bool(self._values[Q.ENABLE])
        return wanted and self._state not in {AxisState.ERRORSTOP, AxisState.DISABLED}

    def _monitored(self, seen: Seen) -> None:
        """Take up what the monitors found."""
        job = self._job
        waited = job is not None and job.watched
        if seen.error is None and job is not None and waited:
            self._watch_window(job, on=False)
            if not job.locks:
                self._at_rest(job)
        elif seen.error is not None and self._state is not AxisState.ERRORSTOP and (waited or not seen.of_target):
            unit = self.config.unit
            weak = "" if seen.torque is None else f"; the torque of the drive allows {seen.torque:.9g} {unit}/s²"
            self.fault(seen.error, f"{seen.text} {unit}{seen.per}{weak}")

    def _profile_ended(self, ended: Ended) -> None:
        """Take up that the profile came to its last piece."""
        if ended.went_on:
            self._guarded(lambda: self._went_on(ended))
            return
        job = self._job
        if job is None or self._held or job.arrived:
            return
        if job.command is not None and job.kind is not JobKind.SEARCH:
            job.command.end_time = self._store.tick * self._store.dt - ended.early
        if job.kind in BOUNDED:
            if self._store.end_of(self._column)[2] == 0.0:
                self._at_limit(job)
        elif job.kind is JobKind.BRAKE and self._homing is not None:
            self._homing.at_rest()
        elif self._waits_for_more(job):
            job.arrived = True
        elif job.kind is not JobKind.SEARCH:
            self._at_rest(job)

    def _waits_for_more(self, job: Job) -> bool:
        """Tell whether a job whose setpoint has come to its end waits: for the actual position, or to be released."""
        if self._has_window(job):
            self._watch_window(job, on=True)
        return job.watched or job.locks

    def _watch_window(self, job: Job, *, on: bool) -> None:
        """Wait for the actual position, or not any more."""
        job.watched = on
        if isinstance(job.command, HeldCommand):
            job.command.watched = on
        if on and self._monitors is not None:
            self._monitors.wait(self._column)

    def _at_limit(self, job: Job) -> None:
        """Take up that an endless motion has come to rest on a software limit; a jog may stay there."""
        if job.kind is JobKind.JOG:
            job.arrived = True
            return
        up = self._heading > 0.0
        error = ErrorId.MAXIMUM_PASSED if up else ErrorId.MINIMUM_PASSED
        self.fault(error, limit_text(self.config, self.set_position, up=up))

    def _override_changed(self) -> None:
        """Plan anew what only the axis can plan."""
        if self._job is not None:
            self._guarded(self._plan_anew)

    def _released(self, command: HeldCommand) -> None:
        """Take up that a command is held no longer: a jog brakes, and what rests already ends with this tick."""
        job = self._job
        if job is None or job.command is not command:
            return
        if job.kind is JobKind.JOG:
            self._replan(Job(JobKind.HALT, math.nan, job.limits, command))
        elif job.arrived and not job.watched:
            self._replan(Job(job.kind, math.nan, job.limits, command))

    def fault(self, error: ErrorId, detail: str = "") -> None:
        """Put the axis in error: the running command ends with it, and it comes to rest as `REACTIONS` says."""
        self.error = MotionError(error, self.name, detail)
        self._tell(Level.ERROR, Kind.MESSAGE, str(self.error), error)
        job = self._job
        self._drop_job()
        self._leave_homing()
        self._enter(self._step(AxisEvent.FAULT))
        if job is not None and job.command is not None:
            self._fail(job.command, self.error)
        self._drop_follower(error=self.error)
        # A motion that began in this very tick is still at rest; one that would begin is dropped with its row.
        begins = self.remaining_time > 0.0 or bool(self._store.appended[self._column])
        if self.set_velocity != 0.0 or self.set_acceleration != 0.0 or begins:
            self._replan(Job(JobKind.BRAKE, math.nan, self.config.maximum, None))
        if REACTIONS.get(error) is Reaction.POWER_OFF:
            self._cut_power()
        if self._faulted is not None:
            self._faulted.append(self._column)

    def _request_power(self, *, on: bool) -> None:
        """Ask the drive; nothing to wait for where it is so already."""
        self._values[Q.ENABLE] = float(on)
        if self.enabled == on:
            self._power_switched()

    def _cut_power(self) -> None:
        """Take power away because of an error; who waits for it fails with that."""
        self._values[Q.ENABLE] = 0.0
        if self._power is not None and self._enabling and self.error is not None:
            power, self._power = self._power, None
            self._fail(power, self.error)

    def _power_switched(self) -> None:
        """End the command that asked for it; an error that came in between is its end too."""
        power, self._power = self._power, None
        if power is not None and self.enabled and self.error is not None:
            self._fail(power, self.error)
        elif power is not None:
            self._end(power)

    def _leave_homing(self) -> None:
        """No homing is under way, whatever its phase was; nothing is to be latched for it."""
        if self._homing is None:
            return
        self._homing = None
        self._values[Q.HOMING] = 0.0
        self._values[Q.LATCH_ASKED] = 0.0
        if self._bound is not None:
            self._store.unwatch(self._bound)
            self._bound = None

    def _drop_job(self) -> None:
        """Nothing is being executed; an override has nothing to scale."""
        self._job = None
        self._flag(off=HAS_JOB | NEW_TARGET)
        self._values[Q.JOB_KIND] = JOB_OTHER

    def _at_rest(self, job: Job) -> None:
        self._drop_job()
        self._enter(self._step(AxisEvent.AT_REST))
        if job.command is not None:
            self._end(job.command)
        if self._follower is not None:
            self._guarded(self._begin_follower)
        if self._reset is not None:  # set and actual position are of one tick with the next inputs
            self._store.status_changed.append(self._column)
        if self._power is not None and self._job is None:
            self._request_power(on=self._enabling)

    def _finish_reset(self) -> None:
        """Leave the error, once the drive has left its own; the set position becomes the actual one."""
        if self._values[Q.STATUS] != 0.0:
            self._values[Q.DRIVE_RESET] = 1.0  # its answer brings us here again
            return
        reset, self._reset = self._reset, None
        if self._state is AxisState.ERRORSTOP and self.actual_position != self.set_position:
            self._set_plan(self.actual_position)
        self._enter(self._step(AxisEvent.RESET if self.enabled else AxisEvent.RESET_OFF))
        self.error = None
        if reset is not None:
            self._end(reset)

    def _replan(self, job: Job) -> None:
        """Plan a job anew whose command is accepted already."""
        self._guarded(lambda: self._adopt(job, self._planned(job)))

    def _guarded(self, plan: Callable[[], None]) -> None:
        """Plan what is accepted already; where that fails the axis does."""
        try:
            plan()
        except PlanError as error:
            self.fault(ErrorId.INTERNAL, str(error))
