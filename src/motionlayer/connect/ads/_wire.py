"""What goes between the server and the run: requests and outcomes as bytes.

A request is what the mailbox records and a replay feeds again: the name of the client, then its writes. Between the two
processes goes a `Message`; that of a request has a number, which the outcomes repeat.
"""

import enum
import struct
from collections.abc import Sequence
from typing import Final

from motionlayer.connect.ads._service import Kind, Outcome, Write

_NAME: Final = struct.Struct("<H")
_WRITE: Final = struct.Struct("<BII")
_OUTCOME: Final = struct.Struct("<II")


class Message(enum.IntEnum):
    """What a message is.

    ======== ============= =======================================================
    message  goes to       with
    ======== ============= =======================================================
    PLAN     the server    the pickled `Plan`
    PORT     the run       the TCP port, or why the server cannot begin
    CONTENTS the server    the pickled `Contents`
    REQUEST  the run       number and request, for the next tick
    CONTROL  the run       number and request, which goes past the ticks
    OUTCOMES the server    number and outcomes
    TOLD     the run       who is told of in the log and what, with a zero between
    STOP     the server    nothing
    ======== ============= =======================================================
    """

    PLAN = 0
    PORT = 1
    CONTENTS = 2
    REQUEST = 3
    CONTROL = 4
    OUTCOMES = 5
    TOLD = 6
    STOP = 7


def pack_request(client: str, writes: Sequence[Write]) -> bytes:
    """Return a request as bytes."""
    name = client.encode()
    parts = [_NAME.pack(len(name)), name]
    for kind, place, data in writes:
        parts += (_WRITE.pack(kind, place, len(data)), data)
    return b"".join(parts)


def unpack_request(payload: bytes) -> tuple[str, list[Write]]:
    """Return who asks, and what."""
    (length,) = _NAME.unpack_from(payload)
    at = _NAME.size + length
    client = payload[_NAME.size : at].decode()
    writes = []
    while at < len(payload):
        kind, place, length = _WRITE.unpack_from(payload, at)
        at += _WRITE.size
        writes.append(Write(Kind(kind), place, payload[at : at + length]))
        at += length
    return client, writes


def pack_outcomes(outcomes: Sequence[Outcome]) -> bytes:
    """Return outcomes as bytes."""
    return b"".join(_OUTCOME.pack(code, len(data)) + data for code, data in outcomes)


def unpack_outcomes(payload: bytes) -> list[Outcome]:
    """Return the outcomes in their order."""
    outcomes, at = [], 0
    while at < len(payload):
        code, length = _OUTCOME.unpack_from(payload, at)
        at += _OUTCOME.size
        outcomes.append(Outcome(code, payload[at : at + length]))
        at += length
    return outcomes
