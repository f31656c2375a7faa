"""`ActualMotion`: how fast the axes move by what their drives report."""

from typing import TYPE_CHECKING

import numpy as np

from motionlayer.nc._actual_kernels import PLACE, ROWS, follow
from motionlayer.store import Q, Store

if TYPE_CHECKING:
    from numpy.typing import NDArray


class ActualMotion:
    """Actual velocity and acceleration of all axes.

    They are followed in every tick, whoever looks at them and from when on. A redefinition of the position is no
    motion.

    Args:
        store: where the actual positions are; axes are its first columns.
        count: axes.

    Attributes:
        rows: float64, (3, axes): place (u), velocity (u/s), acceleration (u/s²).
    """

    def __init__(self, store: Store, count: int) -> None:
        self.rows: NDArray[np.float64] = np.zeros((ROWS, count))
        self.rows[PLACE] = store.table[Q.ACTUAL_P, :count] - store.table[Q.SHIFT, :count]
        self._store = store
        self._rate = 1.0 / store.dt

    def follow(self) -> None:
        """Take up the actual positions of this tick."""
        follow(self._store.table, self.rows, self._rate)
