"""The inside of an axis: state, job, plan, and what the cycle brings to it."""

import math
from typing import TYPE_CHECKING, NamedTuple

from motionlayer.command import ERRORS, Command, ErrorId, Ledger, MotionError
from motionlayer.event import Event, EventLog, Kind, Level
from motionlayer.nc._config import AxisConfig
from motionlayer.nc._motion import SCALED, AxisCommand, Job, JobKind, Refusal
from motionlayer.nc._states import NEED_POWER, TRANSITIONS, AxisEvent, AxisState
from motionlayer.profile import Limits, PlanError, Profile, plan_position, plan_stop, plan_velocity, rest_at
from motionlayer.store import Ended, Q, Store

if TYPE_CHECKING:
    from motionlayer.nc._homing import Homing


class AxisPlan(NamedTuple):
    """A profile as an axis took it over, for the trace.

    Attributes:
        tick: the tick whose setpoint it starts from; first sampled for the one after. `set` holds from its own tick.
        kind: `position`, `velocity`, `stop` or `set`.
        target: position or signed velocity; NaN for a stop.
        limits: that it was planned under, with the override.
        command: number of the command, 0 without.
    """

    axis: str
    tick: int
    command: int
    kind: str
    target: float
    limits: Limits
    profile: Profile


class AxisCore:
    """State, job and plan of one axis; `Axis` adds the commands.

    Args:
        config: what the machine description says.
        column: the coordinate in the store.
        store: setpoints and actual values.
        ledger: numbers and owners of commands.
        events: where the life of commands and errors is told.
        plans: where profiles are noted when they are taken over; whoever records clears it.
    """

    def __init__(
        self, config: AxisConfig, column: int, store: Store, ledger: Ledger, events: EventLog, plans: list[AxisPlan]
    ) -> None:
        self.config = config
        self.name = config.name
        self.ledger = ledger
        self.plans = plans
        self.homed = False
        self.error: MotionError | None = None
        self._column = column
        self._store = store
        self._table = store.table
        self._events = events
        self._state = AxisState.DISABLED
        self._job: Job | None = None
        self._homing: Homing | None = None
        self._profile = rest_at(self.set_position)
        self._power: AxisCommand | None = None
        self._reset: AxisCommand | None = None
        self._table[Q.OVERRIDE, column] = 1.0
        self._table[Q.STATE, column] = self._state
        self._table[Q.MIN_P, column] = config.limit_min
        self._table[Q.MAX_P, column] = config.limit_max
        self._set_plan(self.set_position)

    # -- what can be read ----------------------------------------------------------------------------------------

    @property
    def state(self) -> AxisState:
        """Present state."""
        return self._state

    @property
    def set_position(self) -> float:
        """Setpoint valid at the present tick, u."""
        return float(self._table[Q.SET_P, self._column])

    @property
    def set_velocity(self) -> float:
        """Setpoint valid at the present tick, u/s."""
        return float(self._table[Q.SET_V, self._column])

    @property
    def set_acceleration(self) -> float:
        """Setpoint valid at the present tick, u/s²."""
        return float(self._table[Q.SET_A, self._column])

    @property
    def actual_position(self) -> float:
        """What the drive reported in this tick, u."""
        return float(self._table[Q.ACTUAL_P, self._column])

    @property
    def override(self) -> float:
        """Factor on the velocity of every motion, 0 to 1."""
        return float(self._table[Q.OVERRIDE, self._column])

    @property
    def enabled(self) -> bool:
        """The drive is ready."""
        return bool(self._table[Q.READY, self._column])

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
        return max(0.0, self._profile.duration - float(passed))

    @property
    def _held(self) -> bool:
        """Override 0 keeps the job from coming to its end."""
        return self._job is not None and self._job.kind in SCALED and self.override == 0.0

    @property
    def in_velocity(self) -> bool:
        """The setpoint moves at the commanded velocity times the override, without acceleration."""
        job = self._job
        if job is None or job.kind is not JobKind.VELOCITY or self.set_acceleration != 0.0:
            return False
        return math.isclose(self.set_velocity, job.target * self.override, rel_tol=1e-12)

    # -- what the cycle brings -----------------------------------------------------------------------------------

    def drive_changed(self) -> None:
        """Take up a change of the drive's readiness or inputs."""
        if self.enabled and self._state is AxisState.DISABLED:
            self._set_plan(self.actual_position)
            self._enter(self._step(AxisEvent.READY))
        elif not self.enabled and self._job is not None and self._state is not AxisState.ERRORSTOP:
            self.fault(ErrorId.NOT_ENABLED, "the drive was switched off in motion")
        elif not self.enabled:
            self._enter(self._step(AxisEvent.OFF))
        if self._power is not None and bool(self._table[Q.ENABLE, self._column]) == self.enabled and not self._job:
            power, self._power = self._power, None
            self._end(power)
        if self._reset is not None and (self._job is None or self._state is not AxisState.ERRORSTOP):
            self._finish_reset()
        if self._homing is not None:
            self._homing.input_changed()

    def profile_ended(self, ended: Ended) -> None:
        """Take up that the profile came to its last piece."""
        job = self._job
        if job is None or self._held:
            return
        if job.command is not None and job.kind is not JobKind.SEARCH:
            job.command.end_time = self._store.tick * self._store.dt - ended.early
        if job.kind is JobKind.VELOCITY:
            if self._profile.pieces[-1, 2] == 0.0:
                up = job.target > 0.0
                self.fault(ErrorId.MAXIMUM_PASSED if up else ErrorId.MINIMUM_PASSED, self._limit_text(up=up))
        elif job.kind is JobKind.BRAKE and self._homing is not None:
            self._homing.at_rest()
        elif job.kind is not JobKind.SEARCH:
            self._at_rest(job)

    def fault(self, error: ErrorId, detail: str = "") -> None:
        """Put the axis in error: the running command ends with it, a moving axis brakes."""
        self.error = MotionError(error, self.name, detail)
        self._tell(Level.ERROR, Kind.MESSAGE, str(self.error), error)
        job, self._job = self._job, None
        self._homing = None
        self._enter(self._step(AxisEvent.FAULT))
        if job is not None and job.command is not None:
            self._fail(job.command, self.error)
        # A motion that began in this very tick is still at rest.
        if self.set_velocity != 0.0 or self.set_acceleration != 0.0 or self.remaining_time > 0.0:
            self._replan(Job(JobKind.BRAKE, math.nan, self.config.maximum, None))

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
        self._job = self._homing = None
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
        refusal = self._bad_target(job)
        if refusal is None:
            try:
                profile = self._planned(job)
                refusal = self._overrun(job, profile)
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
        if self.enabled == on and self._power is not None:
            power, self._power = self._power, None
            self._end(power)

    def _at_rest(self, job: Job) -> None:
        self._job = None
        self._enter(self._step(AxisEvent.AT_REST))
        if job.command is not None:
            self._end(job.command)
        if self._reset is not None:
            self._finish_reset()
        if self._power is not None and self._power.name.endswith("disable"):
            self._request_power(on=False)

    def _finish_reset(self) -> None:
        reset, self._reset = self._reset, None
        self._enter(self._step(AxisEvent.RESET if self.enabled else AxisEvent.RESET_OFF))
        self.error = None
        if reset is not None:
            self._end(reset)

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
        end = self.config.limit_max if job.target > 0.0 else self.config.limit_min
        if job.kind is JobKind.VELOCITY and math.isfinite(end):
            return plan_position(*state, end, limits)
        return plan_velocity(*state, math.copysign(limits.velocity, job.target), limits)

    def _scaled(self, job: Job) -> Limits:
        factor = self.override
        if job.kind not in SCALED or factor == 0.0:
            return job.limits
        return job.limits._replace(velocity=job.limits.velocity * factor)

    def _replan(self, job: Job) -> None:
        """Plan a job anew whose command is accepted already."""
        try:
            self._adopt(job, self._planned(job))
        except PlanError as error:
            self.fault(ErrorId.INTERNAL, str(error))

    def _bad_target(self, job: Job) -> Refusal | None:
        """Tell why a target cannot be commanded, before anything is planned."""
        low, high, here = self.config.limit_min, self.config.limit_max, self.set_position
        if job.kind is JobKind.POSITION and not math.isfinite(job.target):
            return Refusal(ErrorId.TARGET_NOT_FINITE, f"target = {job.target}")
        if job.kind is JobKind.POSITION and not low <= job.target <= high:
            unit = self.config.unit
            return Refusal(ErrorId.TARGET_OUTSIDE_LIMITS, f"target = {job.target}, allowed: {low} to {high} {unit}")
        if job.kind is JobKind.VELOCITY and here >= high and job.target > 0.0:
            return Refusal(ErrorId.ABOVE_MAXIMUM, self._limit_text(up=True))
        if job.kind is JobKind.VELOCITY and here <= low and job.target < 0.0:
            return Refusal(ErrorId.BELOW_MINIMUM, self._limit_text(up=False))
        return None

    def _overrun(self, job: Job, profile: Profile) -> Refusal | None:
        """Tell whether the way to the target leaves the software limits."""
        low, high, here = self.config.limit_min, self.config.limit_max, self.set_position
        blur = 1e-9 * (1.0 + abs(here))
        if job.kind not in (JobKind.POSITION, JobKind.VELOCITY) or (
            profile.low >= min(low, here) - blur and profile.high <= max(high, here) + blur
        ):
            return None
        reach = f"would reach {profile.low} to {profile.high}, allowed: {low} to {high} {self.config.unit}"
        return Refusal(ErrorId.OVERRUN, reach)

    def _limit_text(self, *, up: bool) -> str:
        limit = self.config.limit_max if up else self.config.limit_min
        return f"position = {self.set_position}, limit {limit} {self.config.unit}"

    def _adopt(self, job: Job, profile: Profile) -> None:
        """Hand a profile to the store, put its limits in force, note it for the trace."""
        self._job = job
        self._profile = profile
        self._store.adopt(self._column, profile.pieces)
        limits = self._scaled(job)
        self._table[Q.MAX_V : Q.MAX_J + 1, self._column] = limits
        command = job.command.number if job.command is not None else 0
        kind, target = self._kind(job, profile)
        self.plans.append(AxisPlan(self.name, self._store.tick, command, kind, target, limits, profile))

    def _kind(self, job: Job, profile: Profile) -> tuple[str, float]:
        """Say where a profile leads: an endless motion ends at a position where a software limit is ahead."""
        if job.kind not in SCALED or self.override == 0.0:
            return "stop", math.nan
        end = profile.pieces[-1]
        return ("position", float(end[1])) if end[2] == 0.0 else ("velocity", float(end[2]))

    def _redefine(self, position: float) -> None:
        """Give the place where the axis stands another position: set, actual and drive stay where they are."""
        lag = self.set_position - self.actual_position
        self._table[Q.SHIFT, self._column] += position - self.set_position
        self._table[Q.ACTUAL_P, self._column] = position - lag  # so that no lag stays none, to the last bit
        self._set_plan(position)

    def _set_plan(self, position: float) -> None:
        """Let the setpoint of the resting axis be `position`, from this very tick on."""
        self._store.place(self._column, position)
        self._profile = rest_at(position)
        maximum = self.config.maximum
        self._table[Q.MAX_V : Q.MAX_J + 1, self._column] = maximum
        self.plans.append(AxisPlan(self.name, self._store.tick, 0, "set", position, maximum, self._profile))

    # -- states and the life of commands -------------------------------------------------------------------------

    def _step(self, event: AxisEvent) -> AxisState:
        """Return the next state for an event that cannot be refused."""
        state = TRANSITIONS[self._state][event]
        assert isinstance(state, AxisState), (self._state, event)
        return state

    def _next(self, event: AxisEvent, command: AxisCommand) -> AxisState | None:
        """Return the next state, or refuse the command."""
        state = TRANSITIONS[self._state][event]
        switched_off = not self._table[Q.ENABLE, self._column]
        if switched_off and self._state is AxisState.STANDSTILL and event in NEED_POWER:
            state = ErrorId.NOT_ENABLED  # the drive follows the request in the next tick
        if isinstance(state, AxisState):
            return state
        self._refuse(command, Refusal(state, f"state {self._state.name}"))
        return None

    def _enter(self, state: AxisState) -> None:
        self._state = state
        self._table[Q.STATE, self._column] = state

    def _tell(self, level: Level, kind: Kind, text: str, code: int = 0, command: int = 0) -> None:
        self._events.add(Event(self.ledger.tick, level, kind, self.name, text, code, command))

    def _accept(self, command: AxisCommand, text: str) -> None:
        self._tell(Level.DEBUG, Kind.ACCEPTED, text, 0, command.number)

    def _refuse(self, command: AxisCommand, refusal: Refusal) -> AxisCommand:
        error = MotionError(refusal.id, self.name, refusal.detail)
        self._tell(Level.WARNING, Kind.REFUSED, f"{command.name}: {error}", refusal.id, command.number)
        command.fail(error)
        return command

    def _fail(self, command: AxisCommand, error: MotionError) -> None:
        self._tell(Level.ERROR, Kind.ERROR, ERRORS[error.id].text, error.id, command.number)
        command.fail(error)

    def _end(self, command: AxisCommand, by: Command[None] | None = None) -> None:
        """End a command done, or aborted by another one."""
        if by is None:
            self._tell(Level.DEBUG, Kind.DONE, command.name, 0, command.number)
            command.finish(None)
        else:
            self._tell(Level.DEBUG, Kind.ABORTED, f"{command.name} by {by.name}", 0, command.number)
            command.abort(by)
