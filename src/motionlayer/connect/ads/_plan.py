"""What a server is told by the run: `Plan` when it begins, `Contents` when all symbols are known. Pure data."""

from dataclasses import dataclass, field

from motionlayer.connect.ads._client import Limits
from motionlayer.connect.ads._nc import NcContents
from motionlayer.connect.ads._router import Access
from motionlayer.connect.ads._tree import Tree


@dataclass(frozen=True)
class Mqtt:
    """A broker by which clients reach a server too.

    Attributes:
        host: of the broker.
        port: its TCP port.
        network: what all topics begin with.
        name: of the server, as others see it.
    """

    host: str
    port: int
    network: str
    name: str


@dataclass(frozen=True)
class Plan:
    """Where a server is, and whom it serves.

    Attributes:
        host: address to listen on.
        port: TCP port; 0: a free one.
        net_id: of the server.
        cycle_ns: of the run.
        access: who may do what.
        limits: of clients.
        mqtt: a broker by which it is reached too; None without one.
    """

    host: str
    port: int
    net_id: bytes
    cycle_ns: int
    access: Access = field(default_factory=Access)
    limits: Limits = field(default_factory=Limits)
    mqtt: Mqtt | None = None


@dataclass(frozen=True)
class Contents:
    """What it serves; known when the first tick has ended, since programs may declare symbols in it.

    Attributes:
        tree: symbols and types.
        size: bytes of the image.
        nc: of the ports of the NC; None without axes.
    """

    tree: Tree
    size: int
    nc: NcContents | None = None
