"""The motion layer of a machine, or the side that commands one in another machine, made of what the file says.

Imported for machines that have either: a run of the others starts sooner.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from motionlayer.command import Ledger
from motionlayer.drive import ServoDrives
from motionlayer.event import Level
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
from motionlayer.machine._description import Description
from motionlayer.machine._drive_symbols import DriveFaults, add_symbol, fault_variable
from motionlayer.machine._layer_description import ControlDescription, LayerDescription, MapDescription
from motionlayer.machine._logging import Logging
from motionlayer.machine._outside import LINK, Told
from motionlayer.runtime import Guest, Stage, Step

if TYPE_CHECKING:
    from motionlayer.fb import AXIS_REF
    from motionlayer.nc import AxisRefs, AxisStage


class Surroundings(NamedTuple):
    """What a run has for its motion layer.

    Attributes:
        outside: its byte areas, mailbox and events.
        ledger: the present tick.
        log: its message files.
        servos: the drives that can fail.
        cycle_ns: base cycle in ns.
        guest: names the user's code that a namespace calls.
    """

    outside: Outside
    ledger: Ledger
    log: Logging
    servos: ServoDrives
    cycle_ns: int
    guest: Callable[[str], Guest]


class Layered(NamedTuple):
    """A motion layer, or the variables of one on a control side.

    Attributes:
        layer: itself.
        mapping: its images.
        namespaces: what programs declare beside it.
        stages: what a tick calls for all of them.
    """

    layer: MotionLayer | ControlSide
    mapping: ImageMapping
    namespaces: Namespaces
    stages: Sequence[Stage]


def make_layer(
    description: Description, run: Surroundings, refs: "Callable[[], Mapping[str, AXIS_REF]]", axes: "AxisStage"
) -> Layered:
    """Make what a machine describes.

    Args:
        description: of the machine, with `[layer]` or `[control]`.
        run: what it is made for.
        refs: returns the axes as blocks know them; called if there is a motion layer for them.
        axes: has their cyclic interface.
    """
    if description.layer is not None:
        return _own_layer(description.layer, run, refs(), axes.images)
    assert description.control is not None
    return _control_side(description.control, run)


def _own_layer(
    described: LayerDescription, run: Surroundings, refs: "Mapping[str, AXIS_REF]", images: "AxisRefs"
) -> Layered:
    events, ledger = run.outside.events, run.ledger
    layer = MotionLayer(list(refs.values()), images, events, ledger, layer_options(described, len(refs)))
    faults = fault_variable(len(refs))
    maps, extra = layer_maps(described, list(refs)), {faults.name: faults}
    mapping = map_variables(layer_mapping, maps, layer.globals, run.outside, ledger, extra)
    add_symbol(layer.symbols, faults)
    return _with_namespaces(
        layer,
        mapping,
        run,
        [
            Stage(Step.INPUTS, "MAPPING_in", mapping.copy_in),
            *layer.stages(),
            DriveFaults(run.servos, list(refs), faults, events).stage(),
            _messages(layer, described, run).stage(),
            Stage(Step.OUTPUTS, "MAPPING_out", mapping.copy_out),
        ],
    )


def _control_side(described: ControlDescription, run: Surroundings) -> Layered:
    sizes, maps = layer_sizes(described, len(described.axes)), control_maps(described)
    faults = fault_variable(len(described.axes))
    control = ControlSide(described.axes, sizes, maps, run.outside, run.ledger, {faults.name: faults})
    add_symbol(control.symbols, faults)
    run.outside.mailbox.register(LINK, Told(run.outside.events, run.ledger, "link"))
    return _with_namespaces(control, control.mapping, run, control.stages())


def _with_namespaces(
    layer: MotionLayer | ControlSide, mapping: ImageMapping, run: Surroundings, stages: Sequence[Stage]
) -> Layered:
    namespaces = Namespaces(layer.symbols, run.outside, run.ledger, run.cycle_ns, run.guest)
    return Layered(layer, mapping, namespaces, [*namespaces.stages(), *stages])


def _messages(layer: MotionLayer, described: LayerDescription, run: Surroundings) -> Messages:
    """Let GVL_MSG_AXIS follow the run; the level is that of `[log]`, or as the original's where there is none."""
    levels = run.log.levels
    if described.test:
        levels.level = Level.VERBOSE
    elif run.log.folder is None:
        levels.level = Level.ERROR
    return Messages(
        layer.globals.messages,
        layer.globals.other_messages,
        run.outside.events,
        levels,
        run.ledger,
        run.log.time,
        lambda: layer.ready,
        run.cycle_ns * 1e-9,
    )


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
        max_other_message=described.max_other_message,
    )


def layer_maps(layer: LayerDescription, axes: list[str]) -> list[MapOptions]:
    """Return the maps of a motion layer, names of axes as indices."""
    return [_map(name, one, axes) for name, one in layer.map.items()]


def control_maps(control: ControlDescription) -> list[MapOptions]:
    """Return the maps of a control side: its groups, with the names of the original."""
    axes = MapOptions("axis", "axis", selector=control.selector, switches=control.switches)
    return [axes if group == "axis" else MapOptions(group, group) for group in control.groups]


def _map(name: str, one: MapDescription, axes: list[str]) -> MapOptions:
    whole = one.objects is None
    selector = one.group == "axis" and (whole if one.selector is None else one.selector)
    indices = [axes.index(thing) + 1 if isinstance(thing, str) else thing for thing in one.objects or ()]
    return MapOptions(name, one.group, None if whole else tuple(indices), selector, one.switches)
