"""Axis: its parameters and monitors, 0x4300 to 0x43FF."""

from typing import Final

from motionlayer.command._errors._id import ErrorId as E
from motionlayer.command._errors._text import ErrorText

AXIS: Final = {
    E.MANUAL_VELOCITY_SLOW: ErrorText("slow manual velocity not valid"),
    E.RAPID_VELOCITY: ErrorText("velocity of rapid traverse not valid"),
    E.ACCELERATION_PARAMETER: ErrorText("acceleration of the axis outside 0.001 to 1e20"),
    E.DECELERATION_PARAMETER: ErrorText("deceleration of the axis outside 0.001 to 1e20"),
    E.JERK_PARAMETER: ErrorText("jerk of the axis outside 0.01 to 1e30"),
    E.OVERRIDE_TYPE: ErrorText("type of the override not valid"),
    E.HOMING_VELOCITY_CAM: ErrorText(
        "homing velocity towards the cam not valid", "see velocity of the homing, and max_velocity"
    ),
    E.HOMING_VELOCITY_SYNC: ErrorText(
        "homing velocity in the direction of the sync pulse not valid",
        "see the velocities of the homing, and max_velocity",
    ),
    E.TARGET_WINDOW_PARAMETER: ErrorText("target window outside 0 to 10000"),
    E.RANGE_WINDOW_PARAMETER: ErrorText("range window outside 0 to 10000"),
    E.MAX_VELOCITY_PARAMETER: ErrorText("maximum velocity not valid"),
    E.TARGET_TIMEOUT_PARAMETER: ErrorText("timeout of the target window not valid"),
    E.SLAVE_COMMANDS_FLAG: ErrorText('flag "motion commands to slaves" not valid'),
    E.EXTERNAL_COMMANDS_FLAG: ErrorText('flag "motion commands to axes with external set points" not valid'),
    E.CONTROLLER_NOT_ENABLED: ErrorText(
        "controller enable missing", "enable the axis and wait for the command to be done"
    ),
    E.FEED_MINUS_NOT_ENABLED: ErrorText(
        "feed enable in negative direction missing", "enable the axis in negative direction as well"
    ),
    E.FEED_PLUS_NOT_ENABLED: ErrorText(
        "feed enable in positive direction missing", "enable the axis in positive direction as well"
    ),
    E.TARGET_VELOCITY_REFUSED: ErrorText("target velocity not permitted"),
    E.SET_ACCELERATION: ErrorText("monitor of the set acceleration"),
    E.TARGET_TIMEOUT: ErrorText(
        "the axis has not come into its target window in time",
        "see target_window; look for what holds it",
        "positioning, by its monitor",
    ),
    E.NO_MOTION: ErrorText(
        "the axis does not move though it should",
        "look for what holds it: brake, mechanics, drive; see motion_window and motion_time",
        "the motion monitor",
    ),
    E.START_VELOCITY: ErrorText("start velocity not permitted"),
    E.END_VELOCITY: ErrorText("end velocity not permitted", "see max_velocity"),
    E.TIME_IN_FUTURE: ErrorText("time too far in the future"),
    E.TIME_IN_PAST: ErrorText("time too far in the past"),
    E.POSITION_NEVER_REACHED: ErrorText("the position is never reached"),
    E.DIRECTION_CONFLICT: ErrorText("direction contradicts what is expected"),
    E.COUPLING_VELOCITY: ErrorText("the coupling would exceed the velocity of the slave"),
    E.COUPLING_ACCELERATION: ErrorText("the coupling would exceed the acceleration of the slave"),
    E.AXIS_CONSEQUENCE: ErrorText("consequence of an error elsewhere in the axis"),
}
