"""`NCTOPLC_AXIS_REF` and `PLCTONC_AXIS_REF`: the bytes of the cyclic interface (function-blocks 3.1 to 3.5).

All axes share one buffer per direction, so that mapping and clients copy slices. Padding that the original leaves to
the compiler is written out: every offset below is part of the interface.
"""

import enum
from typing import Final

import numpy as np


class StateDWord(enum.IntFlag):
    """Bits of `NcToPlc.StateDWord`, named as in `ST_AxisStatus`."""

    Operational = 1 << 0
    Homed = 1 << 1
    NotMoving = 1 << 2
    InPositionArea = 1 << 3
    InTargetPosition = 1 << 4
    Protected = 1 << 5
    ErrorPropagationDelayed = 1 << 6
    HasBeenStopped = 1 << 7
    HasJob = 1 << 8
    PositiveDirection = 1 << 9
    NegativeDirection = 1 << 10
    HomingBusy = 1 << 11
    ConstantVelocity = 1 << 12
    Compensating = 1 << 13
    ExtSetPointGenEnabled = 1 << 14
    PhasingActive = 1 << 15
    ExternalLatchValid = 1 << 16
    NewTargetPos = 1 << 17
    DriveLimitActive = 1 << 18
    ContinuousMotion = 1 << 19
    ControlLoopClosed = 1 << 20
    CamTableQueued = 1 << 21
    CamDataQueued = 1 << 22
    CamScalingPending = 1 << 23
    CmdBuffered = 1 << 24
    PTPmode = 1 << 25
    SoftLimitMinExceeded = 1 << 26
    SoftLimitMaxExceeded = 1 << 27
    DriveDeviceError = 1 << 28
    MotionCommandsLocked = 1 << 29
    IoDataInvalid = 1 << 30
    Error = 1 << 31


HOMED: Final = int(StateDWord.Homed)
HAS_JOB: Final = int(StateDWord.HasJob)
BEEN_STOPPED: Final = int(StateDWord.HasBeenStopped)
NEW_TARGET: Final = int(StateDWord.NewTargetPos)
BUFFERED: Final = int(StateDWord.CmdBuffered)
"""Bits that change with commands, as the axis writes them."""


class OpModeDWord(enum.IntFlag):
    """Bits 0 to 23 of `NcToPlc.OpModeDWord`; 24 to 31 count the cycles."""

    PositionAreaMonitoring = 1 << 0
    TargetPositionMonitoring = 1 << 1
    LoopMode = 1 << 2
    MotionMonitoring = 1 << 3
    PEHTimeMonitoring = 1 << 4
    BacklashCompensation = 1 << 5
    DelayedErrorReaction = 1 << 6
    Modulo = 1 << 7
    SimulationAxis = 1 << 8
    StopMonitoring = 1 << 12
    PositionLagMonitoring = 1 << 16
    VeloLagMonitoring = 1 << 17
    SoftLimitMinMonitoring = 1 << 18
    SoftLimitMaxMonitoring = 1 << 19
    PositionCorrection = 1 << 20
    AllowSlaveCommands = 1 << 21
    AllowExtSetAxisCommands = 1 << 22
    NcApplicationRequest = 1 << 23


class ControlDWord(enum.IntFlag):
    """Bits of `PlcToNc.ControlDWord`."""

    Enable = 1 << 0
    FeedEnablePlus = 1 << 1
    FeedEnableMinus = 1 << 2
    HomingSensor = 1 << 5
    AcceptBlockedDrive = 1 << 8
    BlockedDriveDetected = 1 << 9
    PlcDebugFlag = 1 << 30


NCTOPLC_AXIS_REF: Final = np.dtype(
    {
        "names": [
            "StateDWord", "ErrorCode", "AxisState", "AxisModeConfirmation", "HomingState", "CoupleState",
            "SvbEntries", "SafEntries", "AxisId", "OpModeDWord", "ActPos", "ModuloActPos", "ActiveControlLoopIndex",
            "ControlLoopIndex", "ModuloActTurns", "ActVelo", "PosDiff", "SetPos", "SetVelo", "SetAcc", "TargetPos",
            "ModuloSetPos", "ModuloSetTurns", "CmdNo", "CmdState", "SetJerk", "SetTorque", "ActTorque", "StateDWord2",
            "StateDWord3", "TouchProbeState", "TouchProbeCounter", "CamCouplingState", "CamCouplingTableID",
            "ActTorqueDerivative", "SetTorqueDerivative", "AbsPhasingPos", "TorqueOffset",
            "ActPosWithoutPosCorrection", "ActAcc", "DcTimeStamp", "UserData",
        ],
        "formats": [
            "<u4", "<u4", "<u4", "<u4", "<u4", "<u4", "<u4", "<u4", "<u4", "<u4", "<f8", "<f8", "<u2", "<u2", "<i4",
            "<f8", "<f8", "<f8", "<f8", "<f8", "<f8", "<f8", "<i4", "<u2", "<u2", "<f8", "<f8", "<f8", "<u4", "<u4",
            "<u4", "<u4", ("u1", 8), ("<u2", 8), "<f8", "<f8", "<f8", "<f8", "<f8", "<f8", "<u4", "<f8",
        ],
        "offsets": [
            0, 4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 48, 56, 58, 60, 64, 72, 80, 88, 96, 104, 112, 120, 124, 126, 128,
            136, 144, 152, 156, 160, 164, 168, 176, 192, 200, 208, 216, 224, 232, 240, 248,
        ],
        "itemsize": 256,
    }
)  # fmt: skip
"""256 bytes; the first 128 are the classic structure."""

PLCTONC_AXIS_REF: Final = np.dtype(
    {
        "names": [
            "ControlDWord", "Override", "AxisModeRequest", "AxisModeDWord", "AxisModeLReal", "PositionCorrection",
            "ExtSetPos", "ExtSetVelo", "ExtSetAcc", "ExtSetDirection", "ExtControllerOutput", "GearRatio1",
            "GearRatio2", "GearRatio3", "GearRatio4", "MapState", "PlcCycleControl", "PlcCycleCount", "ExtTorque",
        ],
        "formats": [
            "<u4", "<u4", "<u4", "<u4", "<f8", "<f8", "<f8", "<f8", "<f8", "<i4", "<f8", "<f8", "<f8", "<f8", "<f8",
            "?", "u1", "u1", "<f8",
        ],
        "offsets": [0, 4, 8, 12, 16, 24, 32, 40, 48, 56, 64, 72, 80, 88, 96, 104, 105, 106, 112],
        "itemsize": 128,
    }
)  # fmt: skip
"""128 bytes."""
