"""Coming to rest."""

import math
from typing import Unpack

from motionlayer.event import Kind, Level
from motionlayer.nc._arguments import Asked
from motionlayer.nc._keywords import BrakeKeywords, HaltKeywords, checked
from motionlayer.nc._limits import least_pull
from motionlayer.nc._motion import BRAKES, AxisCommand, HeldCommand, Job, JobKind
from motionlayer.nc._states import TRANSITIONS, AxisEvent, AxisState
from motionlayer.nc._submission import AxisSubmission
from motionlayer.profile import Limits


class AxisBraking(AxisSubmission):
    """Halt and stop; the arguments are those of `AxisBase`."""

    @property
    def under_way(self) -> bool:
        """A motion has not come to its end: the setpoint moves, or will."""
        return self._job is not None and not self._job.arrived

    @property
    def braking(self) -> bool:
        """The setpoint comes to rest by a halt, a stop, an error or a loss of power, and nothing follows."""
        job = self._job
        ends = job is not None and not job.arrived and job.kind in BRAKES
        return ends and self._homing is None and self._follower is None

    def halt(self, **keywords: Unpack[HaltKeywords]) -> AxisCommand:
        """Brake to rest; another command may take over at any time.

        The mode BUFFERED waits for rest. BLENDING_LOW and BLENDING_NEXT keep the target of the running command and
        brake there with these dynamics; BLENDING_PREVIOUS and BLENDING_HIGH go on to it and begin to brake there.

        Args:
            **keywords: see `HaltKeywords`.

        Raises:
            TypeError: a keyword is unknown, or of another type.
        """
        chosen = checked("halt", HaltKeywords, keywords)
        command = AxisCommand(self, "halt")
        limits = self._braking(command, chosen.asked)
        if limits is not None:
            job = Job(JobKind.HALT, math.nan, limits, command, monitored=bool(chosen.monitored))
            self._submit(command, AxisEvent.HALT, "halt()", lambda _start: job, chosen.buffering)
        return command

    def stop(self, *, hold: bool = False, **keywords: Unpack[BrakeKeywords]) -> HeldCommand:
        """Brake to rest; until then no other command is taken.

        Args:
            hold: keep the axis locked at rest, until `command.release()` or a `reset()`. `command.at_target` tells
                that it rests.
            **keywords: see `BrakeKeywords`.

        Raises:
            TypeError: a keyword is unknown, or of another type.
        """
        chosen = checked("stop", BrakeKeywords, keywords)
        command = HeldCommand(self, "stop", self._released)
        command.held = hold
        limits = self._braking(command, chosen.asked)
        if limits is not None:
            job = Job(JobKind.STOP, math.nan, limits, command, monitored=bool(chosen.monitored))
            self._submit(command, AxisEvent.STOP, "stop()", lambda _start: job)
        return command

    def emergency_stop(self) -> AxisCommand:
        """Brake with the maximum dynamics, also where a weaker stop runs; otherwise as `stop`."""
        command = AxisCommand(self, "emergency_stop")
        job = Job(JobKind.STOP, math.nan, self.config.maximum, command)
        self._submit(command, AxisEvent.EMERGENCY_STOP, "emergency_stop()", lambda _start: job)
        return command

    def abandon(self) -> AxisCommand | None:
        """Brake because nobody leads the axis any more: halt, or stop where a halt is not taken.

        Returns:
            The command that ends when the axis rests; None at rest, and in error, where it brakes by itself.
        """
        if self._job is None:
            return None
        legal = TRANSITIONS[self._state]
        if isinstance(legal[AxisEvent.HALT], AxisState):
            return self.halt()
        if isinstance(legal[AxisEvent.STOP], AxisState):
            return self.stop()
        if isinstance(self.command, HeldCommand):
            self.command.release()
        return self.command or self._power

    def left_alone(self) -> None:
        """Warn if the axis moves on: no program is left to lead it."""
        if self.under_way and not self.braking:
            what = self.command.name if self.command is not None else "a motion"
            text = f"still moves: {what} goes on, and the last program has ended; await it, or halt() before"
            self._tell(Level.WARNING, Kind.MESSAGE, text)

    def _braking(self, command: AxisCommand, asked: Asked) -> Limits | None:
        """Return the dynamics of a brake; None if they are refused.

        It falls not short of what it brakes, and is never too weak to be planned: nothing else stops the axis.
        """
        limits = self._dynamics(command, asked)
        if limits is None:
            return None
        running, (_, _, deceleration, own_jerk) = self._chained(), asked
        jerk = max(running.jerk, limits.jerk if own_jerk is not None else 0.0)
        own = limits.deceleration if deceleration is not None else 0.0
        least = least_pull(max(running.velocity, abs(self.set_velocity)), jerk)
        return running._replace(
            acceleration=max(running.acceleration, least), deceleration=max(running.deceleration, own, least), jerk=jerk
        )
