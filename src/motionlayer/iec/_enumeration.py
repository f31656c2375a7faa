"""`Enumeration`: an IEC enumeration over a plain `enum.IntEnum`."""

import enum
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Final, Generic, TypeVar

from motionlayer.iec._elementary import Integer
from motionlayer.iec._type import Scalar

E = TypeVar("E", bound=enum.IntEnum)


class Enumeration(Scalar["E | int"], Generic[E]):
    """An enumeration type.

    A number without a member is a value too, as in a controller: it is read as a plain int.

    Args:
        name: as declared, `E_AXIS_CTRL`.
        base: its integer type.
        members: the members, named as in Python.
        prefix: stands before the names in the declaration, `AXIS_`.
        keep: beginnings of names that stand without the prefix.
        names: declared names that do not follow that rule, by the name in Python.
        further: declared members that have none in Python, name and number; read as plain ints.
        comment: what it is for.

    Raises:
        ValueError: a member is out of the base's range, or two have the same declared name.
    """

    def __init__(
        self,
        name: str,
        base: Integer,
        members: type[E],
        *,
        prefix: str = "",
        keep: tuple[str, ...] = (),
        names: Mapping[str, str] | None = None,
        further: Mapping[str, int] | None = None,
        comment: str = "",
    ) -> None:
        super().__init__(name, base.code, base.numpy)
        self.base: Final = base
        self.members: Final = members
        self.comment: Final = comment
        given = names or {}
        self.items: Final[tuple[tuple[str, E | int], ...]] = (
            *(
                (given.get(key, key if key.startswith(keep) else prefix + key), member)
                for key, member in members.__members__.items()
            ),
            *(further or {}).items(),
        )
        self._known = {int(member): member for member in members}
        self._named = {int(member): declared for declared, member in reversed(self.items)}
        self._check_items(given)

    def initial(self) -> E | int:
        """Return the member 0, or the number 0 without one."""
        return self._known.get(0, 0)

    def check(self, value: object, who: str = "") -> E | int:
        """Return the member with this value, or the number."""
        if type(value) is self.members:
            return value
        number = self.base.check(value, who or self.name)
        return self._known.get(number, number)

    def decode(self, raw: int) -> E | int:
        """Return the member, or the number without one."""
        return self._known.get(raw, raw)

    def decode_each(self, raw: Sequence[int]) -> Iterable[E | int]:
        """Return the members, or the numbers without one."""
        return map(self._known.get, raw, raw)

    def iec_name(self, value: int) -> str:
        """Return the declared name of a value, `AXIS_MOVE_POS`; without a member the number."""
        return self._named.get(value) or str(int(value))

    def value_of(self, name: str) -> E | int:
        """Return the member with a declared name, in whatever case.

        Raises:
            ValueError: there is none.
        """
        for declared, member in self.items:
            if declared.lower() == name.lower():
                return member
        raise ValueError(f"{self.name} has no member {name!r}; it has {', '.join(item[0] for item in self.items)}")

    def _check_items(self, names: Mapping[str, Any]) -> None:
        for declared, member in self.items:
            self.base.check(int(member), f"{self.name}.{declared}")
        declared_names = [declared.lower() for declared, _ in self.items]
        twice = next((one for one in declared_names if declared_names.count(one) > 1), None)
        if twice:
            raise ValueError(f"{self.name}: two members are named {twice}")
        lost = next((key for key in names if key not in self.members.__members__), None)
        if lost:
            raise ValueError(f"{self.name}: names tells of {lost}, which is no member of {self.members.__name__}")
