"""Blocks that move an axis (function-blocks 2.7)."""

import abc
from dataclasses import dataclass
from typing import Any, ClassVar, TypedDict

from motionlayer import nc
from motionlayer.command import Command, ErrorId
from motionlayer.fb._axis_block import AxisBlock
from motionlayer.fb._axis_ref import AXIS_REF
from motionlayer.fb._inputs import BUFFER_MODES, buffer_mode_of, enumeration, lreal, member_of, structure


@dataclass(slots=True)
class ST_MoveOptions:  # noqa: N801 - the name of the interface
    """Options of a motion command.

    Attributes:
        EnableBlendingPosition: hand over at `BlendingPosition`, not at the target of the running command.
        BlendingPosition: u.
        IgnorePositionMonitoring: a positioning is done with its setpoint, whatever windows the axis has.
        EnableStopPositionMonitoring: MC_Halt and MC_Stop wait for the window of the actual position too.
    """

    EnableBlendingPosition: bool = False
    BlendingPosition: float = 0.0
    IgnorePositionMonitoring: bool = False
    EnableStopPositionMonitoring: bool = False


class Dynamics(TypedDict):
    """Keywords that all motion commands take."""

    acceleration: float | None
    deceleration: float | None
    jerk: float | None
    blending_position: float | None


class Motion(AxisBlock):
    """What all of them have in common."""

    Velocity = lreal(0.0, "largest velocity, u/s, > 0")
    Acceleration = lreal(0.0, "u/s²; 0 for the default of the axis")
    Deceleration = lreal(0.0, "u/s²; 0 for the default of the axis")
    Jerk = lreal(0.0, "u/s³; 0 for the default of the axis")
    BufferMode = enumeration(nc.BufferMode.ABORTING, "when to begin beside a running command")
    Options = structure(ST_MoveOptions, "blending position; whether windows are waited for")

    METHOD: ClassVar = ""
    """Method of the axis that it stands for."""

    def _issue(self) -> Command[Any]:
        mode = buffer_mode_of(self.BufferMode)
        if mode is None:
            return self._refuse(self.METHOD, ErrorId.BUFFER_MODE, "BufferMode", BUFFER_MODES)
        return self._move(mode, self._dynamics())

    @abc.abstractmethod
    def _move(self, mode: nc.BufferMode, dynamics: Dynamics) -> Command[Any]:
        """Give the command."""

    def _dynamics(self) -> Dynamics:
        options = self.Options
        return {
            "acceleration": self.Acceleration or None,
            "deceleration": self.Deceleration or None,
            "jerk": self.Jerk or None,
            "blending_position": options.BlendingPosition if options.EnableBlendingPosition else None,
        }


class Positioning(Motion):
    """A move that ends at rest."""

    def _moved(self, mode: nc.BufferMode, dynamics: Dynamics) -> nc.MoveKeywords:
        """Return all keywords."""
        waits = not self.Options.IgnorePositionMonitoring
        return {**dynamics, "velocity": self.Velocity, "buffer_mode": mode, "position_monitoring": waits}


class MC_MoveAbsolute(Positioning):  # noqa: N801 - here and below, names of PLCopen
    """Move to a position in the continuous coordinate system, also on modulo axes."""

    METHOD = "move_absolute"

    Position = lreal(0.0, "target, u")

    def _move(self, mode: nc.BufferMode, dynamics: Dynamics) -> Command[Any]:
        return self._axis.move_absolute(self.Position, **self._moved(mode, dynamics))


class MC_MoveRelative(Positioning):  # noqa: N801
    """Move by a distance from the set position at which the command begins."""

    METHOD = "move_relative"

    Distance = lreal(0.0, "way, u")

    def _move(self, mode: nc.BufferMode, dynamics: Dynamics) -> Command[Any]:
        return self._axis.move_relative(self.Distance, **self._moved(mode, dynamics))


