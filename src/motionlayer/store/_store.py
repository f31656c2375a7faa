"""`Store`: the tables of a run and the calls of its cycle."""

from collections.abc import Callable, Sequence
from typing import NamedTuple, cast

import numpy as np

from motionlayer.store._kernels import WENT_ON, Floats, add_up, passing_time, sample, take_over
from motionlayer.store._layout import PIECE_FIELDS, Q


class Ended(NamedTuple):
    """A profile that came to its last piece.

    Attributes:
        column: the coordinate.
        early: seconds before the sampled tick at which it happened, 0 <= early.
        went_on: another one was appended to it, and has begun at that instant.
    """

    column: int
    early: float
    went_on: bool = False


class Watch(NamedTuple):
    """Somebody who wants to know when a setpoint passes a position.

    Attributes:
        column: a generator.
        position: u.
        tell: called once, with the seconds before the sampled tick at which it happened.
    """

    column: int
    position: float
    tell: Callable[[float], None]


class _Curve(NamedTuple):
    """What a column follows before a sample: pieces, seconds that have passed of them, setpoint, more appended."""

    pieces: Floats
    since: float
    position: float
    continued: bool


class Store:
    """All coordinates of a run.

    Args:
        generators: number of columns that follow a profile.
        dt: base cycle in seconds.
        max_pieces: most pieces of the profiles of one column, the appended one included.
        sums: pairs of columns; each becomes a further column that is the sum of the two. An operand must stand
            before the sum, so evaluating in order is evaluating by level, and a ring cannot be written.

    Raises:
        ValueError: a sum names a column that does not stand before it.
    """

    __slots__ = (
        "_left", "_passed", "_right", "_watches", "appended", "begun", "counts", "current", "dt",
        "generators", "pieces", "placed", "shifted", "status_changed", "table", "taken_over", "tick",
    )  # fmt: skip

    def __init__(self, generators: int, *, dt: float, max_pieces: int, sums: Sequence[tuple[int, int]] = ()) -> None:
        for column, operands in enumerate(sums, generators):
            if not all(0 <= operand < column for operand in operands):
                raise ValueError(f"column {column} is the sum of {operands}: both must stand before it")
        self.generators = generators
        self.dt = dt
        self.table: Floats = np.zeros((Q.COUNT, generators + len(sums)))
        self.pieces: Floats = np.zeros((generators, max_pieces, PIECE_FIELDS))
        self.counts = np.ones(generators, dtype=np.int64)
        self.current = np.zeros(generators, dtype=np.int64)
        self.appended = np.zeros(generators, dtype=np.int64)
        """Pieces of the appended profile; they stand behind those of the followed one."""
        self.tick = 0
        """The tick at which the setpoints in the table are valid."""
        self.taken_over: dict[int, None] = {}
        """Columns that follow another profile since the dictionary was last cleared, in order."""
        self.placed: list[tuple[int, int, float]] = []
        """Column, tick and position of every `place` since the list was last cleared."""
        self.shifted: list[tuple[int, int]] = []
        """Column and tick of every `shift` in motion since the list was last cleared."""
        self.status_changed: list[int] = []
        """Columns whose drive status or inputs changed; the drives append, the axes take."""
        self.begun: Callable[[int], None] = _nobody
        """Told the column whose appended profile has begun, as soon as all about it is in force."""
        self._passed = np.zeros((2 * generators, 2), dtype=np.int64)
        self._left = np.array([left for left, _ in sums], dtype=np.int64)
        self._watches: list[Watch] = []
        self._right = np.array([right for _, right in sums], dtype=np.int64)
        self.table[Q.END_TIME] = np.inf

    def column(self, column: int) -> "memoryview[float]":
        """Return what the table says of one coordinate, by `Q`: read and written item by item several times as fast."""
        return cast("memoryview[float]", self.table[:, column].data)

    def adopt(self, column: int, pieces: Floats, *, offset: float = 0.0) -> None:
        """Let a column follow a profile from the present setpoint on; it is first sampled for the tick after.

        Args:
            column: a generator.
            pieces: shape (k, 5), as `Store.pieces`; the last piece goes on for ever.
            offset: seconds of the profile that have passed at the present tick.

        Raises:
            ValueError: too many pieces.
        """
        if len(pieces) > self.pieces.shape[1]:
            raise ValueError(f"a profile of {len(pieces)} pieces; at most {self.pieces.shape[1]} are possible")
        tables = self.table, self.pieces, self.counts, self.current, self.appended
        take_over(*tables, column, pieces, len(pieces), float(self.tick), offset)
        self.taken_over[column] = None

    def append(self, column: int, pieces: Floats) -> None:
        """Let a column go on with another profile at the instant at which the one it follows comes to its last piece.

        That instant lies inside a cycle as a rule; nothing of the cycle is lost. The next `adopt` drops it.

        Args:
            column: a generator.
            pieces: shape (k, 5), as `Store.pieces`; begins in the state in which the followed profile ends.

        Raises:
            ValueError: too many pieces together, or the followed profile has ended already.
        """
        count = int(self.counts[column])
        if count + len(pieces) > self.pieces.shape[1]:
            raise ValueError(
                f"profiles of {count} and {len(pieces)} pieces; at most {self.pieces.shape[1]} are possible together"
            )
        if self.table[Q.END_TIME, column] == np.inf:
            raise ValueError(f"the profile of column {column} has ended: adopt the next one instead of appending it")
        self.pieces[column, count : count + len(pieces)] = pieces
        self.appended[column] = len(pieces)

    def place(self, column: int, position: float) -> None:
        """Redefine where a resting column stands: its setpoint changes at once and stays there."""
        table = self.table
        table[Q.SET_P, column] = position
        table[Q.SET_V : Q.SET_A + 1, column] = 0.0
        self.adopt(column, np.array([[0.0, position, 0.0, 0.0, 0.0]]))
        del self.taken_over[column]  # what was taken over in this tick before was never followed
        self.placed.append((column, self.tick, position))
        table[Q.END_TIME, column] = np.inf

    def shift(self, column: int, way: float) -> None:
        """Add to the set position of a column; what it follows has to be planned anew in this tick."""
        self.table[Q.SET_P, column] += way
        self.shifted.append((column, self.tick))

    def sample(self, tick: int) -> list[Ended]:
        """Evaluate all coordinates at `tick` and report the profiles that came to their last piece.

        One that was replaced in this very tick, by somebody who watched for a position, is not reported: its end would
        be taken for that of the new one.
        """
        before = [self._curve_before(watch.column) for watch in self._watches]
        tables = self.table, self.pieces, self.counts, self.current, self.appended
        count = sample(*tables, self.generators, float(tick), self.dt, self._passed)
        self.tick = tick
        if len(self._left):
            add_up(self.table, self.generators, self._left, self._right)
        ended = [self._ended(column, how == WENT_ON) for column, how in self._passed[:count].tolist()] if count else []
        if before:
            self._look(before)
            ended = [one for one in ended if self.table[Q.TICK, one.column] != tick]
        return ended

    def _ended(self, column: int, went_on: bool) -> Ended:
        """Return how long before the present tick a profile ended: the followed one, or the one it was appended to."""
        since = self.since(column)
        return Ended(column, since if went_on else since - float(self.table[Q.PIECE_TIME, column]), went_on)

    def watch(self, watch: Watch) -> None:
        """Tell somebody, once, when the setpoint of a column passes a position or comes to it."""
        self._watches.append(watch)

    def unwatch(self, watch: Watch) -> None:
        """Forget somebody who watches; one who has been told already is forgotten."""
        self._watches = [one for one in self._watches if one is not watch]

    def _curve_before(self, column: int) -> _Curve:
        """Return what a column follows before the next sample; a copy, which an appended profile does not overwrite."""
        pieces = self.pieces[column, : self.counts[column]].copy()
        return _Curve(pieces, self.since(column), float(self.table[Q.SET_P, column]), bool(self.appended[column]))

    def _look(self, before: list[_Curve]) -> None:
        """Find the watches that were passed in the cycle that ends at the present tick."""
        waiting, passed = [], []
        for watch, old in zip(self._watches, before, strict=True):
            early = self._passed_before(watch, old)
            if early is None:
                waiting.append(watch)
            else:
                passed.append((watch, early))
        self._watches = waiting
        for watch, early in passed:
            watch.tell(early)

    def _passed_before(self, watch: Watch, old: _Curve) -> float | None:
        """Return how long before the present tick a watch was passed in the last cycle; None if it was not."""
        column, position = watch.column, watch.position
        last = self.since(column)
        first, start = last - self.dt, old.position
        if old.continued and not self.appended[column]:  # up to the instant of change the old profile counts
            ended, joint = float(old.pieces[-1, 0]), float(self.pieces[column, 0, 1])
            if _between(start, position, joint):
                return last + ended - passing_time(old.pieces, old.since, ended, position)
            first, start = 0.0, joint
        if not _between(start, position, float(self.table[Q.SET_P, column])):
            return None
        return last - passing_time(self.pieces[column, : self.counts[column]], first, last, position)

    def forget_plans(self) -> None:
        """Clear what `taken_over` and `placed` have noted."""
        if self.taken_over or self.placed or self.shifted:
            self.taken_over.clear()
            self.placed.clear()
            self.shifted.clear()

    def since(self, column: int) -> float:
        """Return how many seconds of the profile of a column have passed at the present tick."""
        return float((self.tick - self.table[Q.TICK, column]) * self.dt + self.table[Q.OFFSET, column])

    def end_of(self, column: int) -> Floats:
        """Return the last piece of the profile that a column follows."""
        end: Floats = self.pieces[column, self.counts[column] - 1]
        return end


def _nobody(_column: int) -> None:
    """Nobody wants to know."""


def _between(start: float, position: float, end: float) -> bool:
    """Tell whether the way from `start` to `end` passes a position or comes to it."""
    return start < position <= end or start > position >= end
