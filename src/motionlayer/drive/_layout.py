"""Rows of the two tables of servo drives: parameters, fixed at load, and states."""

from typing import Final


class Par:
    """Parameter of a drive: row of `ServoDrives.parameters`. u is the unit of the axis."""

    GAIN: Final = 0
    """Position gain, 1/s."""
    FORWARD: Final = 1
    """Velocity feed-forward, 0 to 1."""
    RISE: Final = 2
    """1 - e with e = exp(-dt/T): the share of a velocity error that is gone after a cycle."""
    GLIDE: Final = 3
    """T (1 - e): way per velocity error, in s."""
    MOST: Final = 4
    """Largest change of velocity in a cycle (torque limit), u/s."""
    BRAKE: Final = 5
    """Deceleration without power, u/s²."""
    PLAY: Final = 6
    """Half of the backlash, u."""
    STEP: Final = 7
    """Resolution of the encoder, u; 0 without."""
    NOISE: Final = 8
    """Standard deviation of the encoder's noise, u."""
    EDGE: Final = 9
    """Drive position of the reference switch; infinite without."""
    SIDE: Final = 10
    """Direction in which the switch is on, +1 or -1."""
    LEAP: Final = 11
    """Largest plausible change of the encoder in a cycle, u."""
    PREPARE: Final = 12
    """Cycles from the request to readiness, beyond the first."""
    PATIENCE: Final = 13
    """Cycles without communication that are borne."""
    WIDTH: Final = 14
    """Width of the reference switch, u; infinite for one that is on up to the end of the way."""

    COUNT: Final = 15


class State:
    """State of a drive: row of `ServoDrives.states`. Positions are those of the drive, without the shift."""

    X: Final = 0
    """Position of the motor, u."""
    V: Final = 1
    """Velocity of the motor, u/s."""
    LOAD: Final = 2
    """Position behind the backlash, u."""
    OFFSET: Final = 3
    """What the encoder is off, u."""
    REPORTED: Final = 4
    """What the encoder showed last, u."""
    POWER: Final = 5
    """1 with power."""
    ASKED: Final = 6
    """The last request for power that arrived, 0 or 1."""
    WAITED: Final = 7
    """Cycles since power was asked for."""
    SILENT: Final = 8
    """Cycles without communication."""
    ERRORS: Final = 9
    """Latched bits of `store.Status`."""
    FAILS_UNTIL: Final = 10
    """Tick before which a drive error cannot be reset."""
    DISABLED_UNTIL: Final = 11
    """Tick before which the enable input is open."""
    SILENT_UNTIL: Final = 12
    """Tick before which there is no communication."""
    BLOCKED_UNTIL: Final = 13
    """Tick before which the mechanics are stuck."""
    DELAYED_P: Final = 14
    """Set position that has come through the dead time, u."""
    DELAYED_V: Final = 15
    """Set velocity that has, u/s."""

    COUNT: Final = 16
