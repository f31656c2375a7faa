"""An independent judge of traces.

`verify` takes nothing on trust but the header and the record of plans, and checks those too. It shares no
code with what made the trace: the evaluation of pieces, the limits and the state table here are its own.
The argument goes

1. *Plans* are sound: within the machine, continuous from piece to piece and from plan to plan, at rest or
   at their velocity in the end, inside their limits on the exact curves and not only at the samples.
2. *Samples* are the plans, tick by tick and to rounding: row n belongs to the last plan taken over before
   n, its limits to the last one taken over at or before n::

       t = (n - tick) dt + offset       s = t - t_k
       p = p_k + s (v_k + s (a_k/2 + s j_k/6))

3. *Samples alone* are plausible too: over each cycle p, v and a fit one another within the jerk limit. The
   jerk is the difference of the accelerations; position differences would drown it (an error e in p is 8 e
   / dt³ in it).
4. *States* follow the diagram, nothing moves in a state of rest, and each change has its cause in the events:
   a command, its end, an error. *Commands* live once and end at their targets; what moves the axis serves a
   command that is under way. *Power* comes where it was asked for, and the axis then stands at its set position.
5. *What was asked* is what is done: the message that accepts a command is its call. Plans lead to its position
   (told, or worked out from where the command began), go on with its velocity, and were made under its limits;
   what begins inside a cycle was to wait. What redefines a coordinate has its cause, and in motion its amount.

`TOLERANCES` is published. Tolerances scale with the numbers they apply to, so that the same trace is judged
the same in µm and in m: `tolerance` gives them sample by sample. A resolution other than lossless widens
them by half of it; where it would hide what a limit allows in one cycle, `verify` refuses the axis instead
of passing it.
"""

from motionlayer.verify._report import Finding, Report
from motionlayer.verify._tolerance import TOLERANCES, Tolerance, tolerance
from motionlayer.verify._verify import assert_valid, verify

__all__ = [
    "TOLERANCES",
    "Finding",
    "Report",
    "Tolerance",
    "assert_valid",
    "tolerance",
    "verify",
]
