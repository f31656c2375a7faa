"""Channel and interpreter of NC programs, 0x4100 to 0x41FF."""

from typing import Final

from motionlayer.command._errors._id import ErrorId as E
from motionlayer.command._errors._text import ErrorText

CHANNEL: Final = {
    E.CHANNEL_GROUP_INDEX: ErrorText("index of the group in the channel not valid"),
    E.CHANNEL_WITHOUT_IMAGE: ErrorText("the channel has no process image to the PLC"),
    E.M_NUMBER_EXECUTED: ErrorText("M number outside 0 to 159 when executed"),
    E.CHANNEL_BUSY: ErrorText("the channel is busy with a similar function"),
    E.CHANNEL_COMMAND_UNSUPPORTED: ErrorText("the channel does not support the command"),
    E.CHANNEL_START_PARAMETER: ErrorText("start parameters of the channel not valid"),
    E.CHANNEL_COMMAND_REFUSED: ErrorText("channel command not possible now: busy, nothing loaded, or in error"),
    E.NO_DECODER_STOP: ErrorText("GoAhead without a decoder stop that waits"),
    E.NC_PROGRAM_NOT_FOUND: ErrorText("NC program file not found"),
    E.NC_SYNTAX_LOADING: ErrorText("syntax error in an NC program, found when loading"),
    E.NC_SYNTAX_RUNNING: ErrorText("syntax error in an NC program, found when interpreting"),
    E.SUBROUTINE_MISSING: ErrorText("subroutine missing when loading"),
    E.LOAD_BUFFER: ErrorText("load buffer too small"),
    E.SUBROUTINE_HEADER: ErrorText("header of a subroutine missing"),
    E.TOO_MANY_NC_PROGRAMS: ErrorText("too many NC programs loaded"),
    E.NC_PROGRAM_NAME: ErrorText("name of an NC program too long"),
    E.DIVISION_BY_ZERO: ErrorText("division by zero in an NC program"),
    E.CIRCLE: ErrorText("circle cannot be computed"),
    E.ARITHMETIC: ErrorText("arithmetic operation not valid, such as the root of a negative number"),
    E.SUBROUTINE_LEVELS: ErrorText("too many levels of subroutines"),
    E.TOO_MANY_RETURNS: ErrorText("more returns than subroutine calls"),
    E.ARITHMETIC_OVERFLOW: ErrorText("arithmetic stack overflow"),
    E.ARITHMETIC_UNDERFLOW: ErrorText("arithmetic stack underflow"),
    E.R_INDEX: ErrorText("index of an R parameter not valid"),
    E.G_CODE: ErrorText("G code not permitted"),
    E.M_NUMBER: ErrorText("M number not permitted"),
    E.EXTENDED_ADDRESS: ErrorText("extended address not permitted"),
    E.MACHINE_DATA_BIT: ErrorText("bit index of machine data outside 0 to 7"),
    E.COMPENSATION_PARAMETER: ErrorText("parameters of the tool compensation may not change here"),
    E.COMPENSATION: ErrorText("tool compensation cannot be computed"),
    E.COMPENSATION_PLANE: ErrorText("the plane may not change while the compensation is on"),
    E.D_WORD: ErrorText("D word missing or not valid"),
    E.TOOL_RADIUS: ErrorText("tool radius not positive"),
    E.TOOL_RADIUS_CHANGED: ErrorText("tool radius may not change here"),
    E.INNER_CIRCLE: ErrorText("inner circle smaller than the cutter radius"),
    E.BOTTLE_NECK: ErrorText("bottle neck: the contour would be violated"),
    E.LOADING_PARAMETER: ErrorText("parameter not valid when loading"),
    E.START_NOT_ON_CONTOUR: ErrorText("start position is not on the contour"),
    E.DEFAULT_G_CODE: ErrorText("default G code not valid"),
    E.DEFAULT_G_CODE_FILE: ErrorText("file of the default G code cannot be opened"),
}
