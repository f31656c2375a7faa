"""Who may write what clients write: every element has one owner, a map or access by symbol (motion-layer 7).

In the original all bytes of an image are copied in every cycle, so a mapped field cannot be written by symbol: what is
written there is lost without a word. Here it is refused, to whoever writes, and the log names the writer once. Programs
and clients together are the other side; of two that write one command in the same tick the last one counts, and the
log names both once: each of them believes that its command is carried out.

The layer itself writes what belongs to others, INIT at start-up and 0.0 for what is no number; it does so by
`InputArray.accept`, as images do, and nobody is asked.
"""

from collections.abc import Mapping
from typing import Any, Final

from motionlayer.command import Ledger
from motionlayer.event import Device, Event, EventLog, Kind, Level, Subdevice, device_of
from motionlayer.iec import InputArray

SCRIPT: Final = "the script of the run"
"""Who writes outside of programs."""

_DEVICES: Final = {
    "GVL_AXIS": (Device.Axis, Subdevice.AxisControl),
    "GVL_NCI": (Device.NciChannelCtrl, Subdevice.NciControl),
    "GVL_CAM": (Device.Camming, Subdevice.CamControl),
    "GVL_FLYING_SAW": (Device.FlyingSaw, Subdevice.FlyingSawControl),
}
"""By the namespace of a symbol: what a message about one of its elements speaks of."""


class Access:
    """Who writes, and where it is told that he may not; one for all arrays of a run.

    Args:
        events: where messages go.
        ledger: the present tick, and the program that runs now.
    """

    def __init__(self, events: EventLog, ledger: Ledger) -> None:
        self._events = events
        self._ledger = ledger

    @property
    def tick(self) -> int:
        """The present tick."""
        return self._ledger.tick

    @property
    def writer(self) -> str:
        """Who writes an attribute now."""
        program = self._ledger.issuer
        return SCRIPT if program is None else f"program {program.name}"

    def warn(self, symbol: str, index: int | None, text: str) -> None:
        """Put a warning about an element into the log."""
        base, part = _DEVICES.get(symbol.partition(".")[0], (Device.General, Subdevice.General))
        device = device_of(base, index or 0)
        event = Event(self._ledger.tick, Level.WARNING, Kind.MESSAGE, element(symbol, index), text, 0, 0, device, part)
        self._events.add(event)


class Ownership:
    """The guard of one array.

    Args:
        array: its elements are guarded from now on.
        mapped: name of the image that each mapped element belongs to, by index; None is the index of a single object.
        access: tells who writes.
        command: two writers in one tick are worth a warning.
    """

    def __init__(
        self, array: InputArray[Any], mapped: Mapping[int | None, str], access: Access, *, command: bool
    ) -> None:
        self._array = array
        self._mapped = mapped
        self._access = access
        self._command = command
        self._last: dict[int | None, tuple[int, str]] = {}
        self._told: set[tuple[int | None, str, str]] = set()
        array.guard = self

    def __call__(self, index: int | None) -> None:
        """Let the present writer write an element.

        Raises:
            PermissionError: a map owns it.
        """
        image = self._mapped.get(index)
        if image is not None:
            self._refuse(index, image)
        if self._command:
            self._note(index)

    def _refuse(self, index: int | None, image: str) -> None:
        who, what = self._array.by or self._access.writer, element(self._array.name, index)
        text = f"{what} belongs to the image {image}: {who} cannot write it"
        self._warn_once(index, who, "", text)
        raise PermissionError(f"{text}; let the controller write the image, or take the object out of [layer.map]")

    def _note(self, index: int | None) -> None:
        """Remember who has written a command, and tell of two in one tick."""
        tick, who = self._access.tick, self._array.by or self._access.writer
        before, other = self._last.get(index, (-1, ""))
        self._last[index] = (tick, who)
        if before == tick and other != who:
            what = element(self._array.name, index)
            text = f"{what}: {other} and {who} write it in the same tick; the last one counts"
            self._warn_once(index, other, who, text)

    def _warn_once(self, index: int | None, one: str, other: str, text: str) -> None:
        if (index, one, other) not in self._told:
            self._told.add((index, one, other))
            self._access.warn(self._array.name, index, text)


def element(symbol: str, index: int | None) -> str:
    """Return the name of an element: `GVL_AXIS.Ctrl[2]`."""
    return symbol if index is None else f"{symbol}[{index}]"
