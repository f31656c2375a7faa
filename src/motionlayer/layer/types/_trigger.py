"""Trigger boxes and their terminals (motion-layer 3.8). u is the unit of the axis."""

from typing import Final

from motionlayer.iec import BIT, BOOL, BYTE, LREAL, UDINT, UINT, ULINT, USINT, Array, Field, Struct

MAX_TRIGGER_COUNT: Final = 4
"""Positions of a trigger box, as delivered; the machine file may say another number."""


class TriggerBits(Struct, iec="T_TriggerControlBits"):
    """Control bits of a trigger box."""

    enable = Field("Enable", BIT, "a rising edge starts, FALSE resets")
    init = Field("Init", BIT, "initialise the outputs")
    no_feedback = Field("NoFeedback", BIT, "do not wait for a feedback")
    b3 = Field("b3", BIT, "reserved")
    b4 = Field("b4", BIT, "reserved")
    b5 = Field("b5", BIT, "reserved")
    b6 = Field("b6", BIT, "reserved")
    b7 = Field("b7", BIT, "reserved")


class TriggerCtrl(Struct, iec="ST_CTRL_TRIGGER"):
    """Command of a trigger box; the room is MAX_TRIGGER_COUNT."""

    control = Field("Control", TriggerBits, "bits")
    reserved = Field("byc", Array(BYTE, (1, 7)), "reserved")
    axis_id = Field("AxisId", UDINT, "id of the axis in the NC")
    count = Field("TriggerCount", UDINT, "positions that are used")
    positions = Field("TriggerPosition", Array(LREAL, (1, MAX_TRIGGER_COUNT)), "where to trigger (u)")


class TriggerState(Struct, iec="ST_STATE_TRIGGER"):
    """Answer of a trigger box; the room is MAX_TRIGGER_COUNT."""

    state = Field("State", UINT, "E_PROGRESS; an error is 9000 and its code")
    init = Field("Init", UINT, "E_PROGRESS of the initialisation of the outputs")
    positions = Field("FlashPosition", Array(LREAL, (1, MAX_TRIGGER_COUNT)), "where the feedback came (u)")


class TriggerInput(Struct, iec="ST_DC_Input"):
    """Input of a terminal that latches edges."""

    state = Field("Input", BIT, "level")
    status = Field("Status", USINT, "status of the terminal")
    rising = Field("LatchPositive", ULINT, "DC time of the last rising edge (ns)")
    falling = Field("LatchNegative", ULINT, "DC time of the last falling edge (ns)")


class TriggerOutput(Struct, iec="ST_DC_Output"):
    """Output of a terminal that switches at a time."""

    start_time = Field("dcStartTime", ULINT, "DC time of the next action (ns)")
    activate = Field("nActivate", BYTE, "0 off, 3 arms both channels")
    output_1 = Field("Ch1_Output", BOOL, "channel 1")
    tristate_1 = Field("Ch1_Tristate", BOOL, "channel 1 drives nothing")
    output_2 = Field("Ch2_Output", BOOL, "channel 2")
    tristate_2 = Field("Ch2_Tristate", BOOL, "channel 2 drives nothing")


class TriggerOutputState(Struct, iec="ST_DC_State"):
    """Status of a terminal that switches at a time."""

    system_time = Field("SysTime", ULINT, "DC time of the terminal (ns)")
    feedback = Field("Feedback", USINT, "bit 0 output 1, 1 tristate 1, 2 output 2, 3 tristate 2")
