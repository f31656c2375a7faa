"""How objects of each kind are followed, and how they get back what they held."""

import collections
import datetime as dt
import decimal
import enum
import functools
import random
import re
import struct
import types
import weakref
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Final, NoReturn, Protocol

import numpy as np

from motionlayer.runtime.copying._attributes import is_plain

PACKAGE: Final = __name__.partition(".")[0]

Put = Callable[[Any, Any], object]
"""Gives an object (first) back what it held (second)."""

Trail = tuple[Any, str, object]
"""Trail of the parent, and what leads on from there: a form and the key in it. Written out only for a message."""


class Copying(Protocol):
    """What a follower tells."""

    def note(self, put: Put, thing: object, held: object) -> None:
        """Remember what an object holds."""

    def later(self, things: Iterable[tuple[object, object]], trail: Trail, form: str) -> None:
        """Follow what it holds."""

    def plain(self, thing: object, trail: Trail) -> None:
        """Treat it as an object of a class written in Python."""


Follower = Callable[[Any, Any, Trail], None]
"""Takes a `Copying`, the object, and its trail."""


class NotCopyable(RuntimeError):  # noqa: N818 - the state, as a user would say it
    """Something cannot be copied; the message says where it is kept."""


_KNOWN: Final[dict[type, Follower]] = {}
"""Found once per class."""


def follower_of(kind: type) -> Follower:
    """Return how objects of a class are followed."""
    known = _KNOWN.get(kind)
    return known if known is not None else _KNOWN.setdefault(kind, _found(kind))


def _found(kind: type) -> Follower:
    if issubclass(kind, (*ATOMS, enum.Enum)) or getattr(kind, "UNCHANGING", False):
        return _leave
    known = next((_FOLLOWERS[base] for base in kind.__mro__ if base in _FOLLOWERS), None)
    if known is None:
        return _follow_plain if is_plain(kind) else _refuse
    if kind in _FOLLOWERS or kind.__dictoffset__ == 0:
        return known

    def both(copies: Copying, thing: object, trail: Trail) -> None:
        known(copies, thing, trail)
        copies.plain(thing, trail)

    return both


def _follow_plain(copies: Copying, thing: object, trail: Trail) -> None:
    copies.plain(thing, trail)


def _leave(_copies: Copying, _thing: object, _trail: Trail) -> None:
    """Nothing to follow."""


def _refuse(_copies: Copying, thing: object, trail: Trail) -> NoReturn:
    path = ""
    while trail[0] is not None:
        trail, path = trail[0], trail[1].format(trail[2]) + path
    kind = f"{type(thing).__module__}.{type(thing).__qualname__}".removeprefix("builtins.")
    raise NotCopyable(f"{trail[2]}{path} is a {kind}, which cannot be copied; keep it in a global or a closure instead")


def _follow_list(copies: Copying, thing: list[object], trail: Trail) -> None:
    held = tuple(thing)
    copies.note(_put_list, thing, held)
    copies.later(enumerate(held), trail, "[{}]")


def _follow_dict(copies: Copying, thing: dict[object, object], trail: Trail) -> None:
    held = dict(thing)
    copies.note(_put_mapping, thing, held)
    copies.later(held.items(), trail, "[{!r}]")
    copies.later(enumerate(held), trail, ".keys()[{}]")


def _follow_set(copies: Copying, thing: set[object], trail: Trail) -> None:
    held = tuple(thing)  # in whatever order: nothing follows from it
    copies.note(_put_mapping, thing, held)
    copies.later(enumerate(held), trail, "{{{}}}")


def _follow_deque(copies: Copying, thing: collections.deque[object], trail: Trail) -> None:
    held = tuple(thing)
    copies.note(_put_deque, thing, held)
    copies.later(enumerate(held), trail, "[{}]")


def _follow_items(copies: Copying, thing: Iterable[object], trail: Trail) -> None:
    copies.later(enumerate(thing), trail, "[{}]")


def _follow_proxy(copies: Copying, thing: Mapping[object, object], trail: Trail) -> None:
    copies.later(thing.items(), trail, "[{!r}]")


