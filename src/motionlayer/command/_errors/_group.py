"""Group and set-point generation, 0x4200 to 0x42FF: what a command is refused for."""

from typing import Final

from motionlayer.command._errors._id import ErrorId as E
from motionlayer.command._errors._text import ErrorText

GROUP: Final = {
    E.GROUP_ID_INVALID: ErrorText("id of the group not valid"),
    E.GROUP_TYPE: ErrorText("type of the group not valid"),
    E.GROUP_INTERNAL: ErrorText(
        "internal error of the group", "please report it with the input that the message holds"
    ),
    E.COUPLING_TABLE: ErrorText("coupling table unknown"),
    E.NO_REFERENCE_TABLE: ErrorText("automatic offset of the master without a reference table"),
    E.MASTER_START: ErrorText("start position of the master does not permit synchronising"),
    E.GEAR_RATIO_ZERO: ErrorText("gear ratio 0", "give a ratio other than 0"),
    E.CANNOT_JOIN_GROUP: ErrorText("axis cannot be put into the group: its place is taken, or it is coupled"),
    E.GENERATOR_UNSUPPORTED: ErrorText("the set-point generator does not support the function"),
    E.GROUP_BUSY: ErrorText(
        "the axis is busy and takes no such command now",
        "halt the axis first, or set the position relative to where it is",
        "setting an absolute position, a software limit or a maximum while the axis moves",
    ),
    E.VELOCITY: ErrorText(
        "velocity not positive or above the maximum", "see max_velocity", "moves, by their `velocity`"
    ),
    E.TARGET_OUTSIDE_LIMITS: ErrorText(
        "target outside the software limits", "see software_limit_min/max", "moves to a position"
    ),
    E.FEED_NOT_ENABLED: ErrorText(
        "feed enable of the direction missing",
        "enable the axis in this direction as well, or move the other way",
        "moves, and motion under way that loses the feed enable",
    ),
    E.PATH_TOO_SHORT: ErrorText("path smaller than an increment of the encoder, reported as finished"),
    E.NOT_READY_AT_START: ErrorText(
        "the drive was not ready at the start",
        "enable the drive and wait until it is ready; mend its error first, if it has one",
        "moves that begin before the drive is ready",
    ),
    E.EMERGENCY_STOP_DYNAMICS: ErrorText(
        "dynamics of the emergency stop negative or weaker than those at work",
        "leave deceleration and jerk out, or give more than the motion uses",
    ),
    E.GENERATOR_INACTIVE: ErrorText("the set-point generator is not active"),
    E.SLAVE_TARGET_OUTSIDE_LIMITS: ErrorText(
        "target outside the software limits of the slave", "see software_limit_min/max of the slave"
    ),
    E.SLAVE_FEED_NOT_ENABLED: ErrorText(
        "controller or feed enable of the slave missing", "enable the slave in this direction as well"
    ),
    E.ACTIVATION_OUTSIDE_MOVE: ErrorText(
        "activation position outside the running move", "give a position between here and the target"
    ),
    E.EXTERNAL_START_TYPE: ErrorText(
        "external set-point generator: start type differs from the active one, or absolute during another motion",
        "switch the generator off before changing its type; halt the axis before an absolute start",
    ),
    E.VELOCITY_NOT_CONSTANT: ErrorText(
        "velocity not constant, the dynamics cannot change", "wait until the velocity is constant"
    ),
    E.JERK: ErrorText("jerk not positive or above the maximum", "see max_jerk", "moves and stops, by their `jerk`"),
    E.ACCELERATION: ErrorText(
        "acceleration not positive or above the maximum", "see max_acceleration", "moves, by their `acceleration`"
    ),
    E.DECELERATION: ErrorText(
        "deceleration not positive or above the maximum",
        "see max_deceleration",
        "moves and stops, by their `deceleration`",
    ),
    E.TARGET_VELOCITY: ErrorText(
        "target velocity not positive, or outside 1e-3 to 1e10", "give a velocity in this range"
    ),
    E.POSITIONING_TOO_LONG: ErrorText(
        "positioning too long for the resolution of numbers",
        "go faster, or part of the way; see the ranges in profile.md",
        "moves, by the time that they would take",
    ),
    E.CYCLE_TIME: ErrorText("cycle time not positive"),
    E.OVERRIDE: ErrorText("override outside 0 to 100 %", "give 0 to 1 in Python, 0 to 100 % in the axis interface"),
    E.START_TYPE: ErrorText("start type unknown"),
    E.VELOCITY_OVERSHOOT: ErrorText(
        "the velocity would overshoot with these dynamics", "give more deceleration or jerk"
    ),
    E.GENERATOR_TABLE_FULL: ErrorText("table of the set-point generator full"),
    E.STOP_ACTIVE_ALREADY: ErrorText("a stop is active already", "wait until it has ended"),
    E.SUPERPOSITION_PARTIAL: ErrorText("warning: the superposition cannot cover the whole distance"),
    E.SUPERPOSITION_REFUSED: ErrorText(
        "a superposition is active already, or the axis does not move",
        "wait for the end of the one before; start the axis first",
    ),
    E.NO_SUPERPOSITION: ErrorText("no superposition is active", "there is nothing to abort"),
    E.MASTER_AT_REST: ErrorText(
        "master at rest, coupling on the fly impossible", "start the master first, or couple both at rest"
    ),
    E.COUPLING_VELOCITIES: ErrorText("velocities not constant when coupling on the fly"),
    E.DECOUPLING_REFUSED: ErrorText("decoupling not permitted in this state", "only a slave can be decoupled"),
    E.FUNCTION_IMPOSSIBLE: ErrorText("the function makes no sense here, such as for a slave"),
    E.POSITION_TYPE: ErrorText("type of the start or end position not valid"),
    E.FUNCTION_UNSUPPORTED: ErrorText(
        "function not supported",
        "see which commands the object has; a number may be mistyped",
        "the motion layer, for a command that its object does not have",
    ),
    E.CAM_RELEASED_EARLY: ErrorText(
        "homing cam released too early",
        "a longer cam, or a lower homing velocity towards it",
        "homing, at rest on the cam",
    ),
    E.LATCH_TOO_CLOSE: ErrorText(
        "latch and sync pulse too close together",
        "move the cam by half a turn of the encoder",
        "homing, in the search for the sync pulse",
    ),
    E.SLAVE_WITHOUT_TABLE: ErrorText("table slave without an active table"),
    E.FUNCTION_NOT_ALLOWED: ErrorText(
        "function not allowed",
        "name a persistent_file in the machine file",
        "parameters to be written persistently, without a file for them",
    ),
    E.SLAVE_TABLE_IN_USE: ErrorText("table of the slave in use"),
    E.BUSY_WHILE_COUPLING: ErrorText("master or slave is busy when coupling", "wait until both rest"),
    E.COUPLING_PARAMETER: ErrorText("start parameter of the coupling wrong: a ratio or scaling of 0"),
    E.STOP_ACTIVE: ErrorText("a stop is active already", "wait until it has ended", "`stop()` during another stop"),
    E.TOO_MANY_TABLES: ErrorText("too many tables for a slave, 4 at most"),
    E.SCALING_MODE: ErrorText("scaling mode not permitted"),
    E.NOT_ENABLED: ErrorText(
        "the axis is not enabled",
        "enable it and wait for the command to be done",
        "moves without power, and motion under way that loses it",
    ),
    E.TABLE_NOT_FOUND: ErrorText("table not found"),
    E.TABLE_TYPE_WRONG: ErrorText("the table has the wrong type"),
    E.SINGLE_STEP: ErrorText("single step mode refuses another task"),
    E.GROUP_TASK: ErrorText("task of the group unknown"),
    E.SLAVE_TASK: ErrorText("motion command to a slave", "decouple it first, or allow motion commands to slaves"),
    E.SLAVE_GROUP_FUNCTION: ErrorText("group function on a slave", "decouple it first"),
    E.NCI_INACTIVE: ErrorText("the interpolating generator is not active"),
    E.START_IS_TARGET: ErrorText("start equals target"),
    E.SUPERPOSITION_PARAMETER: ErrorText("parameters of the superposition not valid"),
    E.ACTIVATION_PASSED: ErrorText(
        "the activation position has passed already", "activate at once, or give a position ahead of the master"
    ),
    E.ACTIVATION_AT_REST: ErrorText("activation impossible, the master rests", "start the master first"),
    E.ACTIVATION_SLAVE_MOVES: ErrorText("activation mode not possible while the slave moves"),
    E.SUPERPOSITION_DYNAMICS: ErrorText("dynamics of the superposition not positive"),
    E.SUPERPOSITION_LENGTH: ErrorText("length of the superposition not positive"),
    E.GROUP_PARAMETER: ErrorText("parameter of the group not valid"),
    E.GENERATOR_START: ErrorText("start of the generator failed, such as of a flying saw"),
    E.NEW_TARGET_UNREACHABLE: ErrorText("new target cannot be reached", "brake harder, or halt and move anew"),
    E.NEW_VELOCITY: ErrorText("new travel or end velocity not valid"),
    E.TARGET_NOT_FINITE: ErrorText(
        "target is not a finite number",
        "command a finite position or distance",
        "moves, by their `position` or `distance`",
    ),
    E.NEW_TRAVEL_VELOCITY: ErrorText("new travel velocity not valid", "see max_velocity"),
    E.AS_GOOD_AS_POSSIBLE: ErrorText(
        "warning: the command was done as well as possible",
        "the axis overshoots its target and turns back; command it earlier, or with a stronger deceleration",
        "a message about a move in motion to a target ahead; the move is not refused",
    ),
    E.OVERRUN: ErrorText(
        "the way to the target would leave the software limits",
        "brake harder, or stop before the new command",
        "moves from a motion that must swing beyond the target",
    ),
    E.ORIENTED_STOP_TARGET: ErrorText(
        "oriented stop: modulo target outside 0 to the period",
        "give a target of at least 0 and below modulo_period",
        "oriented stops, which ADS clients ask for",
    ),
    E.MODULO_TARGET: ErrorText(
        "modulo target not valid for this direction",
        "give a target of at least 0 and, for the shortest way, below the period",
        "modulo moves",
    ),
    E.ACTIVATION_MODE: ErrorText("activation mode not valid"),
    E.JERK_TOO_SMALL: ErrorText("jerk below the minimum", "give more jerk"),
    E.ACCELERATION_TOO_SMALL: ErrorText(
        "acceleration or deceleration below the minimum",
        "give more acceleration or deceleration, or less velocity or jerk",
        "moves, where they are too weak to be planned",
    ),
    E.VELOCITY_TOO_SMALL: ErrorText("velocity below the minimum", "give more velocity"),
    E.ACTIVATION_PENDING: ErrorText("another activation is pending", "wait for it, or cancel it"),
    E.REVERSAL_NOT_PERMITTED: ErrorText(
        "reversal of the motion not permitted",
        "halt first, or move in the present direction",
        "modulo moves that are commanded in motion",
    ),
    E.ACTIVATION_COMMAND_PENDING: ErrorText("another command with an activation position is pending"),
    E.ACTIVATION_PATH_TOO_SHORT: ErrorText("rest of the path too short for the activation position"),
    E.BRAKING_ALREADY: ErrorText(
        "braking already, activation position impossible", "give the following command before the axis brakes"
    ),
    E.BUFFER_FULL: ErrorText(
        "the command buffer is full",
        "one command can wait: give the next when this one has become active",
        "buffered and blended moves",
    ),
    E.NEW_VELOCITY_NOT_FEASIBLE: ErrorText("new velocity not feasible"),
    E.SAME_END_POSITION: ErrorText("two commands with the same end position", "leave one of them out", "blended moves"),
    E.BLENDING_POSITION: ErrorText(
        "blending position or direction contradicts the running command",
        "give a position between the beginning and the target of the running move",
        "blended moves with a blending position",
    ),
    E.DISTANCE_TOO_SHORT: ErrorText(
        "remaining distance too short",
        "command earlier, a longer way, or with more deceleration",
        "moves with an end velocity, blended moves; moves by less than can be planned",
    ),
    E.START_PARAMETER: ErrorText("start parameters not valid"),
    E.CAM_NOT_FOUND: ErrorText(
        "homing cam not found",
        "look for cam and switch; see direction and largest way of the search",
        "homing, in the search for the cam",
    ),
    E.CAM_NOT_LEFT: ErrorText(
        "homing cam not left",
        "look for a switch that is stuck; see the largest way of the search",
        "homing, on the way off the cam",
    ),
    E.SYNC_PULSE_NOT_FOUND: ErrorText(
        "sync pulse of the homing not found",
        "look for the encoder's index; see the largest way of the search",
        "homing, in the search for the sync pulse",
    ),
    E.BUFFER_MODE: ErrorText(
        "buffer mode unknown or not supported here",
        "use BufferMode.ABORTING",
        "commands that cannot wait in the buffer",
    ),
    E.GROUP_CONSEQUENCE: ErrorText(
        "consequence of the error of another axis of the group", "mend and reset the other axis"
    ),
    E.REDUCTION_FACTOR: ErrorText("reduction factor C0 or C1 not valid"),
    E.CRITICAL_ANGLE: ErrorText("critical angle outside 0 to 180 degrees"),
    E.TOLERANCE_RADIUS: ErrorText("radius of the tolerance ball out of range"),
    E.BLENDING_IMPOSSIBLE: ErrorText("blending impossible"),
    E.MINIMUM_VELOCITY: ErrorText("minimum velocity negative"),
    E.PATH_DYNAMICS: ErrorText("dynamics of the path not valid"),
    E.HELIX_IS_CIRCLE: ErrorText("the helix is only a circle"),
    E.HELIX_IS_LINE: ErrorText("the helix is only a line"),
    E.TOLERANCE_RADIUS_TOO_SMALL: ErrorText("radius of the tolerance ball below 0.1 mm"),
    E.BLOCK_OUTSIDE_LIMITS: ErrorText("NC block violates the software limits of the path"),
    E.PATH_AXIS_LIMIT: ErrorText("axis of the path violates its limit"),
    E.AXIS_UNSUITABLE: ErrorText("the interpolation group holds an axis of an unsuitable type"),
    E.DIMENSION: ErrorText("dimension not valid; comes where no reset follows a stop"),
    E.LINE_LENGTH_ZERO: ErrorText("line of length 0"),
    E.CIRCLE_DEGENERATE: ErrorText("circle degenerate"),
    E.HELIX_DEGENERATE: ErrorText("helix degenerate"),
    E.CNC_VELOCITY: ErrorText("target velocity of the CNC not positive"),
    E.CNC_OVERRIDE: ErrorText("override of the CNC outside 0 to 100 %"),
    E.DELETE_DISTANCE: ErrorText("delete distance to go is not possible"),
    E.MOTION_FUNCTION_PARAMETER: ErrorText("table parameters of the motion function wrong"),
    E.MOTION_FUNCTION_POINTS: ErrorText("points of the motion function wrong: an active one refers to an ignored one"),
    E.SAW_DYNAMICS: ErrorText("flying saw: dynamics of the slave not valid, or the synchronous velocity too high"),
    E.SAW_SYNC_BEHIND: ErrorText("flying saw: the sync position is not ahead of the master"),
    E.SAW_LIMIT: ErrorText("flying saw: the profile violates a checked limit"),
    E.FIFO_PARAMETER: ErrorText("parameter of the FIFO generator not valid"),
    E.EXTERNAL_ACTIVE: ErrorText("external set-point generator already active"),
    E.EXTERNAL_INACTIVE: ErrorText("external set-point generator not active"),
    E.AUXILIARY_AXIS_LIMIT: ErrorText("auxiliary axis violates its limit"),
    E.LOCKED_BY_STOP: ErrorText(
        "the axis is locked by a stop", "wait until the stop has ended", "moves, halts and homing during a stop"
    ),
    E.SEGMENT_NOT_FOUND: ErrorText("block search: segment not found"),
}
