"""MC_Home and MC_SetPosition (function-blocks 2.3, 2.10)."""

from dataclasses import dataclass
from typing import Any, Final

from motionlayer import nc
from motionlayer.command import Command, ErrorId
from motionlayer.fb._axis_block import AxisBlock
from motionlayer.fb._inputs import boolean, enumeration, lreal, member_of, structure

DEFAULT_HOME_POSITION: Final = 1.7e308
"""Stands for the reference position of the machine description."""


@dataclass(slots=True)
class ST_HomingOptions:  # noqa: N801 - here and below, names of the interface
    """Options of MC_Home.

    Attributes:
        ClearPositionLag: with MC_Direct the set position becomes the actual one too.
    """

    ClearPositionLag: bool = False


@dataclass(slots=True)
class ST_SetPositionOptions:  # noqa: N801
    """Options of MC_SetPosition.

    Attributes:
        ClearPositionLag: the set position becomes the actual one.
        ClearPositionOffset: go back to the coordinate of the last homing; `Position` is ignored.
    """

    ClearPositionLag: bool = False
    ClearPositionOffset: bool = False


class MC_Home(AxisBlock):  # noqa: N801
    """Find the reference of an axis, or say that it is homed or is not."""

    Position = lreal(DEFAULT_HOME_POSITION, "reference position, u; where left out that of the machine description")
    HomingMode = enumeration(nc.Calibration.DEFAULT, "find the reference, define it here, or only call the axis homed")
    Options = structure(ST_HomingOptions, "position lag")

    def _issue(self) -> Command[Any]:
        mode = member_of(nc.Calibration, self.HomingMode)
        if mode is None:
            return self._refuse("home", ErrorId.MODE_INVALID, "HomingMode", "0 to 3")
        position = None if self.Position == DEFAULT_HOME_POSITION else self.Position
        return self._axis.home(position, mode, clear_lag=bool(self.Options.ClearPositionLag))


class MC_SetPosition(AxisBlock):  # noqa: N801
    """Give the place where the axis is another position; nothing moves."""

    Position = lreal(0.0, "new actual position or, relative, what is added to it, u")
    Mode = boolean("TRUE: relative")
    Options = structure(ST_SetPositionOptions, "position lag and offset")

    def _issue(self) -> Command[Any]:
        options = self.Options
        return self._axis.define_position(
            self.Position,
            relative=bool(self.Mode),
            clear_lag=bool(options.ClearPositionLag),
            clear_offset=bool(options.ClearPositionOffset),
        )