def _follow_array(copies: Copying, thing: np.ndarray[Any, Any], trail: Trail) -> None:
    if isinstance(thing.base, np.ndarray):  # a view: what it looks at is copied once and whole
        copies.later([("base", thing.base)], trail, ".{}")
    elif thing.flags.writeable:
        if thing.dtype.hasobject:
            _refuse(copies, thing, trail)
        copies.note(np.copyto, thing, thing.copy())


def _follow_view(copies: Copying, thing: memoryview, trail: Trail) -> None:
    if isinstance(thing.obj, np.ndarray):
        copies.later([("obj", thing.obj)], trail, ".{}")
        return
    if not thing.c_contiguous:
        _refuse(copies, thing, trail)
    if not thing.readonly:
        copies.note(_put_list, thing.cast("B"), thing.tobytes())


def _follow_generator(copies: Copying, thing: np.random.Generator, _trail: Trail) -> None:
    copies.note(_put_stream, thing.bit_generator, thing.bit_generator.state)


def _follow_function(copies: Copying, thing: types.FunctionType, trail: Trail) -> None:
    """Follow what a function of this package has kept; it is how a listener knows its command."""
    if (thing.__module__ or "").partition(".")[0] != PACKAGE:  # code that was executed has none
        return
    cells = zip(thing.__code__.co_freevars, thing.__closure__ or (), strict=True)
    copies.later(((name, cell.cell_contents) for name, cell in cells), trail, ".{}")
    copies.later(enumerate(thing.__defaults__ or ()), trail, ".default {}")
    copies.later((thing.__kwdefaults__ or {}).items(), trail, ".{}")


def _follow_method(copies: Copying, thing: types.MethodType, trail: Trail) -> None:
    copies.later([("__self__", thing.__self__), ("__func__", thing.__func__)], trail, ".{}")


def _follow_builtin(copies: Copying, thing: types.BuiltinMethodType, trail: Trail) -> None:
    copies.later([("__self__", thing.__self__)], trail, ".{}")


def _follow_partial(copies: Copying, thing: functools.partial[object], trail: Trail) -> None:
    copies.later([("func", thing.func), ("args", thing.args), ("keywords", thing.keywords)], trail, ".{}")


def _put_list(thing: Any, held: object) -> None:  # noqa: ANN401 - anything with a slice
    thing[:] = held


def _put_mapping(thing: dict[object, object] | set[object], held: Any) -> None:  # noqa: ANN401
    thing.clear()
    thing.update(held)


def _put_deque(thing: collections.deque[object], held: tuple[object, ...]) -> None:
    thing.clear()
    thing.extend(held)


def _put_stream(thing: np.random.BitGenerator, held: dict[str, Any]) -> None:
    thing.state = held


ATOMS: Final = frozenset(
    {
        type(None), bool, int, float, complex, str, bytes, range, slice, type(...), type, types.ModuleType,
        BaseException, np.dtype, np.generic, np.ufunc, re.Pattern, weakref.ref, decimal.Decimal, dt.date,
        dt.time, dt.timedelta, dt.tzinfo, types.WrapperDescriptorType, types.MethodDescriptorType, struct.Struct,
    }
)  # fmt: skip
"""What never changes; subclasses do not either."""

_FOLLOWERS: Final[dict[type, Follower]] = {
    list: _follow_list,
    bytearray: lambda copies, thing, _trail: copies.note(_put_list, thing, bytes(thing)),
    dict: _follow_dict,
    set: _follow_set,
    collections.deque: _follow_deque,
    tuple: _follow_items,
    frozenset: _follow_items,
    types.MappingProxyType: _follow_proxy,
    types.SimpleNamespace: _follow_plain,
    np.ndarray: _follow_array,
    memoryview: _follow_view,
    np.random.Generator: _follow_generator,
    random.Random: lambda copies, thing, _trail: copies.note(random.Random.setstate, thing, thing.getstate()),
    types.FunctionType: _follow_function,
    types.MethodType: _follow_method,
    types.BuiltinFunctionType: _follow_builtin,
    functools.partial: _follow_partial,
}
"""How objects of these classes and their subclasses are followed; all others are plain, or refused."""
