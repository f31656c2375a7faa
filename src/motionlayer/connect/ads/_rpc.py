"""Calls of methods in the cycle (ads 7): from the bytes of a request to the call, and back.

A call is a `Write` of the kind CALL: its place is that of the object in the image, its data the number of the method
and the inputs, packed without gaps. The outcome holds the value that the method returns and its outputs, packed too.
"""

import bisect
import struct
from collections.abc import Sequence
from typing import Final

from motionlayer.connect.ads._codes import Code
from motionlayer.connect.ads._describe import Placed
from motionlayer.connect.ads._service import Kind, Outcome, Write
from motionlayer.connect.ads._tree import MethodPlace
from motionlayer.iec import Array, Method

_NUMBER: Final = struct.Struct("<H")


def call(method: MethodPlace, inputs: bytes) -> Write:
    """Return what the run is asked for to call a method."""
    return Write(Kind.CALL, method.place.offset, _NUMBER.pack(method.number) + inputs)


class Calls:
    """Carries out calls; an `Act` of `Inside` for the kind CALL.

    Args:
        places: all symbols with their places in the image.
    """

    def __init__(self, places: Sequence[Placed]) -> None:
        self._places = [one for one in places if one.symbol.methods]
        self._starts = [one.start for one in self._places]

    def __call__(self, write: Write, _client: str) -> Outcome:
        """Call a method.

        Raises:
            IndexError: nothing with methods is at this place, or it has none of this number.
            TypeError, ValueError: the inputs do not fit.
        """
        place = self._places[max(0, bisect.bisect_right(self._starts, write.place) - 1)]
        symbol = place.symbol
        offset = write.place - place.start
        if not 0 <= offset < symbol.type.size:
            raise IndexError(f"no methods at {write.place}")
        (number,) = _NUMBER.unpack_from(write.data)
        method = symbol.methods[number]
        results = method.call(_index(place, offset), *_inputs(method, write.data[_NUMBER.size :]))
        return Outcome(Code.NO_ERROR, _packed(method, results))


def _index(place: Placed, offset: int) -> int | None:
    """Return the index of the element at an offset; None of a single object."""
    kind = place.symbol.type
    if not isinstance(kind, Array):
        return None
    ((low, _),) = kind.bounds.pairs
    return low + offset // kind.of.size


def _inputs(method: Method, data: bytes) -> list[object]:
    values, at = [], 0
    for one in method.inputs:
        values.append(one.type.unpack_from(data, at))
        at += one.type.size
    return values


def _packed(method: Method, results: Sequence[object]) -> bytes:
    data = bytearray()
    for kind, value in zip(method.results, results, strict=True):
        raw = bytearray(kind.size)
        kind.pack_into(kind.check(value), raw)
        data += raw
    return bytes(data)
