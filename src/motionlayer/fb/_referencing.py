"""MC_Home and MC_SetPosition (function-blocks 2.3, 2.10)."""

from dataclasses import dataclass
from typing import Any, Final

from motionlayer import nc
from motionlayer.command import Command, ErrorId
from motionlayer.fb._axis_block import AxisBlock
from motionlayer.fb._axis_ref import AXIS_REF
from motionlayer.fb._inputs import boolean, enumeration, lreal, member_of, structure
from motionlayer.fb._reference_modes import HOMING_METHODS, E_EncoderReferenceMode

DEFAULT_HOME_POSITION: Final = 1.7e308
"""Stands for the reference position of the machine description."""


@dataclass(slots=True)
class ST_HomingOptions:  # noqa: N801 - here and below, names of the interface
    """Options of MC_Home.

    Attributes:
        ClearPositionLag: with MC_Direct the set position becomes the actual one too.
        SearchDirection: towards the cam, 1 or 3; 128 for that of the machine file.
        SearchVelocity: towards the cam, u/s; 0 for that of the machine file.
        SyncDirection: off the cam, 1 or 3; 128 for that of the machine file, which turns with `SearchDirection`.
        SyncVelocity: off the cam, u/s; 0 for that of the machine file.
        ReferenceMode: what the reference is, 0 to 7; one for which the drive has no signal is refused, 0x4418.
    """

    ClearPositionLag: bool = False
    SearchDirection: nc.Direction = nc.Direction.UNDEFINED
    SearchVelocity: float = 0.0
    SyncDirection: nc.Direction = nc.Direction.UNDEFINED
    SyncVelocity: float = 0.0
    ReferenceMode: E_EncoderReferenceMode = E_EncoderReferenceMode.DEFAULT


@dataclass(slots=True)
class ST_SetPositionOptions:  # noqa: N801
    """Options of MC_SetPosition.

    Attributes:
        ClearPositionLag: the set position becomes the actual one.
        SelectEncoderIndex: take the encoder `EncoderIndex`, not the one of the position loop.
        EncoderIndex: 0; an axis has one encoder, and others are refused, 0x4013.
        ClearPositionOffset: go back to the coordinate of the last homing; `Position` is ignored.
    """

    ClearPositionLag: bool = False
    SelectEncoderIndex: bool = False
    EncoderIndex: int = 0
    ClearPositionOffset: bool = False


class MC_Home(AxisBlock):  # noqa: N801
    """Find the reference of an axis, or say that it is homed or is not.

    The cam is the switch of the drive, or one that the program reads and gives as `bCalibrationCam`; either counts. An
    axis without a cam gives TRUE at the start and FALSE from `HomingState` 4 on.
    """

    Position = lreal(DEFAULT_HOME_POSITION, "reference position, u; where left out that of the machine file")
    HomingMode = enumeration(nc.Calibration.DEFAULT, "find the reference, define it here, or only call the axis homed")
    Options = structure(ST_HomingOptions, "directions, velocities, what the reference is; position lag")
    bCalibrationCam = boolean("signal of the cam, in every call; its edge counts where the axis then is")  # noqa: N815

    _command: nc.HomeCommand | None

    def __init__(self, axis: AXIS_REF | None = None) -> None:
        super().__init__(axis)
        self._cam = False

    def _call(self) -> None:
        on = bool(self.bCalibrationCam)
        if on != self._cam:
            self._tell_cam(on=on)
        super()._call()

    def _tell_cam(self, *, on: bool) -> None:
        """Copy the signal of the cam, and tell it to a homing that runs."""
        self._cam, image, sensor = on, self._ref.PlcToNc, nc.ControlDWord.HomingSensor
        image.ControlDWord = image.ControlDWord | sensor if on else image.ControlDWord & ~sensor
        if self._command is not None:
            self._command.cam(on=on)

    def _issue(self) -> Command[Any]:
        mode, options = member_of(nc.Calibration, self.HomingMode), self.Options
        search = member_of(nc.Direction, options.SearchDirection)
        sync = member_of(nc.Direction, options.SyncDirection)
        reference = member_of(E_EncoderReferenceMode, options.ReferenceMode)
        if mode is None:
            return self._refuse("home", ErrorId.MODE_INVALID, "HomingMode", "0 to 3")
        if search is None or sync is None:
            detail = f"SearchDirection = {options.SearchDirection}, SyncDirection = {options.SyncDirection}"
            return self._axis.refuse("home", ErrorId.MODE_INVALID, f"{detail}, allowed: 1, 3, 128")
        if reference is None:
            detail = f"ReferenceMode = {options.ReferenceMode}, allowed: 0 to 7"
            return self._axis.refuse("home", ErrorId.REFERENCE_MODE, detail)
        return self._axis.home(
            None if self.Position == DEFAULT_HOME_POSITION else self.Position,
            mode,
            method=HOMING_METHODS[reference],
            search_direction=search,
            search_velocity=options.SearchVelocity or None,
            sync_direction=sync,
            sync_velocity=options.SyncVelocity or None,
            cam=self._cam,
            clear_lag=bool(options.ClearPositionLag),
        )


class MC_SetPosition(AxisBlock):  # noqa: N801
    """Give the place where the axis is another position; nothing moves."""

    Position = lreal(0.0, "new actual position or, relative, what is added to it, u")
    Mode = boolean("TRUE: relative")
    Options = structure(ST_SetPositionOptions, "position lag, encoder, offset")

    def _issue(self) -> Command[Any]:
        options = self.Options
        return self._axis.define_position(
            self.Position,
            relative=bool(self.Mode),
            clear_lag=bool(options.ClearPositionLag),
            encoder=options.EncoderIndex if options.SelectEncoderIndex else 0,
            clear_offset=bool(options.ClearPositionOffset),
        )
