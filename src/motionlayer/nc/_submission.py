"""How a motion that is commanded becomes the running one, waits for it, or is refused."""

from collections.abc import Callable
from typing import Final

from motionlayer.command import ErrorId
from motionlayer.event import Kind, Level
from motionlayer.nc._arguments import Asked, dynamics
from motionlayer.nc._config import BufferMode
from motionlayer.nc._core import AxisCore
from motionlayer.nc._follower import AT_ONCE, Buffering
from motionlayer.nc._limits import least_jerk
from motionlayer.nc._motion import SCALED, AxisCommand, Job, JobKind, Refusal
from motionlayer.nc._states import AxisEvent, AxisState
from motionlayer.nc._ways import overshoots
from motionlayer.profile import Limits

DYNAMICS: Final = ("velocity", "acceleration", "deceleration", "jerk")


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
            self._follow(job, buffering, self._told(text, job, buffering))
        else:
            self._begin(job, state, self._told(text, job, buffering))

    def _told(self, text: str, job: Job, buffering: Buffering) -> str:
        """Return the text of a message with all that is not as usual: the dynamics in force, and when it begins."""
        monitored = job.monitored is (job.kind is JobKind.POSITION)
        if monitored and buffering == AT_ONCE and job.limits == self.config.default:
            return text
        first = 0 if job.kind in SCALED else 2  # a brake takes the rest from what it brakes
        shown = list(zip(DYNAMICS, job.limits, self.config.default, strict=True))[first:]
        unusual = [f"{name}={value}" for name, value, usual in shown if value != usual and f"({name}=" not in text]
        if buffering.mode is not BufferMode.ABORTING:
            unusual.append(f"buffer_mode={buffering.mode.name}")
        if buffering.blends and buffering.position is not None:
            unusual.append(f"blending_position={buffering.position}")
        if not monitored:
            unusual.append(f"position_monitoring={job.monitored}")
        separator = "" if text.endswith("()") or not unusual else ", "
        return f"{text[:-1]}{separator}{', '.join(unusual)})"

    def _begin(self, job: Job, state: AxisState, text: str) -> None:
        """Let a motion replace the running one, or refuse it and change nothing."""
        command, here = job.command, self._here
        assert command is not None
        way = self._checked(job, here)
        if isinstance(way, Refusal):
            self._refuse(command, way)
            return
        self._accept(command, text)
        if overshoots(job, here, way.profile):
            text = f"{command.name}: cannot come to rest before {job.target} {self.config.unit}, and turns back"
            self._tell_of(command, Level.WARNING, Kind.MESSAGE, text, ErrorId.AS_GOOD_AS_POSSIBLE)
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
        pull = self.set_acceleration
        if limits is None or pull == 0.0:
            return limits
        least = least_jerk(self.set_velocity, pull, self.config.maximum)
        return limits if least <= limits.jerk else limits._replace(jerk=least)
