"""A device for ADS conversations without a run and without sockets: the real protocol over the real image.

What the cycle of a run does for a server, `Device.tick` does: it applies what clients have asked for, publishes, and
lets notifications look. Time stands between two ticks.
"""

import enum
from collections.abc import Sequence
from typing import Final

from motionlayer.connect.ads import Access, Contents, Inside, Limits, Status, net_id, placed, tree_of
from motionlayer.connect.ads._connection import Connection
from motionlayer.connect.ads._frame import Packet, Splitter
from motionlayer.connect.ads._image import SharedImage
from motionlayer.connect.ads._memory import Shared
from motionlayer.connect.ads._notify import Notifications
from motionlayer.connect.ads._ports import services
from motionlayer.connect.ads._router import Router
from motionlayer.connect.ads._service import Kind, Later, Outcome, Write
from motionlayer.connect.ads._watches import Lookout, Watches
from motionlayer.connect.ads._wire import pack_request, unpack_outcomes
from motionlayer.iec import (
    BIT,
    BOOL,
    BYTE,
    DATE,
    DINT,
    DT,
    DWORD,
    INT,
    LINT,
    LREAL,
    LTIME,
    LWORD,
    REAL,
    SINT,
    STRING,
    TIME,
    TOD,
    UDINT,
    UINT,
    ULINT,
    USINT,
    WORD,
    WSTRING,
    Array,
    Enumeration,
    Field,
    InputArray,
    OutputArray,
    Struct,
    SymbolTable,
)

CYCLE_NS: Final = 1_000_000
SLOW_NS: Final = 10_000_000
"""Cycle that the history is sized for: a small one, since there are many devices."""

BEGIN: Final = 133_000_000_000_000_000
"""FILETIME of tick 0."""

RUN: Final = 5


class Colour(enum.IntEnum):
    """An enumeration with a negative value."""

    NONE = -1
    RED = 0
    BLUE = 7


E_COLOUR: Final = Enumeration("E_COLOUR", INT, Colour)


class Inner(Struct, iec="ST_INNER"):
    """A structure within another."""

    flag = Field("bFlag", BIT, "a bit")
    other = Field("bOther", BIT, "another bit of the same byte")
    value = Field("rValue", LREAL, "a number")


class Everything(Struct, iec="ST_EVERYTHING"):
    """All elementary types, and what is made of them."""

    bool_ = Field("bBool", BOOL)
    byte = Field("nByte", BYTE)
    sint = Field("nSint", SINT)
    usint = Field("nUsint", USINT)
    int_ = Field("nInt", INT)
    uint = Field("nUint", UINT)
    word = Field("nWord", WORD)
    dint = Field("nDint", DINT)
    udint = Field("nUdint", UDINT)
    dword = Field("nDword", DWORD)
    lint = Field("nLint", LINT)
    ulint = Field("nUlint", ULINT)
    lword = Field("nLword", LWORD)
    real = Field("rReal", REAL)
    lreal = Field("rLreal", LREAL)
    time = Field("tTime", TIME)
    ltime = Field("tLtime", LTIME)
    date = Field("dDate", DATE)
    dt = Field("dDt", DT)
    tod = Field("dTod", TOD)
    text = Field("sText", STRING(20))
    wide = Field("wsText", WSTRING(10))
    colour = Field("eColour", E_COLOUR)
    numbers = Field("aNumbers", Array(INT, (1, 4)))
    grid = Field("aGrid", Array(DINT, (0, 1), (1, 3)))
    inner = Field("stInner", Inner)


def declare(symbols: SymbolTable) -> None:
    """Add the variables of the device to a table."""
    symbols.add("GVL.All", InputArray(Everything, None, None, "GVL.All"), comment="everything")
    symbols.add("GVL.Inners", InputArray(Inner, 1, 3, "GVL.Inners"))
    symbols.add("GVL.Count", InputArray(DINT, None, None, "GVL.Count"), comment="a number that clients write")
    symbols.add("GVL.Shown", OutputArray(LREAL, 1, 4, "GVL.Shown"), comment="numbers that clients read")


class Outbox:
    """Requests that wait for the next tick."""

    def __init__(self, inside: Inside) -> None:
        self._inside = inside
        self._waiting: list[tuple[bytes, Later[list[Outcome]]]] = []
        self.controls: list[int] = []

    def post(self, writes: Sequence[Write], client: str) -> Later[list[Outcome]]:
        """Take writes; the arguments are those of the outbox of a service."""
        later: Later[list[Outcome]] = Later()
        if writes[0].kind is Kind.CONTROL:
            self.controls.append(writes[0].place)
            later.settle([Outcome(0)])
        else:
            self._waiting.append((pack_request(client, writes), later))
        return later

    def apply(self) -> list[tuple[bytes, Later[list[Outcome]]]]:
        """Apply what waits; return outcomes and who waits for them."""
        waiting, self._waiting = self._waiting, []
        return [(self._inside.apply(payload), later) for payload, later in waiting]


class Peer:
    """A stream to the device."""

    def __init__(self, router: Router, host: str) -> None:
        self.received = b""
        self.connection = Connection(router, host, self._take)

    def _take(self, data: bytes) -> None:
        self.received += data

    def packets(self) -> list[Packet]:
        """Return the AMS packets that have come, and forget them."""
        data, self.received = self.received, b""
        parsed = (Packet.parse(frame.data) for frame in Splitter().feed(data))
        return [packet for packet in parsed if packet is not None]


class Device:
    """A device.

    Args:
        limits: of clients.
        access: who may do what.
    """

    def __init__(self, limits: Limits = Limits(), access: Access = Access()) -> None:  # noqa: B008 - frozen
        self.symbols = SymbolTable()
        declare(self.symbols)
        self.inside = Inside(lambda: placed(self.symbols))
        size = self.inside.size
        shared = Shared(memoryview(bytearray(Shared.size_of(size, SLOW_NS))), size, SLOW_NS)
        self.inside.begin(shared, lambda tick: Status(BEGIN + tick * CYCLE_NS // 100, RUN, 0, RUN))
        self.image = SharedImage(shared.published)
        self.outbox = Outbox(self.inside)
        watches = Watches(shared.history, self.image.size)
        self.notifications = Notifications(CYCLE_NS, limits.all_notifications, watches)
        self.told: list[str] = []
        contents = Contents(tree_of(self.inside.places), 0)
        self.lookout = Lookout(self.image, shared.history, self.notifications, self._tell)
        self.router = Router(
            net_id("127.0.0.1.1.1"),
            services(contents, self.image),
            self.image,
            self.outbox,
            self.notifications,
            self._tell,
            access,
            limits,
        )
        self.next = 0
        self.tick()

    def connect(self, host: str = "127.0.0.1") -> Peer:
        """Return a new stream."""
        return Peer(self.router, host)

    def _tell(self, who: str, why: str) -> None:
        self.told.append(f"{who}: {why}")

    def tick(self, ticks: int = 1) -> None:
        """Let ticks pass."""
        for _ in range(ticks):
            settled = self.outbox.apply()
            self.inside.publish(self.next)
            for outcomes, later in settled:
                later.settle(unpack_outcomes(outcomes))
            self.lookout.look()
            self.next += 1
