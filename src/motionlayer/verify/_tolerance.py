"""The published tolerances, and the tolerance of every sample and of every plan."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

import numpy as np

from motionlayer.verify._axis import LIMITS, Axis
from motionlayer.verify._curves import Curves, Flags, Floats, Integers, Point

if TYPE_CHECKING:
    from motionlayer.record import Trace

EPS: Final = float(np.finfo(np.float64).eps)


@dataclass(frozen=True, slots=True)
class Tolerance:
    """One line of the table.

    Attributes:
        relative: factor on the magnitudes named in `of`.
        of: what it is relative to; scales with the axis, so that it holds in µm as in m.
        doc: what is allowed by it.
    """

    relative: float
    of: str
    doc: str


TOLERANCES: Final[Mapping[str, Tolerance]] = MappingProxyType(
    {
        "position": Tolerance(
            8 * EPS,
            "|p| + |v| s + |a| s²/2 + |j| s³/6 of the piece, |v| t of the plan, max_velocity · cycle",
            "set position against the recorded plan; actual position of an ideal drive against the same",
        ),
        "velocity": Tolerance(
            8 * EPS,
            "|v| + |a| s + |j| s²/2 of the piece, |a| t of the plan, max_velocity",
            "set velocity against the recorded plan",
        ),
        "acceleration": Tolerance(
            8 * EPS,
            "|a| + |j| s of the piece, |j| t of the plan, the larger machine maximum of both",
            "set acceleration against the recorded plan",
        ),
        "jerk": Tolerance(
            2.0,
            "acceleration tolerance / cycle (of the two samples it is the difference of)",
            "set jerk against the difference of the planned accelerations",
        ),
        "limits": Tolerance(
            4 * EPS,
            "the limit, and the maximum of the machine",
            "signals of the limits in force against the plan; software limits against the machine",
        ),
        "resolution": Tolerance(
            0.5 * (1 + 1e-9),
            "the recorded resolution of the signal",
            "added to each of the above where a signal is not stored lossless",
        ),
        "handover": Tolerance(
            64 * EPS,
            "the magnitudes of position, velocity, acceleration as above",
            "start of a plan against the plan before it",
        ),
        "continuity": Tolerance(
            1e-10,
            "path, peak velocity, peak acceleration of the plan (and 64 eps of |p|, |v| t …)",
            "steps from piece to piece inside a plan, and its end against its target: what the planner promises",
        ),
        "plan limits": Tolerance(
            1e-9,
            "the limit (and the continuity tolerance)",
            "velocity, acceleration, jerk of the planned curve against its limits",
        ),
    }
)


def differs(value: Floats, expected: Floats, allowed: Floats | float) -> Flags:
    """Tell which samples are off; a nan is, equal infinities are not."""
    with np.errstate(invalid="ignore"):
        return np.asarray(~(np.abs(value - expected) <= allowed) & (value != expected))


def _relative(name: str) -> float:
    return TOLERANCES[name].relative


def point_tolerance(axis: Axis, point: Point, name: str = "position") -> tuple[Floats, Floats, Floats]:
    """Return the rounding allowed in p, v, a of points on the curves (`position` or `handover`)."""
    factor = _relative(name)
    v, a = axis.maximum("velocity"), max(axis.maximum("acceleration"), axis.maximum("deceleration"))
    return (
        factor * (point.size_p + v * axis.dt),
        factor * (point.size_v + v),
        factor * (point.size_a + a),
    )


def quantisation(axis: Axis, signal: str) -> float:
    """Return what the recorded resolution adds to the tolerance of a signal of an axis."""
    return _relative("resolution") * axis.resolution.get(signal, 0.0)


def sample_tolerance(axis: Axis, signal: str) -> Floats:
    """Return the tolerance of every sample of `signal` (name without the axis), in the unit of the signal."""
    p, v, a = point_tolerance(axis, axis.reference)
    before = point_tolerance(axis, axis.reference_before)[2]
    rows: dict[str, Floats] = {
        "set_position": p,
        "actual_position": p,
        "set_velocity": v,
        "set_acceleration": a,
        "set_jerk": _relative("jerk") * (a + before) / 2 / axis.dt,
    }
    if signal not in rows:
        rows[signal] = _limit_tolerance(axis, signal)
    return np.asarray(rows[signal] + quantisation(axis, signal))


def _limit_tolerance(axis: Axis, signal: str) -> Floats:
    if signal in LIMITS:
        return _relative("limits") * (axis.limit(signal) + axis.maximum(signal.removeprefix("max_")))
    if signal.startswith("software_limit_"):
        limit = axis.machine_limit(signal.removeprefix("software_limit_"))
        near = abs(limit) if np.isfinite(limit) else 0.0
        return np.full(len(axis.ticks), _relative("limits") * (near + axis.maximum("velocity") * axis.dt))
    return np.zeros(len(axis.ticks))  # states and the override are exact


def tolerance(trace: "Trace", signal: str) -> Floats:
    """Return the tolerance of every sample of a signal.

    Args:
        trace: a trace that `verify` does not refuse.
        signal: full name, `X.set_position`.

    Returns:
        One number per row, in the unit of the signal.

    Raises:
        KeyError: the trace has no such signal.
        ValueError: the plans of the axis are missing or malformed.
    """
    if signal not in trace:
        raise KeyError(signal)
    axis, _, name = signal.rpartition(".")
    return sample_tolerance(Axis.of(trace, axis), name)


@dataclass(frozen=True)
class Slack:
    """What is allowed inside each plan: steps of p, v, a from piece to piece, shape (P,) each."""

    p: Floats
    v: Floats
    a: Floats

    @classmethod
    def of(cls, curves: Curves) -> "Slack":
        """Measure the plans: how far, how fast, how hard, how long."""
        index: Integers = np.arange(len(curves.pieces), dtype=np.int64)
        length = curves.durations()
        size = curves.evaluate(index, length, np.zeros(len(index)))
        start = np.abs(curves.pieces[:, 1])
        t, j = curves.last_piece()[:, 0], curves.most(np.abs(curves.pieces[:, 4]))
        p, v, a = curves.most(start), curves.most(size.size_v), curves.most(size.size_a)
        fastest, hardest = curves.most(curves.fastest()), curves.most(np.abs(curves.pieces[:, 3]))
        share, rounding = _relative("continuity"), _relative("handover")
        return cls(
            p=share * curves.paths() + rounding * (p + t * v),
            v=share * fastest + rounding * (t * a + curves.velocity),
            a=share * hardest + rounding * (t * j + curves.acceleration),
        )
