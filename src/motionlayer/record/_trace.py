"""`Trace`: a recorded run as a mapping of names to arrays."""

from collections.abc import Iterable, Iterator, Mapping
from difflib import get_close_matches
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from motionlayer.record._encode import quantise
from motionlayer.record._errors import TraceError
from motionlayer.record._reader import Content, read
from motionlayer.record._writer import TraceWriter

if TYPE_CHECKING:
    from motionlayer.event import Event, Input
    from motionlayer.record._records import End, Gap, Plan, Signal

Floats = NDArray[np.float64]

SAVE_TICKS: Final = 4096
"""Rows per block of a saved trace."""

NEAREST: Final = 3
"""Signals that are named in the place of an unknown one."""


class Trace(Mapping[str, Floats]):
    """A recorded run: signal name to read-only float64 array of shape (ticks,), in the order of the header.

    Equal to another if every bit of it is. A column is decoded when it is first asked for.

    Attributes:
        header: as recorded; see the documentation of the format.
        signals: names, units, resolutions.
        plans: profiles that were taken over, in order.
        events: in order. Plans and events of a trace that is not complete may be younger than its last row.
        inputs: what came from outside, in order; no part of the hash.
        gaps: what a recorder in real time has lost because its writer did not keep up, in order.
        hash: of the run, hexadecimal; "" if not taken, if the trace is not complete or has gaps, or if values
            were replaced.
        end: how the run ended; None if the trace is not complete, or nobody told its recorder.
        complete: whether the writer came to its end and nothing is damaged; else this is what stands before.
        damage: where and how the file is damaged, and how much of it was read; "" if it is not. A trace that
            is neither damaged nor complete broke off, because its writer was killed or could not write. It is
            no part of the comparison of two traces, and a damaged trace is saved as one that broke off.
        base_cycle: s.
        ticks: int64, number of every row; a jump is a gap in the recording.
        time: s, of every row.
    """

    __hash__ = None  # type: ignore[assignment]

    def __init__(self, content: Content, name: str = "") -> None:
        self.header: dict[str, Any] = content.header
        self.signals: tuple[Signal, ...] = content.signals
        self.plans: tuple[Plan, ...] = tuple(content.plans)
        self.events: tuple[Event, ...] = tuple(content.events)
        self.inputs: tuple[Input, ...] = tuple(content.inputs)
        self.gaps: tuple[Gap, ...] = tuple(content.gaps)
        self.hash: str = content.hash
        self.end: End | None = content.end
        self.complete: bool = content.complete
        self.damage: str = content.damage
        self.base_cycle: float = self.header["base_cycle_ns"] / 1e9
        spans = [np.arange(block.first, block.first + block.ticks) for block in content.blocks]
        self.ticks: NDArray[np.int64] = _sealed(np.concatenate([np.empty(0, np.int64), *spans]))
        self.time: Floats = _sealed(self.ticks * int(self.header["base_cycle_ns"]) / 1e9)
        self._blocks = content.blocks
        self._columns = {signal.name: signal for signal in self.signals}
        self._arrays: dict[str, Floats] = {}
        self._name = name

    @classmethod
    def load(cls, path: str | Path) -> "Trace":
        """Read a trace file; what stands before a damaged or cut off place is loaded.

        Raises:
            TraceError: there is no such file, it is no trace, or its header is damaged.
        """
        try:
            data = Path(path).read_bytes()
        except OSError as error:
            raise TraceError(f"{path}: the trace cannot be read: {error.strerror}; name an existing file") from error
        return cls(read([data], str(path)), str(path))

    @classmethod
    def from_chunks(cls, chunks: Iterable[bytes]) -> "Trace":
        """Return the trace that a `TraceWriter` without a file has kept.

        Raises:
            TraceError: the first chunk is no head of a trace.
        """
        return cls(read(chunks, "memory"))

    def __getitem__(self, name: str) -> Floats:
        array = self._arrays.get(name)
        if array is None:
            signal = self._signal(name)
            parts = [block.column(signal.index, signal.resolution) for block in self._blocks]
            array = _sealed(np.concatenate([np.empty(0), *parts]))
            self._arrays[name] = array
        return array

    def _signal(self, name: str) -> "Signal":
        signal = self._columns.get(name)
        if signal is None:
            raise KeyError(_unknown(name, list(self._columns)))
        return signal

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Trace)
            and (self.header, self.plans, self.events) == (other.header, other.plans, other.events)
            and (self.inputs, self.gaps) == (other.inputs, other.gaps)
            and (self.hash, self.end, self.complete) == (other.hash, other.end, other.complete)
            and self.ticks.tobytes() == other.ticks.tobytes()
            and all(self[name].tobytes() == other[name].tobytes() for name in self)
        )

    def __repr__(self) -> str:
        size = f"{len(self)} signals x {len(self.ticks)} ticks of {self.base_cycle:g} s"
        state = "" if self.complete else ", damaged" if self.damage else ", incomplete"
        gaps = f", {len(self.gaps)} gaps" if self.gaps else ""
        extras = f"{len(self.plans)} plans, {len(self.events)} events, {len(self.inputs)} inputs"
        return f"<Trace {self._name or 'in memory'}: {size}, {extras}{gaps}{state}>"

    @property
    def jumps(self) -> NDArray[np.intp]:
        """Rows after which ticks are missing, ascending."""
        return np.flatnonzero(np.diff(self.ticks) != 1)

    def stretches(self) -> tuple["Trace", ...]:
        """Return the parts without missing ticks, in order; each has all plans, events and inputs, and no hash."""
        edges = [0, *(self.jumps + 1).tolist(), len(self.ticks)]
        return tuple(self._stretch(slice(start, end)) for start, end in pairwise(edges)) if len(edges) > 2 else (self,)

    def tail(self, ticks: int) -> "Trace":
        """Return the end of the trace: the blocks that begin within its last `ticks`, the last one at least.

        It has all plans, events and inputs, and no hash.
        """
        begin = max((block.first for block in self._blocks), default=0)
        within = [block.first for block in self._blocks if block.first > self.ticks[-1] - ticks]
        return self._stretch(slice(int(np.searchsorted(self.ticks, min([begin, *within]))), None))

    def _stretch(self, rows: slice) -> "Trace":
        other = object.__new__(Trace)
        ticks = self.ticks[rows]
        other.__dict__.update(
            self.__dict__,
            ticks=ticks,
            time=self.time[rows],
            hash="",
            _blocks=[block for block in self._blocks if ticks[0] <= block.first <= ticks[-1]],
            _arrays={name: array[rows] for name, array in self._arrays.items()},
        )
        return other

    def replace(self, arrays: Mapping[str, ArrayLike]) -> "Trace":
        """Return a trace with other values for some signals, and without a hash.

        Quantised signals are rounded as in recording.

        Raises:
            KeyError: the trace has no such signal.
            ValueError: an array is not of shape (ticks,).
        """
        other = object.__new__(Trace)
        other.__dict__.update(self.__dict__, _arrays=dict(self._arrays), hash="")
        for name, values in arrays.items():
            signal = self._signal(name)
            array = np.array(values, dtype=np.float64)
            if array.shape != self.ticks.shape:
                raise ValueError(f"{name}: shape {array.shape}; {self.ticks.shape} is expected")
            other._arrays[name] = _sealed(quantise(array, signal.resolution) if signal.resolution else array)
        return other

    def save(self, path: str | Path) -> None:
        """Write the trace to a file, from which an equal one can be loaded.

        Raises:
            TraceError: the file cannot be written.
        """
        writer = TraceWriter(Path(path), self.header)
        try:
            writer.records(self.gaps, self.inputs, self.plans, self.events)
            for start, end in self._spans():
                columns = [self[name][start:end] for name in self]
                block = np.array(columns).reshape(len(self), end - start).T
                writer.rows(int(self.ticks[start]), block)
            if self.complete:
                writer.close(len(self.ticks), self.hash, self.end)
        finally:
            writer.abandon()

    def _spans(self) -> Iterator[tuple[int, int]]:
        """Yield spans of rows with consecutive ticks, at most `SAVE_TICKS` long."""
        for begin, end in pairwise([0, *(self.jumps + 1).tolist(), len(self.ticks)]):
            for start in range(begin, end, SAVE_TICKS):
                yield start, min(start + SAVE_TICKS, end)


def _unknown(name: str, known: list[str]) -> str:
    """Return what is said to someone who asks for a signal that was not recorded."""
    axis = name.rpartition(".")[0]
    own = [other for other in known if other.rpartition(".")[0] == axis]
    near = ", ".join(get_close_matches(name, own or known, NEAREST, 0.0))
    what = f"signal {name!r}" if own or not axis else f"axis {axis!r}"
    return f"no {what} in the trace; nearest: {near}" if near else f"no {what}: the trace has no signals"


def _sealed(array: NDArray[Any]) -> NDArray[Any]:
    array.flags.writeable = False
    return array
