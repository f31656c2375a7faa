"""Which services a server has on which AMS ports (ads 1.5)."""

from typing import Final

from motionlayer.connect.ads._nc import NcService
from motionlayer.connect.ads._plan import Contents
from motionlayer.connect.ads._service import Image, Service
from motionlayer.connect.ads._symbols import SymbolService
from motionlayer.connect.ads._system import SystemService

NC: Final = (500, 501)
PLC: Final = 851
SYSTEM: Final = 10_000
BARE: Final = (1, 300, 511)
"""Ports that have a state and a name, and nothing else: router, I/O, preparation of the NC."""


def services(contents: Contents, image: Image) -> dict[int, Service]:
    """Return all services by port."""
    nc = Service() if contents.nc is None else NcService(contents.nc, image)
    return {
        **{port: Service() for port in BARE},
        **dict.fromkeys(NC, nc),
        PLC: SymbolService(contents.tree, image),
        SYSTEM: SystemService(image),
    }
