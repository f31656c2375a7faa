"""General: ids and types in a request, 0x4000 to 0x40FF."""

from typing import Final

from motionlayer.command._errors._id import ErrorId as E
from motionlayer.command._errors._text import ErrorText

GENERAL: Final = {
    E.INTERNAL: ErrorText(
        "internal error",
        "please report it with the input that the message holds",
        "the runtime itself, where its own planning failed",
    ),
    E.OUTPUT_MONITORING: ErrorText("set-point output monitoring: parameter not valid"),
    E.EXTERNAL_MODULE: ErrorText("error raised by an external module"),
    E.CHANNEL_ID: ErrorText("channel id outside 1 to 255 or unknown"),
    E.GROUP_ID: ErrorText("group id outside 1 to 255 or unknown"),
    E.AXIS_ID: ErrorText(
        "axis id outside 1 to 255 or unknown", "name an axis of the machine file; an axis reference left at 0 is none"
    ),
    E.ENCODER_ID: ErrorText(
        "encoder id outside 1 to 255 or unknown",
        "take one of the encoders in the message",
        "MC_SetPosition, by its `EncoderIndex`",
    ),
    E.DRIVE_ID: ErrorText("drive id unknown"),
    E.TABLE_ID: ErrorText("table id unknown"),
    E.COUPLING_TYPE: ErrorText("coupling type not permitted"),
    E.AXIS_TYPE: ErrorText("type of the axis not suitable for this"),
    E.CHANNEL_NOT_READY: ErrorText("channel not ready"),
    E.GROUP_NOT_READY: ErrorText("group not ready"),
    E.AXIS_NOT_READY: ErrorText("axis not ready"),
    E.TABLE_ID_TAKEN: ErrorText("table id already in use"),
}
