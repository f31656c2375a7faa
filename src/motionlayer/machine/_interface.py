"""The interface of a machine's motion layer, as a control side is told of it."""

from motionlayer.iec import Array
from motionlayer.iec.export import Declarations, Variable, VariableList
from motionlayer.layer import control_side
from motionlayer.machine._drive_symbols import fault_variable
from motionlayer.machine._machine_run import MachineRun


def interface(run: MachineRun) -> Declarations:
    """Return what the control side of a machine declares: types, constants, variables.

    Args:
        run: of a machine with a motion layer, or of a control side itself. The namespaces that its programs have
            declared so far belong to it.

    Raises:
        ValueError: it has neither.
    """
    shared, name = run.layer.globals, run.machine.name
    axes = shared.sizes.max_axis
    title = f"motionlayer: interface of {name}, {axes} axes"
    return control_side(shared, title, [*_machine_lists(axes), *run.namespaces.exported()], run.mapping.symbols)


def _machine_lists(axes: int) -> list[VariableList]:
    """Return the lists beside the layer: what only simulated machines have, and the objects with methods."""
    from motionlayer.machine._ads_motion import NAME, MotionAxis  # noqa: PLC0415 - with all blocks, for exports alone

    faults, (motion, objects) = fault_variable(axes), NAME.split(".")
    simulation, fault = faults.name.split(".")
    comment = "what goes wrong with a simulated drive; a change of eFault is a command"
    methods = "what has become of the last method that was called; methods are called by ADS"
    return [
        VariableList(simulation, [Variable(fault, faults.type, comment, written=True, optional=True)]),
        VariableList(motion, [Variable(objects, Array(MotionAxis.type, (1, axes)), methods)]),
    ]
