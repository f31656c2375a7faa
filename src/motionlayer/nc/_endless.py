"""Motion without end, and jogging."""

import math

from motionlayer.command import ErrorId
from motionlayer.nc._config import BufferMode, Direction, JogMode
from motionlayer.nc._motion import Asked, AxisCommand, HeldCommand, Job, JobKind, Refusal, member, number, required
from motionlayer.nc._positioning import buffering_of
from motionlayer.nc._states import AxisEvent
from motionlayer.nc._submission import AxisSubmission


class AxisEndless(AxisSubmission):
    """Endless motion; the arguments are those of `AxisBase`.

    An axis with a software limit ahead brakes in time, comes to rest on the limit and goes into error; a jog only
    comes to rest there.
    """

    def move_velocity(
        self,
        velocity: float,
        direction: Direction = Direction.POSITIVE,
        *,
        acceleration: float | None = None,
        deceleration: float | None = None,
        jerk: float | None = None,
        buffer_mode: BufferMode = BufferMode.ABORTING,
        blending_position: float | None = None,
    ) -> AxisCommand:
        """Move without end; the command stays active until another one takes over.

        `command.in_velocity` tells when the velocity is reached.

        Args:
            velocity: magnitude, u/s.
            direction: POSITIVE, NEGATIVE, or CURRENT, which keeps that of the present motion, positive at rest.
            acceleration: see `move_absolute`, as the following ones.
            deceleration: see there.
            jerk: see there.
            buffer_mode: see there.
            blending_position: see there.

        Raises:
            TypeError: an argument is not a number, or of another enumeration.
        """
        way = member("direction", direction, Direction)
        command = AxisCommand(self, "move_velocity")
        buffering = buffering_of(buffer_mode, blending_position)
        asked = required("velocity", velocity), acceleration, deceleration, jerk
        limits = self._lively(self._dynamics(command, asked))
        if limits is None:
            return command
        if way in (Direction.SHORTEST_WAY, Direction.UNDEFINED):
            detail = f"direction = {way.name}, allowed: POSITIVE, NEGATIVE, CURRENT"
            return self._refuse(command, Refusal(ErrorId.COMMAND_NOT_PERMITTED, detail))
        current = -1.0 if self.set_velocity < 0.0 else 1.0
        sign = {Direction.POSITIVE: 1.0, Direction.NEGATIVE: -1.0, Direction.CURRENT: current}[way]
        job = Job(JobKind.VELOCITY, sign * limits.velocity, limits, command)
        text = f"move_velocity(velocity={velocity}, direction={way.name})"
        self._submit(command, AxisEvent.MOVE_ENDLESS, text, lambda _start: job, buffering)
        return command

    def move_continuous_absolute(
        self,
        position: float,
        end_velocity: float,
        *,
        velocity: float | None = None,
        acceleration: float | None = None,
        deceleration: float | None = None,
        jerk: float | None = None,
        buffer_mode: BufferMode = BufferMode.ABORTING,
        blending_position: float | None = None,
    ) -> AxisCommand:
        """Move past a position with an end velocity, and on with it; the command stays active until another takes over.

        `command.in_end_velocity` tells when the position is passed and the velocity reached. Where the way is too
        short for the end velocity the axis passes with the nearest it can reach, and gains the rest behind.

        Args:
            position: to be passed, u.
            end_velocity: magnitude, u/s; above `velocity` too.
            velocity: at most on the way, u/s; see `move_absolute`, as the following ones.
            acceleration: see there.
            deceleration: see there.
            jerk: see there.
            buffer_mode: see there.
            blending_position: see there.

        Raises:
            TypeError: an argument is not a number, or the mode not a `BufferMode`.
        """
        goal = required("position", position)
        text = f"move_continuous_absolute(position={goal}, end_velocity={end_velocity})"
        asked = velocity, acceleration, deceleration, jerk
        return self._continuous(text, goal, end_velocity, asked, (buffer_mode, blending_position), relative=False)

    def move_continuous_relative(
        self,
        distance: float,
        end_velocity: float,
        *,
        velocity: float | None = None,
        acceleration: float | None = None,
        deceleration: float | None = None,
        jerk: float | None = None,
        buffer_mode: BufferMode = BufferMode.ABORTING,
        blending_position: float | None = None,
    ) -> AxisCommand:
        """The same for a distance from the set position at which the command begins."""
        way = required("distance", distance)
        text = f"move_continuous_relative(distance={way}, end_velocity={end_velocity})"
        asked = velocity, acceleration, deceleration, jerk
        return self._continuous(text, way, end_velocity, asked, (buffer_mode, blending_position), relative=True)

    def _continuous(
        self,
        text: str,
        goal: float,
        end_velocity: float,
        asked: Asked,
        follows: tuple[BufferMode, float | None],
        *,
        relative: bool,
    ) -> AxisCommand:
        command = AxisCommand(self, text.partition("(")[0])
        buffering, end = buffering_of(*follows), required("end_velocity", end_velocity)
        limits = self._lively(self._dynamics(command, asked))
        if limits is None:
            return command
        most = self.config.maximum.velocity
        if not 0.0 < end <= most:
            detail = f"end_velocity = {end}, allowed: 0 < end_velocity <= {most} {self.config.unit}/s"
            return self._refuse(command, Refusal(ErrorId.VELOCITY, detail))
        dynamics = limits

        def make(start: float) -> Job:
            target = start + goal if relative else goal
            return Job(JobKind.CONTINUOUS, target, dynamics, command, end_speed=end)

        self._submit(command, AxisEvent.MOVE_ENDLESS, text, make, buffering)
        return command

    def jog(
        self,
        direction: Direction,
        mode: JogMode = JogMode.STANDARD_SLOW,
        *,
        step: float | None = None,
        velocity: float | None = None,
        acceleration: float | None = None,
        deceleration: float | None = None,
        jerk: float | None = None,
    ) -> HeldCommand:
        """Move by hand: until `command.release()`, which brakes, or by one step; done at rest.

        Args:
            direction: POSITIVE or NEGATIVE.
            mode: see `JogMode`; the standard modes take velocity and dynamics from the axis alone.
            step: of the inching modes, u, > 0; that of the machine description where left out.
            velocity: see `move_absolute`, as the following ones; for the slow manual velocity where left out.
            acceleration: see there.
            deceleration: see there.
            jerk: see there.

        Raises:
            TypeError: an argument is not a number, or of another enumeration.
        """
        way, kind = member("direction", direction, Direction), member("mode", mode, JogMode)
        command = HeldCommand(self, "jog")
        manual, size = self.config.manual, number("step", step)
        asked: Asked = (manual.slow if velocity is None else velocity, acceleration, deceleration, jerk)
        if kind in (JogMode.STANDARD_SLOW, JogMode.STANDARD_FAST):
            asked = (manual.slow if kind is JogMode.STANDARD_SLOW else manual.fast, None, None, None)
        limits = self._lively(self._dynamics(command, asked))
        if limits is None:
            return command
        if way not in (Direction.POSITIVE, Direction.NEGATIVE):
            detail = f"direction = {way.name}, allowed: POSITIVE, NEGATIVE"
            self._refuse(command, Refusal(ErrorId.COMMAND_NOT_PERMITTED, detail))
            return command
        sign = 1.0 if way is Direction.POSITIVE else -1.0
        text = f"jog(direction={way.name}, mode={kind.name})"
        if kind not in (JogMode.INCHING, JogMode.INCHING_MODULO):
            job = Job(JobKind.JOG, sign * limits.velocity, limits, command)
            self._submit(command, AxisEvent.MOVE_ENDLESS, text, lambda _start: job)
            return command
        width = (manual.forward if sign > 0.0 else manual.backward) if size is None else size
        if not 0.0 < width < math.inf:
            self._refuse(command, Refusal(ErrorId.PARAMETER, f"step = {width}, allowed: 0 < step {self.config.unit}"))
            return command
        dynamics = limits

        def make(start: float) -> Job:
            goal = start + sign * width if kind is JogMode.INCHING else _multiple(start, sign, width)
            return Job(JobKind.POSITION, goal, dynamics, command)

        self._submit(command, AxisEvent.MOVE, text, make)
        return command


def _multiple(start: float, sign: float, step: float) -> float:
    """Return the next integer multiple of a step in a direction."""
    return (math.floor(start / step) + 1.0 if sign > 0.0 else math.ceil(start / step) - 1.0) * step
