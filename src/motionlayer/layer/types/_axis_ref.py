"""`AXIS_REF` as a client sees it: the two cyclic images of an axis (function-blocks 3).

The images have the bytes of `motionlayer.nc.NCTOPLC_AXIS_REF` and `PLCTONC_AXIS_REF`. Of the library's block around
them only the size is known, 1136 bytes. It begins with the pointer that every block begins with, then come its
members in the order of their declaration; what is behind the images belongs to the library and is shown as bytes.
Clients address the members by name.
"""

from typing import Final

from motionlayer.iec import BOOL, BYTE, DINT, DWORD, LREAL, UDINT, UINT, ULINT, USINT, WORD, Array, Field, Struct

SIZE: Final = 1136
"""Bytes of the library's block."""

PLC_TO_NC: Final = 8
NC_TO_PLC: Final = PLC_TO_NC + 128
"""Offsets of the images in it, in bytes."""


class NcToPlc(Struct, iec="NCTOPLC_AXIS_REF"):
    """From the NC. u is the unit of the axis."""

    state_bits = Field("StateDWord", DWORD, "bits of ST_AxisStatus")
    error_code = Field("ErrorCode", DWORD, "error of the axis, 0 without")
    axis_state = Field("AxisState", DWORD, "MC_AxisStates")
    mode_confirmation = Field("AxisModeConfirmation", DWORD, "feedback of the mode")
    homing_state = Field("HomingState", DWORD, "phase of the homing")
    couple_state = Field("CoupleState", DWORD, "0 single, 1 master, 2 master and slave, 3 slave")
    svb_entries = Field("SvbEntries", DWORD, "entries in the preparation task")
    saf_entries = Field("SafEntries", DWORD, "entries in the execution task")
    axis_id = Field("AxisId", DWORD, "id of the axis")
    operation_bits = Field("OpModeDWord", DWORD, "which monitors are on; bits 24 to 31 count the cycles")
    position = Field("ActPos", LREAL, "actual position (u)")
    modulo_position = Field("ModuloActPos", LREAL, "actual position within a turn (u)")
    active_control_loop = Field("ActiveControlLoopIndex", WORD, "control loop in force")
    control_loop = Field("ControlLoopIndex", WORD, "control loop asked for")
    modulo_turns = Field("ModuloActTurns", DINT, "turns of the actual position")
    velocity = Field("ActVelo", LREAL, "actual velocity (u/s)")
    lag = Field("PosDiff", LREAL, "set position less actual position (u)")
    set_position = Field("SetPos", LREAL, "set position (u)")
    set_velocity = Field("SetVelo", LREAL, "set velocity (u/s)")
    set_acceleration = Field("SetAcc", LREAL, "set acceleration (u/s²)")
    target_position = Field("TargetPos", LREAL, "where the motion ends (u)")
    modulo_set_position = Field("ModuloSetPos", LREAL, "set position within a turn (u)")
    modulo_set_turns = Field("ModuloSetTurns", DINT, "turns of the set position")
    command_number = Field("CmdNo", WORD, "number of the active command")
    command_state = Field("CmdState", WORD, "state of the active command")
    set_jerk = Field("SetJerk", LREAL, "set jerk (u/s³)")
    set_torque = Field("SetTorque", LREAL, "set torque")
    torque = Field("ActTorque", LREAL, "actual torque")
    state_bits_2 = Field("StateDWord2", DWORD, "further bits")
    state_bits_3 = Field("StateDWord3", DWORD, "further bits")
    probe_state = Field("TouchProbeState", DWORD, "state of the touch probe")
    probe_counter = Field("TouchProbeCounter", DWORD, "counter of the touch probe")
    cam_coupling_states = Field("CamCouplingState", Array(BYTE, (0, 7)), "states of cam couplings")
    cam_coupling_tables = Field("CamCouplingTableID", Array(UINT, (0, 7)), "tables of cam couplings")
    torque_derivative = Field("ActTorqueDerivative", LREAL, "derivative of the actual torque")
    set_torque_derivative = Field("SetTorqueDerivative", LREAL, "derivative of the set torque")
    phasing_position = Field("AbsPhasingPos", LREAL, "phase shift (u)")
    torque_offset = Field("TorqueOffset", LREAL, "offset of the torque")
    uncorrected_position = Field("ActPosWithoutPosCorrection", LREAL, "actual position without correction (u)")
    acceleration = Field("ActAcc", LREAL, "actual acceleration (u/s²)")
    time_stamp = Field("DcTimeStamp", UDINT, "low 32 bits of the time (ns)")
    user_data = Field("UserData", LREAL, "free")


class PlcToNc(Struct, iec="PLCTONC_AXIS_REF"):
    """To the NC."""

    control_bits = Field("ControlDWord", DWORD, "bits: enable, feed enables, calibration cam")
    override = Field("Override", UDINT, "override, 1000000 is 100 %")
    mode_request = Field("AxisModeRequest", DWORD, "mode asked for")
    mode_bits = Field("AxisModeDWord", DWORD, "option of the mode")
    mode_value = Field("AxisModeLReal", LREAL, "value of the mode")
    position_correction = Field("PositionCorrection", LREAL, "added to the actual position (u)")
    external_position = Field("ExtSetPos", LREAL, "external setpoint: position (u)")
    external_velocity = Field("ExtSetVelo", LREAL, "external setpoint: velocity (u/s)")
    external_acceleration = Field("ExtSetAcc", LREAL, "external setpoint: acceleration (u/s²)")
    external_direction = Field("ExtSetDirection", DINT, "external setpoint: direction")
    external_output = Field("ExtControllerOutput", LREAL, "external output of the controller")
    gear_ratio_1 = Field("GearRatio1", LREAL, "ratio to the first master")
    gear_ratio_2 = Field("GearRatio2", LREAL, "ratio to the second master")
    gear_ratio_3 = Field("GearRatio3", LREAL, "ratio to the third master")
    gear_ratio_4 = Field("GearRatio4", LREAL, "ratio to the fourth master")
    map_state = Field("MapState", BOOL, "the images are linked")
    cycle_control = Field("PlcCycleControl", BYTE, "cycles of the writer")
    cycle_count = Field("PlcCycleCount", BYTE, "counter of the writer")
    external_torque = Field("ExtTorque", LREAL, "external setpoint: torque")
    reserved = Field("_reserved", ULINT, "fills up to 128 bytes")


class AxisRef(Struct, iec="AXIS_REF"):
    """An axis of the NC as a variable of a program."""

    block = Field("_block", ULINT, "pointer of the block")
    plc_to_nc = Field("PlcToNc", PlcToNc, "image to the NC")
    nc_to_plc = Field("NcToPlc", NcToPlc, "image from the NC")
    library = Field("_library", Array(USINT, (1, SIZE - NC_TO_PLC - 256)), "members of the library")
