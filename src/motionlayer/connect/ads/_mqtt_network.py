"""`Network`: a server as a member of an ADS network of MQTT topics (ads 10). It does no input or output of its own.

================================ =========================================== ==============================
topic                            payload                                     who publishes
================================ =========================================== ==============================
`<network>/<NetId>/info`         XML: the NetId is online or not, retained   its owner; the broker as a will
`<network>/<NetId>/ams`          requests to this NetId                      clients
`<network>/<NetId>/ams/res`      answers to this NetId, and notifications    servers
================================ =========================================== ==============================

A payload is an AMS packet as on TCP, without the header that tells its length. The broker does not tell connections
apart, so everything that is held for a client hangs on its AMS address, until its NetId goes offline: the last will of
a client that has died says so. A client that never says that it is there is not missed either: what it holds stays.
"""

import re
from collections.abc import Callable
from typing import Final
from xml.sax.saxutils import quoteattr

from motionlayer.connect.ads._codes import Code
from motionlayer.connect.ads._connection import Connection
from motionlayer.connect.ads._frame import MAX_FRAME, RESPONSE, Address, Packet, net_id
from motionlayer.connect.ads._router import Router

HOST: Final = "MQTT"
"""Where clients of a network are, for messages; the broker does not tell."""

Publish = Callable[[str, bytes], None]
"""Takes topic and payload of an answer."""

# Not parsed as XML: what strangers send could be made to expand without end.
_ONLINE: Final = re.compile(rb"<online\b[^>]*>\s*(true|false)\s*</online>", re.IGNORECASE)


def info(name: str, *, online: bool) -> bytes:
    """Return the payload that tells whether a NetId is there.

    Args:
        name: of the device.
        online: it is.
    """
    attributes = f'name={quoteattr(name)} osVersion="10.0.0" osPlatform="2" tcVersion="3.1.4026.0"'
    return f"<info><online {attributes}>{str(online).lower()}</online></info>".encode()


def is_online(payload: bytes) -> bool | None:
    """Return what the payload of an info topic says; None where it says neither."""
    found = _ONLINE.search(payload)
    return None if found is None else found[1].lower() == b"true"


class Network:
    """The member of a network that a server is.

    Args:
        name: of the network: what its topics begin with.
        router: what all ways to the server share.
        publish: takes what is sent.

    Attributes:
        requests: topic of what is sent to this server.
        info: topic by which others know whether it is there.
        infos: topics of all that are, this one among them.
    """

    def __init__(self, name: str, router: Router, publish: Publish) -> None:
        own = ".".join(map(str, router.net_id))
        self.requests = f"{name}/{own}/ams"
        self.info = f"{name}/{own}/info"
        self.infos = f"{name}/+/info"
        self._name = name
        self._router = router
        self._publish = publish
        self._connections: dict[Address, Connection] = {}

    def take(self, topic: str, payload: bytes) -> bool:
        """Take a message of a topic that this member subscribes.

        Returns:
            False where somebody says that this member is not there: the will of an earlier connection comes late.
        """
        if topic == self.requests:
            self._request(payload)
        elif topic == self.info:
            return is_online(payload) is not False
        elif is_online(payload) is False:
            self._offline(topic)
        return True

    def close(self) -> None:
        """Release everything that was held for clients."""
        for connection in self._connections.values():
            connection.closed()
        self._connections.clear()

    def _request(self, payload: bytes) -> None:
        packet = Packet.head(payload)
        if packet is None or packet.flags & RESPONSE or len(payload) > MAX_FRAME:
            return
        connection = self._connection(packet.source)
        full = packet.answer(b"", Code.NO_MEMORY)
        answer = full.pack() if connection is None else connection.packet(payload)
        if answer:
            self._publish(self._answers(packet.source), answer)

    def _connection(self, source: Address) -> Connection | None:
        """Return what is held for a client; the one silent longest, which holds nothing, makes room for a new one."""
        connections = self._connections
        connection = connections.pop(source, None)
        if connection is None:
            if len(connections) >= self._router.limits.connections and not self._make_room():
                self._router.tell(f"{source} at {HOST}", "too many clients")
                return None
            topic = self._answers(source)
            connection = Connection(self._router, HOST, lambda data: self._publish(topic, data), split=False)
        connections[source] = connection  # the last one is the one heard last
        return connection

    def _make_room(self) -> bool:
        address = next((address for address, one in self._connections.items() if one.idle), None)
        if address is not None:
            self._connections.pop(address).closed()
        return address is not None

    def _offline(self, topic: str) -> None:
        """Release what was held for all clients of a NetId."""
        try:
            gone = net_id(topic.removeprefix(f"{self._name}/").removesuffix("/info"))
        except ValueError:  # a topic of something else
            return
        for address in [address for address in self._connections if address.net_id == gone]:
            self._connections.pop(address).closed()

    def _answers(self, source: Address) -> str:
        return f"{self._name}/{'.'.join(map(str, source.net_id))}/ams/res"
