"""`GVL_MSG_AXIS`: message lists, their writers, and levels; `GVL_MSG`: lists that nobody writes (motion-layer 4, 8).

The second group belongs to a sister project of the original. Its lists take the messages of devices of applications,
transports, metrics and products, which programs may have; nobody empties them.
"""

import enum
from typing import Final

from motionlayer.event import BLOCK, Device
from motionlayer.iec import DT, STRING, UDINT, UINT, InputArray, OutputArray
from motionlayer.iec.export import Constant
from motionlayer.layer._constants import PLACEHOLDERS, Features, Sizes, message_constants
from motionlayer.layer._global_list import GlobalList
from motionlayer.layer.types import E_MESSAGE_TYPE, Message, MessageCtrl, MessageState

NAME: Final = "GVL_MSG_AXIS"
OTHER: Final = "GVL_MSG"


class OtherList(enum.Enum):
    """Lists of `GVL_MSG`; the values make the names of their symbols."""

    APPLICATION = "Application"
    TRANSPORT = "Transport"
    METRICS = "Metrics"
    PRODUCT = "Product"


_OTHER_BLOCKS: Final = {
    Device.Process: OtherList.APPLICATION,
    Device.Application: OtherList.APPLICATION,
    Device.MetricsXts: OtherList.METRICS,
    Device.DataProduct: OtherList.PRODUCT,
}
_APPLICATIONS: Final = (Device.Device_MainApplication, Device.Device_XmlData, Device.Device_Utilities)


def other_list_of(device: int) -> OtherList:
    """Return the list of a device that has none in `GVL_MSG_AXIS` (motion-layer 8.2)."""
    if device in _APPLICATIONS:
        return OtherList.APPLICATION
    return next((of for base, of in _OTHER_BLOCKS.items() if device // BLOCK * BLOCK == base), OtherList.TRANSPORT)


class MessageList:
    """A message list and its writer.

    Args:
        globals_: where its variables stand.
        space: namespace of their symbols.
        name: `Motion` or `Metric`.
        size: slots.

    Attributes:
        messages: the slots; those that are free have the type eMessageEmpty.
        ctrl: command of the writer.
        state: its answer.
        index: slot that was filled last, 0 for none.
        errors: errors since the list was written last.
        lost: messages that found no free slot since the run began; the original has no such counter.
    """

    def __init__(self, globals_: GlobalList, space: str, name: str, size: int) -> None:
        who = f"of the {name.lower()} list"
        self.messages = globals_.add(OutputArray(Message, 1, size, f"{space}.{name}Messages"), f"slots {who}")
        self.ctrl = globals_.add(OutputArray(MessageCtrl, None, None, f"{space}.{name}MessageCtrl"), f"writer {who}")
        self.state = globals_.add(OutputArray(MessageState, None, None, f"{space}.{name}MessageState"), f"writer {who}")
        self.index = globals_.add(OutputArray(UINT, None, None, f"{space}.Message{name}Index"), f"last slot {who}")
        self.errors = globals_.add(OutputArray(UINT, None, None, f"{space}.Message{name}Error"), f"errors {who}")
        self.lost = globals_.add(OutputArray(UDINT, None, None, f"{space}.Message{name}Lost"), f"without a slot {who}")


class MessageGlobals(GlobalList):
    """Variables of `GVL_MSG_AXIS`. Levels are `E_MessageType`; eMessageEmpty writes errors alone.

    Attributes:
        motion: messages of motion.
        metric: counters.
        level: level that the axes take over when the start-up is done.
        axis_level: level of each axis.
        cam_level: of each cam.
        saw_level: of each flying saw.
        nci_level: of each NCI channel.
        trigger_level: of each trigger box.
        probe_level: of each touch probe.
        local_time: as messages show it.
        local_date: the same as a date and time, s.
    """

    def __init__(self, sizes: Sizes, features: Features) -> None:
        super().__init__()
        self.motion = MessageList(self, NAME, "Motion", sizes.max_message)
        self.metric = MessageList(self, NAME, "Metric", sizes.max_message)
        self.level = self.add(
            InputArray(E_MESSAGE_TYPE, None, None, f"{NAME}.MessageLevel"), "level of all", f"{OTHER}.MessageLevel"
        )
        self.axis_level = self._levels("AxisPtp", sizes.max_axis, "axis")
        self.cam_level = self._levels("AxisCam", sizes.max_axis, "cam")
        self.saw_level = self._levels("AxisFly", sizes.max_axis, "flying saw")
        self.nci_level = self._levels("NciChn", sizes.max_nci_channels, "NCI channel")
        self.trigger_level = self._levels("TriggerBox", sizes.max_trigger_box, "trigger box")
        self.probe_level = self._levels("TouchProbe", sizes.max_touch_probe, "touch probe")
        self.local_time = self.add(
            OutputArray(STRING(80), None, None, f"{NAME}.sLocalTime"), "local time", f"{OTHER}.sLocalTime"
        )
        self.local_date = self.add(
            OutputArray(DT, None, None, f"{NAME}.dtLocalTime"), "local time", f"{OTHER}.dtLocalTime"
        )
        for one in message_constants(sizes, features):
            self.add_constant(NAME, one)

    def _levels(self, name: str, count: int, what: str) -> InputArray[int]:
        return self.add(InputArray(E_MESSAGE_TYPE, 1, count, f"{NAME}.MessageLevel{name}"), f"level of each {what}")


class OtherMessageGlobals(GlobalList):
    """Variables of `GVL_MSG`. Level of all and local time are those of `GVL_MSG_AXIS`, under both names (D44).

    Attributes:
        lists: messages of applications, transports, metrics and products.
        station_level: level of each station.
        mover_level: of each mover.
        process_level: of each process.
    """

    def __init__(self, sizes: Sizes) -> None:
        super().__init__()
        self.lists = {of: MessageList(self, OTHER, of.value, sizes.max_other_message) for of in OtherList}
        self.station_level, self.mover_level, self.process_level = (
            self.add(
                InputArray(E_MESSAGE_TYPE, 1, PLACEHOLDERS, f"{OTHER}.MessageLevel{what.title()}"),
                f"level of each {what}",
            )
            for what in ("station", "mover", "process")
        )
        self.add_constant(OTHER, Constant("MAX_MESSAGE", UINT, sizes.max_other_message, "slots of a list here"))
