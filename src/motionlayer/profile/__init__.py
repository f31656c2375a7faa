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

*To a point.* The position at rest is one case of a point that is at `target` at time 0, moves at w, and is met with
velocity u and a = 0. With D(v, a -> u) and T(v, a -> u), displacement and time of the fastest way to u, its gain on
the point takes the place of S:

    p(t) - w·t + D(v(t), a(t) -> u) - w·T(v(t), a(t) -> u) = target                                   (4)

w = u = 0 is (3). w = u joins a moving target; the left side is monotone again. w = 0 passes a position with velocity u.
There, if the target lies beyond in the direction of u, the left side is constant as long as the plans to s·V and to u
are one, and rises from then on. If it is nearer, the velocity cannot be reached (or cannot be braked down to) on the
way that is left: the axis backs off, along the plan to -s·V, and comes again. The left side then first rises, the
more is lost the later it comes round, and falls as soon as it goes backwards; it has one more valley if the start goes
backwards and is about to turn. Of two crossings the first is taken.

The way on which u is reached, D(v, a -> u), has one valley over the velocities u of one sign: at v + a|a|/2J, which is
reached by bringing a to zero at once. So the velocities with which a target can be passed without backing off form an
interval around that one; its end towards the velocity asked for is bisected.

*To a state with an acceleration, at a time.* The last phase is the ramp at full jerk from a = 0 into the state,
computed backwards: no other one needs less velocity before, nor less acceleration where v = 0. The ramp begins in a
velocity at a time and place, and so at the end of a ride along the line through both, which is a moving point.
The slower the velocity by way of which that point is met, the later; it is bisected.

Start states outside the limits: an acceleration is taken back at full jerk at once, a velocity by the fastest way to
its limit with a = 0. Nothing above assumes a start inside.

Sources: the plane of v and a² is the usual phase-plane argument for double-S profiles (Biagiotti, Melchiorri,
Trajectory Planning for Automatic Machines and Robots, chapter 3); the separate limits follow PLCopen's Acceleration
and Deceleration.
"""

from motionlayer.profile._kernels import MAX_PIECES
from motionlayer.profile._passing import passable_velocity, plan_passing
from motionlayer.profile._plan import (
    Limits,
    PlanError,
    Profile,
    plan,
    plan_meeting,
    plan_position,
    plan_stop,
    plan_velocity,
    rest_at,
    stop_at,
)
from motionlayer.profile._stop import stop_displacement, stop_position
from motionlayer.profile._synchronise import Moving, State, plan_rendezvous, plan_synchronise
from motionlayer.profile._tolerances import RANGES, TOLERANCES

__all__ = [
    "MAX_PIECES",
    "RANGES",
    "TOLERANCES",
    "Limits",
    "Moving",
    "PlanError",
    "Profile",
    "State",
    "passable_velocity",
    "plan",
    "plan_meeting",
    "plan_passing",
    "plan_position",
    "plan_rendezvous",
    "plan_stop",
    "plan_synchronise",
    "plan_velocity",
    "rest_at",
    "stop_at",
    "stop_displacement",
    "stop_position",
]
