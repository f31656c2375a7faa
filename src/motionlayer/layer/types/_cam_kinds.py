"""Enumerations of cam tables and cam couplings (motion-layer 2.9)."""

import enum


class InterpolationType(enum.IntEnum):
    """`MC_InterpolationType`: how a cam goes between two points of its table."""

    LINEAR = 0
    SPLINE = 2
    SLIDINGSPLINE = 3


class CamOperationMode(enum.IntEnum):
    """`MC_CamOperationMode`: what a table does to those that are coupled already."""

    DEFAULT = 0
    ADDITIVE = 1
    EXCHANGE = 2
    REMOVE = 3


class CamScalingMode(enum.IntEnum):
    """`MC_CamScalingMode`: where offset and scale of a side come from."""

    USERDEFINED = 0
    AUTOOFFSET = 1
    OFF = 2


class CamActivationMode(enum.IntEnum):
    """`MC_CamActivationMode`: when a change comes into force."""

    INSTANTANEOUS = 0
    ATMASTERCAMPOS = 1
    ATMASTERAXISPOS = 2
    NEXTCYCLE = 3
    NEXTCYCLEONCE = 4
    ASSOONASPOSSIBLE = 5
    OFF = 6
    DELETEQUEUEDDATA = 7
    ATMASTERAXISPOS_POSITIVEDIRECTION = 8
    ATMASTERAXISPOS_NEGATIVEDIRECTION = 9
    BUFFERED = 10


class TableType(enum.IntEnum):
    """`MC_TableType`: how a table is stored."""

    EQUIDISTANT = 10
    NONEQUIDISTANT = 11
    MOTIONFUNCTION = 22
    CHARACTERISTIC = 23


class MotionPointType(enum.IntEnum):
    """`MC_MotionPointType`: what a point of a motion function is for."""

    IGNORE = 0
    REST = 1
    VELOCITY = 2
    TURN = 4
    MOTION = 8
    ADD = 3840
    ACTIVATION = 8192


class MotionFunctionType(enum.IntEnum):
    """`MC_MotionFunctionType`: the law of motion from a point to the next."""

    NOTDEF = 0
    POLYNOM1 = 1
    POLYNOM3 = 3
    POLYNOM5 = 5
    POLYNOM7 = 7
    POLYNOM8 = 8
    POLYNOM9 = 9
    SINUSLINIE = 10
    MODSINUSLINIE = 11
    BESTEHORN = 12
    BESCHLTRAPEZ = 13
    POLYNOM5_MM = 15
    SINUS_GERADE_KOMBI = 16
    HARMONIC_KOMBI_RT = 17
    HARMONIC_KOMBI_TR = 18
    HARMONIC_KOMBI_VT = 19
    HARMONIC_KOMBI_TV = 20
    BESCHLTRAPEZ_RT = 21
    BESCHLTRAPEZ_TR = 22
    MODSINUSLINIE_VV = 23
    POLYNOM7_MM = 24
    POLYNOM6STP = 27
    POLYNOM6WDP = 28
    BESCHLTRAPEZ_RV = 38
    BESCHLTRAPEZ_VR = 39
    POLYNOM3_VV = 40
    POLYNOM11 = 41
    PEISEKAH11 = 45
    STEPFUNCTION = 99
    SPLINE = 100
    SPLINE_NATURAL = 101
    SPLINE_TANGENTIAL = 102
    SPLINE_PERIODIC = 103
    SPLINE_LINEAR = 120
