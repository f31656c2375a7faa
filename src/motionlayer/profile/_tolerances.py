"""What a profile may miss: the published promise of the planner, checked on every profile before it is used."""

from typing import Final, NamedTuple


class Tolerances(NamedTuple):
    """Relative tolerances; each is multiplied by the scale named beside it."""

    position: float
    velocity: float
    acceleration: float
    time: float
    clock: float


TOLERANCES: Final = Tolerances(
    position=1e-10,  # of |start| + |end| + the path travelled: jumps between pieces, miss of the target
    velocity=1e-10,  # of the largest velocity of the profile and the velocity limit
    acceleration=1e-10,  # of the largest acceleration of the profile and the acceleration limit
    time=1e-12,  # of the duration: the same move in µm, mm, m or degrees
    clock=5e-16,  # of the time since the profile began: blur of every instant; matters after long cruises only
)
