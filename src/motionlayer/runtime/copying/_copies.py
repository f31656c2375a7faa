"""`Copies`: the walk along all references, and the way back."""

from collections.abc import Callable, Iterable
from typing import Any

from motionlayer.runtime.copying._attributes import attributes_of, put_attributes
from motionlayer.runtime.copying._followers import ATOMS, Put, Trail, follower_of


class Copies:
    """A copy of what can change behind some objects.

    Args:
        roots: where to begin, by the name that a message calls it.
        pinned: objects that are not followed.
        settled: tells of an object whether it cannot change any more; it is not followed either.

    Raises:
        NotCopyable: something behind the roots cannot be copied.
    """

    def __init__(
        self,
        roots: Iterable[tuple[str, object]],
        pinned: Iterable[object],
        settled: Callable[[object], bool] = lambda _: False,
    ) -> None:
        self._settled = settled
        self._notes: list[tuple[Put, Any, Any]] = []
        self._pinned = list(pinned)  # kept, so that no other object takes their place in memory
        self._seen = {id(one) for one in self._pinned}
        self._open: list[tuple[object, Trail]] = []
        for name, root in roots:
            self._open.append((root, (None, "", name)))
            self._follow_all()

    def __len__(self) -> int:
        return len(self._notes)

    def put_back(self) -> None:
        """Let everything be as it was; as often as wanted."""
        for put, thing, held in self._notes:
            put(thing, held)

    def note(self, put: Put, thing: object, held: object) -> None:
        """Remember what an object holds, and how it gets it back."""
        self._notes.append((put, thing, held))

    def later(self, things: Iterable[tuple[object, object]], trail: Trail, form: str) -> None:
        """Follow what an object holds: pairs of a key and what is there; `form` writes the key into a path."""
        for key, thing in things:
            if type(thing) not in ATOMS:
                self._open.append((thing, (trail, form, key)))

    def _follow_all(self) -> None:
        seen = self._seen
        while self._open:
            thing, trail = self._open.pop()
            if id(thing) not in seen:
                seen.add(id(thing))
                follower_of(type(thing))(self, thing, trail)

    def plain(self, thing: object, trail: Trail) -> None:
        """Follow an object of a class written in Python."""
        if self._settled(thing):
            return
        values, slots = attributes_of(thing)
        self.note(put_attributes, thing, (values, slots))
        self.later(values.items(), trail, ".{}")
        for slot, value in slots:
            if type(value) not in ATOMS:
                self._open.append((value, (trail, ".{}", slot.__name__)))
