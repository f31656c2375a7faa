"""The buffer of an axis: one command runs, one waits for it.

The plan of the waiting one is appended to the row of the axis at acceptance, so that the change costs no time: it
happens at the exact instant inside the cycle. How both are planned is told in `_chaining`; what can be commanded when
is function-blocks 2.8, and record 25 where that leaves a choice. A change of the override plans both anew.
"""

import math
from typing import TYPE_CHECKING

from motionlayer.command import Command, ErrorId, Ledger, MotionError
from motionlayer.event import EventLog
from motionlayer.nc._axis_ref import BUFFERED
from motionlayer.nc._chaining import AxisChaining, stronger
from motionlayer.nc._config import AxisConfig, BufferMode
from motionlayer.nc._follower import Buffering, Follower
from motionlayer.nc._limits import bad_target, too_weak
from motionlayer.nc._motion import DEFINITE, SCALED, AxisCommand, Job, JobKind, Refusal
from motionlayer.nc._through import Point, Way, arrival
from motionlayer.nc._ways import scaled, way_of
from motionlayer.profile import PlanError
from motionlayer.store import JOB_BRAKE, JOB_COMPOUND, Ended, Q, Store

if TYPE_CHECKING:
    from motionlayer.nc._monitors import Monitors


class AxisBuffer(AxisChaining):
    """The buffer; the arguments are those of `AxisBase`."""

    def __init__(self, config: AxisConfig, column: int, store: Store, ledger: Ledger, events: EventLog) -> None:
        super().__init__(config, column, store, ledger, events)
        self._monitors: Monitors | None = None

    @property
    def buffered(self) -> AxisCommand | None:
        """The command that waits for the running one."""
        return self._follower.job.command if self._follower is not None else None

    def _joint(self, buffering: Buffering) -> float | Refusal | None:
        """Return where a command would begin that is given now; None for at once."""
        job = self._job
        if buffering.mode is BufferMode.ABORTING or job is None or job.kind not in DEFINITE:
            return None
        if self._follower is not None:
            return Refusal(ErrorId.BUFFER_FULL, "one command runs and one is buffered")
        end = self._end_of(job)
        if not buffering.blends:
            return end
        if job.arrived:
            return Refusal(ErrorId.DISTANCE_TOO_SHORT, "the setpoint of the running command has come to its target")
        return end if buffering.position is None else self._blending_position(job, end, buffering.position)

    def _end_of(self, job: Job) -> float:
        """Return where a definite job ends."""
        return job.target if job.kind is JobKind.POSITION else float(self._store.end_of(self._column)[1])

    def _blending_position(self, job: Job, end: float, place: float) -> float | Refusal | None:
        """Return a joint before the end of a job; None where it has been passed."""
        unit = self.config.unit
        if not math.isfinite(place):
            return Refusal(ErrorId.TARGET_NOT_FINITE, f"blending_position = {place}")
        heading = arrival(self._here, end, scaled(job, self.override))
        behind = (end - place) * heading < 0.0
        if not behind and (place - self.set_position) * heading > 0.0:
            return place
        if behind or (place - job.start) * heading < 0.0:
            allowed = f"allowed: from {job.start}, where the running command began, to {end} {unit}"
            return Refusal(ErrorId.BLENDING_POSITION, f"blending_position = {place}, {allowed}")
        return None

    def _follow(self, job: Job, buffering: Buffering, text: str) -> None:
        """Let a job wait for the running one, or refuse it and change nothing."""
        running, command = self._job, job.command
        assert running is not None
        assert command is not None
        follower = Follower(job, buffering, held=self._held)
        limits = running.limits
        if job.kind is JobKind.HALT:
            running.limits = stronger(limits, job.limits)
        ways = self._fitted(running, follower)
        if isinstance(ways, Refusal):
            running.limits = limits
            self._refuse(command, ways)
            return
        self._accept(command, text)
        self._set_follower(follower)
        follower.heading = 0.0 if ways[0] is None else ways[0].heading
        if self._hands_over(running, follower):
            self._chain(running, follower, *ways)

    def _set_follower(self, follower: Follower | None) -> None:
        """Let a command wait, or nothing any more."""
        self._follower = follower
        self._flag(BUFFERED if follower is not None else 0, off=BUFFERED)

    def _fitted(self, running: Job, follower: Follower) -> tuple[Way | None, Way] | Refusal:
        """Plan both jobs, or tell why one cannot follow the other; what override 0 holds is judged at 1.

        Returns:
            Both ways; None for the first where what the axis follows leads to the joint already.
        """
        job, end, here, factor = follower.job, self._end_of(running), self.set_position, self.override or 1.0
        if follower.buffering.blends and job.kind is JobKind.POSITION and job.target == end:
            return Refusal(ErrorId.SAME_END_POSITION, f"target = {end} {self.config.unit}, as of the running command")
        fastest = max(running.limits.velocity, job.limits.velocity)
        refusal = bad_target(self.config, job, end) or too_weak(job, fastest, self.config.unit)
        refusal = refusal or too_weak(running, fastest, self.config.unit)
        if refusal is not None:
            return refusal
        try:
            first = None if self._rests_at_joint(running, follower) else self._first(running, follower, factor)
            if isinstance(first, Refusal):
                return first
            start = Point(end, 0.0, 0.0) if first is None else first.end
            second = self._second(job, start, factor)
        except PlanError as error:
            return Refusal(ErrorId.INTERNAL, str(error))
        objection = self._objection(running, first, here) if first is not None else None
        objection = objection or self._objection(job, second, start.p)
        if objection is not None:
            return objection
        held = running.kind is JobKind.HALT and self.override == 0.0  # a halt is not held, what follows it is
        return first, way_of(self.config, job, start, 0.0) if held else second

    def _chain(self, running: Job, follower: Follower, first: Way | None, second: Way) -> None:
        """Put both jobs into the row of the axis; None for the first leaves what is in it."""
        follower.way = second
        if first is not None:
            self._adopt(running, first)
            follower.heading = follower.heading if follower.beyond else first.heading
        self._store.append(self._column, follower.way.profile.pieces)
        self._values[Q.JOB_KIND] = JOB_COMPOUND if running.kind in SCALED else JOB_BRAKE

    def _hands_over(self, running: Job, follower: Follower) -> bool:
        """Tell whether the end of the setpoint is all that a follower waits for: not for the actual position too."""
        if running.arrived or self._held:
            return False
        return follower.buffering.blends or not self._has_window(running)

    def _has_window(self, job: Job) -> bool:
        """Tell whether a job ends only when the actual position has come into its window."""
        return job.monitored and self._monitors is not None and self._monitors.waits_for_target(self._column)

    def _went_on(self, ended: Ended) -> None:
        """Take up that the running job handed over to its follower inside the last cycle."""
        running, follower = self._job, self._follower
        assert running is not None
        assert follower is not None
        assert follower.way is not None
        assert follower.job.event is not None
        self._set_follower(None)
        self._enter(self._step(follower.job.event))
        if running.command is not None:
            running.command.end_time = self._store.tick * self._store.dt - ended.early
            self._end(running.command)
        if follower.job.command is not None:
            follower.job.command.activate()
        self._put_in_force(follower.job, follower.way)
        self._store.begun(self._column)

    def _begin_follower(self) -> None:
        """Let the follower begin from rest, at the present tick."""
        follower = self._follower
        self._set_follower(None)
        assert follower is not None
        job = follower.job
        assert job.event is not None
        self._enter(self._step(job.event))
        if job.command is not None:
            job.command.activate()
        self._adopt(job, self._planned(job))

    def _plan_anew(self) -> None:
        """Plan the running job, and what follows it, from the present setpoint.

        Raises:
            PlanError: a plan failed its check.
        """
        job, follower = self._job, self._follower
        assert job is not None
        if follower is not None and self._hands_over(job, follower):
            first = self._first_again(job, follower)
            self._chain(job, follower, first, self._second(follower.job, first.end, self.override))
            return
        if follower is not None and self._held:
            follower.held = True
            self._lend(job, follower)
        self._passed_already(job)
        self._adopt(job, self._planned(job))
        if follower is not None and job.kind in SCALED:
            self._values[Q.JOB_KIND] = JOB_COMPOUND

    def _passed_already(self, job: Job) -> None:
        """Let a job that has passed its target not go back to it, also where the override held it behind."""
        if job.kind is not JobKind.CONTINUOUS or job.passed != 0.0:
            return
        beyond = (self.set_position - job.target) * job.heading
        if self._reached(job) or (beyond > 0.0 and self.set_velocity * job.heading >= 0.0):
            job.passed = job.heading

    def _reached(self, job: Job) -> bool:
        """Tell whether CONTINUOUS has passed its target."""
        return self._store.since(self._column) >= job.reach

    def _drop_follower(self, by: Command[None] | None = None, error: MotionError | None = None) -> None:
        """Empty the buffer: what waited ends aborted by a command, or with the error of the axis."""
        follower = self._follower
        if follower is None:
            return
        self._set_follower(None)
        if follower.job.command is None:
            return
        if error is not None:
            self._fail(follower.job.command, error)
        else:
            self._end(follower.job.command, by=by)
