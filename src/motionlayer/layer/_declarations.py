"""What a control side is told of the interface: types, constants, and the variables that it shares with the layer."""

from typing import Final

from motionlayer.iec.export import Declarations, Variable, VariableList
from motionlayer.layer._constants import constants
from motionlayer.layer._globals import CONSTANTS, Globals
from motionlayer.layer.types import (
    ENUMERATIONS,
    LIBRARY_ENUMERATIONS,
    HomingOptions,
    Message,
    MessageCtrl,
    MessageState,
)

_LIBRARIES: Final = (*LIBRARY_ENUMERATIONS, HomingOptions.type)
"""What the motion libraries declare."""

_READ_BY_SYMBOL: Final = (Message.type, MessageCtrl.type, MessageState.type)
"""What belongs to no variable of a control side, but is read by clients."""


def control_side(shared: Globals, title: str) -> Declarations:
    """Return the declarations for the control side of a machine.

    Args:
        shared: the variables of the layer.
        title: first line of each file.
    """
    ready = shared.program.axis
    start = VariableList("MAIN_AXIS", [Variable("eInit", ready.type, "10000: the layer is ready", written=False)])
    lists = [VariableList(name, group.exported()) for name, group in shared.lists.items()]
    return Declarations(
        title,
        types=(*ENUMERATIONS, *_READ_BY_SYMBOL),
        libraries=_LIBRARIES,
        constants=list(constants(shared.sizes, shared.features)),
        lists=[start, *lists],
        constant_list=CONSTANTS,
    )
