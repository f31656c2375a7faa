"""`Messages`: the variables of `GVL_MSG_AXIS` and `GVL_MSG` follow what is said in the run (motion-layer 8).

```
events ─┬─ levels ─ queue ─ thread ─ file            record.log: complete, whatever the lists hold
        └─ levels ─ slots ─ [end of tick] ─ MotionMessages, MetricMessages
                      ▲ freed by the writer: many messages, an error, or 5 s
```

The lists of `GVL_MSG` have no writer: they are filled, and stay so.
"""

from collections.abc import Callable
from datetime import datetime
from typing import TYPE_CHECKING, Final

from motionlayer.event import Device, MessageList, list_of
from motionlayer.layer._message_globals import other_list_of
from motionlayer.layer._messages_levels import LevelVariables
from motionlayer.layer._messages_slots import Slots
from motionlayer.layer._messages_writer import PERIOD, MessageWriter
from motionlayer.runtime import Stage, Step

if TYPE_CHECKING:
    from motionlayer.command import Ledger
    from motionlayer.event import Event, EventLog, Levels
    from motionlayer.layer._message_globals import MessageGlobals, OtherList, OtherMessageGlobals

DAY: Final = 10
SECONDS: Final = 19
"""Characters of the date, and of a local time without its milliseconds."""

REFRESH: Final = 0.010
"""Seconds after which the local time is shown anew; a message has the time of its tick."""


class Messages:
    """Lists, their writers and levels.

    Args:
        variables: of `GVL_MSG_AXIS`.
        others: of `GVL_MSG`.
        events: of the run; listened to from now on.
        levels: which messages are written, into files and lists alike.
        ledger: the present tick.
        time: returns the local time of a tick, `YYYY-MM-DD-hh:mm:ss.xxx`.
        ready: tells whether the axes have been brought up.
        cycle_time: length of a tick, s.
    """

    def __init__(
        self,
        variables: "MessageGlobals",
        others: "OtherMessageGlobals",
        events: "EventLog",
        levels: "Levels",
        ledger: "Ledger",
        time: Callable[[int], str],
        ready: Callable[[], bool],
        cycle_time: float,
    ) -> None:
        lists = {MessageList.MOTION: variables.motion, MessageList.METRICS: variables.metric}
        period = max(1, round(PERIOD / cycle_time))
        self._slots: dict[MessageList | OtherList, Slots] = {of: Slots(one, time) for of, one in lists.items()}
        self._slots |= {of: Slots(one, time) for of, one in others.lists.items()}
        self._writers = [MessageWriter(one, self._slots[of], ledger, period) for of, one in lists.items()]
        self._level_variables = LevelVariables(variables, others, levels, events, ledger)
        self._levels = levels
        self._of_device: dict[int, Slots] = {}
        self._time = time
        self._ready = ready
        self._starting = True
        self._local_time = variables.local_time
        self._local_date = variables.local_date
        self._refresh = max(1, round(REFRESH / cycle_time))
        self._second = ""
        self._next = 0
        events.listen(self._add)

    def stage(self) -> Stage:
        """Return what a tick calls, before images are copied out."""
        return Stage(Step.OUTPUTS, "messages", self._cycle)

    def _add(self, event: "Event") -> None:
        """Take in a message, if it is of interest."""
        if self._levels.passes(event):
            slots = self._of_device.get(event.device) or self._slots_of(event.device)
            slots.add(event, counted=event.device != Device.Device_MoverSelector)
            self._next = 0

    def _slots_of(self, device: int) -> Slots:
        """Return the list of a device, and remember it."""
        self._of_device[device] = slots = self._slots[list_of(device) or other_list_of(device)]
        return slots

    def _cycle(self, tick: int) -> None:
        """Show what has come in this tick."""
        self._level_variables.take()
        if self._starting and self._ready():
            self._starting = False
            self._level_variables.end_of_start()
        if tick % self._refresh == 0:
            self._tell_time(self._time(tick))
        if tick >= self._next:
            for writer in self._writers:
                writer.cycle()
            for slots in self._slots.values():
                slots.put_down()
            self._next = min(writer.due for writer in self._writers)

    def _tell_time(self, text: str) -> None:
        self._local_time.memory[: len(text)] = text.encode()
        if text[:SECONDS] != self._second:
            self._second = text[:SECONDS]
            at = datetime.fromisoformat(f"{text[:DAY]}T{text[DAY + 1 : SECONDS]}+00:00")
            self._local_date.value = int(at.timestamp())
