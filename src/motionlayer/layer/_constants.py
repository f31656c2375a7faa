"""How many objects there are, what is built in, and the constants that say so (motion-layer 1.4, 1.5)."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from motionlayer.iec import BOOL, STRING, UINT
from motionlayer.iec.export import Constant
from motionlayer.layer.types import MAX_MOTION_FUNCTION_POINTS, MAX_R_PARA, MAX_TRIGGER_COUNT

VERSION: Final = "V 01.01.00"
"""Of the interface."""

PLACEHOLDERS: Final = 1
"""Stations, movers and processes of the sister project: MAX_STATION, MAX_MOVER, MAX_PROCESS."""

_NCI_DIRS: Final = ("/usr/local/etc/TwinCAT/Mc/Nci/", "C:\\TwinCAT\\Mc\\Nci\\")
_LOG_DIRS: Final = ("/usr/local/etc/TwinCAT/#MsgFiles/", "C:\\TwinCAT\\#MsgFiles\\")
"""Of BSD and of Windows."""


@dataclass(frozen=True, slots=True)
class Sizes:
    """Objects of each kind, and elements of arrays in structures; all as the constants of these names.

    Attributes:
        max_axis: axes, and cams and flying saws, of which each axis has one.
        max_nci_channels: NCI channels, `MAX_NCI_CH`.
        max_trigger_box: trigger boxes.
        max_touch_probe: touch probes.
        max_trigger_count: positions of a trigger box.
        max_r_para: index of the last R parameter of a structure.
        max_motion_function_points: points of a motion function.
        max_message: slots of a message list, `GVL_MSG_AXIS.MAX_MESSAGE`.
        max_other_message: slots of a list that nobody writes, `GVL_MSG.MAX_MESSAGE`.
        max_retry: how often AXIS_IDLE begins again.
    """

    max_axis: int
    max_nci_channels: int = 1
    max_trigger_box: int = 12
    max_touch_probe: int = 12
    max_trigger_count: int = MAX_TRIGGER_COUNT
    max_r_para: int = MAX_R_PARA
    max_motion_function_points: int = MAX_MOTION_FUNCTION_POINTS
    max_message: int = 200
    max_other_message: int = 20
    max_retry: int = 5


@dataclass(frozen=True, slots=True)
class Features:
    """What the original chooses by compiler defines. What is off still has its symbols.

    Attributes:
        nci: channels are carried out.
        cam: cams are.
        xfc: touch probes and trigger boxes are.
        saw: flying saws are.
        windows: paths are those of Windows, not of BSD.
    """

    nci: bool = False
    cam: bool = False
    xfc: bool = False
    saw: bool = False
    windows: bool = False

    @property
    def log_dir(self) -> str:
        """Folder of message files, as clients read it."""
        return _LOG_DIRS[self.windows]


def constants(sizes: Sizes, features: Features) -> Iterator[Constant]:
    """Yield the list PLC_CONSTANT; its members are reached without the name of the list too."""
    number, text = UINT, STRING(80)
    for one in ("STATION", "MOVER", "PROCESS"):
        yield Constant(f"MAX_{one}", number, PLACEHOLDERS, "levels of GVL_MSG, not used else")
    yield Constant("MAX_AXIS", number, sizes.max_axis, "axes, cams, flying saws")
    yield Constant("MAX_RETRY", number, sizes.max_retry, "retries of AXIS_IDLE")
    yield Constant("NCI_DIR", text, _NCI_DIRS[features.windows], "folder of NC programs")
    yield Constant("NCI_ACTIVE", BOOL, features.nci, "NCI channels are built in")
    yield Constant("CAM_ACTIVE", BOOL, features.cam, "cams are built in")
    yield Constant("XFC_ACTIVE", BOOL, features.xfc, "touch probes and trigger boxes are built in")
    yield Constant("FLY_SAW_ACTIVE", BOOL, features.saw, "flying saws are built in")
    yield Constant("CONFIG_NAME", text, "NCI_Spec_Ch_" if features.nci else "NCI_NOT_ACTIVE", "kind of NCI channels")
    yield Constant("MAX_NCI_CH", number, sizes.max_nci_channels, "NCI channels")
    unused = {"MAX_PATH_STEPS": 5, "MAX_MC_AXIS": 3, "MAX_AUX_AXIS": 2, "MAX_CAM_CH": 1, "MAX_MTI_CH": 1}
    yield from (Constant(name, number, value, "not used here") for name, value in unused.items())
    yield Constant("MAX_R_PARA", number, sizes.max_r_para, "index of the last R parameter")
    yield Constant(
        "MAX_MOTION_FUNCTION_POINTS", number, sizes.max_motion_function_points, "points of a motion function"
    )
    yield Constant("MAX_TRIGGER_BOX", number, sizes.max_trigger_box, "trigger boxes")
    yield Constant("MAX_TOUCH_PROBE", number, sizes.max_touch_probe, "touch probes")
    yield Constant("MAX_TRIGGER_COUNT", number, sizes.max_trigger_count, "positions of a trigger box")


def message_constants(sizes: Sizes, features: Features) -> Iterator[Constant]:
    """Yield the constants of GVL_MSG_AXIS."""
    text = STRING(80)
    yield Constant("MAX_MESSAGE", UINT, sizes.max_message, "slots of a message list")
    yield Constant("LOG_DIR", text, features.log_dir, "folder of message files")
    yield Constant("LOG_FILE", text, "_MSG_PLC_", "of the motion list: name behind the ADS port")
    yield Constant("LOG_FILE_METRIC", text, "_MSG_Metrics_", "of the metric list: name behind the ADS port")
