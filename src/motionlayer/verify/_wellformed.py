"""Whether a recorded plan can be evaluated at all."""

from typing import TYPE_CHECKING, Final

import numpy as np

if TYPE_CHECKING:
    from motionlayer.record import Plan

KINDS: Final = ("position", "velocity", "stop", "set", "passing", "shift")


def malformed(plan: "Plan") -> str:
    """Return why a plan cannot be evaluated, empty if it can."""
    pieces = np.asarray(plan.pieces)
    if plan.kind not in KINDS:
        return f"kind {plan.kind!r} is none of {', '.join(KINDS)}"
    if pieces.ndim != 2 or pieces.shape[1] != 5 or not len(pieces):
        return f"pieces have shape {pieces.shape}, not (k, 5) with k > 0"
    if not np.isfinite(pieces).all():
        return "a piece is not finite"
    if not (np.diff(pieces[:, 0]) > 0.0).all():
        return "the times of the pieces do not increase"
    numbers = (plan.offset, plan.velocity, plan.acceleration, plan.deceleration, plan.jerk)
    if not np.isfinite(numbers).all():
        return "the offset or a limit is not finite"
    target_fits = np.isfinite(plan.target) != (plan.kind == "stop")
    return "" if target_fits else f"target {plan.target} does not fit kind {plan.kind}"
