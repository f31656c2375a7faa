"""What a run has of the motion layer: the layer of its own axes, or the side that commands one in another machine."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from motionlayer.machine._resetting import ResettableRun
from motionlayer.runtime import Stage

if TYPE_CHECKING:
    from motionlayer.fb import AXIS_REF
    from motionlayer.iec import Symbol, SymbolTable
    from motionlayer.layer import ControlSide, ImageMapping, MotionLayer, Namespaces
    from motionlayer.machine._layer_build import Layered
    from motionlayer.nc import AxisStage


class LayeredRun(ResettableRun):
    """A run of a machine that may have a motion layer, or command one."""

    _layered: "Layered | None" = None

    @property
    def layer(self) -> "MotionLayer | ControlSide":
        """The motion layer, or its variables on a control side; a program uses both in the same way.

        Raises:
            ValueError: the machine has neither.
        """
        return self._require_layer("motion layer").layer

    @property
    def symbols(self) -> "SymbolTable":
        """All variables of the motion layer by name; see `layer`."""
        return self.layer.symbols

    @property
    def mapping(self) -> "ImageMapping":
        """The images of the motion layer, and where buses attach theirs.

        Raises:
            ValueError: the machine has no motion layer, nor commands one.
        """
        return self._require_layer("images").mapping

    @property
    def namespaces(self) -> "Namespaces":
        """Commands and states that control programs declare themselves.

        Raises:
            ValueError: the machine has no motion layer, nor commands one.
        """
        return self._require_layer("namespaces").namespaces

    def _require_layer(self, what: str) -> "Layered":
        if self._layered is None:
            raise ValueError(f"{self.machine.name} has no {what}: add [layer] to the machine file, or [control]")
        return self._layered

    def _known_symbols(self) -> "Iterable[Symbol]":
        """Return all variables, of a machine without a motion layer none."""
        return () if self._layered is None else self._layered.layer.symbols

    def _add_layer(self, refs: "Callable[[], Mapping[str, AXIS_REF]]", axes: "AxisStage") -> Sequence[Stage]:
        """Make what the machine describes, and return what a tick calls for it.

        Args:
            refs: returns the axes as blocks know them; called if there is a motion layer for them.
            axes: has their cyclic interface.
        """
        description = self.machine.description
        if description.layer is None and description.control is None:
            return []
        from motionlayer.layer import Outside  # noqa: PLC0415 - most machines have neither
        from motionlayer.machine._layer_build import Surroundings, make_layer  # noqa: PLC0415

        outside = Outside(self.areas, self.mailbox, self.events)
        run = Surroundings(outside, self._ledger, self.log, self._servos, self.base_cycle_ns, self.guest)
        self._layered = make_layer(description, run, refs, axes)
        return self._layered.stages

    def _pinned(self) -> Iterable[object]:
        layered = self._layered
        ports = () if layered is None else (*layered.mapping.ports, *layered.namespaces.ports)
        return *super()._pinned(), *ports
