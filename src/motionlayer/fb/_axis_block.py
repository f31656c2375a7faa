"""Blocks of one axis."""

import abc
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, cast

from motionlayer.command import Command, ErrorId
from motionlayer.fb._axis_ref import AXIS_REF
from motionlayer.fb._block import Block, Calls, CommandBlock, ExecuteBlock
from motionlayer.fb._inputs import Input, boolean

if TYPE_CHECKING:
    from motionlayer import nc


class Trouble(NamedTuple):
    """Why a block that acts by level cannot.

    Attributes:
        error: number.
        detail: value and what is allowed, with the unit.
    """

    error: ErrorId
    detail: str


class OfAxis(Block):
    """A block with an axis.

    Args:
        axis: what it commands; may also be given with a call, as `Axis=...`.
    """

    Axis = cast("AXIS_REF | None", Input("AXIS_REF", None, "the axis; in/out"))

    def __init__(self, axis: AXIS_REF | None = None) -> None:
        super().__init__()
        self.Axis = axis

    @property
    def _ref(self) -> AXIS_REF:
        ref = self.Axis
        if not isinstance(ref, AXIS_REF):
            name = type(self).__name__
            raise TypeError(f"{name}: Axis is {ref!r}; give an AXIS_REF, as in {name}(run.axis_refs['X'])")
        return ref

    @property
    def _axis(self) -> "nc.Axis":
        return self._ref.axis


class AxisCommandBlock(OfAxis, CommandBlock):
    """A block that commands an axis.

    The axis is that of the call in which the command begins; another one given while it runs is for the next command.
    """

    def _begin(self) -> None:
        self._calls = Calls(self._axis.ledger)
        super()._begin()

    def _refuse(self, method: str, error: ErrorId, name: str, allowed: str) -> Command[Any]:
        """Return a refused command for an input that its method cannot even be asked."""
        return self._axis.refuse(method, error, f"{name} = {getattr(self, name)}, allowed: {allowed}")


class AxisBlock(AxisCommandBlock, ExecuteBlock):
    """An Execute block of an axis."""


class EnableBlock(OfAxis):
    """A block that acts as long as Enable is TRUE (function-blocks 1.5).

    Attributes:
        Valid: the outputs may be used.
        Busy: Enable is TRUE.
    """

    METHOD: ClassVar = ""
    """What a message about it names; empty for a block that never has trouble."""

    Enable = boolean("TRUE: read or act in every call")

    def __init__(self, axis: AXIS_REF | None = None) -> None:
        super().__init__(axis)
        self.Valid = False

    def _call(self) -> None:
        self.Busy = bool(self.Enable)
        if self.Enable:
            trouble = self._act()
            self.Valid = trouble is None
            # A message tells it once, the outputs in every call.
            if trouble is not None and trouble.error != self.ErrorID:
                self._axis.refuse(self.METHOD, *trouble)
            self._show_error(None if trouble is None else trouble.error)
        elif self.Valid or self.Error:
            self.Valid = False
            self._show_error(None)
            self._clear()

    @abc.abstractmethod
    def _act(self) -> Trouble | None:
        """Do the work of one call, or tell why it cannot be done."""

    def _clear(self) -> None:
        """Take the outputs back."""
