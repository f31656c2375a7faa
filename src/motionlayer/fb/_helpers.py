"""Blocks that only compute: MC_OverrideFilter and MC_CalcDynamicsByRampTime (function-blocks 2.6)."""

import math
from typing import Final, Protocol

from motionlayer.command import ErrorId
from motionlayer.fb._block import Block
from motionlayer.fb._inputs import integer, lreal, real

FULL: Final = 1_000_000
"""`PlcToNc.Override` of 100 %."""

STIFFEST: Final = 0.99
"""Largest stiffness: at 1 the jerk would be infinite."""


class Clock(Protocol):
    """Who knows the time; a run does."""

    @property
    def time(self) -> float:
        """Seconds."""


class MC_OverrideFilter(Block):  # noqa: N801 - here and below, names of the interface
    """Turn the raw value of a knob into an override that does not change with every flicker.

    The value is clamped to the thresholds and taken in steps. Each new step holds for the recovery time; 0 % and 100 %
    pass at once. It has no axis; the run tells it the time: `MC_OverrideFilter(run)`.

    Args:
        clock: tells the time, as a run does.

    Attributes:
        OverrideValueFiltered: 0 to 1 000 000.
        OverridePercentFiltered: the same in percent.
    """

    OverrideValueRaw = integer("DINT", 0, "raw value of the knob")
    LowerOverrideThreshold = integer("DINT", 0, "raw value of 0 %")
    UpperOverrideThreshold = integer("DINT", 32767, "raw value of 100 %, above the lower one")
    OverrideSteps = integer("UDINT", 200, "steps from 0 to 100 %, > 1")
    OverrideRecoveryTime = lreal(0.150, "for how long each value holds, s")

    def __init__(self, clock: Clock) -> None:
        super().__init__()
        self.OverrideValueFiltered = 0
        self.OverridePercentFiltered = 0.0
        self._clock = clock
        self._since = -math.inf

    def _call(self) -> None:
        low, high = real(self, "LowerOverrideThreshold"), real(self, "UpperOverrideThreshold")
        raw, steps, hold = (real(self, name) for name in ("OverrideValueRaw", "OverrideSteps", "OverrideRecoveryTime"))
        if not (steps > 1 and low < high and 0.0 <= hold < math.inf and math.isfinite(raw * steps)):
            self._show_error(ErrorId.PARAMETER)
            return
        self._show_error(None)
        share = min(max((raw - low) / (high - low), 0.0), 1.0)
        value = round(round(share * steps) / steps * FULL)
        now = self._clock.time
        if value == self.OverrideValueFiltered:
            return
        # The clock counts cycles: half a millionth of a second is its rounding, not time.
        if value in (0, FULL) or now - self._since >= hold - 5e-7:
            self._since = now
            self.OverrideValueFiltered = value
            self.OverridePercentFiltered = value * 100.0 / FULL


class MC_CalcDynamicsByRampTime(Block):  # noqa: N801
    """Compute acceleration and jerk from the time in which a velocity is to be reached.

    The ramp of RampTime t has two phases of equal jerk, t1 each, and one of constant acceleration between them, t2.
    The stiffness c shares it out: t1 = t (1-c)/(2-c), t2 = t c/(2-c). So c = 0 has no constant phase, and at c = 0.5
    all three are alike. As the velocity is reached, a = v / (t1 + t2), and the jerk takes t1 to get there.

    Attributes:
        Acceleration: u/s².
        Deceleration: the same.
        Jerk: u/s³.
    """

    Velocity = lreal(0.0, "to be reached, u/s, > 0")
    RampTime = lreal(0.0, "in which time, s, > 0")
    Stiffness = lreal(0.0, "share of constant acceleration, 0 to 1; above 0.99 it counts as that")

    def __init__(self) -> None:
        super().__init__()
        self._show(0.0, 0.0)

    def _call(self) -> None:
        v, t, c = (real(self, name) for name in ("Velocity", "RampTime", "Stiffness"))
        if not (0.0 < v < math.inf and 0.0 < t < math.inf and 0.0 <= c <= 1.0):
            self._show(0.0, 0.0)
            self._show_error(ErrorId.PARAMETER)
            return
        self._show_error(None)
        c = min(c, STIFFEST)
        t1 = t * (1.0 - c) / (2.0 - c)
        acceleration = v / (t1 + t * c / (2.0 - c))
        self._show(acceleration, acceleration / t1)

    def _show(self, acceleration: float, jerk: float) -> None:
        self.Acceleration = self.Deceleration = acceleration
        self.Jerk = jerk
