"""AMS/TCP: frames out of a stream of bytes, and their headers (ads 1.1 to 1.3).

A stream is cut at any byte, and one piece may hold many frames. `Splitter` keeps what is left of a piece until the rest
has come; it never holds more than one frame of the largest size that is accepted.
"""

import enum
import struct
from typing import Final, NamedTuple

MAX_FRAME: Final = 4 * 1024 * 1024
"""Bytes after the length field of a frame that are accepted; the ring buffer of AdsLib has as many."""

TCP: Final = struct.Struct("<HI")
AMS: Final = struct.Struct("<6sH6sHHHIII")
HEAD: Final = struct.Struct("<16sHHIII")
ANSWER: Final = struct.Struct("<HI16sHHIII")
"""Header of a packet: with addresses taken apart; with both as they lie; with that of the frame before it."""

REQUEST: Final = 0x0004
RESPONSE: Final = 0x0001
NO_RETURN: Final = 0x0002
"""State flags of an AMS header."""


class Carrier(enum.IntEnum):
    """Commands of AMS/TCP: what a frame carries."""

    PACKET = 0x0000
    PORT_CLOSE = 0x0001
    PORT_CONNECT = 0x1000
    ROUTER_NOTE = 0x1001
    LOCAL_NET_ID = 0x1002


class FrameError(Exception):
    """The stream cannot be read on; the connection is to be closed."""


class Address(NamedTuple):
    """An AMS address: NetId and port.

    Attributes:
        net_id: 6 bytes.
        port: AMS port.
    """

    net_id: bytes
    port: int

    def __str__(self) -> str:
        return f"{'.'.join(map(str, self.net_id))}:{self.port}"


def net_id(text: str) -> bytes:
    """Return the 6 bytes of a NetId.

    Raises:
        ValueError: it is not six numbers from 0 to 255 with dots between.
    """
    try:
        raw = bytes(int(part) for part in text.split("."))
    except ValueError:
        raw = b""
    if len(raw) != 6:
        raise ValueError(f"NetId {text!r}: must be six numbers from 0 to 255, as in 127.0.0.1.1.1")
    return raw


class Frame(NamedTuple):
    """An AMS/TCP frame.

    Attributes:
        command: of AMS/TCP; 0 is followed by an AMS packet.
        data: everything after the length.
    """

    command: int
    data: bytes


class Packet(NamedTuple):
    """An AMS packet, with the fields of its header in order.

    Attributes:
        target: address it goes to.
        source: address it comes from.
        command: ADS command.
        flags: state flags.
        error: error of the AMS level.
        invoke_id: number that the answer repeats.
        data: of the command.
    """

    target: Address
    source: Address
    command: int
    flags: int
    error: int
    invoke_id: int
    data: bytes

    @classmethod
    def parse(cls, raw: bytes) -> "Packet | None":
        """Return the packet in a frame; None where the bytes are none: too short, or lengths disagree."""
        head = cls.head(raw)
        return head if head is not None and int.from_bytes(raw[20:24], "little") == len(head.data) else None

    @classmethod
    def head(cls, raw: bytes) -> "Packet | None":
        """Return what a frame holds, whatever its length field says; None where not even the header is there."""
        if len(raw) < AMS.size:
            return None
        target, target_port, source, source_port, command, flags, _, error, invoke_id = AMS.unpack_from(raw)
        to, by = Address(target, target_port), Address(source, source_port)
        return cls(to, by, command, flags, error, invoke_id, raw[AMS.size :])

    def pack(self) -> bytes:
        """Return header and data, without those of AMS/TCP."""
        target, source, command, flags, error, invoke_id, data = self
        return AMS.pack(*target, *source, command, flags, len(data), error, invoke_id) + data

    def answer(self, data: bytes, error: int = 0) -> "Packet":
        """Return the answer to this request."""
        target, source, command, flags, _, invoke_id, _ = self
        return Packet(source, target, command, flags | RESPONSE, error, invoke_id, data)


def framed(packet: bytes, command: int = 0) -> bytes:
    """Return the bytes of a frame."""
    return TCP.pack(command, len(packet)) + packet


class Splitter:
    """Frames out of a stream.

    Args:
        limit: bytes of a frame that are accepted.
    """

    def __init__(self, limit: int = MAX_FRAME) -> None:
        self._limit = limit
        self._rest = bytearray()

    @property
    def pending(self) -> bool:
        """A frame has begun whose rest has not come."""
        return bool(self._rest)

    def feed(self, data: bytes) -> list[Frame]:
        """Return the frames that are complete now.

        Raises:
            FrameError: a frame would be longer than the limit; the stream has no meaning from there on.
        """
        rest = self._rest
        if not rest and len(data) >= TCP.size:  # the usual piece is one frame
            command, length = TCP.unpack_from(data)
            if length == len(data) - TCP.size and length <= self._limit:
                return [Frame(command, data[TCP.size :])]
        rest += data
        frames: list[Frame] = []
        at, end = 0, len(rest)
        while end - at >= TCP.size:
            command, length = TCP.unpack_from(rest, at)
            if length > self._limit:
                raise FrameError(f"a frame of {length} bytes, at most {self._limit} are accepted")
            stop = at + TCP.size + length
            if stop > end:
                break
            frames.append(Frame(command, bytes(rest[at + TCP.size : stop])))
            at = stop
        del rest[:at]
        return frames
