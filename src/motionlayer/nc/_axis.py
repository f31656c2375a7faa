"""`Axis`: point to point motion of one coordinate."""

import math
from typing import Final

from motionlayer.command import ErrorId
from motionlayer.nc._config import Direction
from motionlayer.nc._core import AxisCore
from motionlayer.nc._homing import Homing
from motionlayer.nc._motion import AxisCommand, Job, JobKind, Refusal, dynamics, least_jerk, number
from motionlayer.nc._override import STEPS
from motionlayer.nc._states import TRANSITIONS, AxisEvent, AxisState
from motionlayer.profile import Limits
from motionlayer.store import Q, Watch

_DIRECTIONS: Final = ", ".join(f"Direction.{one.name}" for one in Direction)


class Axis(AxisCore):
    """One axis. Units: the axis unit u, u/s, u/s², u/s³.

    Commands may be called between the inputs and the motion of a cycle, which is when programs run. Each is checked
    and planned in the call and may come back refused; a new motion replaces the running one without a jump in
    position, velocity or acceleration.
    """

    def enable(self) -> AxisCommand:
        """Switch the drive on; done when it is ready. The actual position becomes the set position."""
        return self._switch("enable", AxisEvent.ENABLE, on=True)

    def disable(self) -> AxisCommand:
        """Switch the drive off; done when it is. A moving axis first brakes with its maximum dynamics."""
        return self._switch("disable", AxisEvent.DISABLE, on=False)

    def reset(self) -> AxisCommand:
        """Clear the error; done a tick later, or when a braking axis rests. Without an error nothing changes."""
        command = AxisCommand(self, "reset")
        if self._next(AxisEvent.RESET if self.enabled else AxisEvent.RESET_OFF, command) is None:
            return command
        self._accept(command, "reset()")
        if self._state is not AxisState.ERRORSTOP:  # an error that comes later is not what was to be cleared
            self._end(command)
            return command
        if self._reset is not None:
            self._end(self._reset, by=command)
        self._reset = command
        self._store.status_changed.append(self._column)  # at rest it takes a tick, as the drive's part will
        return command

    def move_absolute(
        self,
        position: float,
        *,
        velocity: float | None = None,
        acceleration: float | None = None,
        deceleration: float | None = None,
        jerk: float | None = None,
    ) -> AxisCommand:
        """Move to a position and stop there; done when the setpoint has come to it.

        Args:
            position: target, u.
            velocity: at most, u/s; default of the axis where left out, as the following ones.
            acceleration: at most while |v| grows, u/s².
            deceleration: at most while |v| falls, u/s².
            jerk: at most, u/s³; raised where it could not take back the present acceleration within the maxima.

        Raises:
            TypeError: an argument is not a number.
        """
        goal = _required("position", position)
        text = f"move_absolute(position={goal})"
        return self._move(text, goal, (velocity, acceleration, deceleration, jerk))

    def move_relative(
        self,
        distance: float,
        *,
        velocity: float | None = None,
        acceleration: float | None = None,
        deceleration: float | None = None,
        jerk: float | None = None,
    ) -> AxisCommand:
        """Move by a distance from the present set position; otherwise as `move_absolute`."""
        way = _required("distance", distance)
        text = f"move_relative(distance={way})"
        return self._move(text, self.set_position + way, (velocity, acceleration, deceleration, jerk))

    def move_velocity(
        self,
        velocity: float,
        direction: Direction = Direction.POSITIVE,
        *,
        acceleration: float | None = None,
        deceleration: float | None = None,
        jerk: float | None = None,
    ) -> AxisCommand:
        """Move without end; the command stays active until another one takes over.

        `command.in_velocity` tells when the velocity is reached. An axis with a software limit ahead brakes in
        time, comes to rest on the limit and goes into error.

        Args:
            velocity: magnitude, u/s.
            direction: CURRENT keeps the direction of the present motion, positive at rest.
            acceleration: see `move_absolute`.
            deceleration: see `move_absolute`.
            jerk: see `move_absolute`.

        Raises:
            TypeError: an argument is not a number, or the direction not a `Direction`.
        """
        command = AxisCommand(self, "move_velocity")
        sign = self._sign(direction)
        asked = (_required("velocity", velocity), acceleration, deceleration, jerk)
        limits = self._lively(self._dynamics(command, asked))
        if limits is not None:
            text = f"move_velocity(velocity={velocity}, direction={Direction(direction).name})"
            job = Job(JobKind.VELOCITY, sign * limits.velocity, limits, command)
            self._start(job, AxisEvent.MOVE_ENDLESS, text)
        return command

    def halt(self, *, deceleration: float | None = None, jerk: float | None = None) -> AxisCommand:
        """Brake to rest; another command may take over at any time.

        Weaker dynamics than those of the running command are raised to them.
        """
        return self._brake("halt", JobKind.HALT, AxisEvent.HALT, deceleration, jerk)

    def stop(self, *, deceleration: float | None = None, jerk: float | None = None) -> AxisCommand:
        """Brake to rest; until then no other command is taken. Dynamics as `halt`."""
        return self._brake("stop", JobKind.STOP, AxisEvent.STOP, deceleration, jerk)

    def emergency_stop(self) -> AxisCommand:
        """Brake with the maximum dynamics, also where a weaker stop runs; otherwise as `stop`."""
        command = AxisCommand(self, "emergency_stop")
        job = Job(JobKind.STOP, math.nan, self.config.maximum, command)
        self._start(job, AxisEvent.EMERGENCY_STOP, "emergency_stop()")
        return command

    def home(self, position: float | None = None) -> AxisCommand:
        """Find the reference, in the way the machine description says; done when the axis is homed and at rest.

        Args:
            position: of the reference, u; that of the machine description where left out.

        Raises:
            TypeError: the position is not a number.
        """
        command = AxisCommand(self, "home")
        reference = number("position", position)
        reference = self.config.home.position if reference is None else reference
        if not math.isfinite(reference):
            return self._refuse(command, Refusal(ErrorId.TARGET_NOT_FINITE, f"position = {reference}"))
        state = self._next(AxisEvent.HOME, command)
        if state is not None:
            self._accept(command, f"home(position={reference})")
            self._enter(state)
            self._homing = Homing(self, command, reference)
            self._homing.begin()
        return command

    def passes(self, position: float) -> AxisCommand:
        """Wait until the setpoint passes a position or comes to it; `command.end_time` is when, inside the cycle.

        Nothing moves by it. It stays busy until then, whatever the axis does.

        Raises:
            TypeError: the position is not a number.
        """
        command = AxisCommand(self, "passes")
        place = _required("position", position)
        if not math.isfinite(place):
            return self._refuse(command, Refusal(ErrorId.TARGET_NOT_FINITE, f"position = {place}"))
        self._accept(command, f"passes(position={place})")
        if self.set_position == place:
            command.end_time = self._store.tick * self._store.dt
            self._end(command)
            return command

        def passed(early: float) -> None:
            command.end_time = self._store.tick * self._store.dt - early
            self._end(command)

        self._store.watch(Watch(self._column, place, passed))
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
        return self.command or self._power

    def set_override(self, factor: float) -> None:
        """Scale the velocity of every motion from this tick on; 0 holds the axis without ending its command.

        Acceleration and jerk stay as they are. It may change in every cycle.

        Args:
            factor: 0 to 1, taken to 1e-6.

        Raises:
            TypeError: it is not a number.
            ValueError: it is not between 0 and 1.
        """
        value = _required("factor", factor)
        if not 0.0 <= value <= 1.0:
            raise ValueError(f"{self.name}: override {value}, allowed: 0 to 1 (1 is 100 %)")
        self._table[Q.REQUEST, self._column] = round(value * STEPS) / STEPS

    def _move(
        self, text: str, goal: float, asked: tuple[float | None, float | None, float | None, float | None]
    ) -> AxisCommand:
        command = AxisCommand(self, text.partition("(")[0])
        limits = self._lively(self._dynamics(command, asked))
        if limits is not None:
            self._start(Job(JobKind.POSITION, goal, limits, command), AxisEvent.MOVE, text)
        return command

    def _dynamics(
        self, command: AxisCommand, asked: tuple[float | None, float | None, float | None, float | None]
    ) -> Limits | None:
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

    def _brake(
        self, name: str, kind: JobKind, event: AxisEvent, deceleration: float | None, jerk: float | None
    ) -> AxisCommand:
        command = AxisCommand(self, name)
        asked = self._dynamics(command, (None, None, deceleration, jerk))
        if asked is None:
            return command
        running = self._running()
        limits = running._replace(
            deceleration=max(running.deceleration, asked.deceleration if deceleration is not None else 0.0),
            jerk=max(running.jerk, asked.jerk if jerk is not None else 0.0),
        )
        self._start(Job(kind, math.nan, limits, command), event, f"{name}()")
        return command

    def _switch(self, name: str, event: AxisEvent, *, on: bool) -> AxisCommand:
        command = AxisCommand(self, name)
        state = self._next(event, command)
        if state is None:
            return command
        self._accept(command, f"{name}()")
        if self._power is not None:
            self._end(self._power, by=command)
        self._power = command
        if on or self._job is None:
            self._request_power(on=on)
            return command
        if self._state is not state:
            if self._job.command is not None:
                self._end(self._job.command, by=command)
            self._homing = None
            self._enter(state)
            self._replan(Job(JobKind.BRAKE, math.nan, self.config.maximum, None))
        return command

    def _sign(self, direction: Direction) -> float:
        if not isinstance(direction, Direction):
            raise TypeError(f"direction is {direction!r}; it must be one of {_DIRECTIONS}")
        if direction is Direction.CURRENT:
            return -1.0 if self.set_velocity < 0.0 else 1.0
        return 1.0 if direction is Direction.POSITIVE else -1.0


def _required(name: str, value: float) -> float:
    given = number(name, value)
    if given is None:
        raise TypeError(f"{name} is None; it must be a number")
    return given
