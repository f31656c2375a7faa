"""Motion of one coordinate: jerk-limited profiles from any start state.

Theory
------
A profile is a row of pieces with constant jerk. Two questions are asked, and the second is answered with the first.

*To a velocity.* From (v, a) to (v_t, 0) in the shortest time. Let s be the sign of v_t minus the velocity reached
by bringing a to zero at once, v + a|a|/2J. If s·a < 0 the acceleration is first brought to zero. From there s·a >= 0,
and along constant jerk ±J the square of the acceleration is linear in the velocity,

    d(a²)/dv = ±2J                                                                                    (1)

so in the plane of v and a² every bound is a straight line: the rise from the start, the fall to the target, the
acceleration limit A where |v| grows, the deceleration limit D where it falls, and between the two at v = 0 a line of
slope ±2J through min(A, D)². The fastest way is the lower envelope of these lines, because time is the integral of
dv/a. It has one ramp (rise, hold, fall) on each side of v = 0. A ramp that gains w from b to x (accelerations) without
touching its limit peaks at

    peak² = J·w + (b² + x²)/2                                                                         (2)

*To a position at rest.* Let S(v, a) be the displacement of the fastest stop (the plan above with v_t = 0). If the
target lies at p + S, that stop is the answer. If it lies beyond, in direction s, the fastest way is the plan to the
velocity s·V, left at the one moment at which its stop ends at the target:

    p(t) + S(v(t), a(t)) = target                                                                     (3)

The left side is monotone in t along that plan, so the moment is found by bracketing: the piece first, then the time
inside it; in the cruise the equation is linear.

*Into the motion of a target at constant velocity u.* The same with the fastest way to u in place of the stop, and
with the distance to the moving point: u·t is taken off on the left of (3). Limits are those of the absolute motion.

Start states outside the limits: an acceleration is taken back at full jerk at once, a velocity by the fastest way to
its limit with a = 0. Nothing above assumes a start inside.

Sources: the plane of v and a² is the usual phase-plane argument for double-S profiles (Biagiotti, Melchiorri,
Trajectory Planning for Automatic Machines and Robots, chapter 3); the separate limits follow PLCopen's Acceleration
and Deceleration.
"""

from motionlayer.profile._plan import (
    MAX_PIECES,
    Limits,
    PlanError,
    Profile,
    plan,
    plan_position,
    plan_stop,
    plan_velocity,
    rest_at,
    stop_at,
)
from motionlayer.profile._stop import stop_displacement, stop_position
from motionlayer.profile._synchronise import Moving, plan_synchronise
from motionlayer.profile._tolerances import RANGES, TOLERANCES

__all__ = [
    "MAX_PIECES",
    "RANGES",
    "TOLERANCES",
    "Limits",
    "Moving",
    "PlanError",
    "Profile",
    "plan",
    "plan_position",
    "plan_stop",
    "plan_synchronise",
    "plan_velocity",
    "rest_at",
    "stop_at",
    "stop_displacement",
    "stop_position",
]
