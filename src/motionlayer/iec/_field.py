"""`Field`: a member in the declaration of a structure."""

from typing import TYPE_CHECKING, Any, Generic, TypeVar, overload

from motionlayer.iec._compound import type_of
from motionlayer.iec._type import Got, IecType, Put

if TYPE_CHECKING:
    from typing import Self

    from motionlayer.iec._struct import Struct

S = TypeVar("S", bound="Struct")


class Field(Generic[Got, Put]):
    """A member: what the class of a structure says, and what type checkers see of it.

    When the class is made, its fields become slots: reading one costs no call.

    Args:
        name: as declared on the other side, `rSetPos`.
        kind: the type, or the class of a structure.
        comment: what it means, with its unit.
        default: the declared start value; the one of the type without.

    Raises:
        TypeError: `kind` is no type, or the start value of the wrong kind.
        ValueError: the start value is out of the type's range.
    """

    @overload
    def __init__(
        self: "Field[Got, Put]", name: str, kind: IecType[Got, Put], comment: str = "", *, default: Put | None = None
    ) -> None: ...

    @overload
    def __init__(
        self: "Field[S, S]", name: str, kind: type[S], comment: str = "", *, default: S | None = None
    ) -> None: ...

    def __init__(self, name: str, kind: Any, comment: str = "", *, default: Any = None) -> None:
        self.name = name
        self.type: IecType[Any, Any] = type_of(kind)
        self.comment = comment
        self.default: Any = None if default is None else self.type.check(default, name)

    if TYPE_CHECKING:

        @overload
        def __get__(self, instance: None, owner: object) -> Self: ...

        @overload
        def __get__(self, instance: object, owner: object) -> Got: ...

        def __get__(self, instance: object, owner: object) -> object: ...

        def __set__(self, instance: object, value: Put) -> None: ...
