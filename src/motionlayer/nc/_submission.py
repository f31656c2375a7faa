"""How a motion that is commanded becomes the running one, waits for it, or is refused."""

from collections.abc import Callable

from motionlayer.command import ErrorId
from motionlayer.nc._buffer import AT_ONCE, Buffering
from motionlayer.nc._core import AxisCore
from motionlayer.nc._motion import Asked, AxisCommand, Job, Refusal, dynamics, least_jerk
from motionlayer.nc._states import AxisEvent, AxisState
from motionlayer.profile import Limits


class AxisSubmission(AxisCore):
    """What all motion commands share; the arguments are those of `AxisBase`."""

    def refuse(self, name: str, error: ErrorId, detail: str) -> AxisCommand:
        """Return a command that comes back refused, for what its method cannot even be asked.

        Args:
            name: of the method.
            error: why.
            detail: value and what is allowed, with the unit.
        """
        return self._refuse(AxisCommand(self, name), Refusal(error, detail))

    def _submit(
        self,
        command: AxisCommand,
        event: AxisEvent,
        text: str,
        make: Callable[[float], Job | Refusal],
        buffering: Buffering = AT_ONCE,
    ) -> None:
        """Take a motion over, or let it wait for the running one; or refuse it and change nothing.

        Args:
            command: new.
            event: what it means for the state machine.
            text: of the message.
            make: returns the job for the position at which it begins.
            buffering: when it begins.
        """
        state = self._next(event, command)
        if state is None:
            return
        joint = self._joint(buffering)
        job = joint if isinstance(joint, Refusal) else make(self.set_position if joint is None else joint)
        if isinstance(job, Refusal):
            self._refuse(command, job)
        elif joint is not None:
            job.event = event
            self._follow(job, buffering, text)
        else:
            self._begin(job, state, text)

    def _begin(self, job: Job, state: AxisState, text: str) -> None:
        """Let a motion replace the running one, or refuse it and change nothing."""
        command = job.command
        assert command is not None
        way = self._checked(job, self._here)
        if isinstance(way, Refusal):
            self._refuse(command, way)
            return
        self._accept(command, text)
        self._drop_follower(by=command)
        if self._job is not None and self._job.command is not None:
            self._end(self._job.command, by=command)
        self._leave_homing()
        self._enter(state)
        command.activate()
        self._adopt(job, way)

    def _dynamics(self, command: AxisCommand, asked: Asked) -> Limits | None:
        """Return the limits that a command asks for; None if they are refused."""
        limits = dynamics(asked, self.config.default, self.config.maximum, self.config.unit)
        if isinstance(limits, Refusal):
            self._refuse(command, limits)
            return None
        return limits

    def _lively(self, limits: Limits | None) -> Limits | None:
        """Raise a jerk with which the present acceleration would carry the axis beyond its maxima."""
        if limits is None:
            return None
        least = least_jerk(self.set_velocity, self.set_acceleration, self.config.maximum)
        return limits if least <= limits.jerk else limits._replace(jerk=least)
