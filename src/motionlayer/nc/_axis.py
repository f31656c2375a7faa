"""`Axis`: point to point motion of one coordinate."""

import math

from motionlayer.command import ErrorId
from motionlayer.nc._arguments import required
from motionlayer.nc._braking import AxisBraking
from motionlayer.nc._config import AxisConfig
from motionlayer.nc._endless import AxisEndless
from motionlayer.nc._motion import AxisCommand, Refusal
from motionlayer.nc._override import STEPS
from motionlayer.nc._positioning import AxisPositioning
from motionlayer.nc._power import AxisPower
from motionlayer.nc._referencing import AxisReferencing
from motionlayer.nc._states import AxisState
from motionlayer.store import Q, Watch


class Axis(AxisPower, AxisPositioning, AxisEndless, AxisBraking, AxisReferencing):
    """One axis. Units: the axis unit u, u/s, u/s², u/s³.

    Commands may be called between the inputs and the motion of a cycle, which is when programs run. Each is checked
    and planned in the call and may come back refused; a new motion replaces the running one without a jump in
    position, velocity or acceleration, or waits for it as its buffer mode says.
    """

    def passes(self, position: float) -> AxisCommand:
        """Wait until the setpoint passes a position or comes to it; `command.end_time` is when, inside the cycle.

        Nothing moves by it. It stays busy until then, whatever the axis does.

        Raises:
            TypeError: the position is not a number.
        """
        command = AxisCommand(self, "passes")
        place = required("position", position)
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

    def configure(self, config: AxisConfig, text: str) -> AxisCommand:
        """Put another configuration in force for everything that is commanded from now on.

        It has been checked; software limits and maxima change only while the axis has no job.

        Args:
            config: with the same name and unit.
            text: of the message: what was changed.
        """
        command = AxisCommand(self, text.partition("(")[0])
        self._accept(command, text)
        self.config = config
        self._values[Q.MIN_P], self._values[Q.MAX_P] = config.limit_min, config.limit_max
        if self._state in (AxisState.DISABLED, AxisState.STANDSTILL) and self._job is None:
            commanded = self._commanded
            self._set_plan(self.set_position)  # what rests does so within the new maxima
            self._commanded = commanded
        self._configured(self._column)
        self._end(command)
        return command

    def set_override(self, factor: float) -> None:
        """Scale the velocity of every motion from this tick on; 0 holds the axis without ending its command.

        Acceleration and jerk stay as they are. It may change in every cycle.

        Args:
            factor: 0 to 1, taken to 1e-6.

        Raises:
            TypeError: it is not a number.
            ValueError: it is not between 0 and 1.
        """
        value = required("factor", factor)
        if not 0.0 <= value <= 1.0:
            raise ValueError(f"{self.name}: override {value}, allowed: 0 to 1 (1 is 100 %)")
        self._values[Q.REQUEST] = round(value * STEPS) / STEPS
