"""`Loop`: the ticks of a run, one after the other, until its end has come.

A run ends when its time is over or somebody stops it, at once. Otherwise it ends when no program is left, and not while
an axis brakes: what a failed program was moving, and what an emergency stop or an error brings to rest, comes to rest.
"""

import math
from collections.abc import Callable
from numbers import Real
from operator import index
from typing import Final, SupportsIndex, TypeVar

from motionlayer.runtime._ticking import Ticking
from motionlayer.runtime._watchdog import Watchdog

T = TypeVar("T")

LAST_TICK: Final = 2**53
"""Up to here the tick is a whole number also where it is kept as a float."""


class Loop(Ticking):
    """Cycles in order, and their end; the arguments are those of `Ticking`."""

    _end: float = math.inf
    """The tick that is not run any more."""
    _stopped = ""
    """Why somebody has stopped it, in words."""

    @property
    def idle(self) -> bool:
        """No program is left, and no axis brakes: `run()` would return."""
        return self._over()

    def stop(self, cause: str) -> None:
        """End `run()` after the present tick, or as soon as it begins, as if its time were over; for any thread.

        Args:
            cause: for the record, in words.
        """
        self._stopped = cause
        self._end = 0

    def step(self, ticks: int = 1) -> None:
        """Run a number of ticks, programs or not.

        Raises:
            TypeError: not a whole number.
            ValueError: a negative one.
            RuntimeError: called in a program.
            CycleFault: a step of the runtime itself failed.
        """
        if self._ledger.issuer is not None:
            raise RuntimeError("a program cannot run ticks itself: await run.sleep(seconds) or a command")
        if type(ticks) is not int:  # to ask a protocol takes longer than many a tick
            if not _is_a(SupportsIndex, ticks):
                raise TypeError(f"step({ticks!r}): a {type(ticks).__name__}, it must be a whole number of ticks")
            ticks = index(ticks)
        if ticks < 0:
            raise ValueError(f"step({ticks}): allowed: 0 and more ticks")
        self._set_off()
        self._advance(ticks)

    def _set_end(self, call: str, time: float | None) -> None:
        """Let the loop end after a time from now."""
        self._end = math.inf if time is None else self.tick + self._ticks(call, time)
        if self._stopped:  # before it began; asked after the line above, `stop` cannot be missed
            self._end = 0

    def _watched(
        self,
        watchdog: Watchdog,
        watch: Callable[[int], None] | None,
        met: Callable[[], T | None] | None = None,
    ) -> T | None:
        """Run to the end, or to the tick after which `met` returns something, which is returned; note how it came."""
        found = None
        try:
            found = self._loop(watch, met)
            self.ending = self._stopped or ("all programs ended" if self._over() else "time over")
        except KeyboardInterrupt as interrupt:
            self.ending = str(interrupt) or "interrupted"
            if watchdog.stuck is None:
                raise
        except SystemExit:
            self.ending = "sys.exit() in a program"
            raise
        finally:
            self._stopped = ""
        if watchdog.stuck is not None:
            self.ending = "a program did not yield"
            raise watchdog.stuck
        return found

    def _loop(self, watch: Callable[[int], None] | None, met: Callable[[], T | None] | None) -> T | None:
        alone = not self._scheduler.programs and self._end < math.inf  # nothing but the time ends the run
        self._set_off()
        # Ticks take their time with a pace; who watches must not wait for many, and who looks for something for none.
        burst = 1 if self._pace is not None or met is not None else 256
        while (alone or not self._over()) and self.tick < (end := self._end):
            most = min(burst - self.tick % burst, end - self.tick) if alone else 1
            ticks = self._gate.take(int(most))
            if ticks:
                self._advance(ticks)
            else:
                self._stand()
            if watch is not None and (self.tick % burst == 0 or not ticks):
                watch(self.tick)
            found = met() if met is not None else None
            if found is not None:
                return found
        return None

    def _over(self) -> bool:
        """No program is left, and no axis brakes."""
        return not (self._scheduler.programs or self._braking())

    def _braking(self) -> bool:
        """Tell whether something comes to rest that the run does not end before; for who knows what moves."""
        return False

    def _ticks(self, call: str, seconds: float) -> int:
        """Return seconds in whole ticks, rounded up; a rounding error of a millionth tick is none.

        Raises:
            TypeError: no number.
            ValueError: negative, NaN, or more ticks than can be counted exactly. The messages name the call.
        """
        if not _is_a(Real, seconds):
            raise TypeError(f"{call}({seconds!r}): a {type(seconds).__name__}, it must be a number of seconds")
        longest = LAST_TICK * self.base_cycle_ns / 1e9
        if not 0.0 <= seconds <= longest:
            raise ValueError(f"{call}({seconds!s:.24}): allowed: 0 to {longest:.6g} seconds of the run")
        return math.ceil(seconds * 1e9 / self.base_cycle_ns - 1e-6)


def _is_a(kind: type, value: object) -> bool:
    """Tell whether an argument is a number of a kind; a truth value is none."""
    return isinstance(value, kind) and not isinstance(value, bool)
