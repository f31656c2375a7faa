"""Pacing: holding back each tick until it is due.

Tick n is due at the instant `start + n · cycle / speed`. The instants are absolute, so that a tick that begins late
does not delay those after it. The thread sleeps until shortly before and spins for the rest, because a sleep ends late
by an amount that varies less than its mean; how much earlier it must end follows what was seen.

What happens to a tick that begins `late` whole ticks after it was due:

========= ======================================================================================
0         nothing
1 to 5    it is an overrun; this one and those after it run back to back until time is caught up
6 or more time slips: the instants of this tick and all after it move, to the next whole tick
========= ======================================================================================

An *incident* begins with an overrun and ends when the cycle has to wait again. What was lost by slipping counts until
then, so a cycle that is always too long ends above every limit, by however little it is too long. Faster than real
time, a late tick is one base cycle of the clock all the same: how late a computer is does not depend on the speed.
"""

from collections.abc import Callable
from fractions import Fraction
from typing import Final

from motionlayer.runtime._clock import Clock
from motionlayer.runtime._statistics import Histogram

CATCH_UP: Final = 5
"""Ticks that are caught up; what is later slips."""

BRAKE: Final = 10
"""More ticks late than this within one incident, and all axes brake."""

QUIET_NS: Final = 1_000_000_000
"""Between two warnings, in nanoseconds of the clock; only braking is always told."""

SLOWEST: Final = 0.01
FASTEST: Final = 1000.0
"""Bounds of the speed, in real time."""

_DECAY: Final = 64
"""Waits after which the time to wake early has sunk by about two thirds."""


class Pace:
    """Hold back each tick until it is due.

    Args:
        cycle_ns: base cycle in nanoseconds.
        clock: what it is measured with.
        speed: seconds of the run in a second of the clock, 0.01 to 1000.
        spin_ns: longest time to spin before a tick, in nanoseconds; at most a quarter of a tick is used.
        report: called with the ticks that an incident is late, when it begins, slips or passes `BRAKE`.
        slipped: called with the nanoseconds by which time slips.
        idle: called before a wait with its length in nanoseconds.

    Attributes:
        lateness: of all ticks.
        overruns: ticks that began at least one tick late.
        slips: how often time slipped.
        slipped_ns: by how much in total, in nanoseconds of the clock.
        brakes: incidents that passed `BRAKE`.

    Raises:
        ValueError: the speed is out of range.
    """

    def __init__(
        self,
        cycle_ns: int,
        clock: Clock,
        *,
        report: Callable[[int], None],
        speed: float = 1.0,
        spin_ns: int = 0,
        slipped: Callable[[int], None] = lambda _: None,
        idle: Callable[[int], None] = lambda _: None,
    ) -> None:
        if not SLOWEST <= speed <= FASTEST:
            raise ValueError(f"speed = {speed}: must be {SLOWEST:g} to {FASTEST:g} (times real time)")
        self.lateness = Histogram()
        self.overruns = self.slips = self.slipped_ns = self.brakes = 0
        self._clock = clock
        # As a fraction of integers the instants stay exact, however long the run.
        self._period_ns = cycle_ns / Fraction(str(float(speed)))
        self._late_ns = max(cycle_ns, int(self._period_ns))
        self._report, self._slipped, self._idle = report, slipped, idle
        self._quiet_until = 0
        self.spin(spin_ns)
        self.start(0)

    def spin(self, spin_ns: int) -> None:
        """Spin for at most this long from now on, in nanoseconds; 0 sleeps only."""
        self._spin_ns = min(spin_ns, int(self._period_ns) // 4)
        self._early_ns = 0

    def start(self, tick: int) -> None:
        """Let this tick be due now, and those after it in their time; an incident is over."""
        self._origin = self._clock.now_ns()
        self._first = tick
        self._lost = self._grade = 0

    def wait(self, tick: int) -> None:
        """Return when a tick is due; called once before each."""
        period = self._period_ns
        due = self._origin + (tick - self._first) * period.numerator // period.denominator
        now = self._clock.now_ns()
        if now < due:
            self._lost = self._grade = 0
            self._idle(due - now)
            now = self._sleep(due)
        self.lateness.add(now - due)
        late = (now - due) // self._late_ns
        if late:
            self.overruns += 1
            if late > CATCH_UP:
                self._slip(due, late)
            self._tell(self._lost if late > CATCH_UP else self._lost + late)

    def _sleep(self, due: int) -> int:
        """Sleep, spin, and return what time it is then."""
        clock = self._clock
        wake = due - self._early_ns
        clock.sleep_until(wake)
        now = clock.now_ns()
        # Rises at once to what was seen, sinks slowly.
        self._early_ns = min(self._spin_ns, max(now - wake, self._early_ns - self._early_ns // _DECAY))
        while now < due:
            now = clock.now_ns()
        return now

    def _slip(self, due: int, late: int) -> None:
        """Move the instants of this tick and all after it, and wait for the new one."""
        # To the next whole tick, not to this instant: a cycle that is always too long sleeps now and then.
        lost = (late + 1) * self._late_ns
        self._origin += lost
        self._lost += late
        self.slips += 1
        self.slipped_ns += lost
        self._slipped(lost)
        self._sleep(due + lost)

    def _tell(self, late: int) -> None:
        """Report an incident when it gets graver."""
        grade = 1 + (late > CATCH_UP) + (late > BRAKE)
        if grade <= self._grade:
            return
        self._grade = grade
        self.brakes += late > BRAKE
        now = self._clock.now_ns()
        if late > BRAKE or now >= self._quiet_until:
            self._quiet_until = now + QUIET_NS
            self._report(late)
