"""What kind of encoder an axis has, and how the parameter selector names an axis (motion-layer 2.8)."""

import enum


class AxisEncoderType(enum.IntEnum):
    """`E_AxisEncoderType`, with the names that a message shows; larger numbers are passed through as they are."""

    NoEncoder = 0
    Simulation_Encoder = 1
    M3000_Enc = 2
    M31x0_M2000_Enc = 3
    MDP_511_Enc = 4
    MDP_500_501_Enc = 5
    MDP_510_Enc = 6
    KL30xx_Enc = 7
    SERCOS_EtherCAT_SoE_Pos = 8
    SERCOS_EtherCAT_SoE_Pos_Velo = 9
    Binary_Enc = 10
    M2510_Enc = 11
    FOX50_Enc = 12
    AX2000_Lightbus = 14
    Provi_DriveMC_Simodrive_611U = 15
    Universal_Encoder_varBitmask = 16
    NC_Backplane = 17
    spec_CANopen_Typ = 18  # noqa: N815
    MDP_513_DS402 = 19
    AX2xx_B900 = 20
    KL5151_Encoder = 21
    IP5209_Encoder = 24
    KL2531_KL2541_Encoder = 25
    KL2532_KL2542_Encoder = 26
    Time_Base_Encoder = 27
    TCom_Encoder_SoftDrive = 28


class AxisSelector(enum.IntEnum):
    """`E_AXIS_SELECTOR`: what the number of a selector means."""

    INDEX = 0
    AXIS_ID = 1
