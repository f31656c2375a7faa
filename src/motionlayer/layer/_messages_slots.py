"""`Slots`: the messages of a list, as clients read them (motion-layer 8.2).

A message takes the first free slot; the writer frees them all at once, so the free ones are always the last ones. A
message that finds none is lost to the list, and counted. It is not lost to the file, which has a way of its own. What
comes in a tick is put down at its end, so a message costs the one who raises it no more than a place in a queue, and a
tick no more than a whole list.
"""

from typing import TYPE_CHECKING, Final

from motionlayer.event import Event, Level, text_of
from motionlayer.iec import UDINT, UINT

if TYPE_CHECKING:
    from collections.abc import Callable

    from motionlayer.layer._message_globals import MessageList

TEXT: Final = 127
"""Characters of a text in a slot; the line of the file has more."""

NUMBER: Final = (1 << 64) - 1
"""A number is a ULINT."""

MOST_ERRORS: Final = (1 << 8 * UINT.size) - 1
MOST_LOST: Final = (1 << 8 * UDINT.size) - 1
"""Where the counters stay."""


class Slots:
    """What one list holds.

    Args:
        variables: where clients see it.
        time: returns the local time of a tick as text.

    Attributes:
        size: slots there are.
        used: slots that are not free; what has come in the present tick is among them.
        errors: errors since the slots were freed, those that found no slot too.
        lost: messages that found none, since the run began.
    """

    def __init__(self, variables: "MessageList", time: "Callable[[int], str]") -> None:
        self.size: Final = len(variables.messages)
        self.used = self.errors = self.lost = 0
        self._variables = variables
        self._time = time
        self._fresh: list[Event] = []
        self._changed = False

    def add(self, event: Event, *, counted: bool = True) -> None:
        """Take in a message; `counted` tells whether an error of its device counts as one of the list (8.2)."""
        if self.used < self.size:
            self.used += 1
            self._fresh.append(event)
        else:
            self.lost += 1
        if counted and event.level == Level.ERROR:
            self.errors += 1
        self._changed = True

    def put_down(self) -> None:
        """Show what has come since the last call."""
        if not self._changed:
            return
        self._changed = False
        variables, fresh = self._variables, self._fresh
        if fresh:
            variables.messages.array[self.used - len(fresh) : self.used] = [self._row(event) for event in fresh]
            fresh.clear()
        variables.index.value = self.used
        variables.errors.value = min(self.errors, MOST_ERRORS)
        variables.lost.value = min(self.lost, MOST_LOST)

    def _row(self, event: Event) -> tuple[int, int, int, int, bytes, bytes]:
        """Return a message as the fields of `Message`; texts are Windows-1252, in which an omega is a question mark."""
        tick, level, _, _, _, code, _, device, part = event
        text = text_of(event)[:TEXT].encode("cp1252", "replace")
        return level, device, part, code & NUMBER, self._time(tick).encode(), text

    def free(self) -> None:
        """Free all slots, and begin to count anew."""
        messages = self._variables.messages
        messages.memory[:] = bytes(len(messages.memory))
        self._fresh.clear()
        self.used = self.errors = 0
        self._changed = True
