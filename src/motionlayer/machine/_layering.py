"""What a run has of the motion layer: the layer of its own axes, or the side that commands one in another machine."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from motionlayer.event import Level
from motionlayer.iec import Symbol, SymbolTable
from motionlayer.layer import (
    NAMESPACES,
    ControlSide,
    Features,
    ImageMapping,
    LayerOptions,
    MapOptions,
    Messages,
    MotionLayer,
    Namespaces,
    Outside,
    Schedule,
    Sizes,
    layer_mapping,
    map_variables,
)
from motionlayer.machine._drive_symbols import DriveFaults, add_symbol, fault_variable
from motionlayer.machine._layer_description import ControlDescription, LayerDescription, MapDescription
from motionlayer.machine._outside import LINK, Told
from motionlayer.machine._resetting import ResettableRun
from motionlayer.runtime import Stage, Step

if TYPE_CHECKING:
    from motionlayer.fb import AXIS_REF
    from motionlayer.nc import AxisRefs, AxisStage


class LayeredRun(ResettableRun):
    """A run of a machine that may have a motion layer, or command one."""

    _layer: MotionLayer | ControlSide | None = None
    _mapping: ImageMapping | None = None
    _messages: Messages | None = None
    _namespaces: Namespaces | None = None
    _faults: DriveFaults | None = None

    @property
    def layer(self) -> MotionLayer | ControlSide:
        """The motion layer, or its variables on a control side; a program uses both in the same way.

        Raises:
            ValueError: the machine has neither.
        """
        if self._layer is None:
            raise ValueError(f"{self.machine.name} has no motion layer: add [layer] to the machine file, or [control]")
        return self._layer

    @property
    def symbols(self) -> SymbolTable:
        """All variables of the motion layer by name; see `layer`."""
        return self.layer.symbols

    def _known_symbols(self) -> Iterable[Symbol]:
        """Return all variables, of a machine without a motion layer none."""
        return () if self._layer is None else self._layer.symbols

    @property
    def mapping(self) -> ImageMapping:
        """The images of the motion layer, and where buses attach theirs.

        Raises:
            ValueError: the machine has no motion layer, nor commands one.
        """
        if self._mapping is None:
            raise ValueError(f"{self.machine.name} has no images: add [layer] to the machine file, or [control]")
        return self._mapping

    @property
    def namespaces(self) -> Namespaces:
        """Commands and states that control programs declare themselves.

        Raises:
            ValueError: the machine has no motion layer, nor commands one.
        """
        if self._namespaces is None:
            raise ValueError(f"{self.machine.name} has no namespaces: add [layer] to the machine file, or [control]")
        return self._namespaces

    def _add_layer(self, refs: "Callable[[], Mapping[str, AXIS_REF]]", axes: "AxisStage") -> Sequence[Stage]:
        """Make what the machine describes, and return what a tick calls for it.

        Args:
            refs: returns the axes as blocks know them; called if there is a motion layer for them.
            axes: has their cyclic interface.
        """
        description, outside = self.machine.description, Outside(self.areas, self.mailbox, self.events)
        if description.layer is not None:
            stages = self._add_own(description.layer, outside, refs(), axes.images)
        elif description.control is not None:
            stages = self._add_control(description.control, outside)
        else:
            return []
        self._namespaces = Namespaces(self.symbols, outside, self._ledger, self.base_cycle_ns)
        return [*self._namespaces.stages(), *stages]

    def _add_own(
        self, described: LayerDescription, outside: Outside, refs: "Mapping[str, AXIS_REF]", images: "AxisRefs"
    ) -> Sequence[Stage]:
        options = layer_options(described, len(refs))
        layer = MotionLayer(list(refs.values()), images, self.events, self._ledger, options)
        maps = layer_maps(described, list(refs))
        faults = fault_variable(len(refs))
        mapping = map_variables(layer_mapping, maps, layer.globals, outside, self._ledger, {faults.name: faults})
        add_symbol(layer.symbols, faults)
        self._layer, self._mapping = layer, mapping
        self._faults = DriveFaults(self._servos, list(refs), faults, self.events)
        return [
            Stage(Step.INPUTS, "MAPPING_in", mapping.copy_in),
            *layer.stages(),
            self._faults.stage(),
            self._add_messages(layer, described).stage(),
            Stage(Step.OUTPUTS, "MAPPING_out", mapping.copy_out),
        ]

    def _add_messages(self, layer: MotionLayer, described: LayerDescription) -> Messages:
        """Let GVL_MSG_AXIS follow the run; the level is that of `[log]`, or as the original's where there is none."""
        levels = self.log.levels
        if described.test:
            levels.level = Level.VERBOSE
        elif self.log.folder is None:
            levels.level = Level.ERROR
        self._messages = Messages(
            layer.globals.messages,
            self.events,
            levels,
            self._ledger,
            self.log.time,
            lambda: layer.ready,
            self.base_cycle_ns * 1e-9,
        )
        return self._messages

    def _add_control(self, described: ControlDescription, outside: Outside) -> Sequence[Stage]:
        sizes, maps = layer_sizes(described, len(described.axes)), control_maps(described)
        faults = fault_variable(len(described.axes))
        control = ControlSide(described.axes, sizes, maps, outside, self._ledger, {faults.name: faults})
        add_symbol(control.symbols, faults)
        self.mailbox.register(LINK, Told(self.events, self._ledger, "link"))
        self._layer, self._mapping = control, control.mapping
        return control.stages()

    def _pinned(self) -> Iterable[object]:
        ports = () if self._mapping is None else (*self._mapping.ports, *self.namespaces.ports)
        return *super()._pinned(), *ports


def layer_options(described: LayerDescription, axes: int) -> LayerOptions:
    """Return what the layer is told of a description and its number of axes."""
    divisors, phases = described.divisor, described.phase
    return LayerOptions(
        sizes=layer_sizes(described, axes),
        features=Features(
            nci=described.nci,
            cam=described.cam,
            xfc=described.xfc,
            saw=described.saw,
            windows=described.paths == "windows",
        ),
        timeout=described.timeout,
        schedule={name: Schedule(getattr(divisors, name), getattr(phases, name)) for name in NAMESPACES},
    )


def layer_sizes(described: LayerDescription | ControlDescription, axes: int) -> Sizes:
    """Return how many objects there are of each kind."""
    return Sizes(
        max_axis=axes,
        max_nci_channels=described.max_nci_channels,
        max_trigger_box=described.max_trigger_box,
        max_touch_probe=described.max_touch_probe,
        max_trigger_count=described.max_trigger_count,
        max_r_para=described.max_r_para,
        max_motion_function_points=described.max_motion_function_points,
        max_message=described.max_message,
    )


def layer_maps(layer: LayerDescription, axes: list[str]) -> list[MapOptions]:
    """Return the maps of a motion layer, names of axes as indices."""
    return [_map(name, one, axes) for name, one in layer.map.items()]


def control_maps(control: ControlDescription) -> list[MapOptions]:
    """Return the maps of a control side: its groups, with the names of the original."""
    return [MapOptions(group, group, selector=control.selector and group == "axis") for group in control.groups]


def _map(name: str, one: MapDescription, axes: list[str]) -> MapOptions:
    whole = one.objects is None
    selector = one.group == "axis" and (whole if one.selector is None else one.selector)
    indices = [axes.index(thing) + 1 if isinstance(thing, str) else thing for thing in one.objects or ()]
    return MapOptions(name, one.group, None if whole else tuple(indices), selector)
