"""The interface of a machine's motion layer, as a control side is told of it."""

from motionlayer.iec.export import Declarations
from motionlayer.layer import Features, Globals, control_side
from motionlayer.machine._layering import layer_options, layer_sizes
from motionlayer.machine._machine import Machine


def interface(machine: Machine) -> Declarations:
    """Return what the control side of a machine declares: types, constants, variables.

    Args:
        machine: with a motion layer, or a control side itself.

    Raises:
        ValueError: it has neither.
    """
    described = machine.description
    axes = len(described.axis)
    if described.layer is not None:
        options = layer_options(described.layer, axes)
        shared = Globals(options.sizes, options.features)
    elif described.control is not None:
        axes = len(described.control.axes)
        shared = Globals(layer_sizes(described.control, axes), Features())
    else:
        raise ValueError(f"{described.name} has no motion layer: add [layer] to the machine file, or [control]")
    return control_side(shared, f"motionlayer: interface of {described.name}, {axes} axes")
