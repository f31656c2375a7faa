"""`Signal`, `Plan`, `Gap` and `End`, and how they, events and inputs become bytes and come back."""

import json
import math
import struct
from dataclasses import dataclass
from typing import Final, Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from motionlayer.event import Event, Input, Kind, Level

Floats = NDArray[np.float64]
PlanKind = Literal["position", "velocity", "stop", "set", "passing", "shift"]

PLAN_KINDS: Final[tuple[PlanKind, ...]] = get_args(PlanKind)
PIECE_FIELDS: Final = 5
PLAN: Final = struct.Struct("<qq6dBHI")
"""tick, command; offset, target and the four limits; kind; lengths of name and pieces."""

INPUT: Final = struct.Struct("<qI")
"""tick; length of the name of the channel, which follows; the rest is the payload."""

GAP: Final = struct.Struct("<qQQ")
"""first tick, ticks, records."""


@dataclass(frozen=True, slots=True)
class Signal:
    """One recorded quantity.

    Attributes:
        name: `<axis>.<signal>`, unique in a trace.
        unit: for a person, `mm/s`.
        index: flat index into the table that is recorded; in a trace that was read, the number of its column.
        resolution: 0 keeps every bit, else values are kept as integers times this.

    Raises:
        ValueError: `resolution` is negative or not finite.
    """

    name: str
    unit: str
    index: int
    resolution: float = 0.0

    def __post_init__(self) -> None:
        if not 0.0 <= self.resolution < math.inf:
            raise ValueError(f"{self.name}: resolution is {self.resolution}; it is 0 (lossless) or positive and finite")


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """A profile that a coordinate took over; equal to another if all its bits are.

    It holds from `tick` on with `offset` seconds passed, and is first sampled at `tick + 1`. A plan with a negative
    offset begins inside the cycle, that much after `tick`, where the plan before it ends; its limits are in force from
    `tick + 1` on. A `passing` plan reaches its target with the velocity of its last piece, and another one follows
    there::

        t = (n - tick) * dt + offset         p = p_k + v_k s + a_k s²/2 + j_k s³/6,   s = t - t_k

    A `shift` plan shows a coordinate that was redefined in motion, at its own tick alone.

    Attributes:
        axis: name of the coordinate.
        tick: the tick in which it was taken over.
        offset: s.
        command: number of the command it serves, 0 without.
        kind: what it aims at.
        target: position for `position`, `set`, `shift` and `passing`, velocity for `velocity`, nan for `stop`.
        velocity: limit it was planned under, u/s.
        acceleration: limit while the speed grows, u/s².
        deceleration: limit while the speed falls, u/s².
        jerk: limit, u/s³.
        pieces: shape (k, 5), k > 0: time since the profile began, p, v, a at the start of the piece,
            jerk. The last one goes on for ever. Copied, read-only.

    Raises:
        ValueError: `pieces` has another shape, or `kind` is unknown.
    """

    axis: str
    tick: int
    offset: float
    command: int
    kind: PlanKind
    target: float
    velocity: float
    acceleration: float
    deceleration: float
    jerk: float
    pieces: Floats

    def __post_init__(self) -> None:
        # A view of the store would have changed by the time it is written.
        pieces = np.array(self.pieces, dtype=np.float64, order="C")
        if pieces.ndim != 2 or pieces.shape[1] != PIECE_FIELDS or not len(pieces):
            raise ValueError(f"{self.axis}: pieces of shape {pieces.shape}; (k, {PIECE_FIELDS}) with k > 0 is expected")
        if self.kind not in PLAN_KINDS:
            raise ValueError(f"{self.axis}: kind of plan {self.kind!r}; possible are {', '.join(PLAN_KINDS)}")
        pieces.flags.writeable = False
        object.__setattr__(self, "pieces", pieces)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Plan) and encode_plan(self) == encode_plan(other)

    def __hash__(self) -> int:
        return hash((self.axis, self.tick, self.command))


class Gap(NamedTuple):
    """What a recorder that must not wait has lost.

    Attributes:
        first: tick of the first missing row; without missing rows, of the first row after the missing records.
        ticks: number of missing rows.
        records: number of plans, events and inputs that are missing as well; those of a gap are kept, as long
            as there is room.
    """

    first: int
    ticks: int
    records: int


class End(NamedTuple):
    """How a run ended.

    Attributes:
        tick: number of ticks that were finished.
        cause: in words.
        inside: it ended inside of the tick that came next: what that had already done is recorded, but it is no
            whole tick.
    """

    tick: int
    cause: str
    inside: bool = False


def encode_plan(plan: Plan) -> bytes:
    """Return the payload of a PLAN chunk."""
    name = plan.axis.encode()
    head = PLAN.pack(
        plan.tick,
        plan.command,
        plan.offset,
        plan.target,
        plan.velocity,
        plan.acceleration,
        plan.deceleration,
        plan.jerk,
        PLAN_KINDS.index(plan.kind),
        len(name),
        len(plan.pieces),
    )
    return head + name + plan.pieces.tobytes()


def decode_plan(payload: memoryview) -> Plan:
    """Return the plan of a PLAN chunk.

    Raises:
        ValueError, struct.error, IndexError: the payload is none.
    """
    tick, command, offset, target, velocity, acceleration, deceleration, jerk, kind, length, count = PLAN.unpack_from(
        payload
    )
    start = PLAN.size + length
    return Plan(
        axis=bytes(payload[PLAN.size : start]).decode(),
        tick=tick,
        offset=offset,
        command=command,
        kind=PLAN_KINDS[kind],
        target=target,
        velocity=velocity,
        acceleration=acceleration,
        deceleration=deceleration,
        jerk=jerk,
        pieces=np.frombuffer(payload[start:], dtype="<f8").reshape(count, PIECE_FIELDS),
    )


def encode_event(event: Event) -> bytes:
    """Return the payload of an EVNT chunk; also what the hash of a run is fed with."""
    fields = (
        event.tick,
        int(event.level),
        str(event.kind),
        event.source,
        event.code,
        event.command,
        event.device,
        event.subdevice,
        event.text,
    )
    return json.dumps(fields).encode()


def decode_event(payload: memoryview) -> Event:
    """Return the event of an EVNT chunk.

    Raises:
        ValueError: the payload is none.
    """
    tick, level, kind, source, code, command, device, subdevice, text = json.loads(bytes(payload))
    return Event(tick, Level(level), Kind(kind), source, text, code, command, device, subdevice)


def encode_input(what: Input) -> bytes:
    """Return the payload of an INPT chunk."""
    channel = what.channel.encode()
    return INPUT.pack(what.tick, len(channel)) + channel + what.payload


def decode_input(payload: memoryview) -> Input:
    """Return the input of an INPT chunk.

    Raises:
        ValueError, struct.error: the payload is none.
    """
    tick, length = INPUT.unpack_from(payload)
    start = INPUT.size + length
    if start > len(payload):
        raise ValueError(f"the name of the channel has {length} bytes; {len(payload) - INPUT.size} are left")
    return Input(tick, bytes(payload[INPUT.size : start]).decode(), bytes(payload[start:]))


def encode_gap(gap: Gap) -> bytes:
    """Return the payload of a GAP chunk."""
    return GAP.pack(*gap)


def decode_gap(payload: memoryview) -> Gap:
    """Return the gap of a GAP chunk.

    Raises:
        struct.error: the payload is none.
    """
    return Gap(*GAP.unpack(payload))
