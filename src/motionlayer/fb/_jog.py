"""MC_Jog (function-blocks 2.11)."""

from typing import Any

from motionlayer import nc
from motionlayer.command import Command, ErrorId
from motionlayer.fb._axis_block import AxisCommandBlock
from motionlayer.fb._axis_ref import AXIS_REF
from motionlayer.fb._inputs import boolean, enumeration, lreal, member_of


class MC_Jog(AxisCommandBlock):  # noqa: N801 - the name of the interface
    """Move by hand, while a key is held or by steps.

    While the axis moves no further edge is taken; of two in one call forward wins.
    Done, CommandAborted and Error are shown in one call, or as long as the key is held that began it.
    At a software limit the axis comes to rest without an error, and the block stays busy until the key is released.
    """

    JogForward = boolean("key: in positive direction")
    JogBackwards = boolean("key: in negative direction")
    Mode = enumeration(nc.JogMode.STANDARD_SLOW, "while the key is held, or by steps")
    Position = lreal(0.0, "step of the inching modes, u")
    Velocity = lreal(0.0, "u/s; the standard modes take the manual velocities of the axis")
    Acceleration = lreal(0.0, "u/s²; 0 for the default of the axis")
    Deceleration = lreal(0.0, "u/s²; 0 for the default of the axis")
    Jerk = lreal(0.0, "u/s³; 0 for the default of the axis")

    _command: nc.HeldCommand | None

    def __init__(self, axis: AXIS_REF | None = None) -> None:
        super().__init__(axis)
        self._keys = (False, False)
        self._forward = True
        self._held = False

    def _call(self) -> None:
        forward, backward = self.JogForward, self.JogBackwards
        if not self.Busy:
            edges = forward and not self._keys[0], backward and not self._keys[1]
            if any(edges):
                self._forward = bool(edges[0])
                self._edge = False
        self._keys = forward, backward
        self._held = bool(forward if self._forward else backward)
        self._cycle(execute=self._held)

    def _issue(self) -> Command[Any]:
        mode = member_of(nc.JogMode, self.Mode)
        if mode is None:
            return self._refuse("jog", ErrorId.MODE_INVALID, "Mode", "0 to 4")
        inching = mode in (nc.JogMode.INCHING, nc.JogMode.INCHING_MODULO)
        return self._axis.jog(
            nc.Direction.POSITIVE if self._forward else nc.Direction.NEGATIVE,
            mode,
            step=self.Position if inching else None,
            velocity=self.Velocity,
            acceleration=self.Acceleration or None,
            deceleration=self.Deceleration or None,
            jerk=self.Jerk or None,
        )

    def _watch(self) -> None:
        command = self._command
        assert command is not None
        if not self._held:
            command.release()
        super()._watch()
