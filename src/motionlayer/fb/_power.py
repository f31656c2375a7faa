"""MC_Power, MC_Reset and MC_SetOverride (function-blocks 2.1, 2.2, 2.6)."""

import math
from typing import Any

from motionlayer import nc
from motionlayer.command import Command, ErrorId
from motionlayer.fb._axis_block import AxisBlock, EnableBlock, OfAxis, Trouble
from motionlayer.fb._axis_ref import AXIS_REF
from motionlayer.fb._helpers import FULL
from motionlayer.fb._inputs import BUFFER_MODES, boolean, buffer_mode_of, enumeration, lreal, real


class MC_Power(OfAxis):  # noqa: N801 - here and below, names of PLCopen
    """Switch the controller of an axis on and off, release its directions, set its override.

    What the inputs ask for is compared with the axis in every call: power that an error has taken away comes back after
    a reset, as long as Enable is TRUE. What the axis refuses is asked again when its state has changed. An axis in
    Stopping is asked once it has come to rest: Enable is a level, and no error while it cannot be followed yet.

    Attributes:
        Status: the axis is ready.
        Busy: Enable is TRUE.
        Active: as Busy.
    """

    Enable = boolean("controller enable")
    Enable_Positive = boolean("release motion in positive direction; effective with Enable only")
    Enable_Negative = boolean("release motion in negative direction; effective with Enable only")
    Override = lreal(100.0, "velocity override, %, 0 to 100")
    BufferMode = enumeration(nc.BufferMode.ABORTING, "how Enable falls: at once, or when the axis has no job")

    def __init__(self, axis: AXIS_REF | None = None) -> None:
        super().__init__(axis)
        self.Status = False
        self.Active = False
        self._given = (False, False, False)
        self._override = math.nan
        self._misset = False
        self._refused: tuple[ErrorId, nc.AxisState] | None = None
        self._command: nc.AxisCommand | None = None

    def _call(self) -> None:
        ref = self._ref
        axis, enable = ref.axis, bool(self.Enable)
        asked = enable, enable and bool(self.Enable_Positive), enable and bool(self.Enable_Negative)
        error = self._set_override(ref) if enable else None
        differs = asked != self._given or (enable and not axis.power_requested and axis.error is None)
        if differs and not (enable and axis.state is nc.AxisState.STOPPING):
            self._ask(ref, asked)
        if self._refused is not None:
            error = self._refused[0]
        elif self._command is not None and self._command.error is not None:
            error = self._command.error.id
        self.Status = axis.enabled
        self.Busy = self.Active = enable
        self._show_error(error or (axis.error if enable else None))

    def _ask(self, ref: AXIS_REF, asked: tuple[bool, bool, bool]) -> None:
        """Ask the axis for what differs; what it refused not again in the same state."""
        axis = ref.axis
        if asked != self._given:
            self._refused = None
        elif self._refused is not None and self._refused[1] is axis.state:
            return
        enable, positive, negative = self._given = asked
        command = axis.enable(positive=positive, negative=negative) if enable else self._disable(axis)
        self._command = command
        self._refused = None if command.error is None else (command.error.id, axis.state)
        bits = nc.ControlDWord.Enable * enable | nc.ControlDWord.FeedEnablePlus * positive
        kept = ref.PlcToNc.ControlDWord & nc.ControlDWord.HomingSensor
        ref.PlcToNc.ControlDWord = kept | bits | nc.ControlDWord.FeedEnableMinus * negative

    def _disable(self, axis: nc.Axis) -> nc.AxisCommand:
        mode = buffer_mode_of(self.BufferMode)
        if mode is None:
            return axis.refuse(
                "disable", ErrorId.BUFFER_MODE, f"BufferMode = {self.BufferMode}, allowed: {BUFFER_MODES}"
            )
        return axis.disable(buffer_mode=mode)

    def _set_override(self, ref: AXIS_REF) -> ErrorId | None:
        if self.Override == self._override:
            self._misset = False
            return None
        value = real(self, "Override")
        told, self._misset = self._misset, not 0.0 <= value <= 100.0
        if self._misset:
            if not told:
                ref.axis.refuse("set_override", ErrorId.PARAMETER, f"Override = {value}, allowed: 0 to 100 %")
            return ErrorId.PARAMETER
        ref.axis.set_override(value / 100.0)
        self._override = value
        ref.PlcToNc.Override = round(value / 100.0 * FULL)
        return None


class MC_Reset(AxisBlock):  # noqa: N801
    """Clear the error of an axis and of its drive; the set position becomes the actual one."""

    def _issue(self) -> Command[Any]:
        return self._axis.reset()


class MC_SetOverride(EnableBlock):  # noqa: N801
    """Scale the velocity of every motion of an axis."""

    METHOD = "set_override"

    VelFactor = lreal(1.0, "factor, 0 to 1")
    AccFactor = lreal(1.0, "without effect")
    JerkFactor = lreal(1.0, "without effect")

    @property
    def Enabled(self) -> bool:  # noqa: N802 - the name of the interface
        """The override is in force."""
        return self.Valid

    def _act(self) -> Trouble | None:
        ref = self._ref
        if self.VelFactor == ref.axis.override:
            return None
        value = real(self, "VelFactor")
        if not 0.0 <= value <= 1.0:
            return Trouble(ErrorId.PARAMETER, f"VelFactor = {value}, allowed: 0 to 1")
        ref.axis.set_override(value)
        ref.PlcToNc.Override = round(value * FULL)
        return None
