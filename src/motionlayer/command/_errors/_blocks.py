"""Function blocks of the PLC 0x4B00, kinematics 0x4C00."""

from typing import Final

from motionlayer.command._errors._id import ErrorId as E
from motionlayer.command._errors._text import ErrorText

BLOCKS: Final = {
    E.STOPPED_ON_THE_WAY: ErrorText("the axis was stopped on the way", "see who stopped it; reset and command anew"),
    E.CANNOT_START: ErrorText(
        "the axis cannot start this in its state",
        "reset() an axis in ErrorStop; wait for the end of a homing, or stop() it",
        "commands in ErrorStop, and other commands than a stop during homing",
    ),
    E.NO_MONITORING: ErrorText("no monitoring of target or range is active", "set target_window or range_window"),
    E.RESTART_IMPOSSIBLE: ErrorText("the axis does not move, a restart is impossible"),
    E.MODE_INVALID: ErrorText(
        "mode not valid, or not for this command",
        "take one of those that the message allows",
        "modulo moves, by their `direction`; blocks, by a mode that does not exist",
    ),
    E.COMMAND_NOT_PERMITTED: ErrorText(
        "command not permitted with this direction or number",
        "give what the message allows; parameters that are BOOL have blocks of their own",
        "endless moves, by their `direction`; parameters, by their number",
    ),
    E.PARAMETER: ErrorText(
        "parameter out of range",
        "see the range in the message",
        "every command, the override and parameters, by their numbers",
    ),
    E.POSITIONING_TIMEOUT: ErrorText("timeout after a positioning", "see target_window; look for what holds the axis"),
    E.PROTECTED: ErrorText("the axis is in protected mode", "decouple it first, or allow motion commands to slaves"),
    E.NOT_READY: ErrorText(
        "the axis is not ready",
        "enable it and wait for the command to be done; in the motion layer AXIS_INIT comes first",
        "the motion layer, for a command before AXIS_INIT",
    ),
    E.HOMING_FAILED: ErrorText("homing failed", "see the error before it; look for cam, switch and encoder"),
    E.TRIGGER_DEFINITION: ErrorText("definition of the trigger wrong"),
    E.LATCH_DISABLED: ErrorText("the latch of the position was disabled", "arm it again after a reset"),
    E.NO_STATUS: ErrorText("expected status feedback of the NC missing"),
    E.NO_CYCLE_COUNTER: ErrorText("the cycle counter of the NC stands still"),
    E.CONFIRM_WITHOUT_REQUEST: ErrorText("handshake confirmed without a request"),
    E.ZERO_SHIFT_INDEX: ErrorText("index of the zero shift not valid"),
    E.R_PARAMETERS: ErrorText("index or count of R parameters not valid"),
    E.TOOL_INDEX: ErrorText("index of the tool not valid"),
    E.CHANNEL_VERSION: ErrorText("version of the channel interface too old"),
    E.CHANNEL_STATE: ErrorText("the channel is in the wrong state"),
    E.NOT_ACTIVATED: ErrorText("function not activated"),
    E.AXIS_IN_OTHER_GROUP: ErrorText("the axis is in another group already"),
    E.BLOCK_SEARCH: ErrorText("block search failed"),
    E.AXES_NOT_ADDED: ErrorText("not all axes could be added"),
    E.POINTER_NULL: ErrorText("a pointer is null"),
    E.MEMORY_SIZE: ErrorText("memory size wrong"),
    E.CAM_ID: ErrorText("id of the cam outside 1 to 255"),
    E.CAM_POINT_ID: ErrorText("id of a cam point below 1"),
    E.CAM_POINT_COUNT: ErrorText("number of cam points below 1"),
    E.CAM_TYPE_WRONG: ErrorText("type of the cam table wrong"),
    E.CAM_ROWS_TOO_FEW: ErrorText("rows of the cam below 1"),
    E.CAM_COLUMNS_WRONG: ErrorText("columns of the cam wrong"),
    E.INCREMENT: ErrorText("increment not positive"),
    E.CORRECTION_SIZE: ErrorText("position correction: size of the data wrong"),
    E.CORRECTION_RANGE: ErrorText("position correction: range not valid"),
    E.CORRECTION_MODULO_RANGE: ErrorText("position correction: range not valid for a modulo axis"),
    E.BUFFERED_NEVER_ACTIVE: ErrorText(
        "the buffered command never became active", "see how the command before it ended"
    ),
    E.BUFFERED_UNKNOWN_ERROR: ErrorText(
        "the buffered command ended with an unknown error", "see the error of the axis"
    ),
    E.BUFFER_MODE_UNSUPPORTED: ErrorText("the command does not support this buffer mode", "use BufferMode.ABORTING"),
    E.NOT_CALLED_CYCLICALLY: ErrorText(
        "the block was not called in every cycle",
        "call a block in every cycle as long as it is busy",
        "a busy block that was left out of cycles while another command took over",
    ),
    E.FEED_ENTRY_TYPE: ErrorText("feed table: type of the entry unknown"),
    E.FEED_TABLE_FULL: ErrorText("feed table full"),
    E.FEED_CIRCLE: ErrorText("feed table: circle wrong"),
    E.FEED_ENTRY_NULL: ErrorText("feed table: pointer of the entry is null"),
    E.FEED_ENTRY_STRUCTURE: ErrorText("feed table: type of the entry and structure differ"),
    E.FEED_M_NUMBER: ErrorText("feed table: M number outside 0 to 159"),
    E.FEED_DYNAMIC_OVERRIDE: ErrorText("feed table: DynOvr outside 0.01 to 1"),
    E.FEED_SMOOTHING: ErrorText("feed table: parameter of the smoothing wrong"),
    E.FEED_VELOCITY: ErrorText("feed table: velocity not valid"),
    E.KINEMATICS: ErrorText("kinematic transformation failed"),
    E.OUTSIDE_WORKING_SPACE: ErrorText("kinematics: position outside the working space"),
    E.SINGULARITY: ErrorText("kinematics: singularity"),
}
