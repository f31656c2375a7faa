"""`SystemService`: the system service on port 10000 (ads 9), and what a state that a client asks for means.

What a client asks with WriteControl, on the PLC port and on the one of the system service:

============== ================ =======================================================
state          the run          shown from then on
============== ================ =======================================================
RUN, START     goes on          RUN, RUN
STOP           is held up       STOP on the PLC port; the system stays in RUN
CONFIG         is held up       STOP; the system is in CONFIG
RECONFIG       the same
RESET          begins anew      RUN, RUN, another restart index and another symbol version
============== ================ =======================================================
"""

import struct
from typing import Final

from motionlayer.connect.ads._client import Client
from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._service import Image, Kind, Service, State, Write

SYSTEM_STATUS: Final = 0xF0
_STATUS: Final = struct.Struct("<3H2BH2BH2x")
PLATFORM: Final = 0
OS_TYPE: Final = 1

ASKED: Final = (State.RUN, State.START, State.STOP, State.RESET, State.CONFIG, State.RECONFIG)
"""States that can be asked for."""


def controlled(state: int) -> Write:
    """Return what the run is asked for.

    Raises:
        AdsError: it cannot get into that state (0x712).
    """
    if state not in ASKED:
        raise AdsError(Code.INVALID_STATE, f"state {state} cannot be asked for")
    return Write(Kind.CONTROL, state, b"")


class SystemService(Service):
    """Run, stop and configuration of the whole run: see `controlled`.

    Args:
        image: tells how the run is.
    """

    name = "TwinCAT System"

    def __init__(self, image: Image) -> None:
        self._image = image

    def state(self) -> tuple[int, int]:
        """Return the state of the system."""
        status = self._image.status()
        return status.system, status.system_device

    def control(self, state: int, _device_state: int, _data: bytes) -> Write:
        """Let the run go on, hold it up, or let it begin anew; see `controlled`."""
        return controlled(state)

    def read(self, client: Client, group: int, offset: int, length: int) -> bytes:
        """Return the status of the system; the arguments are those of `Service.read`."""
        if group != SYSTEM_STATUS or offset != 0:
            return super().read(client, group, offset, length)
        now, (major, minor, build) = self._image.status(), self.version
        index = now.beginnings & 0xFFFF
        status = _STATUS.pack(now.system, now.system_device, index, major, minor, build, PLATFORM, OS_TYPE, 0)
        return status[:length]
