"""What a control side is told of the interface: types, constants, and the variables that it shares with the layer."""

from collections.abc import Collection, Sequence
from dataclasses import replace
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
    NciCtrl,
    NciState,
)

_LIBRARIES: Final = (*LIBRARY_ENUMERATIONS, HomingOptions.type)
"""What the motion libraries declare."""

_READ_BY_SYMBOL: Final = (Message.type, MessageCtrl.type, MessageState.type)
"""What belongs to no variable of a control side, but is read by clients."""


TYPE_ALIASES: Final = {"ST_CTRL_NCI": NciCtrl.type, "ST_STATE_NCI": NciState.type}
"""Other names of types (motion-layer 1.7)."""

_USED: Final = ("GVL_AXIS",)
"""Lists that are carried out. What stands in the others answers NOT_EXIST, and need not be carried anywhere."""


def control_side(
    shared: Globals, title: str, own: Sequence[VariableList] = (), mapped: Collection[str] = ()
) -> Declarations:
    """Return the declarations for the control side of a machine.

    Args:
        shared: the variables of the layer.
        title: first line of each file.
        own: variables of the machine beside the layer, and of namespaces that programs have declared.
        mapped: names of the variables that its maps hold, see `ImageMapping.symbols`.

    Raises:
        ValueError: two different types have one name.
    """
    ready = shared.program.axis
    start = VariableList("MAIN_AXIS", [Variable("eInit", ready.type, "10000: the layer is ready", written=False)])
    lists = [VariableList(name, group.exported(mapped), name in _USED) for name, group in shared.lists.items()]
    messages = VariableList("GVL_MSG_AXIS", [replace(one, written=None) for one in shared.messages.exported()])
    return Declarations(
        title,
        types=(*ENUMERATIONS, *_READ_BY_SYMBOL),
        libraries=_LIBRARIES,
        constants=list(constants(shared.sizes, shared.features)),
        lists=[start, *lists, messages, *own],
        constant_list=CONSTANTS,
        start=f"{start.name}.{start.variables[0].name}",
        aliases=TYPE_ALIASES,
    )
