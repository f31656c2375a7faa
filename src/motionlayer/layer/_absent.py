"""`AbsentNamespace`: a namespace that is not built in. Its symbols are there, and every command is answered NOT_EXIST.

Its program shows INVALID until the axes have been brought up, and NOT_EXIST from then on (motion-layer 1.2). A cycle in
which nobody writes a command costs a test.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from motionlayer.layer.types._progress import Progress

if TYPE_CHECKING:
    from motionlayer.iec import InputArray, OutputArray


class AbsentNamespace:
    """A namespace that is off.

    Args:
        e_init: where its program shows how far it is.
        ctrl: command fields `cmd`, one per object.
        state: state fields `state`.
        ready: tells whether the axes have been brought up.
    """

    # Called in every cycle of every machine: a third quicker than with a dictionary.
    __slots__ = ("_ctrl", "_e_init", "_ready", "_state", "_tells_error", "_waits")

    def __init__(
        self,
        e_init: "OutputArray[Any]",
        ctrl: "InputArray[Any]",
        state: "OutputArray[Any]",
        ready: Callable[[], bool],
    ) -> None:
        self._e_init = e_init
        self._ctrl = ctrl
        self._state = state
        self._ready = ready
        self._waits = True
        self._tells_error = hasattr(state[1], "error")  # of the structures of states that of a cam has one

    def call(self, _tick: int) -> None:
        """Do the work of one cycle."""
        if self._waits or self._ctrl.touched:
            self._go_on()

    def _go_on(self) -> None:
        """Wait for the axes, then answer every command; NULL takes the answer back."""
        if self._waits and not self._ready():
            return
        if self._waits:
            self._waits = False
            self._e_init.value = Progress.NOT_EXIST
        for index in self._ctrl.take():
            command, state = self._ctrl[index].cmd, self._state[index]
            state.state = int(command) + Progress.NOT_EXIST if command else 0
            if self._tells_error:
                state.error = bool(command)


class AbsentFunctions:
    """Touch probes and trigger boxes that are off; they have no commands that could be answered.

    Args:
        e_init: where their program shows how far it is.
        ready: tells whether the axes have been brought up.
    """

    __slots__ = ("_e_init", "_ready", "_waits")

    def __init__(self, e_init: "OutputArray[Any]", ready: Callable[[], bool]) -> None:
        self._e_init = e_init
        self._ready = ready
        self._waits = True

    def call(self, _tick: int) -> None:
        """Do the work of one cycle."""
        if self._waits and self._ready():
            self._waits = False
            self._e_init.value = Progress.NOT_EXIST
