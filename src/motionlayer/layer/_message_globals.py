"""`GVL_MSG_AXIS`: message lists, their writers, and levels (motion-layer 4, 8)."""

from typing import Final

from motionlayer.iec import DT, STRING, UDINT, UINT, InputArray, OutputArray
from motionlayer.layer._constants import Features, Sizes, message_constants
from motionlayer.layer._global_list import GlobalList
from motionlayer.layer.types import E_MESSAGE_TYPE, Message, MessageCtrl, MessageState

NAME: Final = "GVL_MSG_AXIS"


class MessageList:
    """A message list and its writer.

    Args:
        globals_: where its variables stand.
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

    def __init__(self, globals_: GlobalList, name: str, size: int) -> None:
        who = f"of the {name.lower()} list"
        self.messages = globals_.add(OutputArray(Message, 1, size, f"{NAME}.{name}Messages"), f"slots {who}")
        self.ctrl = globals_.add(OutputArray(MessageCtrl, None, None, f"{NAME}.{name}MessageCtrl"), f"writer {who}")
        self.state = globals_.add(OutputArray(MessageState, None, None, f"{NAME}.{name}MessageState"), f"writer {who}")
        self.index = globals_.add(OutputArray(UINT, None, None, f"{NAME}.Message{name}Index"), f"last slot {who}")
        self.errors = globals_.add(OutputArray(UINT, None, None, f"{NAME}.Message{name}Error"), f"errors {who}")
        self.lost = globals_.add(OutputArray(UDINT, None, None, f"{NAME}.Message{name}Lost"), f"without a slot {who}")


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
        self.motion = MessageList(self, "Motion", sizes.max_message)
        self.metric = MessageList(self, "Metric", sizes.max_message)
        self.level = self.add(InputArray(E_MESSAGE_TYPE, None, None, f"{NAME}.MessageLevel"), "level of all")
        self.axis_level = self._levels("AxisPtp", sizes.max_axis, "axis")
        self.cam_level = self._levels("AxisCam", sizes.max_axis, "cam")
        self.saw_level = self._levels("AxisFly", sizes.max_axis, "flying saw")
        self.nci_level = self._levels("NciChn", sizes.max_nci_channels, "NCI channel")
        self.trigger_level = self._levels("TriggerBox", sizes.max_trigger_box, "trigger box")
        self.probe_level = self._levels("TouchProbe", sizes.max_touch_probe, "touch probe")
        self.local_time = self.add(OutputArray(STRING(80), None, None, f"{NAME}.sLocalTime"), "local time")
        self.local_date = self.add(OutputArray(DT, None, None, f"{NAME}.dtLocalTime"), "local time")
        for one in message_constants(sizes, features):
            self.add_constant(NAME, one)

    def _levels(self, name: str, count: int, what: str) -> InputArray[int]:
        return self.add(InputArray(E_MESSAGE_TYPE, 1, count, f"{NAME}.MessageLevel{name}"), f"level of each {what}")
