"""Two jobs planned together: the running one up to the joint, and from there on what waits for it.

The rules of the joint are those of `_ways`. Once the running job is to pass its joint in motion, both are one motion:

- near the joint it can no longer come to rest before it, and keeps its direction whatever the override does; what
  override 0 has carried past the joint, or too near to it for its acceleration to be taken back, is handed over there;
- only the way of both has been checked against the software limits. Where something brakes the axis on it (the
  override at 0, a halt) that is done as hard as the follower would brake: alone, the running job might come to rest far
  behind.
"""

import math

from motionlayer.command import ErrorId, Ledger
from motionlayer.event import EventLog
from motionlayer.nc._config import AxisConfig
from motionlayer.nc._follower import Follower
from motionlayer.nc._joints import joint_speeds
from motionlayer.nc._motion import Job, JobKind, Refusal
from motionlayer.nc._planning import AxisPlanning
from motionlayer.nc._through import Point, Way, arrival, remaining, settled, through
from motionlayer.nc._ways import scaled, way_of
from motionlayer.profile import Limits, plan_stop, stop_at
from motionlayer.store import Q, Store


def stronger(limits: Limits, other: Limits) -> Limits:
    """Return limits that brake as hard as the stronger of both."""
    return limits._replace(deceleration=max(limits.deceleration, other.deceleration), jerk=max(limits.jerk, other.jerk))


class AxisChaining(AxisPlanning):
    """Plans of a running and a waiting job; the arguments are those of `AxisBase`."""

    def __init__(self, config: AxisConfig, column: int, store: Store, ledger: Ledger, events: EventLog) -> None:
        super().__init__(config, column, store, ledger, events)
        self._follower: Follower | None = None

    def _rests_at_joint(self, running: Job, follower: Follower) -> bool:
        """Tell whether what the axis follows comes to rest at the joint, as the follower wants it.

        Then it goes on as it is. A plan from the midst of a brake would be the same but for the rounding of its start,
        and there the time grows with the third root of a way: the last bit of a position costs microseconds.
        """
        if self._held or self._values[Q.END_TIME] == math.inf:
            return False
        if tuple(self._values[Q.MAX_V : Q.MAX_J + 1].tolist()) != scaled(running, self.override):
            return False
        if running.kind is JobKind.HALT or not follower.buffering.blends:
            return True
        place, asked, _ = self._meeting(running, follower, self._arriving(running, follower), self.override)
        return asked == 0.0 and place == running.target

    def _meeting(self, running: Job, follower: Follower, heading: float, factor: float) -> tuple[float, float, float]:
        """Return where two blended jobs meet, the speed asked for there in a direction, and the highest one."""
        limits, place = scaled(running, factor), self._place(running, follower)
        speeds = joint_speeds(self.config, follower.buffering.mode, limits, heading, place, follower.job, factor)
        return place, *speeds

    def _arriving(self, running: Job, follower: Follower) -> float:
        """Return the direction in which the running job comes to its joint: as decided, or that of its way to rest."""
        kept = self._passing(self._place(running, follower), follower)
        return kept or arrival(self._here, running.target, running.limits)

    def _place(self, running: Job, follower: Follower) -> float:
        """Return where two blended jobs meet."""
        position = follower.buffering.position
        return running.target if position is None else position

    def _passing(self, place: float, follower: Follower) -> float:
        """Return the direction in which a joint ahead is to be passed in motion, 0 otherwise."""
        return follower.heading if (place - self.set_position) * follower.heading > 0.0 else 0.0

    def _first(self, running: Job, follower: Follower, factor: float) -> Way | Refusal:
        """Plan the running job up to its joint, under an override > 0.

        Raises:
            PlanError: the plan failed its check.
        """
        if running.kind is JobKind.HALT or not follower.buffering.blends:
            return way_of(self.config, running, self._here, factor)
        return self._to_joint(running, follower, self._arriving(running, follower), factor)

    def _to_joint(self, running: Job, follower: Follower, heading: float, factor: float) -> Way | Refusal:
        """Plan the running job up to a joint that it comes to in a direction.

        Raises:
            PlanError: the plan failed its check.
        """
        place, asked, highest = self._meeting(running, follower, heading, factor)
        reached = through(self._here, place, heading, asked, scaled(running, factor), highest)
        if reached is not None:
            return reached
        detail = f"at {place} at most {highest} {self.config.unit}/s are possible for the new one"
        return Refusal(ErrorId.DISTANCE_TOO_SHORT, detail)

    def _first_again(self, running: Job, follower: Follower) -> Way:
        """Plan the running job up to a joint that was accepted before, with the override.

        What override 0 holds brakes without regard to the joint. It may be carried past it, or so near to it that the
        acceleration cannot be taken back before.

        Raises:
            PlanError: a plan failed its check.
        """
        if follower.held and self._carried_past(running, follower):
            follower.beyond = True
        first = None if follower.beyond else self._first(running, follower, self.override)
        if isinstance(first, Way):
            return first
        follower.beyond, follower.heading = True, follower.heading or math.copysign(1.0, self.set_velocity)
        return self._beyond(running, follower)

    def _carried_past(self, running: Job, follower: Follower) -> bool:
        """Tell whether a joint lies behind; who comes to it only after a turn has not been there yet."""
        way = self._place(running, follower) - self.set_position
        return way * follower.heading < 0.0 <= self.set_velocity * follower.heading

    def _beyond(self, running: Job, follower: Follower) -> Way:
        """Plan the running job to where its follower takes over if the joint is as good as passed.

        That is where its acceleration has been taken back; where the follower could not brake from there, it goes on
        braking, and the follower takes over at rest. Nothing turns back for the joint, nor for a target behind that
        the follower is to pass.

        Raises:
            PlanError: a plan failed its check.
        """
        limits, heading, job = scaled(running, self.override), follower.heading, follower.job
        way = Way(plan_stop(*self._here, limits), limits)
        if heading * remaining(self._here, limits.jerk) > 0.0:
            onward = settled(self._here, limits)
            speeds = self.config, follower.buffering.mode, limits, heading, onward.end.p, job, self.override
            asked, highest = joint_speeds(*speeds)
            way = onward if asked > 0.0 and heading * onward.end.v <= highest else way
        if job.kind is JobKind.CONTINUOUS and (job.target - way.end.p) * heading <= 0.0:
            job.passed = heading
        return way

    def _second(self, job: Job, start: Point, factor: float) -> Way:
        """Plan the follower from its joint; passed in motion, it goes on in that direction.

        Raises:
            PlanError: the plan failed its check.
        """
        if job.kind is JobKind.CONTINUOUS:
            job.heading = math.copysign(1.0, start.v) if (job.target - start.p) * start.v > 0.0 else 0.0
        return way_of(self.config, job, start, factor)

    def _lend(self, running: Job, follower: Follower) -> None:
        """Let a job that cannot come to rest before a joint any more brake as hard as its follower would there.

        The way of both was checked, and not that on which the running job would come to rest alone.
        """
        place = self._place(running, follower)
        heading = self._passing(place, follower) if follower.way is not None else 0.0  # else this hold came before it
        if (stop_at(*self._here, running.limits) - place) * heading > 0.0:
            running.limits = stronger(running.limits, follower.job.limits)

    def _chained(self) -> Limits:
        """Return the dynamics that a brake must not fall short of, with those behind a joint that is to be passed."""
        running, follower = self._running(), self._follower
        return running if follower is None or follower.heading == 0.0 else stronger(running, follower.job.limits)
