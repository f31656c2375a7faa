"""How an axis is homed (motion-layer 3.2). u is the unit of the axis."""

from motionlayer.iec import BIT, BOOL, LREAL, Field, Struct
from motionlayer.layer.types._enumerations import E_ENCODER_REFERENCE_MODE, MC_DIRECTION, MC_HOMING_MODE
from motionlayer.nc import Direction


class HomingOptions(Struct, iec="ST_HomingOptions"):
    """Options of the homing block, as the library lays them out."""

    clear_lag = Field("ClearPositionLag", BOOL, "with MC_Direct the set position becomes the actual one too")
    search_direction = Field(
        "SearchDirection", MC_DIRECTION, "towards the cam; undefined: machine file", default=Direction.UNDEFINED
    )
    search_velocity = Field("SearchVelocity", LREAL, "towards the cam (u/s), 0 for that of the machine file")
    sync_direction = Field(
        "SyncDirection", MC_DIRECTION, "off the cam; undefined: machine file", default=Direction.UNDEFINED
    )
    sync_velocity = Field("SyncVelocity", LREAL, "off the cam (u/s), 0 for that of the machine file")
    reference_mode = Field("ReferenceMode", E_ENCODER_REFERENCE_MODE, "what the reference is")


class HomeParams(Struct, iec="ST_HomeParams"):
    """Position, mode and signals of a homing."""

    position = Field("Position", LREAL, "calibration position (u)")
    mode = Field("HomingMode", MC_HOMING_MODE, "how the axis is referenced")
    options = Field("Options", HomingOptions, "options of the library")
    invert_sensor = Field("InvertHomeSensor", BIT, "the calibration cam is a break contact")
    simulate_sensor = Field("SimulateHomeSensor", BIT, "the signal follows from the phase of the homing")
    use_limit_min = Field("UseLimitMin", BIT, "not evaluated", default=True)
    invert_limit_min = Field("InvertLimitMin", BIT, "the lower limit switch is a break contact")
    home_on_limit_min = Field("HomeOnLimitMin", BIT, "the lower limit switch is the calibration signal")
    use_limit_max = Field("UseLimitMax", BIT, "not evaluated", default=True)
    invert_limit_max = Field("InvertLimitMax", BIT, "the upper limit switch is a break contact")
    home_on_limit_max = Field("HomeOnLimitMax", BIT, "the upper limit switch is the calibration signal")


class Homing(Struct, iec="ST_HOMING", pack=2):
    """Homing of an axis."""

    execute = Field("bExecute", BIT, "not evaluated; AXIS_HOME starts it")
    parameters = Field("stHomingParam", HomeParams, "how")
