"""Message lists (motion-layer 3.9)."""

from motionlayer.iec import STRING, ULINT, Field, Struct
from motionlayer.layer.types._enumerations import (
    E_DEVICE,
    E_MESSAGE_CTRL,
    E_MESSAGE_STATE,
    E_MESSAGE_TYPE,
    E_SUBDEVICE,
)


class Message(Struct, iec="ST_Message"):
    """A slot of a message list."""

    kind = Field("eType", E_MESSAGE_TYPE, "eMessageEmpty: the slot is free")
    device = Field("eDevice", E_DEVICE, "object: base of its block, and its id")
    subdevice = Field("eSubdevice", E_SUBDEVICE, "part of the object")
    number = Field("iErrorNumber", ULINT, "number of the error, or of what the text tells")
    time = Field("tTime", STRING(24), "local time")
    text = Field("sText", STRING(127), "free text")


class MessageCtrl(Struct, iec="ST_MESSAGE_CTRL"):
    """Command of the writer of a list."""

    cmd = Field("Cmd", E_MESSAGE_CTRL, "command")


class MessageState(Struct, iec="ST_MESSAGE_STATE"):
    """Answer of the writer of a list."""

    state = Field("State", E_MESSAGE_STATE, "command + progress")
