"""The inside of an axis: its job, and what the cycle brings to it."""

import math
from typing import TYPE_CHECKING

from motionlayer.command import ErrorId, Ledger, MotionError
from motionlayer.event import EventLog, Kind, Level
from motionlayer.nc._config import AxisConfig
from motionlayer.nc._limits import bad_target, limit_text, overrun
from motionlayer.nc._monitors import IN_RANGE, IN_TARGET, Monitors, Seen
from motionlayer.nc._motion import SCALED, AxisCommand, Job, JobKind, Refusal
from motionlayer.nc._planning import AxisPlanning
from motionlayer.nc._reaction import REACTIONS, Reaction, status_error
from motionlayer.nc._states import AxisEvent, AxisState
from motionlayer.profile import PlanError
from motionlayer.store import JOB_OTHER, Ended, Q, Store

if TYPE_CHECKING:
    from motionlayer.nc._homing import Homing


class AxisCore(AxisPlanning):
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
        self.homed = False
        self._homing: Homing | None = None
        self._power: AxisCommand | None = None
        self._reset: AxisCommand | None = None
        self.monitors: Monitors | None = None
        self.faulted: list[int] | None = None
        self._set_plan(self.set_position)

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
        passed = (store.tick - self._table[Q.TICK, self._column]) * store.dt
        return max(0.0, float(store.end_of(self._column)[0] - passed))

    @property
    def _held(self) -> bool:
        """Override 0 keeps the job from coming to its end."""
        in_force = self._table[Q.OVERRIDE, self._column]
        return self._job is not None and self._job.kind in SCALED and (self.override == 0.0 or in_force == 0.0)

    @property
    def in_velocity(self) -> bool:
        """The setpoint moves at the commanded velocity times the override, without acceleration."""
        job = self._job
        if job is None or job.kind is not JobKind.VELOCITY or self.set_acceleration != 0.0:
            return False
        return math.isclose(self.set_velocity, job.target * self.override, rel_tol=1e-12)

    @property
    def in_target(self) -> bool:
        """InTargetPosition: inside the target window for its time; False without such a window."""
        return self.monitors is not None and self.monitors.flag(self._column, IN_TARGET)

    @property
    def in_position_area(self) -> bool:
        """InPositionArea: inside the range window; False without such a window."""
        return self.monitors is not None and self.monitors.flag(self._column, IN_RANGE)

    # -- what the cycle brings -----------------------------------------------------------------------------------

    def drive_changed(self) -> None:
        """Take up a change of the drive's readiness, status or inputs."""
        trouble = status_error(int(self._table[Q.STATUS, self._column]))
        if trouble is not None and self._state is not AxisState.ERRORSTOP:
            self.fault(*trouble)
        elif self.enabled and self._state is AxisState.DISABLED:
            self._set_plan(self.actual_position)
            self._enter(self._step(AxisEvent.READY))
        elif self.enabled and self._state is AxisState.ERRORSTOP and self._enabling:
            self._set_plan(self.actual_position)
        elif not self.enabled and self._missed:
            self.fault(ErrorId.NOT_ENABLED, "the drive lost its enable")
        elif not self.enabled:
            self._enter(self._step(AxisEvent.OFF))
        if self._power is not None and bool(self._table[Q.ENABLE, self._column]) == self.enabled and not self._job:
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
        wanted = self._job is not None or bool(self._table[Q.ENABLE, self._column])
        return wanted and self._state not in {AxisState.ERRORSTOP, AxisState.DISABLED}

    def monitored(self, seen: Seen) -> None:
        """Take up what the monitors found."""
        job = self._job
        waited = job is not None and job.arrived
        if seen.error is None and job is not None and waited:
            self._at_rest(job)
        elif seen.error is not None and self._state is not AxisState.ERRORSTOP and (waited or not seen.of_target):
            self.fault(seen.error, f"{seen.text} {self.config.unit}")

    def profile_ended(self, ended: Ended) -> None:
        """Take up that the profile came to its last piece."""
        job = self._job
        if job is None or self._held or job.arrived:
            return
        if job.command is not None and job.kind is not JobKind.SEARCH:
            job.command.end_time = self._store.tick * self._store.dt - ended.early
        if job.kind is JobKind.VELOCITY:
            if self._store.end_of(self._column)[2] == 0.0:
                up = job.target > 0.0
                self.fault(
                    ErrorId.MAXIMUM_PASSED if up else ErrorId.MINIMUM_PASSED,
                    limit_text(self.config, self.set_position, up=up),
                )
        elif job.kind is JobKind.BRAKE and self._homing is not None:
            self._homing.at_rest()
        elif job.kind is JobKind.POSITION and self.monitors is not None and self.monitors.waits(self._column):
            job.arrived = True
        elif job.kind is not JobKind.SEARCH:
            self._at_rest(job)

    def fault(self, error: ErrorId, detail: str = "") -> None:
        """Put the axis in error: the running command ends with it, and it comes to rest as `REACTIONS` says."""
        self.error = MotionError(error, self.name, detail)
        self._tell(Level.ERROR, Kind.MESSAGE, str(self.error), error)
        job = self._job
        self._drop_job()
        self._homing = None
        self._enter(self._step(AxisEvent.FAULT))
        if job is not None and job.command is not None:
            self._fail(job.command, self.error)
        # A motion that began in this very tick is still at rest.
        if self.set_velocity != 0.0 or self.set_acceleration != 0.0 or self.remaining_time > 0.0:
            self._replan(Job(JobKind.BRAKE, math.nan, self.config.maximum, None))
        if REACTIONS.get(error) is Reaction.POWER_OFF:
            self._cut_power()
        if self.faulted is not None:
            self.faulted.append(self._column)

    def search(self, velocity: float, command: AxisCommand) -> None:
        """Move with a signed velocity for the homing, software limits aside."""
        limits = self.config.default._replace(velocity=abs(velocity))
        self._replan(Job(JobKind.SEARCH, velocity, limits, command))

    def brake(self, command: AxisCommand) -> None:
        """Come to rest for the homing."""
        self._replan(Job(JobKind.BRAKE, math.nan, self.config.default, command))

    def finish_homing(self, position: float, command: AxisCommand) -> None:
        """Redefine the present position, end the homing."""
        self._redefine(position)
        self.homed = True
        self._drop_job()
        self._homing = None
        self._enter(self._step(AxisEvent.AT_REST))
        self._end(command)

    @property
    def at_home_input(self) -> bool:
        """The reference switch is on."""
        return bool(self._table[Q.HOME_INPUT, self._column])

    @property
    def home_latch(self) -> float:
        """Drive position at the last edge of the reference switch, in the present coordinate."""
        return float(self._table[Q.HOME_LATCH, self._column] + self._table[Q.SHIFT, self._column])

    def _start(self, job: Job, event: AxisEvent, text: str) -> None:
        """Take a motion over, or refuse it and change nothing."""
        command = job.command
        assert command is not None
        state = self._next(event, command)
        if state is None:
            return
        refusal = bad_target(self.config, job, self.set_position)
        if refusal is None:
            try:
                profile = self._planned(job)
                refusal = overrun(self.config, job, profile, self.set_position)
            except PlanError as error:
                refusal = Refusal(ErrorId.INTERNAL, str(error))
        if refusal is not None:
            self._refuse(command, refusal)
            return
        self._accept(command, text)
        if self._job is not None and self._job.command is not None:
            self._end(self._job.command, by=command)
        self._homing = None
        self._enter(state)
        command.activate()
        self._adopt(job, profile)

    def _request_power(self, *, on: bool) -> None:
        """Ask the drive; nothing to wait for where it is so already."""
        self._table[Q.ENABLE, self._column] = float(on)
        if self.enabled == on:
            self._power_switched()

    def _cut_power(self) -> None:
        """Take power away because of an error; who waits for it fails with that."""
        self._table[Q.ENABLE, self._column] = 0.0
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

    def _drop_job(self) -> None:
        """Nothing is being executed; an override has nothing to scale."""
        self._job = None
        self._table[Q.JOB_KIND, self._column] = JOB_OTHER

    def _at_rest(self, job: Job) -> None:
        self._drop_job()
        self._enter(self._step(AxisEvent.AT_REST))
        if job.command is not None:
            self._end(job.command)
        if self._reset is not None:  # set and actual position are of one tick with the next inputs
            self._store.status_changed.append(self._column)
        if self._power is not None and self._power.name.endswith(".disable"):
            self._request_power(on=False)

    def _finish_reset(self) -> None:
        """Leave the error, once the drive has left its own; the set position becomes the actual one."""
        if self._table[Q.STATUS, self._column] != 0.0:
            self._table[Q.DRIVE_RESET, self._column] = 1.0  # its answer brings us here again
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
        try:
            self._adopt(job, self._planned(job))
        except PlanError as error:
            self.fault(ErrorId.INTERNAL, str(error))
