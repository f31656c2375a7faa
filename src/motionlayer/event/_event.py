"""`Event` and the ring `EventLog`."""

import enum
from collections import deque
from collections.abc import Callable
from typing import NamedTuple


class Level(enum.IntEnum):
    """`E_MessageType`: how much a person should care; the smaller, the graver (motion-layer 2.5)."""

    BATCH = 1
    ERROR = 2
    WARNING = 3
    INFO = 4
    VERBOSE = 5
    SENTIENT = 6


class Kind(enum.StrEnum):
    """What the record speaks of: a message, or one step in the life of a command."""

    MESSAGE = "message"
    ACCEPTED = "accepted"
    REFUSED = "refused"
    DONE = "done"
    ABORTED = "aborted"
    ERROR = "error"


class Event(NamedTuple):
    """One record.

    Attributes:
        tick: the tick in which it happened.
        level: how much a person should care.
        kind: a message, or which step of a command.
        source: the object it speaks of, `X` or `program pick`.
        text: one line for a person; where a command is accepted its call, whose numbers read back exactly.
        code: error id (`motionlayer.command.errors`), 0 without.
        command: number of the command within the run, 0 without.
        device: `e_Device` plus the id of the object, for the line of a message file.
        subdevice: `e_Subdevice`.
    """

    tick: int
    level: Level
    kind: Kind
    source: str
    text: str
    code: int = 0
    command: int = 0
    device: int = 0
    subdevice: int = 0


class EventLog:
    """The last `capacity` events, and the listeners that see every one in order."""

    def __init__(self, capacity: int = 4096) -> None:
        self._ring: deque[Event] = deque(maxlen=capacity)
        self._listeners: list[Callable[[Event], None]] = []

    def listen(self, listener: Callable[[Event], None]) -> None:
        """Call `listener` with every event from now on, in the cycle thread."""
        self._listeners.append(listener)

    def add(self, event: Event) -> None:
        """Keep an event and hand it to the listeners."""
        self._ring.append(event)
        for listener in self._listeners:
            listener(event)

    @property
    def ring(self) -> deque[Event]:
        """The ring itself, for who copies a run and puts it back."""
        return self._ring

    def last(self, level: Level = Level.SENTIENT) -> list[Event]:
        """Return what the ring still holds, oldest first, as grave as `level` or graver."""
        return [event for event in self._ring if event.level <= level]
