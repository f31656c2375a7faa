"""MC_Halt and MC_Stop (function-blocks 2.7)."""

from typing import Any

from motionlayer import nc
from motionlayer.command import Command, ErrorId
from motionlayer.fb._axis_block import AxisBlock
from motionlayer.fb._inputs import BUFFER_MODES, buffer_mode_of, enumeration, lreal, structure
from motionlayer.fb._moves import ST_MoveOptions
from motionlayer.fb._phase import Phase


class MC_Halt(AxisBlock):  # noqa: N801 - here and below, names of PLCopen
    """Brake to rest; another command may take over at any time."""

    Deceleration = lreal(0.0, "u/s²; 0 for that of the running command")
    Jerk = lreal(0.0, "u/s³; 0 for that of the running command")
    BufferMode = enumeration(nc.BufferMode.ABORTING, "when to brake")
    Options = structure(ST_MoveOptions, "blending position; whether the window is waited for")

    def _issue(self) -> Command[Any]:
        mode, options = buffer_mode_of(self.BufferMode), self.Options
        if mode is None:
            return self._refuse("halt", ErrorId.BUFFER_MODE, "BufferMode", BUFFER_MODES)
        return self._axis.halt(
            deceleration=positive(self.Deceleration),
            jerk=positive(self.Jerk),
            buffer_mode=mode,
            blending_position=options.BlendingPosition if options.EnableBlendingPosition else None,
            position_monitoring=bool(options.EnableStopPositionMonitoring),
        )


class MC_Stop(AxisBlock):  # noqa: N801
    """Brake to rest and keep the axis locked as long as Execute is TRUE.

    `Done` tells that it rests; `Busy` and `Active` stay TRUE until the lock is released.
    """

    Deceleration = lreal(0.0, "u/s²; 0 for that of the running command")
    Jerk = lreal(0.0, "u/s³; 0 for that of the running command")
    Options = structure(ST_MoveOptions, "whether the window of the actual position is waited for")

    _command: nc.HeldCommand | None

    def _issue(self) -> Command[Any]:
        return self._axis.stop(
            deceleration=positive(self.Deceleration),
            jerk=positive(self.Jerk),
            hold=True,
            position_monitoring=bool(self.Options.EnableStopPositionMonitoring),
        )

    def _watch(self) -> None:
        command = self._command
        assert command is not None
        if not self.Execute:
            command.release()
        super()._watch()
        if self._phase is Phase.BUSY:
            self.Done = command.at_target


def positive(value: float) -> float | None:
    """Return a value above zero; zero or less asks for that of the running command. The axis refuses NaN and text."""
    given: object = value
    return None if isinstance(given, int | float) and given <= 0.0 else value
