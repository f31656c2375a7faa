"""`Router`: what all connections of a server share: services, ports, clients, limits and access (ads 1.4)."""

import ipaddress
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Final

from motionlayer.connect.ads._client import Client, Limits
from motionlayer.connect.ads._codes import Code
from motionlayer.connect.ads._frame import Address, net_id
from motionlayer.connect.ads._notify import Notifications
from motionlayer.connect.ads._service import Image, Outbox, Service
from motionlayer.connect.ads._symbols import SymbolService

LOOPBACK: Final = net_id("127.0.0.1.1.1")
FIRST_PORT: Final = 32768
LAST_PORT: Final = 65535


@dataclass(frozen=True)
class Access:
    """Who may connect, and who may write.

    Attributes:
        hosts: addresses that may connect beside those of the computer itself; an entry may be a network.
        net_ids: NetIds that may ask; empty: all.
        read_only: NetIds that may change nothing.
    """

    hosts: tuple[ipaddress.IPv4Network | ipaddress.IPv6Network, ...] = ()
    net_ids: frozenset[bytes] = frozenset()
    read_only: frozenset[bytes] = frozenset()

    def admits(self, host: str) -> bool:
        """Tell whether a connection from an address is taken."""
        address: ipaddress.IPv4Address | ipaddress.IPv6Address = ipaddress.ip_address(host)
        if isinstance(address, ipaddress.IPv6Address) and address.ipv4_mapped is not None:
            address = address.ipv4_mapped  # who comes by IPv4 to a socket for both
        return address.is_loopback or any(address in network for network in self.hosts)


@dataclass
class Router:
    """What all connections of a server share.

    Attributes:
        net_id: of the server.
        services: by AMS port.
        image: what they read.
        outbox: the way into the run.
        notifications: of all clients.
        tell: takes what is refused: who, and why.
        access: who may do what.
        limits: of a client.
    """

    net_id: bytes
    services: Mapping[int, Service]
    image: Image
    outbox: Outbox
    notifications: Notifications
    tell: Callable[[str, str], None]
    access: Access = field(default_factory=Access)
    limits: Limits = field(default_factory=Limits)
    _ports: set[int] = field(default_factory=set)

    def error_of(self, target: Address) -> Code:
        """Return the AMS error of a packet whose target is nobody, else 0."""
        if target.net_id not in (self.net_id, LOOPBACK):
            return Code.TARGET_MACHINE_NOT_FOUND
        return Code.NO_ERROR if target.port in self.services else Code.TARGET_PORT_NOT_FOUND

    def admit(self, address: Address, host: str) -> Client | None:
        """Return a new client; None if it may not ask, which is told."""
        if self.access.net_ids and address.net_id not in self.access.net_ids:
            self.tell(f"{address} at {host}", "its NetId is not among those that may ask")
            return None
        who = f"{address} at {host}"
        read_only = address.net_id in self.access.read_only
        return Client(address, host, read_only, self.limits, lambda why: self.tell(who, why))

    def forget(self, client: Client) -> None:
        """Release what a client held."""
        self.notifications.forget(client)
        for service in self.services.values():
            if isinstance(service, SymbolService):
                service.forget(client)

    def held(self) -> int:
        """Return how many handles and ports all clients hold."""
        counts = (len(service) for service in self.services.values() if isinstance(service, SymbolService))
        return sum(counts) + len(self._ports)

    def take_port(self, wanted: int) -> int | None:
        """Return an AMS port for a client, the one it wants or a free one; None if there is none."""
        if wanted:
            free = wanted not in self._ports and wanted not in self.services
            port = wanted if free else None
        else:
            port = next((one for one in range(FIRST_PORT, LAST_PORT + 1) if one not in self._ports), None)
        if port is not None:
            self._ports.add(port)
        return port

    def release_port(self, port: int) -> None:
        """Let others have a port."""
        self._ports.discard(port)
