"""`AXIS_REF`: an axis as the blocks know it, with its cyclic interface."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from motionlayer.fb._image import Image
from motionlayer.fb._settings import Settings
from motionlayer.fb._status import ST_AxisStatus, status_of

if TYPE_CHECKING:
    from motionlayer.nc import Axis, AxisRefs


Keep = Callable[[str, str, float], str]
"""Keeps a parameter, given axis, name and value; returns why that was not possible, "" if it was."""


class AXIS_REF:  # noqa: N801 - the name of the interface
    """An axis, as it is handed to blocks; `run.axis_refs["X"]`.

    Attributes:
        axis: the axis that the blocks command.
        NcToPlc: what the NC shows of it: the outcome of the last finished cycle (function-blocks 3.1).
        PlcToNc: what the blocks have asked of it (function-blocks 3.5).
        Status: as of the last `ReadStatus`.
        settings: what can be set of it by parameters.
        cycle_time: of the NC, s.
        keep: keeps parameters beyond the run; None where there is no file for them.
    """

    __slots__ = ("NcToPlc", "PlcToNc", "Status", "axis", "cycle_time", "keep", "settings")

    def __init__(self, axis: "Axis", images: "AxisRefs", index: int, keep: Keep | None = None) -> None:
        self.keep = keep
        self.axis = axis
        self.settings = Settings(axis, axis.config)
        self.cycle_time = images.cycle_time
        self.NcToPlc = Image(images.nc_to_plc[index : index + 1].reshape(()))
        self.PlcToNc = Image(images.plc_to_nc[index : index + 1].reshape(()))
        self.Status = ST_AxisStatus()

    def ReadStatus(self) -> ST_AxisStatus:  # noqa: N802 - the name of the interface
        """Refresh `Status` from `NcToPlc`; to be called once at the start of a cycle."""
        self.Status = status_of(self.NcToPlc, self.axis.state)
        return self.Status

    def __repr__(self) -> str:
        return f"<AXIS_REF {self.axis.name}>"
