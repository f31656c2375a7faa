"""Motion without end, and jogging."""

import math
from typing import Unpack

from motionlayer.command import ErrorId
from motionlayer.nc._arguments import Asked, bad_speed, member, number, required
from motionlayer.nc._config import Direction, JogMode
from motionlayer.nc._keywords import ContinuousKeywords, EndlessKeywords, JogKeywords, checked
from motionlayer.nc._motion import AxisCommand, HeldCommand, Job, JobKind, Refusal
from motionlayer.nc._states import AxisEvent
from motionlayer.nc._submission import AxisSubmission
from motionlayer.profile import Limits


class AxisEndless(AxisSubmission):
    """Endless motion; the arguments are those of `AxisBase`.

    An axis with a software limit ahead brakes in time, comes to rest on the limit and goes into error; a jog only
    comes to rest there.
    """

    def move_velocity(
        self, velocity: float, direction: Direction = Direction.POSITIVE, **keywords: Unpack[EndlessKeywords]
    ) -> AxisCommand:
        """Move without end; the command stays active until another one takes over.

        `command.in_velocity` tells when the velocity is reached.

        Args:
            velocity: magnitude, u/s.
            direction: POSITIVE, NEGATIVE, or CURRENT, which keeps that of the present motion, positive at rest.
            **keywords: see `EndlessKeywords`.

        Raises:
            TypeError: an argument is not a number, or of another enumeration, or a keyword unknown.
        """
        way = member("direction", direction, Direction)
        chosen = checked("move_velocity", EndlessKeywords, keywords)
        command = AxisCommand(self, "move_velocity")
        limits = self._lively(self._dynamics(command, (required("velocity", velocity), *chosen.asked[1:])))
        if limits is None:
            return command
        if way in (Direction.SHORTEST_WAY, Direction.UNDEFINED):
            detail = f"direction = {way.name}, allowed: POSITIVE, NEGATIVE, CURRENT"
            return self._refuse(command, Refusal(ErrorId.COMMAND_NOT_PERMITTED, detail))
        current = -1.0 if self.set_velocity < 0.0 else 1.0
        sign = {Direction.POSITIVE: 1.0, Direction.NEGATIVE: -1.0, Direction.CURRENT: current}[way]
        job = Job(JobKind.VELOCITY, sign * limits.velocity, limits, command)
        text = f"move_velocity(velocity={velocity}, direction={way.name})"
        self._submit(command, AxisEvent.MOVE_ENDLESS, text, lambda _start: job, chosen.buffering)
        return command

    def move_continuous_absolute(
        self, position: float, end_velocity: float, **keywords: Unpack[ContinuousKeywords]
    ) -> AxisCommand:
        """Move past a position with an end velocity, and on with it; the command stays active until another takes over.

        `command.in_end_velocity` tells when the position is passed and the velocity reached. Where the way is too
        short for the end velocity the axis passes with the nearest it can reach, and gains the rest behind. With a
        software limit behind, it passes no faster than it could brake before that. The direction in which it passes is
        decided when it begins: an override does not turn it round.

        Args:
            position: to be passed, u.
            end_velocity: magnitude, u/s; above `velocity` too, which holds on the way.
            **keywords: see `ContinuousKeywords`.

        Raises:
            TypeError: an argument is not a number, or a keyword is unknown or of another type.
        """
        goal = required("position", position)
        text = f"move_continuous_absolute(position={goal}, end_velocity={end_velocity})"
        return self._continuous(text, goal, end_velocity, keywords, relative=False)

    def move_continuous_relative(
        self, distance: float, end_velocity: float, **keywords: Unpack[ContinuousKeywords]
    ) -> AxisCommand:
        """The same for a distance from the set position at which the command begins."""
        way = required("distance", distance)
        text = f"move_continuous_relative(distance={way}, end_velocity={end_velocity})"
        return self._continuous(text, way, end_velocity, keywords, relative=True)

    def _continuous(
        self, text: str, goal: float, end_velocity: float, keywords: ContinuousKeywords, *, relative: bool
    ) -> AxisCommand:
        name, end = text.partition("(")[0], required("end_velocity", end_velocity)
        chosen = checked(name, ContinuousKeywords, keywords)
        command = AxisCommand(self, name)
        limits = self._lively(self._dynamics(command, chosen.asked))
        if limits is None:
            return command
        most = self.config.maximum.velocity
        refusal = bad_speed("end_velocity", end, most, self.config.unit)
        if refusal is not None:
            return self._refuse(command, refusal)
        dynamics = limits

        def make(start: float) -> Job:
            target = start + goal if relative else goal
            return Job(JobKind.CONTINUOUS, target, dynamics, command, end_speed=end)

        self._submit(command, AxisEvent.MOVE_ENDLESS, text, make, chosen.buffering)
        return command

    def jog(
        self,
        direction: Direction,
        mode: JogMode = JogMode.STANDARD_SLOW,
        *,
        step: float | None = None,
        **keywords: Unpack[JogKeywords],
    ) -> HeldCommand:
        """Move by hand: until `command.release()`, which brakes, or by one step; done at rest.

        Args:
            direction: POSITIVE or NEGATIVE.
            mode: see `JogMode`; the standard modes take velocity and dynamics from the axis alone.
            step: of the inching modes, u, > 0; that of the machine description where left out.
            **keywords: see `JogKeywords`; the velocity is the slow manual one where left out.

        Raises:
            TypeError: an argument is not a number, or of another enumeration, or a keyword unknown.
        """
        way, kind = member("direction", direction, Direction), member("mode", mode, JogMode)
        asked: Asked = checked("jog", JogKeywords, keywords).asked
        command = HeldCommand(self, "jog", self._released)
        manual, size = self.config.manual, number("step", step)
        asked = (manual.slow if asked[0] is None else asked[0], *asked[1:])
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
        return self._inch(command, sign, width, limits, kind, f"{text[:-1]}, step={width})")

    def _inch(
        self, command: HeldCommand, sign: float, step: float, dynamics: Limits, mode: JogMode, text: str
    ) -> HeldCommand:
        """Move by one step, or refuse its size."""
        if not 0.0 < step < math.inf:
            self._refuse(command, Refusal(ErrorId.PARAMETER, f"step = {step}, allowed: 0 < step {self.config.unit}"))
            return command

        def make(start: float) -> Job:
            goal = start + sign * step if mode is JogMode.INCHING else _multiple(start, sign, step)
            return Job(JobKind.POSITION, goal, dynamics, command)

        self._submit(command, AxisEvent.MOVE, text, make)
        return command


def _multiple(start: float, sign: float, step: float) -> float:
    """Return the next integer multiple of a step in a direction."""
    return (math.floor(start / step) + 1.0 if sign > 0.0 else math.ceil(start / step) - 1.0) * step
