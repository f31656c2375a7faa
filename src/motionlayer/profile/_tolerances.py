"""What a profile may miss: the published promise of the planner, checked on every profile before it is used."""

from typing import Final, NamedTuple


class Tolerances(NamedTuple):
    """Relative tolerances; each is multiplied by the scale named beside it."""

    position: float
    velocity: float
    acceleration: float
    rounding: float
    time: float
    clock: float


TOLERANCES: Final = Tolerances(
    position=1e-10,  # of the path of the profile: jumps between pieces
    velocity=1e-10,  # of the largest velocity of the profile
    acceleration=1e-10,  # of the largest acceleration of the profile
    rounding=1.4e-14,  # of the position: on top of that, far from 0
    time=1e-12,  # of the duration: the same move in µm, mm, m or degrees
    clock=5e-16,  # of the time since the profile began: blur of every instant; matters after long cruises only
)


class Ranges(NamedTuple):
    """Inputs that are planned for certain; beyond them a plan is refused, or it keeps the same promise."""

    smallest: float
    largest: float
    phases: float
    duration: float
    fineness: float


RANGES: Final = Ranges(
    smallest=1e-60,  # velocity, acceleration, deceleration, jerk, distance (besides 0), in any unit
    largest=1e60,
    phases=1e12,  # the longer of V/A and V/D over the shortest of A/J, D/J and √(V/J)
    duration=9007199.254740992,  # s, 2^53 ns or 104 days: the blur of the clock grows up to there, to 4.5 ns, ...
    fineness=2e12,  # ... or up to this many times the shortest phase, of which it then is a thousandth
)
