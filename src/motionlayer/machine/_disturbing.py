"""What the owner of a run does to it from outside: drives fail, all axes stop. Traces hold it as inputs."""

from typing import TYPE_CHECKING, Any

from motionlayer.command import Command, all_of
from motionlayer.drive import Fault
from motionlayer.machine._ads_run import ServedRun
from motionlayer.machine._outside import EMERGENCY_STOP, INJECT, pack_fault, unpack_fault

if TYPE_CHECKING:
    from collections.abc import Mapping

    from motionlayer.nc import Axis


class DisturbedRun(ServedRun):
    """A run whose drives can be made to fail, and whose axes to stop.

    Attributes:
        axes: the axes by name.
    """

    axes: "Mapping[str, Axis]"

    def _take_disturbances(self) -> None:
        """Let a replay do the same."""
        self.mailbox.register(INJECT, self._injected)
        self.mailbox.register(EMERGENCY_STOP, self._emergency_stopped)

    def inject(self, axis: str, fault: Fault, tick: int | None = None) -> None:
        """Let something go wrong with the servo drive of an axis.

        Args:
            axis: name of the axis.
            fault: what.
            tick: in whose inputs it shows first; the next tick where left out.

        Raises:
            KeyError: no such axis.
            ValueError: its drive is ideal, or the tick has passed.
        """
        if self.machine.description.axis[self.axes[axis].name].drive.kind != "servo":
            raise ValueError(f'{axis}: its drive is ideal, and never has a fault; set kind = "servo"')
        earliest = self.tick + 1 if self._ledger.issuer is not None else self.tick
        begin = earliest if tick is None else tick
        if begin < earliest:
            raise ValueError(
                f"{axis}: a fault at tick {begin}, and tick {earliest} is the next whose inputs can show it"
            )
        self._note(INJECT, pack_fault(axis, fault, begin))
        self._servos.inject(list(self.axes).index(axis), fault, begin)

    def _injected(self, payload: bytes) -> None:
        axis, fault, tick = unpack_fault(payload)
        self._servos.inject(list(self.axes).index(axis), fault, tick)

    def emergency_stop(self) -> Command[tuple[Any, ...]]:
        """Stop all axes with their maximum dynamics, also those that stop more gently already.

        What stands takes no command; an axis in error brakes by itself.

        Returns:
            A command that is done when all rest; until then they take no other motion.
        """
        self._note(EMERGENCY_STOP)
        return self._brake()

    def _emergency_stopped(self, _payload: bytes) -> None:
        self._brake()

    def _brake(self) -> Command[tuple[Any, ...]]:
        return all_of(*[axis.emergency_stop() for axis in self.axes.values() if axis.command is not None])

    def _note(self, channel: str, payload: bytes = b"") -> None:
        """Record what is done to the run from outside; what programs do follows from them."""
        if self._ledger.issuer is None and not self.ticking:
            self.mailbox.note(channel, payload)
