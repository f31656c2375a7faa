"""`AdsLink`: carries the images of a control side by ADS to a motion layer somewhere else, and back.

A `[control]` machine writes images and reads images; whatever carries them, a program does not see. Here every image
is the symbol of the motion layer that it stands for: what has changed is written in one sum command, so that it takes
effect in one tick, and all states are read in another. The link needs no more of an ADS client than ReadWrite, so any
client will do, over any transport.

A thread of its own carries, since a client waits for its answers. It reads the images as of the last finished tick,
and posts what has come as inputs of the next one: the control machine can be replayed without anybody at the other end.
"""

import contextlib
import struct
import threading
from collections.abc import Callable, Iterator, Sequence
from types import TracebackType
from typing import Final, NamedTuple, Self

from motionlayer.connect.ads import INFO_BY_NAME, SUM_READ, SUM_READ_WRITE, SUM_WRITE, VERSION
from motionlayer.layer import SIMULATED, START, ControlSide, Progress
from motionlayer.machine._machine_run import MachineRun
from motionlayer.machine._outside import LINK
from motionlayer.runtime import Area, MailboxFull

ReadWrite = Callable[[int, int, int, bytes], bytes]
"""The command ReadWrite of an ADS client: index group, index offset, most bytes of the answer, data. It returns the
answer, and raises whatever the client raises when the server refuses or is not there."""

RETRY: Final = 1.0
"""Seconds of wall time after which a broken connection is tried again."""

_CODE: Final = struct.Struct("<I")
_RESULT: Final = struct.Struct("<II")
_PLACE: Final = struct.Struct("<3I")
_BOTH: Final = struct.Struct("<4I")
_OPTIONAL: Final = frozenset(row.symbol for row in SIMULATED)


class LinkError(RuntimeError):
    """The other side has not what the images stand for, or refuses it."""


class _Place(NamedTuple):
    group: int
    offset: int
    size: int


_VERSION: Final = _Place(VERSION, 0, 1)


class _Output:
    """An image that this side writes.

    Args:
        area: its bytes.
        place: of the symbol on the other side.
        size: of an element in bytes.
        symbol: name of the symbol.
    """

    def __init__(self, area: Area, place: _Place, size: int, symbol: str) -> None:
        self.symbol = symbol
        self._area = area
        self._place = place
        self._size = size
        self._given: bytes | None = None

    def changes(self, image: bytes) -> Iterator[tuple[_Place, bytes]]:
        """Yield the elements that the other side has not, as of a snapshot of all areas."""
        data, given, size = image[self._area.place], self._given, self._size
        for at in range(0, len(data), size):
            element = data[at : at + size]
            if given is None or element != given[at : at + size]:
                yield _Place(self._place.group, self._place.offset + at, size), element

    def given(self, image: bytes) -> None:
        """Take up that the other side has everything now."""
        self._given = image[self._area.place]


class _Input(NamedTuple):
    """An image that the other side writes."""

    area: Area
    place: _Place


