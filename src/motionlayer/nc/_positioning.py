"""Moves to a position at rest."""

from collections.abc import Callable
from typing import Unpack

from motionlayer.nc._arguments import member, required
from motionlayer.nc._config import Direction
from motionlayer.nc._keywords import MoveKeywords, checked
from motionlayer.nc._modulo import target_from_rest, target_in_motion
from motionlayer.nc._motion import AxisCommand, Job, JobKind, Refusal
from motionlayer.nc._states import AxisEvent
from motionlayer.nc._submission import AxisSubmission
from motionlayer.profile import stop_at


class AxisPositioning(AxisSubmission):
    """Positioning; the arguments are those of `AxisBase`.

    Every move is done when the setpoint has come to the target, and the actual position into its window where the axis
    has one. A move in motion that cannot come to rest before a target ahead turns back to it, and warns: 0x427E.
    """

    def move_absolute(self, position: float, **keywords: Unpack[MoveKeywords]) -> AxisCommand:
        """Move to a position and stop there.

        Args:
            position: target, u.
            **keywords: see `MoveKeywords`.

        Raises:
            TypeError: an argument is not a number, or a keyword is unknown or of another type.
        """
        goal = required("position", position)
        return self._position(f"move_absolute(position={goal})", lambda _start: goal, keywords)

    def move_relative(self, distance: float, **keywords: Unpack[MoveKeywords]) -> AxisCommand:
        """Move by a distance from the set position at which the command begins; otherwise as `move_absolute`."""
        way = required("distance", distance)
        return self._position(f"move_relative(distance={way})", lambda start: start + way, keywords)

    def move_additive(self, distance: float, **keywords: Unpack[MoveKeywords]) -> AxisCommand:
        """Move by a distance from the last commanded target, reached or not; otherwise as `move_absolute`.

        Where no target is known, or in endless motion, it is the set position at which the command begins.
        """
        way = required("distance", distance)

        def goal(start: float) -> float:
            return (start if self._commanded is None else self._commanded) + way

        return self._position(f"move_additive(distance={way})", goal, keywords)

    def move_modulo(
        self, position: float, direction: Direction = Direction.SHORTEST_WAY, **keywords: Unpack[MoveKeywords]
    ) -> AxisCommand:
        """Move to an orientation, a position modulo the period of the axis; otherwise as `move_absolute`.

        From rest, every whole period in the position is a further turn. In motion the axis takes the next orientation
        it can reach without turning back. Inside the tolerance window it takes the nearest way from rest.

        Args:
            position: modulo position, u, >= 0; below the period on the shortest way.
            direction: of the motion; CURRENT keeps that of the present or the last one.
            **keywords: see `MoveKeywords`.

        Raises:
            TypeError: an argument is not a number, or of another enumeration, or a keyword unknown.
        """
        goal = required("position", position)
        way = member("direction", direction, Direction)

        def target(start: float) -> float | Refusal:
            modulo = self.config.modulo
            if start != self.set_position or (self.set_velocity == 0.0 and self.set_acceleration == 0.0):
                return target_from_rest(modulo, start, goal, way, self._heading)
            stop = stop_at(*self._here, self._running())
            return target_in_motion(modulo, start, stop, goal, way, self._heading)

        return self._position(f"move_modulo(position={goal}, direction={way.name})", target, keywords)

    def _position(self, text: str, target: Callable[[float], float | Refusal], keywords: MoveKeywords) -> AxisCommand:
        """Command a positioning; `target` returns where to, for the position at which it begins."""
        name = text.partition("(")[0]
        chosen = checked(name, MoveKeywords, keywords)
        command = AxisCommand(self, name)
        limits = self._lively(self._dynamics(command, chosen.asked))
        if limits is None:
            return command
        dynamics, monitored = limits, chosen.monitored is not False

        def make(start: float) -> Job | Refusal:
            goal = target(start)
            if isinstance(goal, Refusal):
                return goal
            return Job(JobKind.POSITION, goal, dynamics, command, monitored=monitored)

        self._submit(command, AxisEvent.MOVE, text, make, chosen.buffering)
        return command
