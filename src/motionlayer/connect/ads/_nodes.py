"""What the tree of symbols is made of: types with their members and methods, and the roots. Pure data (ads 5, 7)."""

from typing import NamedTuple

Attributes = tuple[tuple[str, str], ...]
"""Names and values."""


class Member(NamedTuple):
    """A member of a structure.

    Attributes:
        name: IEC name.
        type: name of its type.
        offset: bytes from the beginning of the structure.
        bit: number within the byte at `offset`, for a BIT; else None.
        comment: what it is.
        attributes: of its declaration.
    """

    name: str
    type: str
    offset: int
    bit: int | None = None
    comment: str = ""
    attributes: Attributes = ()


class ParameterNode(NamedTuple):
    """An input or output of a method.

    Attributes:
        name: IEC name.
        type: name of its type.
        comment: what it is.
    """

    name: str
    type: str
    comment: str = ""


class MethodNode(NamedTuple):
    """A method of a structure.

    Attributes:
        name: IEC name.
        inputs: in the order in which their bytes are sent.
        outputs: in the order in which theirs come back, behind what the method returns.
        returns: name of the type that it returns; empty without.
        comment: what it does.
    """

    name: str
    inputs: tuple[ParameterNode, ...] = ()
    outputs: tuple[ParameterNode, ...] = ()
    returns: str = ""
    comment: str = ""

    @property
    def results(self) -> tuple[str, ...]:
        """Names of the types of all that comes back."""
        return (*((self.returns,) if self.returns else ()), *(one.type for one in self.outputs))


class TypeNode(NamedTuple):
    """A data type.

    Attributes:
        name: IEC name, `ARRAY [1..6] OF ST_AXIS_CTRL`.
        size: bytes.
        adst: ADST id (ads 5.3); of arrays that of their elements.
        base: name of the type of the elements, or of the base of an enumeration; else empty.
        dimensions: lower bound and number of elements per dimension of an array.
        members: of a structure or union, in order.
        values: names and values of an enumeration.
        comment: what it is.
        methods: of a structure, by their numbers.
    """

    name: str
    size: int
    adst: int
    base: str = ""
    dimensions: tuple[tuple[int, int], ...] = ()
    members: tuple[Member, ...] = ()
    values: tuple[tuple[str, int], ...] = ()
    comment: str = ""
    methods: tuple[MethodNode, ...] = ()


class Root(NamedTuple):
    """A symbol that is declared as such; its members have no entry of their own in an upload.

    Attributes:
        name: `GVL_AXIS.Ctrl`.
        type: name of its type.
        offset: bytes from the beginning of the published image.
        writable: clients may write it.
        comment: what it is.
        attributes: of its declaration.
    """

    name: str
    type: str
    offset: int
    writable: bool = False
    comment: str = ""
    attributes: Attributes = ()
