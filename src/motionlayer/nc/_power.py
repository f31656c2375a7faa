"""Power, feed enables and reset."""

import math

from motionlayer.nc._arguments import member
from motionlayer.nc._config import BufferMode
from motionlayer.nc._core import AxisCore
from motionlayer.nc._limits import directions
from motionlayer.nc._motion import SCALED, AxisCommand, HeldCommand, Job, JobKind
from motionlayer.nc._states import AxisEvent, AxisState
from motionlayer.profile import Profile


class AxisPower(AxisCore):
    """Power and reset; the arguments are those of `AxisBase`."""

    def enable(self, *, positive: bool = True, negative: bool = True) -> AxisCommand:
        """Switch the drive on; done when it is ready. The actual position becomes the set position.

        Again, with the drive on, it changes the feed enables alone. A motion that leads in a direction which is not
        released any more brakes with the maximum dynamics, and the command is done when it rests; a buffered command
        that would is dropped.

        Args:
            positive: release motion in positive direction.
            negative: release motion in negative direction.
        """
        command = AxisCommand(self, "enable")
        state = self._next(AxisEvent.ENABLE, command)
        if state is None:
            return command
        self._accept(command, "enable()" if positive and negative else f"enable({positive=}, {negative=})")
        if self._power is not None:
            self._end(self._power, by=command)
        self._power = command
        self._feed = bool(positive), bool(negative)
        if not self._feed_lost(command):
            self._request_power(on=True)
        return command

    def disable(self, *, buffer_mode: BufferMode = BufferMode.ABORTING) -> AxisCommand:
        """Switch the drive off; done when it is. A moving axis first brakes with its maximum dynamics.

        Args:
            buffer_mode: with any other than ABORTING the axis first does what it has been commanded.

        Raises:
            TypeError: the mode is not a `BufferMode`.
        """
        command = AxisCommand(self, "disable")
        waits = member("buffer_mode", buffer_mode, BufferMode) is not BufferMode.ABORTING
        state = self._next(AxisEvent.DISABLE, command)
        if state is None:
            return command
        self._accept(command, "disable()")
        if self._power is not None:
            self._end(self._power, by=command)
        self._power = command
        job = self._job
        if job is None:
            self._request_power(on=False)
        elif isinstance(job.command, HeldCommand) and job.kind is JobKind.STOP:
            job.command.release()
        elif not waits and self._state is not state:
            self._brake_for(command, state)
        return command

    def reset(self) -> AxisCommand:
        """Clear the error; done a tick later, or when a braking axis rests. It also ends the lock of a stop."""
        command = AxisCommand(self, "reset")
        if self._next(AxisEvent.RESET if self.enabled else AxisEvent.RESET_OFF, command) is None:
            return command
        self._accept(command, "reset()")
        if self._state is AxisState.STOPPING and isinstance(self.command, HeldCommand):
            self.command.release()
        if self._state is not AxisState.ERRORSTOP:  # an error that comes later is not what was to be cleared
            self._end(command)
            return command
        if self._reset is not None:
            self._end(self._reset, by=command)
        self._reset = command
        self._store.status_changed.append(self._column)  # at rest it takes a tick, as the drive's part will
        return command

    def _brake_for(self, command: AxisCommand, state: AxisState) -> None:
        """Let the running motion end aborted, and brake."""
        self._drop_follower(by=command)
        if self._job is not None and self._job.command is not None:
            self._end(self._job.command, by=command)
        self._leave_homing()
        self._enter(state)
        self._replan(Job(JobKind.BRAKE, math.nan, self.config.maximum, None))

    def _feed_lost(self, command: AxisCommand) -> bool:
        """Brake what leads in a direction that is not released any more; tell whether the axis does."""
        job, follower = self._job, self._follower
        if job is None or all(self._feed):
            return False
        here = self.set_position
        rest = self._store.pieces[self._column, self._store.current[self._column] : self._store.counts[self._column]]
        places = [here, *rest[1:, 1].tolist()]
        if job.kind in SCALED and self._locked_out(Profile(rest, min(places), max(places)), here):
            self._brake_for(command, self._step(AxisEvent.FEED_LOST))
            return True
        if follower is not None and follower.way is not None:
            profile = follower.way.profile
            if self._locked_out(profile, float(profile.pieces[0, 1])):
                self._drop_follower(by=command)
                self._guarded(self._plan_anew)
        return False

    def _locked_out(self, profile: Profile, here: float) -> bool:
        """Tell whether a profile leads in a direction that is not released."""
        return any(needed and not given for needed, given in zip(directions(profile, here), self._feed, strict=True))
