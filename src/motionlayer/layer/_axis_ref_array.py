"""`GVL_AXIS.AxisRef`: the cyclic images of the axes inside the library's block around them."""

from typing import TYPE_CHECKING

import numpy as np

from motionlayer.iec import OutputArray
from motionlayer.layer.types import AxisRef

if TYPE_CHECKING:
    from motionlayer.nc import AxisRefs


class AxisRefArray(OutputArray[AxisRef]):
    """The images of all axes as one array of `AXIS_REF`.

    The NC keeps the images in two buffers, where they are filled and mapped in one piece. The array here is brought up
    to date when somebody reads it by symbol, or by `publish`; nobody pays for it in a cycle in which nobody looks.

    Args:
        images: of the NC; None where the axes are in another machine, which leaves zeros.
        count: of axes.
    """

    def __init__(self, images: "AxisRefs | None", count: int) -> None:
        super().__init__(AxisRef, 1, count, "GVL_AXIS.AxisRef")
        self._images = images
        rows = np.frombuffer(self.memory, np.uint8).reshape(count, AxisRef.type.size)
        offsets = {one.name: one.offset for one in AxisRef.type.fields}
        self._nc_to_plc = rows[:, offsets["NcToPlc"] :][:, :256]
        self._plc_to_nc = rows[:, offsets["PlcToNc"] :][:, :128]

    def publish(self) -> None:
        """Bring the bytes up to date: copy what the NC shows now."""
        images = self._images
        if images is not None:
            self._nc_to_plc[:] = images.nc_to_plc.view(np.uint8).reshape(-1, 256)
            self._plc_to_nc[:] = images.plc_to_nc.view(np.uint8).reshape(-1, 128)

    def read(self, offset: int, size: int) -> bytes:
        """Return bytes as they are now."""
        self.publish()
        return super().read(offset, size)
