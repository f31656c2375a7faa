"""The base of an axis: its values in the store, its state, and the life of its commands."""

from typing import TYPE_CHECKING

from motionlayer.command import ERRORS, Command, ErrorId, Ledger, MotionError
from motionlayer.event import Event, EventLog, Kind, Level, Subdevice
from motionlayer.nc._axis_ref import HOMED, StateDWord
from motionlayer.nc._config import AxisConfig
from motionlayer.nc._motion import AxisCommand, Refusal
from motionlayer.nc._states import NEED_POWER, TRANSITIONS, AxisEvent, AxisState
from motionlayer.nc._subdevices import axis_device
from motionlayer.store import Q, Store

if TYPE_CHECKING:
    from collections.abc import Callable


class AxisBase:
    """What can be read of an axis, and how its state and its commands change.

    Args:
        config: what the machine description says.
        column: the coordinate in the store.
        store: setpoints and actual values.
        ledger: numbers and owners of commands.
        events: where the life of commands and errors is told.
    """

    def __init__(self, config: AxisConfig, column: int, store: Store, ledger: Ledger, events: EventLog) -> None:
        self.config = config
        self.name = config.name
        self.ledger = ledger
        self._configured: Callable[[int], None] = _nobody
        """Told the column, when another configuration has come into force."""
        self._error: MotionError | None = None
        self._column = column
        self._device = axis_device(column)
        self._store = store
        self._values = store.column(column)
        self._events = events
        self._state = AxisState.DISABLED
        self._values[Q.OVERRIDE] = self._values[Q.REQUEST] = 1.0
        self._values[Q.STATE] = self._state
        self._values[Q.MIN_P], self._values[Q.MAX_P] = config.limit_min, config.limit_max
        self._values[Q.FLAGS] = StateDWord.PTPmode

    @property
    def state(self) -> AxisState:
        """Present state."""
        return self._state

    @property
    def error(self) -> MotionError | None:
        """Why the axis is in ErrorStop, None elsewhere."""
        return self._error

    @error.setter
    def error(self, error: MotionError | None) -> None:
        self._error = error
        self._values[Q.ERROR] = 0 if error is None else error.id

    @property
    def homed(self) -> bool:
        """The position is that of a reference."""
        return bool(int(self._values[Q.FLAGS]) & HOMED)

    @homed.setter
    def homed(self, homed: bool) -> None:
        self._flag(HOMED if homed else 0, off=HOMED)

    @property
    def set_position(self) -> float:
        """Setpoint valid at the present tick, u."""
        return self._values[Q.SET_P]

    @property
    def set_velocity(self) -> float:
        """Setpoint valid at the present tick, u/s."""
        return self._values[Q.SET_V]

    @property
    def set_acceleration(self) -> float:
        """Setpoint valid at the present tick, u/s²."""
        return self._values[Q.SET_A]

    @property
    def actual_position(self) -> float:
        """What the drive reported in this tick, u."""
        return self._values[Q.ACTUAL_P]

    @property
    def lag(self) -> float:
        """Set position a dead time ago less the actual position, u; exactly 0 for an ideal drive."""
        return self._values[Q.LAG]

    @property
    def override(self) -> float:
        """Factor on the velocity of every motion, 0 to 1."""
        return self._values[Q.REQUEST]

    @property
    def power_requested(self) -> bool:
        """The drive is asked to be on."""
        return bool(self._values[Q.ENABLE])

    @property
    def enabled(self) -> bool:
        """The drive is ready."""
        return bool(self._values[Q.READY])

    def _step(self, event: AxisEvent) -> AxisState:
        """Return the next state for an event that cannot be refused."""
        state = TRANSITIONS[self._state][event]
        assert isinstance(state, AxisState), (self._state, event)
        return state

    def _next(self, event: AxisEvent, command: AxisCommand) -> AxisState | None:
        """Return the next state, or refuse the command."""
        state = TRANSITIONS[self._state][event]
        if event in NEED_POWER and self._state is AxisState.STANDSTILL and not self.power_requested:
            state = ErrorId.NOT_ENABLED  # the drive follows the request in the next tick
        elif event in NEED_POWER and self._state is AxisState.DISABLED and self.power_requested:
            state = ErrorId.NOT_READY_AT_START  # it has not followed yet
        if isinstance(state, AxisState):
            return state
        self._refuse(command, Refusal(state, f"state {self._state!s}"))
        return None

    def _enter(self, state: AxisState) -> None:
        self._state = state
        self._values[Q.STATE] = state

    def _flag(self, on: int = 0, *, off: int = 0) -> None:
        """Show bits of `StateDWord` that change with commands; plain integers, because every command does it."""
        self._values[Q.FLAGS] = int(self._values[Q.FLAGS]) & ~off | on

    def _tell(self, level: Level, kind: Kind, text: str, code: int = 0) -> None:
        tick, part = self.ledger.tick, Subdevice.AxisCycle
        self._events.add(Event(tick, level, kind, self.name, text, code, 0, self._device, part))

    def _tell_of(self, command: AxisCommand, level: Level, kind: Kind, text: str, code: int = 0) -> None:
        tick, part = self.ledger.tick, command.part
        self._events.add(Event(tick, level, kind, self.name, text, code, command.number, self._device, part))

    def _accept(self, command: AxisCommand, text: str) -> None:
        self._tell_of(command, Level.VERBOSE, Kind.ACCEPTED, text)

    def _refuse(self, command: AxisCommand, refusal: Refusal) -> AxisCommand:
        error = MotionError(refusal.id, self.name, refusal.detail)
        self._tell_of(command, Level.WARNING, Kind.REFUSED, f"{command.name}: {error.text}", refusal.id)
        command.fail(error)
        return command

    def _fail(self, command: AxisCommand, error: MotionError) -> None:
        self._tell_of(command, Level.ERROR, Kind.ERROR, f"{command.name}: {ERRORS[error.id].text}", error.id)
        command.fail(error)

    def _end(self, command: AxisCommand, by: Command[None] | None = None) -> None:
        """End a command done, or aborted by another one."""
        if by is None:
            self._tell_of(command, Level.VERBOSE, Kind.DONE, command.name)
            command.finish(None)
        else:
            self._tell_of(command, Level.VERBOSE, Kind.ABORTED, f"{command.name} by {by.name}")
            command.abort(by)

    def __repr__(self) -> str:
        return f"<Axis {self.name}: {self._state!s} at {self.set_position:.6g} {self.config.unit}>"


def _nobody(_column: int) -> None:
    """Nobody wants to know."""