class MC_MoveAdditive(Positioning):  # noqa: N801
    """Move by a distance from the last commanded target, reached or not."""

    METHOD = "move_additive"

    Distance = lreal(0.0, "way, u")

    def _move(self, mode: nc.BufferMode, dynamics: Dynamics) -> Command[Any]:
        return self._axis.move_additive(self.Distance, **self._moved(mode, dynamics))


class MC_MoveModulo(Positioning):  # noqa: N801
    """Move to an orientation, a position modulo the period of the axis."""

    METHOD = "move_modulo"

    Position = lreal(0.0, "modulo position, u, >= 0; whole periods are further turns")
    Direction = enumeration(nc.Direction.SHORTEST_WAY, "of the motion")

    def _move(self, mode: nc.BufferMode, dynamics: Dynamics) -> Command[Any]:
        way = member_of(nc.Direction, self.Direction)
        if way is None:
            return self._refuse(self.METHOD, ErrorId.MODE_INVALID, "Direction", "1 to 4")
        return self._axis.move_modulo(self.Position, way, **self._moved(mode, dynamics))


class Endless(Motion):
    """Motion that goes on after its goal: the block stays busy until another command takes over."""

    HIDDEN = ("Done",)

    _command: nc.AxisCommand | None

    def _watch(self) -> None:
        super()._watch()
        self._show_goal(self._command)

    @abc.abstractmethod
    def _show_goal(self, command: nc.AxisCommand | None) -> None:
        """Show whether the goal of the command, which may have ended, is reached."""


class MC_MoveVelocity(Endless):  # noqa: N801
    """Move without end with a velocity.

    Attributes:
        InVelocity: the setpoint moves at the commanded velocity times the override; FALSE while 0 % holds it.
    """

    METHOD = "move_velocity"

    Direction = enumeration(nc.Direction.POSITIVE, "positive, negative or current")

    def __init__(self, axis: AXIS_REF | None = None) -> None:
        super().__init__(axis)
        self.InVelocity = False

    def _move(self, mode: nc.BufferMode, dynamics: Dynamics) -> Command[Any]:
        way = member_of(nc.Direction, self.Direction)
        if way is None:
            return self._refuse(self.METHOD, ErrorId.COMMAND_NOT_PERMITTED, "Direction", "1, 3 or 4")
        return self._axis.move_velocity(self.Velocity, way, buffer_mode=mode, **dynamics)

    def _show_goal(self, command: nc.AxisCommand | None) -> None:
        self.InVelocity = command is not None and command.in_velocity


class Continuous(Endless):
    """Endless motion past a position.

    Attributes:
        InEndVelocity: the setpoint has passed the position and moves at the end velocity; FALSE while 0 % holds it.
    """

    EndVelocity = lreal(0.0, "velocity behind the position, u/s, > 0")

    def __init__(self, axis: AXIS_REF | None = None) -> None:
        super().__init__(axis)
        self.InEndVelocity = False

    def _show_goal(self, command: nc.AxisCommand | None) -> None:
        self.InEndVelocity = command is not None and command.in_end_velocity


class MC_MoveContinuousAbsolute(Continuous):  # noqa: N801
    """Move past a position with an end velocity, and on with it."""

    METHOD = "move_continuous_absolute"

    Position = lreal(0.0, "to be passed, u")

    def _move(self, mode: nc.BufferMode, dynamics: Dynamics) -> Command[Any]:
        return self._axis.move_continuous_absolute(
            self.Position, self.EndVelocity, velocity=self.Velocity, buffer_mode=mode, **dynamics
        )


class MC_MoveContinuousRelative(Continuous):  # noqa: N801
    """Move past a position at a distance from where the command begins, and on with an end velocity.

    The distance counts from the set position.
    """

    METHOD = "move_continuous_relative"

    Distance = lreal(0.0, "way to the position to be passed, u")

    def _move(self, mode: nc.BufferMode, dynamics: Dynamics) -> Command[Any]:
        return self._axis.move_continuous_relative(
            self.Distance, self.EndVelocity, velocity=self.Velocity, buffer_mode=mode, **dynamics
        )
