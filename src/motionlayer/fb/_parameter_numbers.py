"""Numbers of the parameters of an axis (motion-layer 2.9): all that the interface knows.

Those for which this runtime has something are in `PARAMETERS`. Function-blocks 2.17 counts the numbers from an older
list, without 1036; those here are the ones of the compiled interface. Files and traces hold names, never numbers.
"""

import enum


class MC_AxisParameter(enum.IntEnum):  # noqa: N801 - the name of the interface
    """Numbers of the parameters."""

    CommandedPosition = 1
    SWLimitPos = 2
    SWLimitNeg = 3
    EnableLimitPos = 4
    EnableLimitNeg = 5
    EnablePosLagMonitoring = 6
    MaxPositionLag = 7
    MaxVelocitySystem = 8
    MaxVelocityAppl = 9
    ActualVelocity = 10
    CommandedVelocity = 11
    MaxAccelerationSystem = 12
    MaxAccelerationAppl = 13
    MaxDecelerationSystem = 14
    MaxDecelerationAppl = 15
    MaxJerkSystem = 16
    MaxJerkAppl = 17

    AxisId = 1000
    AxisVeloManSlow = 1001
    AxisVeloManFast = 1002
    AxisVeloMax = 1003
    AxisAcc = 1004
    AxisDec = 1005
    AxisJerk = 1006
    MaxJerk = 1007
    AxisMaxVelocity = 1008
    AxisRapidTraverseVelocity = 1009
    AxisManualVelocityFast = 1010
    AxisManualVelocitySlow = 1011
    AxisCalibrationVelocityForward = 1012
    AxisCalibrationVelocityBackward = 1013
    AxisJogIncrementForward = 1014
    AxisJogIncrementBackward = 1015
    AxisEnMinSoftPosLimit = 1016
    AxisMinSoftPosLimit = 1017
    AxisEnMaxSoftPosLimit = 1018
    AxisMaxSoftPosLimit = 1019
    AxisEnPositionLagMonitoring = 1020
    AxisMaxPosLagValue = 1021
    AxisMaxPosLagFilterTime = 1022
    AxisEnPositionRangeMonitoring = 1023
    AxisPositionRangeWindow = 1024
    AxisEnTargetPositionMonitoring = 1025
    AxisTargetPositionWindow = 1026
    AxisTargetPositionMonitoringTime = 1027
    AxisEnInTargetTimeout = 1028
    AxisInTargetTimeout = 1029
    AxisEnMotionMonitoring = 1030
    AxisMotionMonitoringWindow = 1031
    AxisMotionMonitoringTime = 1032
    AxisDelayTimeVeloPosition = 1033
    AxisEnLoopingDistance = 1034
    AxisLoopingDistance = 1035
    AxisEnBacklashCompensation = 1036
    AxisBacklash = 1037
    AxisEnDataPersistence = 1038
    AxisRefVeloOnRefOutput = 1039
    AxisOverrideType = 1040
    AxisEncoderScalingFactor = 1041
    AxisEncoderOffset = 1042
    AxisEncoderDirectionInverse = 1043
    AxisEncoderMask = 1044
    AxisEncoderModuloValue = 1045
    AxisModuloToleranceWindow = 1046
    AxisEnablePosCorrection = 1047
    AxisPosCorrectionFilterTime = 1048
    AxisUnitInterpretation = 1049
    AxisMotorDirectionInverse = 1050
    AxisCycleTime = 1051
    AxisFastStopSignalType = 1052
    AxisFastAcc = 1053
    AxisFastDec = 1054
    AxisFastJerk = 1055
    AxisEncoderScalingNumerator = 1056
    AxisEncoderScalingDenominator = 1057
    AxisMaximumAcceleration = 1058
    AxisMaximumDeceleration = 1059
    AxisVeloJumpFactor = 1060
    AxisToleranceBallAuxAxis = 1061
    AxisMaxPositionDeviationAuxAxis = 1062
    AxisErrorPropagationMode = 1063
    AxisErrorPropagationDelay = 1064
    AxisCoupleSlaveToActualValues = 1065
    AxisAllowMotionCmdToSlaveAxis = 1066
    AxisAllowMotionCmdToExtSetAxis = 1067
    AxisEncoderSubMask = 1068
    AxisEncoderReferenceSystem = 1069
    AxisEncoderPositionFilterPT1 = 1070
    AxisEncoderVelocityFilterPT1 = 1071
    AxisEncoderAccelerationFilterPT1 = 1072
    AxisEncoderMode = 1073
    AxisEncoderHomingInvDirCamSearch = 1074
    AxisEncoderHomingInvDirSyncSearch = 1075
    AxisEncoderHomingCalibValue = 1076
    AxisEncoderReferenceMode = 1077
    AxisRefVeloOutputRatio = 1078
    AxisDrivePositionOutputScaling = 1079
    AxisDriveVelocityOutputScaling = 1080
    AxisDriveVelocityOutputDelay = 1081
    AxisDriveMinOutputLimitation = 1082
    AxisDriveMaxOutputLimitation = 1083
    AxisTorqueInputScaling = 1084
    AxisTorqueInputFilterPT1 = 1085
    AxisTorqueDerivationInputFilterPT1 = 1086
    AxisTorqueOutputScaling = 1087
    AxisTorqueOutputDelay = 1088
    AxisAccelerationOutputScaling = 1089
    AxisAccelerationOutputDelay = 1090
    AxisDrivePosOutputSmoothFilterType = 1091
    AxisDrivePosOutputSmoothFilterTime = 1092
    AxisDrivePosOutputSmoothFilterOrder = 1093
    AxisDriveMode = 1094
    AxisDriftCompensationOffset = 1095
    AxisPositionControlKv = 1096
    AxisCtrlVelocityPreCtrlWeight = 1097
    AxisControllerMode = 1098
    AxisCtrlAutoOffset = 1099
    AxisCtrlAutoOffsetTimer = 1100
    AxisCtrlAutoOffsetLimit = 1101
    AxisSlaveCouplingControlKcp = 1102
    AxisCtrlOutputLimit = 1103
    AxisFadingAccleration = 1104
    AxisUserDataIdxOffs = 1105

    AxisTargetPosition = 2000
    AxisRemainingTimeToGo = 2001
    AxisRemainingDistanceToGo = 2002
    AxisMcSetPositionOffset = 2003

    AxisGearRatio = 3000

    NcSafCycleTime = 4000
    NcSvbCycleTime = 4001

    AxisEncoderMask64 = 5000
    AxisEncoderSubMask64 = 5001

    AxisMasPositionDeviationAuxAxis = 32000
