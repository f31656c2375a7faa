"""Blocks that read (function-blocks 2.4)."""

from motionlayer.fb._axis_block import EnableBlock
from motionlayer.fb._axis_ref import AXIS_REF
from motionlayer.fb._status import ST_AxisStatus
from motionlayer.nc import AxisState


class MC_ReadActualPosition(EnableBlock):  # noqa: N801 - here and below, names of PLCopen
    """Read the actual position.

    Attributes:
        Position: u, as of the inputs of this tick.
    """

    def __init__(self, axis: AXIS_REF | None = None) -> None:
        super().__init__(axis)
        self.Position = 0.0

    def _act(self) -> None:
        self.Position = self._ref.NcToPlc.ActPos

    def _clear(self) -> None:
        self.Position = 0.0


class MC_ReadActualVelocity(EnableBlock):  # noqa: N801
    """Read the actual velocity.

    Attributes:
        ActualVelocity: u/s, as of the inputs of this tick.
    """

    def __init__(self, axis: AXIS_REF | None = None) -> None:
        super().__init__(axis)
        self.ActualVelocity = 0.0

    def _act(self) -> None:
        self.ActualVelocity = self._ref.NcToPlc.ActVelo

    def _clear(self) -> None:
        self.ActualVelocity = 0.0


class MC_ReadAxisError(EnableBlock):  # noqa: N801
    """Read the error of an axis.

    Attributes:
        AxisErrorID: 0 without an error.
    """

    def __init__(self, axis: AXIS_REF | None = None) -> None:
        super().__init__(axis)
        self.AxisErrorID = 0

    def _act(self) -> None:
        self.AxisErrorID = self._ref.NcToPlc.ErrorCode

    def _clear(self) -> None:
        self.AxisErrorID = 0


class MC_ReadStatus(EnableBlock):  # noqa: N801
    """Read the state of an axis: exactly one of the state outputs is TRUE.

    Attributes:
        Status: all of it.
        Disabled: the drive is off; this and the following ones are the states of PLCopen.
        StandStill: the drive is on, nothing moves.
        ErrorStop: in error; only a reset leads out.
        Stopping: braking, or locked by MC_Stop.
        Homing: a homing is under way.
        DiscreteMotion: a motion that ends by itself, or a halt.
        ContinuousMotion: a motion without end, or a jog.
        SynchronizedMotion: coupled to another axis; not yet.
        ConstantVelocity: the setpoint moves without acceleration.
        Accelerating: the speed of the setpoint grows.
        Decelerating: it falls.
    """

    def __init__(self, axis: AXIS_REF | None = None) -> None:
        super().__init__(axis)
        self._clear()

    def _act(self) -> None:
        self._show(self._ref.ReadStatus())

    def _clear(self) -> None:
        self._show(ST_AxisStatus())

    def _show(self, status: ST_AxisStatus) -> None:
        self.Status = status
        state = status.MotionState
        self.Disabled = state is AxisState.DISABLED
        self.StandStill = state is AxisState.STANDSTILL
        self.ErrorStop = state is AxisState.ERRORSTOP
        self.Stopping = state is AxisState.STOPPING
        self.Homing = state is AxisState.HOMING
        self.DiscreteMotion = state is AxisState.DISCRETE_MOTION
        self.ContinuousMotion = state is AxisState.CONTINUOUS_MOTION
        self.SynchronizedMotion = state is AxisState.SYNCHRONIZED_MOTION
        self.ConstantVelocity = bool(status.ConstantVelocity)
        self.Accelerating = status.Accelerating
        self.Decelerating = status.Decelerating
