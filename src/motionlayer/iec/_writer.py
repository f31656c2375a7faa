"""`Writer`: what a write to a member does."""

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from motionlayer.iec._compound import CompoundType
from motionlayer.iec._layout import Member

Put = Callable[[Any, Any], object]
"""Stores a checked value (second) in an object (first)."""


class Writer(NamedTuple):
    """Check and store.

    Attributes:
        who: `AxisCtrl.cmd`, for messages.
        check: returns what is kept.
        put: stores what has been checked.
    """

    who: str
    check: Callable[[object, str], Any]
    put: Put


def writers_of(cls: str, members: Iterable[Member], scalar: Callable[[Member], Put]) -> dict[str, Writer]:
    """Return the writers of all members by their attributes.

    Args:
        cls: name of the class, for messages.
        members: of the structure.
        scalar: returns what stores a scalar; compound values are copied into the one that is there.
    """
    return {
        one.attribute: Writer(
            f"{cls}.{one.attribute}",
            one.type.check,
            _copy_into(one.attribute) if isinstance(one.type, CompoundType) else scalar(one),
        )
        for one in members
    }


def _copy_into(attribute: str) -> Put:
    def put(value: Any, checked: Any) -> None:  # noqa: ANN401
        getattr(value, attribute).unpack_from(bytes(checked))

    return put
