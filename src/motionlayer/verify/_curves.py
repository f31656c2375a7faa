"""The recorded plans of one axis as stacked arrays, and their evaluation at many instants at once."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence

    from motionlayer.record import Plan

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class Point:
    """Position, velocity, acceleration, and the sums of the magnitudes they were added up from.

    Rounding is proportional to these sums. They hold the effect of a rounded time as well: a time t is only
    known to a few ulp of t, in which the position moves by |v| times that.
    """

    p: Floats
    v: Floats
    a: Floats
    size_p: Floats
    size_v: Floats
    size_a: Floats


class Curves:
    """All plans of one axis, in order of their ticks.

    Args:
        plans: well-formed plans (`motionlayer.verify._wellformed.malformed` finds nothing), in order.
        dt: base cycle in s.

    A plan is first sampled at the tick after its own; a `set` plan, which redefines the coordinate, at its own. A plan
    that begins inside a cycle, where the one before it ends, has the tick before, and its limits hold from the next
    one on; it has a negative offset, or follows a plan that took no time.

    Attributes:
        holds: first tick whose set values belong to each plan, shape (P,).
        tick, offset, command, kind, target: of each plan, shape (P,).
        redefines: whether each plan only shows a coordinate that was redefined, at rest or in motion, shape (P,).
        inside: whether each plan begins inside a cycle, where the one before it ends, shape (P,).
        velocity, acceleration, deceleration, jerk: its limits, shape (P,).
        pieces: of all plans one below the other, shape (N, 5).
        first: index of the first piece of each plan, and N at the end, shape (P + 1,).
        owner: plan of each piece, shape (N,).
    """

    def __init__(self, plans: "Sequence[Plan]", dt: float) -> None:
        self.dt = dt
        self.tick: Integers = np.array([plan.tick for plan in plans], np.int64)
        self.command: Integers = np.array([plan.command for plan in plans], np.int64)
        self.kind: NDArray[np.str_] = np.array([plan.kind for plan in plans], np.str_)
        self.redefines: Flags = np.isin(self.kind, ("set", "shift"))
        self.holds: Integers = self.tick + ~self.redefines
        self.offset: Floats = np.array([plan.offset for plan in plans], np.float64)
        self.inside: Flags = self.offset < 0.0
        self.inside[1:] |= (np.diff(self.tick) == 0) & ~self.redefines[1:] & ~self.redefines[:-1]
        self.target: Floats = np.array([plan.target for plan in plans], np.float64)
        self.velocity: Floats = np.array([plan.velocity for plan in plans], np.float64)
        self.acceleration: Floats = np.array([plan.acceleration for plan in plans], np.float64)
        self.deceleration: Floats = np.array([plan.deceleration for plan in plans], np.float64)
        self.jerk: Floats = np.array([plan.jerk for plan in plans], np.float64)
        self.pieces: Floats = np.concatenate([np.asarray(plan.pieces, np.float64) for plan in plans])
        counts = np.array([len(plan.pieces) for plan in plans], np.int64)
        self.first: Integers = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
        self.owner: Integers = np.repeat(np.arange(len(plans), dtype=np.int64), counts)

    def __len__(self) -> int:
        return len(self.tick)

    def serving(self, ticks: Integers) -> Integers:
        """Return the plan that the set values of each tick belong to; -1 where there is none."""
        return np.searchsorted(self.holds, ticks, side="right").astype(np.int64) - 1

    def in_force(self, ticks: Integers) -> Integers:
        """Return the plan whose limits are in force from each tick on; -1 where there is none."""
        return np.searchsorted(self.tick + self.inside, ticks, side="right").astype(np.int64) - 1

    def time(self, plan: Integers, ticks: Integers) -> Floats:
        """Return the seconds since the profile of `plan` began, at `ticks`."""
        return (ticks - self.tick[plan]) * self.dt + self.offset[plan]

    def piece_at(self, plan: Integers, time: Floats) -> Integers:
        """Return the piece of `plan` that holds at `time`, by bisection of all of them at once."""
        low, high = self.first[plan], self.first[plan + 1] - 1
        while np.any(low < high):
            middle = (low + high + 1) // 2
            later = time >= self.pieces[middle, 0]
            low, high = np.where(later, middle, low), np.where(later, high, middle - 1)
        return low

    def at(self, plan: Integers, time: Floats) -> Point:
        """Evaluate `plan` at `time` (s since its profile began)."""
        piece = self.piece_at(plan, time)
        return self.evaluate(piece, time - self.pieces[piece, 0], np.abs(time))

    def evaluate(self, piece: Integers, s: Floats, time: Floats) -> Point:
        """Evaluate pieces at `s` seconds after their starts; `time` tells how exactly `s` is known."""
        p, v, a, j = self.pieces[piece, 1:].T
        t, size = np.abs(s), np.abs(self.pieces[piece, 1:].T)
        size_a = size[2] + t * size[3]
        size_v = size[1] + t * (size[2] + t * size[3] / 2)
        return Point(
            p=p + s * (v + s * (a / 2 + s * j / 6)),
            v=v + s * (a + s * j / 2),
            a=a + s * j,
            size_p=size[0] + t * (size[1] + t * (size[2] / 2 + t * size[3] / 6)) + time * size_v,
            size_v=size_v + time * size_a,
            size_a=size_a + time * size[3],
        )

    def last_piece(self) -> Floats:
        """Return the piece every plan ends with, shape (P, 5)."""
        return self.pieces[self.first[1:] - 1]

    def most(self, of_pieces: Floats) -> Floats:
        """Return the largest of a number given for every piece, per plan, shape (P,)."""
        return np.maximum.reduceat(of_pieces, self.first[:-1])

    def durations(self) -> Floats:
        """Return how long each piece lasts in s; 0 for the last one of a plan, which has no end."""
        length = np.zeros(len(self.pieces))
        length[:-1] = np.diff(self.pieces[:, 0])
        length[self.first[1:] - 1] = 0.0
        return length

    def fastest(self) -> Floats:
        """Return the largest |v| of every piece, shape (N,); of the last one of a plan that at its start."""
        _, _, v, a, j = self.pieces.T
        index, length = np.arange(len(v), dtype=np.int64), self.durations()
        with np.errstate(all="ignore"):
            turn = np.nan_to_num(np.where(j == 0.0, 0.0, -a / j)).clip(0.0, length)  # where |v| may be larger inside
        inside, end = (self.evaluate(index, s, np.zeros(len(v))).v for s in (turn, length))
        return np.asarray(np.maximum(np.abs(v), np.maximum(np.abs(inside), np.abs(end))))

    def paths(self) -> Floats:
        """Return the path of every plan, shape (P,): the sum over its pieces of the largest |v| times the duration."""
        return np.asarray(np.add.reduceat(self.fastest() * self.durations(), self.first[:-1]))
