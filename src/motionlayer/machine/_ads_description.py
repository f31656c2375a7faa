"""The table `[ads]`: the ADS server of a run."""

import ipaddress
from typing import TYPE_CHECKING, Annotated, Final, TypeAlias

from pydantic import AfterValidator, Field
from pydantic_core import PydanticCustomError

from motionlayer.machine._fields import Duration, Table, Text
from motionlayer.machine._mqtt_description import MqttDescription

if TYPE_CHECKING:
    from motionlayer.connect.ads import Access, Limits

PORT: Final = 48898
"""TCP port of ADS."""


def _net_id(text: str) -> str:
    from motionlayer.connect.ads import net_id  # noqa: PLC0415 - where a machine has [ads]

    try:
        net_id(text)
    except ValueError:
        allowed = 'six numbers from 0 to 255, as "127.0.0.1.1.1"'
        raise PydanticCustomError("relation", "relation", {"allowed": allowed}) from None
    return text


def _network(text: str) -> str:
    try:
        ipaddress.ip_network(text, strict=False)
    except ValueError:
        allowed = 'an IP address or a network, as "192.168.1.7" or "192.168.1.0/24"'
        raise PydanticCustomError("relation", "relation", {"allowed": allowed}) from None
    return text


NetId: TypeAlias = Annotated[str, AfterValidator(_net_id)]
Network: TypeAlias = Annotated[str, AfterValidator(_network)]

_MOST: Final = 1_000_000
Count: TypeAlias = Annotated[int, Field(ge=1, le=_MOST)]


class AdsLimitsDescription(Table):
    """What the server holds for its clients, at most: `[ads.limits]`."""

    connections: Count = Field(default=64, description="Connections of all clients together, 1 to 1 000 000.")
    addresses: Count = Field(
        default=64, description="AMS addresses and registered AMS ports of a connection, 1 to 1 000 000."
    )
    handles: Count = Field(default=10_000, description="Handles of a client, 1 to 1 000 000.")
    all_handles: Count = Field(default=100_000, description="Handles of all clients together, 1 to 1 000 000.")
    notifications: Count = Field(default=2_000, description="Notifications of a client, 1 to 1 000 000.")
    all_notifications: Count = Field(
        default=20_000, description="Notifications of all clients together, 1 to 1 000 000."
    )
    watched: int = Field(
        default=1_048_576,
        ge=1024,
        le=3_000_000,  # they may all go into one frame, and a frame has 4 MiB
        description="Bytes of all notifications of a client, 1024 to 3 000 000.",
        json_schema_extra={"x-unit": "bytes"},
    )
    waiting: Count = Field(
        default=1_000, description="Requests of a connection that wait for the next tick, 1 to 1 000 000."
    )
    unsent: int = Field(
        default=16_777_216,
        ge=65_536,
        le=1_073_741_824,
        description="Bytes for a connection that does not take them, 65 536 to 1 073 741 824; it is closed then.",
        json_schema_extra={"x-unit": "bytes"},
    )
    silence: Duration = Field(
        default=10.0,
        description="How long a connection may take for the rest of a frame that it has begun, greater than 0 (s); it "
        "is closed after that. One that has said nothing at all for so long makes room for another.",
    )

    @property
    def limits(self) -> "Limits":
        """The same for the server."""
        from motionlayer.connect.ads import Limits  # noqa: PLC0415 - where a machine has [ads]

        return Limits(**self.model_dump())


class AdsDescription(Table):
    """The ADS server: `[ads]`. Without this table there is none, unless `motionlayer run --ads` asks for it."""

    host: Text = Field(
        default="127.0.0.1",
        description='Address to listen on; "0.0.0.0": all. Other computers are let in by `hosts` alone.',
    )
    port: int = Field(default=PORT, ge=0, le=65_535, description="TCP port, 0 to 65 535; 0: a free one.")
    net_id: NetId = Field(default="127.0.0.1.1.1", description="AMS NetId of the server, six numbers from 0 to 255.")
    hosts: tuple[Network, ...] = Field(
        default=(),
        strict=False,  # TOML gives a list
        description="Addresses and networks that may connect, beside those of this computer.",
    )
    net_ids: tuple[NetId, ...] = Field(
        default=(),
        strict=False,
        description="AMS NetIds that may ask; default: all. A client that registers a port asks by the NetId of the "
        "server.",
    )
    read_only: tuple[NetId, ...] = Field(
        default=(), strict=False, description="AMS NetIds that may read, and change nothing."
    )
    limits: AdsLimitsDescription = Field(
        default_factory=AdsLimitsDescription, description="What the server holds for its clients, at most."
    )
    mqtt: MqttDescription | None = Field(
        default=None, description="A broker by which clients reach the server too; default: none."
    )

    @property
    def access(self) -> "Access":
        """Who may do what, for the server."""
        from motionlayer.connect.ads import Access, net_id  # noqa: PLC0415 - where a machine has [ads]

        return Access(
            tuple(ipaddress.ip_network(one, strict=False) for one in self.hosts),
            frozenset(map(net_id, self.net_ids)),
            frozenset(map(net_id, self.read_only)),
        )
