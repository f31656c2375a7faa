"""Numbers of the parameters of an axis (function-blocks 2.17), those for which this runtime has something."""

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
    AxisEncoderModuloValue = 1044
    AxisModuloToleranceWindow = 1045
    AxisCycleTime = 1050
    AxisMaximumAcceleration = 1057
    AxisMaximumDeceleration = 1058
    AxisTargetPosition = 2000
    AxisRemainingTimeToGo = 2001
    AxisRemainingDistanceToGo = 2002
    NcSafCycleTime = 4000
    NcSvbCycleTime = 4001
