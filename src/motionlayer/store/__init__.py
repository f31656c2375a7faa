"""The setpoint store: where the numbers of all coordinates live, and the kernels that sample them.

One float64 table, `Store.table`, holds one quantity per row and one coordinate per column, so that a quantity is
contiguous, and a state object holds a column number instead of numbers.

A *generator* is a column with the cubic piece it is on::

    t = (n - TICK) * dt + OFFSET          seconds since the profile began, at tick n; never accumulated
    s = t - PIECE_TIME
    p = PIECE_P + s * (PIECE_V + s * (PIECE_A / 2 + s * PIECE_J / 6))

Another profile can be *appended*: it takes over at the instant at which the followed one comes to its last piece,
with a clock of its own that began inside the cycle (a negative `OFFSET` at the tick before).

The pieces that follow wait in `Store.pieces`; going on to the next one is the rare branch of the sampler. A *sum* is a
coordinate behind the generators whose setpoint is that of two coordinates before it (superposition, offsets).
Levels are evaluated in order, generators first, one kernel call per level.

`sample(n)` replaces the setpoints of tick n-1 by those of tick n. It reports the columns whose profile came to
its last piece on the way, and tells those who watch for a position, each with the time at which it happened inside
the cycle: only their objects have anything to do.
The set jerk is the mean over the cycle that ends at n, (a(n) - a(n-1)) / dt: what a sampled drive sees.
"""

from motionlayer.store._kernels import take_over
from motionlayer.store._layout import (
    JOB_BRAKE,
    JOB_COMPOUND,
    JOB_OTHER,
    JOB_POSITION,
    JOB_VELOCITY,
    PIECE_FIELDS,
    Latch,
    Q,
    Status,
)
from motionlayer.store._store import Ended, Store, Watch

__all__ = [
    "JOB_BRAKE",
    "JOB_COMPOUND",
    "JOB_OTHER",
    "JOB_POSITION",
    "JOB_VELOCITY",
    "PIECE_FIELDS",
    "Ended",
    "Latch",
    "Q",
    "Status",
    "Store",
    "Watch",
    "take_over",
]
