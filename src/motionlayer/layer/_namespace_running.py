"""`RunningNamespace`: calls the objects of a namespace of a control program; one with nothing to do costs nothing."""

from collections.abc import Sequence
from typing import Any

from motionlayer.iec import InputArray
from motionlayer.layer._answer import Waits
from motionlayer.layer._namespace_controller import NamespaceController
from motionlayer.layer._options import Schedule


class RunningNamespace:
    """One namespace at work.

    Args:
        ctrl: its command fields.
        controllers: its objects, in the order of their places.
        schedule: in which ticks they are called.
        waits: who waits for their states.

    Attributes:
        waits: as given.
    """

    def __init__(
        self,
        ctrl: InputArray[Any],
        controllers: Sequence[NamespaceController],
        schedule: Schedule,
        waits: Waits,
    ) -> None:
        self._ctrl = ctrl
        self._controllers = controllers
        self._schedule = schedule
        self._active: list[NamespaceController] = list(controllers)
        self.waits = waits

    def call(self, tick: int) -> None:
        """Do the work of one cycle."""
        if not self._schedule.holds(tick):
            return
        if self._ctrl.touched:
            low = self._ctrl.low or 0
            awake = {one.place for one in self._active} | {index - low for index in self._ctrl.take()}
            self._active = [one for one in self._controllers if one.place in awake]
        if self._active:
            self._active = [one for one in self._active if one.call()]
        if self.waits.open:
            self.waits.look()
