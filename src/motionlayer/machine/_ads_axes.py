"""What ADS clients reach of the axes beside the motion layer: objects with methods, and the ports of the NC."""

import functools
import itertools
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from motionlayer.command import Ledger
from motionlayer.connect.ads import Act, Calls, Kind, NcContents, Outcome, Placed, Write, placed
from motionlayer.iec import Symbol
from motionlayer.machine._ads_functions import NcFunctions
from motionlayer.machine._ads_motion import MotionObjects
from motionlayer.machine._ads_nc import NAME, NcRows

if TYPE_CHECKING:
    from motionlayer.fb import AXIS_REF
    from motionlayer.nc import AxisRefs


class AdsAxes:
    """What ADS clients reach of a run, its axes above all; made when a client or a replay asks.

    Args:
        symbols: returns those of the motion layer.
        refs: returns the axes by name.
        images: returns their cyclic interface, which costs every tick from then on.
        ledger: the present tick.
    """

    def __init__(
        self,
        symbols: Callable[[], Iterable[Symbol]],
        refs: "Callable[[], Mapping[str, AXIS_REF]]",
        images: "Callable[[], AxisRefs]",
        ledger: Ledger,
    ) -> None:
        self._symbols = symbols
        self._named_refs = refs
        self._images = images
        self._ledger = ledger

    @functools.cached_property
    def places(self) -> Sequence[Placed]:
        """All symbols with their places in the image: those given, and what there is for the axes."""
        refs = self._refs
        if not refs:
            return placed(self._symbols())

        def tick() -> int:
            return self._ledger.tick

        rows = NcRows(refs, self._images(), tick)
        shown = itertools.chain(self._symbols(), [MotionObjects(refs, tick).symbol()])
        return placed(shown, [Symbol(NAME, rows, "", {}, ())])

    def acts(self) -> Mapping[Kind, Act]:
        """Return what can be asked of the axes, by kind."""
        return {Kind.CALL: self._call, Kind.FUNCTION: self._function}

    def _call(self, write: Write, client: str) -> Outcome:
        return self._calls(write, client)

    def _function(self, write: Write, client: str) -> Outcome:
        return self._functions(write, client)

    @functools.cached_property
    def _refs(self) -> "Sequence[AXIS_REF]":
        return list(self._named_refs().values())

    @functools.cached_property
    def _calls(self) -> Calls:
        return Calls(self.places)

    @functools.cached_property
    def _functions(self) -> NcFunctions:
        return NcFunctions(self._refs)


def nc_contents(places: Iterable[Placed]) -> NcContents | None:
    """Return what the NC ports are told of the rows among these; None without axes."""
    found = ((one.symbol.source, one.start) for one in places if one.hidden)
    return next((source.contents(start) for source, start in found if isinstance(source, NcRows)), None)
