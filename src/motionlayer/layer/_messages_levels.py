"""`LevelVariables`: how much is said, by symbol (motion-layer 8.8).

`MessageLevel` holds for all that has no level of its own; whoever writes the level of an object gives it one. While
the axes are brought up they say everything, as in the original. There is one source for all objects (D44): the `Levels`
that the message files ask too.
"""

from typing import TYPE_CHECKING, Final

from motionlayer.event import BLOCK, Device, Event, EventLog, Kind, Level, Levels, Subdevice, device_of
from motionlayer.iec import DINT, InputArray

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from motionlayer.command import Ledger
    from motionlayer.layer._message_globals import MessageGlobals, OtherMessageGlobals


class LevelVariables:
    """The levels of `GVL_MSG_AXIS` and `GVL_MSG`.

    Args:
        variables: of `GVL_MSG_AXIS`.
        others: of `GVL_MSG`.
        levels: that decide which messages are written.
        events: where a level that there is not is told.
        ledger: the present tick.
    """

    def __init__(
        self,
        variables: "MessageGlobals",
        others: "OtherMessageGlobals",
        levels: Levels,
        events: EventLog,
        ledger: "Ledger",
    ) -> None:
        self._all = variables.level
        self._axes = variables.axis_level
        self._levels = levels
        self._events = events
        self._ledger = ledger
        self._objects: Final[Mapping[str, tuple[InputArray[int], Sequence[Device]]]] = {
            array.name: (array, bases)
            for array, bases in (
                (variables.axis_level, (Device.Axis,)),
                (variables.cam_level, (Device.Camming,)),
                (variables.saw_level, (Device.FlyingSaw,)),
                (variables.nci_level, (Device.NciChannel, Device.NciChannelCtrl)),
                (variables.trigger_level, (Device.XfcTriggerBox,)),
                (variables.probe_level, (Device.XfcTouchProbe,)),
                (others.station_level, (Device.XtsStation,)),
                (others.mover_level, (Device.Mover, Device.MoverCtrl)),
                (others.process_level, (Device.Process,)),
            )
        }
        self._arrays = [array for array, _ in self._objects.values()]
        self._own: dict[tuple[str, int], None] = {}
        self._starting = True
        self._show_all()
        for index in range(1, len(self._axes) + 1):
            self._show(self._axes, index, Level.VERBOSE)
            self._put(self._axes, index, Level.VERBOSE)

    def end_of_start(self) -> None:
        """Let the axes have the level of all, but for those that were given one meanwhile."""
        self._starting = False
        for index in range(1, len(self._axes) + 1):
            if (self._axes.name, index) not in self._own:
                self._put(self._axes, index, None)
        self._show_all()

    def take(self) -> None:
        """Take up what clients have written; that of objects first, since the level of all is shown for the others."""
        for array in self._arrays:
            if array.touched:
                for index in array.take():
                    self._own[array.name, index] = None
                    self._put(array, index, self._checked(array, index))
        if self._all.touched:
            self._all.take()
            self._levels.level = self._checked(self._all, None)
            self._show_all()

    def _put(self, array: InputArray[int], index: int, level: Level | None) -> None:
        """Let a level hold for an object; ids end with the block (D47)."""
        if index < BLOCK:
            for base in self._objects[array.name][1]:
                self._levels.set_level(device_of(base, index), level)

    def _show_all(self) -> None:
        """Show the level of all, and of objects without one of their own."""
        level = self._levels.level
        if level > Level.ERROR:  # the declared eMessageEmpty says the same as eMessageError
            self._show(self._all, None, level)
        for array in self._arrays:
            for index in range(1, len(array) + 1):
                if (array.name, index) not in self._own and not (self._starting and array is self._axes):
                    self._show(array, index, level if level > Level.ERROR else 0)

    def _show(self, array: InputArray[int], index: int | None, level: int) -> None:
        data = bytearray(array.size)
        DINT.pack_into(int(level), data)
        array.accept(index, data)
        array.take()

    def _checked(self, array: InputArray[int], index: int | None) -> Level:
        """Return the level that was written; one that there is not is told, and the nearest one holds."""
        asked = int(array.value if index is None else array[index])
        level = Level(min(max(asked, Level.ERROR), Level.SENTIENT))
        if not 0 <= asked <= Level.SENTIENT:
            name = array.name if index is None else f"{array.name}[{index}]"
            text = f"{name} = {asked}, allowed: 0 (eMessageEmpty) to 6 (eMessageSentient); {level.value} holds"
            device, part = Device.Device_MainAxis, Subdevice.General
            self._events.add(Event(self._ledger.tick, Level.WARNING, Kind.MESSAGE, "", text, 0, 0, device, part))
        return level
