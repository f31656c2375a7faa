"""`DriveFaults`: what goes wrong with simulated drives, by symbol, so that a remote program can try itself.

`GVL_SIMULATION.DriveFault` has an element per axis. A change of `eFault` is a command, as everywhere in the layer: the
drive fails in the next tick. NONE takes nothing back; it makes the next command a change.
"""

import enum
from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, TypeAlias

from motionlayer.drive import Fault, FaultKind, ServoDrives
from motionlayer.event import Event, EventLog, Kind, Level, Subdevice
from motionlayer.iec import LREAL, UINT, Enumeration, Field, InputArray, Struct
from motionlayer.nc import axis_device
from motionlayer.runtime import Stage, Step

if TYPE_CHECKING:
    from motionlayer.iec import SymbolTable

NAME: Final = "GVL_SIMULATION.DriveFault"


class DriveFault(enum.IntEnum):
    """`E_DRIVE_FAULT`: what goes wrong; see `FAULTS`."""

    NONE = 0
    DRIVE_ERROR = 1
    ENCODER_JUMP = 2
    LOST_ENABLE = 3
    LOST_COMMUNICATION = 4
    BLOCKED = 5


E_DRIVE_FAULT: Final = Enumeration("E_DRIVE_FAULT", UINT, DriveFault, prefix="DRIVE_FAULT_")


class DriveFaultCtrl(Struct, iec="ST_DRIVE_FAULT", pack=2):
    """A fault of a drive, as a command."""

    kind = Field("eFault", E_DRIVE_FAULT, "what goes wrong in the next tick")
    value = Field("rValue", LREAL, "of an encoder jump: by how much (u)")
    duration = Field("rDuration", LREAL, "how long (s); 0: until it is reset, or for good")


Faults: TypeAlias = InputArray[DriveFaultCtrl]


def fault_variable(axes: int) -> Faults:
    """Return the variable for a number of axes; a control side has it too, and its images carry it over."""
    return InputArray(DriveFaultCtrl, 1, axes, NAME)


def add_symbol(symbols: "SymbolTable", faults: Faults) -> None:
    """Give the variable its name."""
    symbols.add(NAME, faults, comment="what goes wrong with a simulated drive; a change is a command")


class DriveFaults:
    """Looks at the variable.

    Args:
        servos: the drives that can fail.
        names: of all axes, in the order of their columns.
        faults: the variable.
        events: where faults are told that cannot be.
    """

    def __init__(self, servos: ServoDrives, names: Sequence[str], faults: Faults, events: EventLog) -> None:
        self._servos = servos
        self._names = names
        self._events = events
        self._array = faults
        self._last = [int(DriveFault.NONE)] * len(names)

    def stage(self) -> Stage:
        """Return what a tick calls."""
        return Stage(Step.OUTPUTS, "drive faults", self._cycle)

    def _cycle(self, tick: int) -> None:
        if not self._array.touched:
            return
        for index in self._array.take():
            asked = self._array[index]
            changed, self._last[index - 1] = asked.kind != self._last[index - 1], int(asked.kind)
            if changed and asked.kind != DriveFault.NONE:
                self._inject(tick, index - 1, asked)

    def _inject(self, tick: int, column: int, asked: DriveFaultCtrl) -> None:
        """Let a drive fail from the next tick on, or tell why it cannot."""
        try:
            self._servos.inject(column, _fault(asked), tick + 1)
        except KeyError:
            self._refuse(tick, column, 'the drive is ideal, and never has a fault; set kind = "servo"')
        except ValueError as error:
            self._refuse(tick, column, str(error))

    def _refuse(self, tick: int, column: int, why: str) -> None:
        name, device, part = self._names[column], axis_device(column), Subdevice.General
        text = f"{NAME}[{column + 1}]: {why}"
        self._events.add(Event(tick, Level.WARNING, Kind.MESSAGE, name, text, 0, 0, device, part))


def _fault(asked: DriveFaultCtrl) -> Fault:
    """Return what is asked for.

    Raises:
        ValueError: there is no such fault.
    """
    if not isinstance(asked.kind, DriveFault):
        raise ValueError(f"eFault = {asked.kind}, allowed: {', '.join(f'{one} ({one.name})' for one in DriveFault)}")
    kind = FaultKind[asked.kind.name]
    value = asked.value if kind is FaultKind.ENCODER_JUMP else None
    return Fault(kind, value, asked.duration or None)