class AdsLink:
    """Carries the images of a control side by ADS; in a `with` block.

    Args:
        control: a run of a machine with `[control]`.
        read_write: of a client that is connected to the motion machine, port 851.
        period: seconds of wall time from one exchange to the next, at least.

    Raises:
        TypeError: the run is no control side.
    """

    def __init__(self, control: MachineRun, read_write: ReadWrite, *, period: float = 0.001) -> None:
        if control.machine.description.control is None or not isinstance(control.layer, ControlSide):
            raise TypeError(f"{control.machine.name} is no control side: its machine file needs [control]")
        self._control = control
        self._side = control.layer
        self._ask = read_write
        self._period = period
        self._up = False  # the start-up of the other side has ended
        self._version: bytes | None = None  # of the symbols there, which a restart changes
        self._outputs: list[_Output] = []
        self._inputs: list[_Input] = []
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._work, name="ADS link", daemon=True)

    def __enter__(self) -> Self:
        """Find the symbols, and begin to carry.

        Raises:
            LinkError: the motion machine has not what the images stand for.
            Exception: whatever the client raises when nobody answers.
        """
        self._find()
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._over.set()
        self._thread.join()

    def _work(self) -> None:
        """Carry; what breaks is told once, and found anew when somebody answers again."""
        broken = False
        while not self._over.wait(RETRY if broken else self._period):
            try:
                if broken:
                    self._find()
                self._give()
                self._take()
            except Exception as error:  # noqa: BLE001 - clients have exceptions of their own
                if not broken:
                    self._tell(f"{type(error).__name__}: {error}; trying again")
                broken = True
            else:
                broken = False

    def _tell(self, text: str) -> None:
        with contextlib.suppress(MailboxFull):  # which the mailbox counts
            self._control.mailbox.post(LINK, text.encode())

    def _find(self) -> None:
        """Ask where the symbols lie on the other side."""
        self._up, self._version = False, None
        images = list(self._control.mapping.images)
        places = self._places([image.partner.array.name for image in images])
        self._outputs, self._inputs = [], []
        for image in images:
            symbol, place = image.partner.array.name, places.get(image.partner.array.name)
            if place is None and symbol in _OPTIONAL:
                continue
            if place is None or place.size != image.area.size:
                raise LinkError(_misfit(symbol, place, image.area.size))
            if image.area.outside:
                self._inputs.append(_Input(image.area, place))
            else:
                self._outputs.append(_Output(image.area, place, image.partner.array.size, symbol))
        # Posted in this order: who sees a State finds what Info says of it, and who sees that the layer is ready, all.
        self._inputs.sort(key=lambda one: (one.area.name == START, one.area.name.endswith("State")))

    def _places(self, names: Sequence[str]) -> dict[str, _Place]:
        """Return the places of the symbols that there are."""
        asked = [name.encode() + b"\0" for name in names]
        requests = b"".join(_BOTH.pack(INFO_BY_NAME, 0, _PLACE.size, len(name)) for name in asked)
        most = (_RESULT.size + _PLACE.size) * len(names)
        answer = self._ask(SUM_READ_WRITE, len(names), most, requests + b"".join(asked))
        results = [_RESULT.unpack_from(answer, at * _RESULT.size) for at in range(len(names))]
        found, at = {}, len(names) * _RESULT.size
        for name, (code, length) in zip(names, results, strict=True):
            if code == 0 and length == _PLACE.size:
                found[name] = _Place(*_PLACE.unpack_from(answer, at))
            at += length
        return found

    def _give(self) -> None:
        """Write what has changed, all of it in one tick of the other side."""
        tick, image = self._control.areas.read(slice(None))
        changes = [(one.symbol, *change) for one in self._outputs for change in one.changes(image)]
        given = self._side.given
        if not self._up or given is None or tick < given or not changes:
            return
        requests = b"".join(_PLACE.pack(*place) for _, place, _ in changes)
        data = b"".join(element for _, _, element in changes)
        answer = self._ask(SUM_WRITE, len(changes), _CODE.size * len(changes), requests + data)
        for (symbol, _, _), (code,) in zip(changes, _CODE.iter_unpack(answer), strict=True):
            if code:
                raise LinkError(
                    f"{symbol}: the other side refuses to have it written, ADS error 0x{code:X}; what a [layer.map] "
                    "holds there is not written by symbol"
                )
        for one in self._outputs:
            one.given(image)

    def _take(self) -> None:
        """Read all states, and post those that have changed; of another run of the other side, find the symbols first.

        What was read of that run is left: it may have been read where its symbols do not lie any more.
        """
        inputs = self._inputs
        places = [_VERSION, *(one.place for one in inputs)]
        head, size = _CODE.size * len(places), sum(place.size for place in places)
        answer = self._ask(SUM_READ, len(places), head + size, b"".join(_PLACE.pack(*place) for place in places))
        if any(answer[:head]):
            raise LinkError("the other side refuses to have its states read")
        version, before = answer[head : head + _VERSION.size], self._version
        if before not in (None, version):
            self._tell("the motion machine has begun anew; after its start-up everything is written again")
            self._find()
            return
        self._version = version
        self._post(answer, head + _VERSION.size)

    def _post(self, answer: bytes, at: int) -> None:
        """Post the states that have changed, from a place in an answer on."""
        _, image = self._control.areas.read(slice(None))
        for one in self._inputs:
            data = answer[at : at + one.place.size]
            at += one.place.size
            if one.area.name == START:  # a start-up is left alone
                self._up = int.from_bytes(data, "little") in (Progress.DONE, Progress.ERROR)
            if not one.area.written or data != image[one.area.place]:
                one.area.post(data)


def _misfit(symbol: str, place: _Place | None, size: int) -> str:
    if place is None:
        return f"{symbol}: the other side has no such symbol; it needs a motion layer, [layer]"
    return (
        f"{symbol}: {place.size} bytes on the other side, {size} here; [control] must name all of its axes, and have "
        "its sizes"
    )
