"""What all function blocks have in common: inputs, outputs, and their life over calls.

A block is an object that a program calls once per cycle, with the inputs that changed. Outputs are attributes. It never
moves anything itself: it issues commands of an axis and shows what becomes of them, so that a call more or less in a
cycle changes no motion.

A busy block has to be called in every turn of its task. If it was not, and its command was aborted meanwhile, it cannot
have told anybody in time: that is error 0x4B66. Source of the rules: function-blocks 1.4.
"""

import abc
import difflib
from collections.abc import Iterable
from typing import Any, ClassVar, Final

from motionlayer.command import Command, ErrorId, Ledger, MotionError
from motionlayer.fb._inputs import Input, boolean
from motionlayer.fb._phase import NEXT, SHOWN, Phase

FIRST: Final = ("Axis", "Execute", "Enable")
"""Inputs that stand before all others."""

NO_TURNS: Final = Ledger()
"""Stands still, until a block knows whom it commands."""


class Calls:
    """The calls of a block, counted in the turns of its task.

    Attributes:
        ledger: whose turns.
        turn: of the last call.
    """

    __slots__ = ("ledger", "turn")

    def __init__(self, ledger: Ledger) -> None:
        self.ledger = ledger
        self.turn = ledger.turn


class Built(abc.ABCMeta):
    """Kind of a class whose objects are complete once they have been built: no attribute can be added after that."""

    def __call__(cls, *args: Any, **kwargs: Any) -> Any:  # noqa: ANN401 - as the class itself
        """Build an object."""
        made = super().__call__(*args, **kwargs)
        made.__dict__["_built"] = True
        return made


class Block(metaclass=Built):
    """A function block; subclasses declare their inputs in the class body.

    An attribute that it does not have cannot be set: a misspelt input would be silently without effect.

    Attributes:
        INPUTS: of the class, by name.
        HIDDEN: outputs that every block has and this one never sets.
        Busy: the block is at work.
        Error: something was refused or went wrong.
        ErrorID: what: 0, or a number of `ErrorId`.
    """

    INPUTS: ClassVar[dict[str, Input]] = {}
    HIDDEN: ClassVar[tuple[str, ...]] = ()
    _STRUCTURES: ClassVar[dict[str, type]] = {}

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        declared: dict[str, Input] = {}
        for base in cls.__mro__:
            declared |= {name: one for name, one in vars(base).items() if isinstance(one, Input)}
        cls.INPUTS = {name: declared[name] for name in sorted(declared, key=lambda name: name not in FIRST)}
        kinds = {name: one.default for name, one in cls.INPUTS.items()}
        cls._STRUCTURES = {name: kind for name, kind in kinds.items() if isinstance(kind, type)}

    def __init__(self) -> None:
        for name, entry in self.INPUTS.items():
            self.__dict__[name] = entry.default() if isinstance(entry.default, type) else entry.default
        self.Busy = False
        self.Error = False
        self.ErrorID = 0

    def __setattr__(self, name: str, value: object) -> None:
        fields = self.__dict__
        if name not in fields and "_built" in fields:
            raise AttributeError(self._unknown([name]))
        fields[name] = value

    def __call__(self, **inputs: Any) -> None:  # noqa: ANN401 - of the types that the block declares
        """Take the inputs that are given, keep the others, and do the work of one call.

        Raises:
            TypeError: the block has no such input, or a value is of the wrong type.
        """
        if inputs:
            if not self.INPUTS.keys() >= inputs.keys():
                raise TypeError(self._unknown([name for name in inputs if name not in self.INPUTS]))
            self.__dict__.update(inputs)
        self._call()

    def __repr__(self) -> str:
        usual = {name: kind() for name, kind in self._STRUCTURES.items()}
        fields = [(name, value) for name, value in vars(self).items() if value and not name.startswith("_")]
        shown = [f"{name}={value}" for name, value in fields if value != usual.get(name)]
        return f"<{' '.join([type(self).__name__, *shown])}>"

    @abc.abstractmethod
    def _call(self) -> None:
        """Do the work of one call."""

    def _unknown(self, wrong: Iterable[str]) -> str:
        """Return the text of an error about inputs that there are not."""
        near = [close for name in wrong for close in difflib.get_close_matches(name, self.INPUTS, n=1)]
        hint = f"did you mean {', '.join(near)}?" if near else f"it has {', '.join(self.INPUTS)}"
        return f"{type(self).__name__} has no input {', '.join(wrong)}; {hint}"

    def _check_structures(self) -> None:
        """Take no other object for a structure: its missing fields would show only when they are asked for."""
        for name, kind in self._STRUCTURES.items():
            value = getattr(self, name)
            if not isinstance(value, kind):
                raise TypeError(f"{type(self).__name__}: {name} is {value!r}; it must be of {kind.__name__}")

    def _show_error(self, error: MotionError | ErrorId | None) -> None:
        self.Error = error is not None
        self.ErrorID = 0 if error is None else int(error.id if isinstance(error, MotionError) else error)


class CommandBlock(Block):
    """A block that commands, whatever starts it.

    Attributes:
        Busy: the command runs, or waits for its turn.
        Active: the axis works on it.
        Done: it has come to its end.
        CommandAborted: another command took over.
    """

    def __init__(self) -> None:
        super().__init__()
        self.Active = False
        self.Done = False
        self.CommandAborted = False
        self._phase = Phase.IDLE
        self._edge = False
        self._command: Command[Any] | None = None
        self._calls = Calls(NO_TURNS)

    def _cycle(self, *, execute: bool) -> None:
        """Do the work of one call; `execute` starts the command by its rising edge."""
        if self.Busy:
            self._watch()
        elif execute:
            if not self._edge:
                self._begin()
        elif self._phase is not Phase.IDLE:
            self._enter(Phase.IDLE)
        if execute is not self._edge:  # a busy block writes nothing that stays as it is
            self._edge = execute

    @abc.abstractmethod
    def _issue(self) -> Command[Any]:
        """Give the command."""

    def _begin(self) -> None:
        """Issue the command; whatever it comes to, it is busy for one call at least, unless it is refused."""
        self._check_structures()
        issued = self._issue()
        if issued.error is not None:
            self._enter(Phase.ERROR, issued.error)
            return
        self._command = issued
        self._enter(Phase.BUSY)
        self.Active = issued.active

    def _watch(self) -> None:
        """Take up what has become of the command."""
        command, calls = self._command, self._calls
        assert command is not None
        last, calls.turn = calls.turn, calls.ledger.turn
        if command.busy:
            if command.active is not self.Active:
                self.Active = command.active
        elif command.done:
            self._enter(Phase.DONE)
        elif command.error is not None:
            self._enter(Phase.ERROR, command.error)
        elif calls.turn > last + 1:
            self._enter(Phase.ERROR, ErrorId.NOT_CALLED_CYCLICALLY)
        else:
            self._enter(Phase.ABORTED)

    def _enter(self, phase: Phase, error: MotionError | ErrorId | None = None) -> None:
        assert phase in NEXT[self._phase], (self._phase, phase)
        self._phase = phase
        self.Busy, self.Done, self.CommandAborted = SHOWN[phase]
        self.Active = False
        self._show_error(error)
        if phase is not Phase.BUSY:
            self._command = None


class ExecuteBlock(CommandBlock):
    """A block that a rising edge of Execute starts."""

    Execute = boolean("rising edge starts the command")

    def _call(self) -> None:
        self._cycle(execute=self.Execute)
