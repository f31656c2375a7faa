"""Homing and the definition of positions."""

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Unpack

from motionlayer.command import ErrorId
from motionlayer.nc._arguments import member, number, required
from motionlayer.nc._config import Calibration, HomeConfig, HomingMode
from motionlayer.nc._follower import Follower
from motionlayer.nc._home_keywords import HomeKeywords, asked_home, told
from motionlayer.nc._homing import LATCHES, HomeCommand, Homing
from motionlayer.nc._homing_port import HomingPort
from motionlayer.nc._limits import bad_place, too_weak
from motionlayer.nc._motion import TARGETED, AxisCommand, Job, JobKind, Refusal
from motionlayer.nc._states import AxisEvent, AxisState
from motionlayer.nc._submission import AxisSubmission
from motionlayer.profile import PlanError, stop_at
from motionlayer.store import Q, Watch

if TYPE_CHECKING:
    from motionlayer.nc._homing_port import Step


class AxisReferencing(AxisSubmission):
    """The coordinate of an axis; the arguments are those of `AxisBase`."""

    _offset = 0.0
    """What `set_position` has shifted the coordinate since the last homing, u."""

    def home(
        self,
        position: float | None = None,
        mode: Calibration = Calibration.DEFAULT,
        **keywords: Unpack[HomeKeywords],
    ) -> HomeCommand:
        """Find the reference; done when the axis is homed and at rest.

        Args:
            position: of the reference, u; that of the machine description where left out.
            mode: DEFAULT finds it in the way the machine description says, DIRECT takes the present position; FORCE and
                RESET only change whether the axis counts as homed.
            **keywords: see `HomeKeywords`.

        Raises:
            TypeError: an argument is not a number, or of another enumeration, or a keyword unknown.
        """
        command = HomeCommand(self, "home")
        kind = member("mode", mode, Calibration)
        home = asked_home(self.config, number("position", position), keywords)
        if isinstance(home, Refusal):
            self._refuse(command, home)
            return command
        home = home._replace(mode=HomingMode.DIRECT) if kind is Calibration.DIRECT else home
        state = self._next(AxisEvent.HOME, command)
        if state is None:
            return command
        refusal = self._unfit(command) if kind is Calibration.DEFAULT and home.mode is not HomingMode.DIRECT else None
        if refusal is not None:
            self._refuse(command, refusal)
            return command
        self._accept(command, told(home, self.config.home) if kind is Calibration.DEFAULT else f"home({kind.name})")
        if kind in (Calibration.FORCE, Calibration.RESET):
            self.homed = kind is Calibration.FORCE
            self._end(command)
            return command
        self._enter(state)
        if keywords.get("clear_lag") and kind is Calibration.DIRECT:
            self._set_plan(self.actual_position)
        self._homing = command.homing = Homing(self._homing_port(home), command, cam=bool(keywords.get("cam")))
        self._homing.begin()
        return command

    def _unfit(self, command: AxisCommand) -> Refusal | None:
        """Tell why nothing can be searched: a direction is not released, or the default dynamics are too weak."""
        if not all(self._feed):
            return Refusal(ErrorId.FEED_NOT_ENABLED, "a homing needs both directions")
        search = Job(JobKind.SEARCH, math.nan, self.config.default, command)
        return too_weak(search, self.config.maximum.velocity, self.config.unit)

    def define_position(
        self,
        position: float = 0.0,
        *,
        relative: bool = False,
        clear_lag: bool = False,
        clear_offset: bool = False,
        encoder: int = 0,
    ) -> AxisCommand:
        """Give the place where the axis is another position (MC_SetPosition); done at once.

        In motion it may be shifted (`relative`): targets, also that of a buffered command, are shifted with it.

        Args:
            position: new actual position, u; with `relative` what is added to the present one.
            relative: shift the coordinate.
            clear_lag: the set position becomes the actual one; else it moves by the same amount, so that the lag stays.
            clear_offset: go back to the coordinate of the last homing; the position is ignored.
            encoder: whose position; an axis has the encoder 0 alone.

        Raises:
            TypeError: the position is not a number, or the encoder not an integer.
        """
        command = AxisCommand(self, "define_position")
        place = 0.0 if clear_offset else required("position", position)
        shift = -self._offset if clear_offset else place if relative else place - self.actual_position
        outside = _bad_encoder(encoder) or bad_place("position", place, self.config.unit)
        outside = outside or bad_place("resulting position", self.actual_position + shift, self.config.unit)
        if outside is not None:
            return self._refuse(command, outside)
        moves = self._job is not None
        if self._state in (AxisState.ERRORSTOP, AxisState.HOMING) or (moves and (clear_lag or not relative)):
            detail = f"state {self._state!s}, allowed: at rest, in motion only relative and without clear_lag"
            return self._refuse(command, Refusal(ErrorId.GROUP_BUSY, detail))
        refusal = self._misplaced(shift) if moves else None
        if refusal is not None:
            return self._refuse(command, refusal)
        self._accept(command, f"define_position(position={place}, {relative=}, {clear_lag=}, {clear_offset=})")
        if clear_lag:
            self._set_plan(self.actual_position)
        self._offset += shift
        if moves:
            self._shift(shift)
        else:
            self._redefine(self.set_position + shift)
        self._end(command)
        return command

    def _misplaced(self, way: float) -> Refusal | None:
        """Tell why the coordinate cannot be shifted in motion: what was commanded would lie outside its limits."""
        job, low, high = self._job, self.config.limit_min, self.config.limit_max
        if job is None:
            return None
        places = [stop_at(*self._here, self._chained())]
        places += [one.target for one in self._targeted()]
        for place in places:
            if not low <= place + way <= high:
                text = f"position {place + way}, allowed: {low} to {high} {self.config.unit}"
                return Refusal(ErrorId.TARGET_OUTSIDE_LIMITS, text)
        self._passed_already(job)
        if self._follower is not None and self._hands_over(job, self._follower):
            return self._chain_misplaced(job, self._follower, way)
        shifted = replace(job, target=job.target + way) if job in self._targeted() else job
        planned = self._checked(shifted, self._here._replace(p=self.set_position + way))
        return planned if isinstance(planned, Refusal) else None

    def _chain_misplaced(self, job: Job, follower: Follower, way: float) -> Refusal | None:
        """Tell why the coordinate cannot be shifted under two motions that are one: not what either does alone.

        To shift the coordinate is to shift the software limits against it, the other way.
        """
        config, trial = self.config, replace(follower, job=replace(follower.job))
        self.config = config._replace(limit_min=config.limit_min - way, limit_max=config.limit_max - way)
        try:
            first = self._first_again(job, trial)
            second = self._second(trial.job, first.end, self.override)
            return self._objection(job, first, self.set_position) or self._objection(trial.job, second, first.end.p)
        except PlanError as error:
            return Refusal(ErrorId.INTERNAL, str(error))
        finally:
            self.config = config

    def _targeted(self) -> list[Job]:
        """Return the running and the buffered job, where they have a target position."""
        jobs = [self._job, self._follower.job if self._follower is not None else None]
        return [one for one in jobs if one is not None and one.kind in TARGETED]

    def _shift(self, way: float) -> None:
        """Shift the coordinate in motion, with all that was commanded in it."""
        for job in self._targeted():
            job.target += way
        if self._job is not None:
            self._job.start += way
        follower = self._follower
        if follower is not None and follower.buffering.position is not None:
            follower.buffering = follower.buffering._replace(position=follower.buffering.position + way)
        commanded = self._commanded
        self._values[Q.SHIFT] += way
        self._values[Q.ACTUAL_P] += way
        self._store.shift(self._column, way)
        self._guarded(self._plan_anew)
        self._commanded = None if commanded is None else commanded + way

    def _homing_port(self, home: HomeConfig) -> HomingPort:
        """Return what a homing sees and does of this axis."""
        return HomingPort(
            config=self.config._replace(home=home),
            place=lambda: self.set_position,
            actual=lambda: self.actual_position,
            switch=lambda: bool(self._values[Q.HOME_INPUT]),
            edge=lambda: self._values[Q.HOME_LATCH] + self._values[Q.SHIFT],
            latched=self._latched,
            arm=lambda: self._arm_latch(LATCHES[home.mode]),
            search=self._search,
            brake=lambda command: self._replan(Job(JobKind.BRAKE, math.nan, self.config.default, command)),
            show=self._show_phase,
            guard=self._guard,
            finish=self._finish_homing,
            fault=self.fault,
        )

    def _search(self, velocity: float, command: AxisCommand) -> None:
        """Move with a signed velocity for the homing, software limits aside."""
        limits = self.config.default._replace(velocity=abs(velocity))
        self._replan(Job(JobKind.SEARCH, velocity, limits, command))

    def _show_phase(self, phase: int) -> None:
        self._values[Q.HOMING] = phase

    def _guard(self, position: float, homing: Homing) -> None:
        """Tell a homing when the setpoint passes a position, if it is still in the same step then."""
        step: Step = homing.step

        def passed(_early: float) -> None:
            if self._homing is homing:
                homing.too_far(step)

        if self._bound is not None:
            self._store.unwatch(self._bound)
        self._bound = Watch(self._column, position, passed)
        self._store.watch(self._bound)

    def _finish_homing(self, position: float, command: AxisCommand) -> None:
        """Redefine the present position, end the homing."""
        self._redefine(position)
        self._offset = 0.0
        self.homed = True
        self._drop_job()
        self._leave_homing()
        self._enter(self._step(AxisEvent.AT_REST))
        self._end(command)

    def _latched(self) -> float | None:
        """Return what came since the latch was armed, in the present coordinate; None while it waits."""
        if self._values[Q.LATCH_ASKED] != 0.0:
            return None
        return self._values[Q.LATCH_P] + self._values[Q.SHIFT]

    def _arm_latch(self, asked: int) -> None:
        """Let the drive latch the next signal of one kind, one of `Latch`."""
        self._values[Q.LATCH_ASKED] = asked


def _bad_encoder(encoder: int) -> Refusal | None:
    if isinstance(encoder, bool) or not isinstance(encoder, int):
        raise TypeError(f"encoder is {encoder!r}, a {type(encoder).__name__}; it must be an integer")
    if encoder == 0:
        return None
    return Refusal(ErrorId.ENCODER_ID, f"encoder = {encoder}, allowed: 0; an axis has one encoder")
