"""Coming to rest."""

import math

from motionlayer.nc._config import BufferMode
from motionlayer.nc._motion import AxisCommand, HeldCommand, Job, JobKind
from motionlayer.nc._positioning import buffering_of
from motionlayer.nc._states import TRANSITIONS, AxisEvent, AxisState
from motionlayer.nc._submission import AxisSubmission
from motionlayer.profile import Limits


class AxisBraking(AxisSubmission):
    """Halt and stop; the arguments are those of `AxisBase`."""

    def halt(
        self,
        *,
        deceleration: float | None = None,
        jerk: float | None = None,
        buffer_mode: BufferMode = BufferMode.ABORTING,
        blending_position: float | None = None,
    ) -> AxisCommand:
        """Brake to rest; another command may take over at any time.

        Weaker dynamics than those of the running command are raised to them.

        Args:
            deceleration: u/s²; that of the running command where left out.
            jerk: u/s³; the same.
            buffer_mode: ABORTING brakes at once, BUFFERED waits for rest. BLENDING_LOW and BLENDING_NEXT keep the
                target of the running command and brake there with these dynamics; BLENDING_PREVIOUS and
                BLENDING_HIGH go on to that target and begin to brake there.
            blending_position: see `move_absolute`.

        Raises:
            TypeError: an argument is not a number, or the mode not a `BufferMode`.
        """
        command = AxisCommand(self, "halt")
        buffering = buffering_of(buffer_mode, blending_position)
        limits = self._braking(command, deceleration, jerk)
        if limits is not None:
            job = Job(JobKind.HALT, math.nan, limits, command)
            self._submit(command, AxisEvent.HALT, "halt()", lambda _start: job, buffering)
        return command

    def stop(self, *, deceleration: float | None = None, jerk: float | None = None, hold: bool = False) -> HeldCommand:
        """Brake to rest; until then no other command is taken. Dynamics as `halt`.

        Args:
            deceleration: see `halt`.
            jerk: see there.
            hold: keep the axis locked at rest, until `command.release()` or a `reset()`. `command.at_target` tells
                that it rests.
        """
        command = HeldCommand(self, "stop")
        command.held = hold
        limits = self._braking(command, deceleration, jerk)
        if limits is not None:
            job = Job(JobKind.STOP, math.nan, limits, command)
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

    def _braking(self, command: AxisCommand, deceleration: float | None, jerk: float | None) -> Limits | None:
        """Return the dynamics of a brake; None if they are refused."""
        asked = self._dynamics(command, (None, None, deceleration, jerk))
        if asked is None:
            return None
        running = self._running()
        return running._replace(
            deceleration=max(running.deceleration, asked.deceleration if deceleration is not None else 0.0),
            jerk=max(running.jerk, asked.jerk if jerk is not None else 0.0),
        )
