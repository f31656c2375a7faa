"""An object of a project: a type, a list of variables, a function or a block, as an editor shows it."""

import enum
from typing import Final, NamedTuple

_ENDS: Final = {"FUNCTION_BLOCK": "END_FUNCTION_BLOCK", "FUNCTION": "END_FUNCTION", "METHOD": "END_METHOD"}
"""What ends a unit in plain text; in an object of its own it is left out."""


class StKind(enum.StrEnum):
    """Kinds of objects, as projects name them."""

    DUT = "DUT"
    """A data unit type: an enumeration or a structure."""
    GVL = "GVL"
    """A global variable list."""
    POU = "POU"
    """A program organisation unit: a function or a function block."""


class StMethod(NamedTuple):
    """A method of a function block.

    Attributes:
        name: as declared.
        declaration: its head and its variables.
        body: its statements.
    """

    name: str
    declaration: str
    body: str

    @property
    def text(self) -> str:
        """The method as plain text."""
        return f"{self.declaration}\n{self.body}\nEND_METHOD"


class StObject(NamedTuple):
    """An object.

    Attributes:
        kind: what it is.
        name: as declared.
        declaration: its text; of a unit its head and its variables.
        body: statements of a unit.
        methods: of a function block.
        library: a project with the motion libraries has it already.
    """

    kind: StKind
    name: str
    declaration: str
    body: str = ""
    methods: tuple[StMethod, ...] = ()
    library: bool = False

    @property
    def text(self) -> str:
        """The object as plain text."""
        if self.kind is not StKind.POU:
            return self.declaration
        end = _ENDS[head(self.declaration)[0]]
        unit = f"{self.declaration}\n\n{self.body}\n{end}"
        return "\n\n".join([unit, *(one.text for one in self.methods)])


def head(text: str) -> tuple[str, str]:
    """Return what a declaration begins: the word, and the name."""
    words = next(line for line in text.splitlines() if line[:1].isupper()).split()
    names = [word for word in words[1:] if word not in ("PRIVATE", ":")]
    return words[0], names[0]


def unit(text: str) -> tuple[str, str]:
    """Split the text of a unit, without its end: head with variables, and statements."""
    lines = text.strip().splitlines()[:-1]
    variables = [at for at, line in enumerate(lines) if line == "END_VAR"]
    first = 1 + (variables[-1] if variables else next(at for at, line in enumerate(lines) if line[:1].isupper()))
    return "\n".join(lines[:first]), "\n".join(lines[first:]).strip()
