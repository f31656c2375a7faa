"""Velocity and acceleration of the actual positions, kept up in one pass per tick."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.store import Q

Floats = NDArray[np.float64]

ACTUAL_P: Final = Q.ACTUAL_P
SHIFT: Final = Q.SHIFT

PLACE: Final = 0
VELOCITY: Final = 1
ACCELERATION: Final = 2
ROWS: Final = 3
"""Rows per axis: where it is, apart from redefinitions of the position (u), u/s, u/s²."""


@kernel
def follow(table: Floats, motion: Floats, rate: float) -> None:
    """Take up the actual positions of a tick; `rate` is the number of ticks per second."""
    actual, shift = table[ACTUAL_P], table[SHIFT]
    places, velocities, accelerations = motion[PLACE], motion[VELOCITY], motion[ACCELERATION]
    for i in range(places.shape[0]):
        place = actual[i] - shift[i]
        velocity = (place - places[i]) * rate
        accelerations[i] = (velocity - velocities[i]) * rate
        places[i], velocities[i] = place, velocity
