"""`ST_AxisStatus`: the bits of `NcToPlc` with their names (function-blocks 3.2, 3.6)."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from motionlayer.nc import AxisState, OpModeDWord, StateDWord

if TYPE_CHECKING:
    from motionlayer.fb._image import Image

ACCELERATING: Final = 4
DECELERATING: Final = 5


@dataclass(slots=True)
class ST_AxisStatus:  # noqa: N801 - the name of the interface
    """State of an axis.

    Attributes:
        MotionState: `MC_AxisStates`.
        ErrorID: of the axis error, 0 without.
        CoupleState: 0 single, 1 master, 2 master and slave, 3 slave.
        CycleCounter: the lower eight bits of the NC cycle counter.
        flags: bits of `StateDWord`; each of them is an attribute too: `status.HasJob`.
        op_mode: bits of `OpModeDWord`.
        axis_state: `NcToPlc.AxisState`.
    """

    MotionState: AxisState = AxisState.UNDEFINED
    ErrorID: int = 0
    CoupleState: int = 0
    CycleCounter: int = 0
    flags: StateDWord = field(default=StateDWord(0))
    op_mode: OpModeDWord = field(default=OpModeDWord(0))
    axis_state: int = 0

    def __getattr__(self, name: str) -> bool:
        flag = StateDWord.__members__.get(name)
        if flag is not None:
            return flag in self.flags
        mode = OpModeDWord.__members__.get(name)
        if mode is not None:
            return mode in self.op_mode
        raise AttributeError(f"ST_AxisStatus has no field {name}")

    @property
    def Moving(self) -> bool:  # noqa: N802 - as the following ones, the name of the interface
        """The setpoint moves."""
        return bool(self.flags & (StateDWord.PositiveDirection | StateDWord.NegativeDirection))

    @property
    def Coupled(self) -> bool:  # noqa: N802
        """The axis is part of a coupling."""
        return self.CoupleState != 0

    @property
    def Accelerating(self) -> bool:  # noqa: N802
        """|velocity| of the setpoint grows."""
        return self.axis_state == ACCELERATING

    @property
    def Decelerating(self) -> bool:  # noqa: N802
        """|velocity| of the setpoint falls."""
        return self.axis_state == DECELERATING


def status_of(image: "Image", state: AxisState) -> ST_AxisStatus:
    """Return what an image shows."""
    op_mode = image.OpModeDWord
    return ST_AxisStatus(
        MotionState=state,
        ErrorID=image.ErrorCode,
        CoupleState=image.CoupleState,
        CycleCounter=op_mode >> 24,
        flags=StateDWord(image.StateDWord),
        op_mode=OpModeDWord(op_mode & 0xFFFFFF),
        axis_state=image.AxisState,
    )
