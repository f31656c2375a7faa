"""Moves to a position at rest."""

from collections.abc import Callable

from motionlayer.nc._buffer import Buffering
from motionlayer.nc._config import BufferMode, Direction
from motionlayer.nc._modulo import target_from_rest, target_in_motion
from motionlayer.nc._motion import Asked, AxisCommand, Job, JobKind, Refusal, member, number, required
from motionlayer.nc._states import AxisEvent
from motionlayer.nc._submission import AxisSubmission
from motionlayer.profile import stop_at


class AxisPositioning(AxisSubmission):
    """Positioning; the arguments are those of `AxisBase`."""

    def move_absolute(
        self,
        position: float,
        *,
        velocity: float | None = None,
        acceleration: float | None = None,
        deceleration: float | None = None,
        jerk: float | None = None,
        buffer_mode: BufferMode = BufferMode.ABORTING,
        blending_position: float | None = None,
    ) -> AxisCommand:
        """Move to a position and stop there; done when the setpoint has come to it.

        Args:
            position: target, u.
            velocity: at most, u/s; default of the axis where left out, as the following ones.
            acceleration: at most while |v| grows, u/s².
            deceleration: at most while |v| falls, u/s².
            jerk: at most, u/s³; raised where it could not take back the present acceleration within the maxima.
            buffer_mode: when it begins while another positioning or a halt runs; beside other motion it begins at once.
            blending_position: where a blending mode hands over instead of at the target of the running command, u;
                it must lie before that. Passed already, the command begins at once.

        Raises:
            TypeError: an argument is not a number, or the mode not a `BufferMode`.
        """
        goal = required("position", position)
        asked = velocity, acceleration, deceleration, jerk
        buffering = buffering_of(buffer_mode, blending_position)
        return self._position(f"move_absolute(position={goal})", lambda _start: goal, asked, buffering)

    def move_relative(
        self,
        distance: float,
        *,
        velocity: float | None = None,
        acceleration: float | None = None,
        deceleration: float | None = None,
        jerk: float | None = None,
        buffer_mode: BufferMode = BufferMode.ABORTING,
        blending_position: float | None = None,
    ) -> AxisCommand:
        """Move by a distance from the set position at which the command begins; otherwise as `move_absolute`."""
        way = required("distance", distance)
        asked = velocity, acceleration, deceleration, jerk
        buffering = buffering_of(buffer_mode, blending_position)
        return self._position(f"move_relative(distance={way})", lambda start: start + way, asked, buffering)

    def move_additive(
        self,
        distance: float,
        *,
        velocity: float | None = None,
        acceleration: float | None = None,
        deceleration: float | None = None,
        jerk: float | None = None,
        buffer_mode: BufferMode = BufferMode.ABORTING,
        blending_position: float | None = None,
    ) -> AxisCommand:
        """Move by a distance from the last commanded target, reached or not; otherwise as `move_absolute`.

        Where no target is known, or in endless motion, it is the set position at which the command begins.
        """
        way = required("distance", distance)
        asked = velocity, acceleration, deceleration, jerk
        buffering = buffering_of(buffer_mode, blending_position)

        def goal(start: float) -> float:
            return (start if self._commanded is None else self._commanded) + way

        return self._position(f"move_additive(distance={way})", goal, asked, buffering)

    def move_modulo(
        self,
        position: float,
        direction: Direction = Direction.SHORTEST_WAY,
        *,
        velocity: float | None = None,
        acceleration: float | None = None,
        deceleration: float | None = None,
        jerk: float | None = None,
        buffer_mode: BufferMode = BufferMode.ABORTING,
        blending_position: float | None = None,
    ) -> AxisCommand:
        """Move to an orientation, a position modulo the period of the axis; otherwise as `move_absolute`.

        From rest, every whole period in the position is a further turn. In motion the axis takes the next orientation
        it can reach without turning back. Inside the tolerance window it takes the nearest way from rest.

        Args:
            position: modulo position, u, >= 0; below the period on the shortest way.
            direction: of the motion; CURRENT keeps that of the present or the last one.
            velocity: see `move_absolute`, as the following ones.
            acceleration: see there.
            deceleration: see there.
            jerk: see there.
            buffer_mode: see there.
            blending_position: see there.

        Raises:
            TypeError: an argument is not a number, or of another enumeration.
        """
        goal = required("position", position)
        way = member("direction", direction, Direction)
        asked = velocity, acceleration, deceleration, jerk
        buffering = buffering_of(buffer_mode, blending_position)

        def target(start: float) -> float | Refusal:
            modulo = self.config.modulo
            if start != self.set_position or (self.set_velocity == 0.0 and self.set_acceleration == 0.0):
                return target_from_rest(modulo, start, goal, way, self._heading)
            stop = stop_at(*self._here, self._running())
            return target_in_motion(modulo, start, stop, goal, way, self._heading)

        return self._position(f"move_modulo(position={goal}, direction={way.name})", target, asked, buffering)

    def _position(
        self, text: str, target: Callable[[float], float | Refusal], asked: Asked, buffering: Buffering
    ) -> AxisCommand:
        """Command a positioning; `target` returns where to, for the position at which it begins."""
        command = AxisCommand(self, text.partition("(")[0])
        limits = self._lively(self._dynamics(command, asked))
        if limits is None:
            return command
        dynamics = limits

        def make(start: float) -> Job | Refusal:
            goal = target(start)
            return goal if isinstance(goal, Refusal) else Job(JobKind.POSITION, goal, dynamics, command)

        self._submit(command, AxisEvent.MOVE, text, make, buffering)
        return command


def buffering_of(mode: BufferMode, position: float | None) -> Buffering:
    """Check the arguments that say when a command begins.

    Raises:
        TypeError: one is of another type.
    """
    return Buffering(member("buffer_mode", mode, BufferMode), number("blending_position", position))
