"""Copies that are put back in place: values, identities, sharing; and what is refused."""

import functools
import itertools
import pickle
import random
import threading
from collections import OrderedDict, defaultdict, deque
from dataclasses import dataclass
from types import MappingProxyType, SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.command import Command, all_of
from motionlayer.event import Level
from motionlayer.runtime import NotCopyable
from motionlayer.runtime.copying import Copies
from tests.effort import examples


class Node:
    """An object with a dictionary and slots."""

    __slots__ = ("__dict__", "first", "second")
    first: object


class Loud:
    """One that guards its attributes."""

    __slots__ = ("held",)
    held: list[int]

    def __init__(self) -> None:
        object.__setattr__(self, "held", [1])

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(name)


@dataclass(frozen=True, slots=True)
class Frozen:
    """One that is frozen, with something in it that is not."""

    inside: list[int]


class Named(list[int]):
    """A list with attributes."""

    name = "class"


class Garden:
    """Objects that refer to one another at random, cycles included, and ways to change them."""

    def __init__(self, seed: int, count: int = 12) -> None:
        self.random = random.Random(seed)
        self.things: list[Any] = [self.make(kind) for kind in itertools.islice(itertools.cycle(range(7)), count)]
        for _ in range(4 * count):
            self.change()

    def make(self, kind: int) -> object:
        makers = (list, dict, deque, Node, SimpleNamespace, lambda: np.arange(4.0), lambda: bytearray(b"abcd"))
        return makers[kind]()

    def anything(self) -> object:
        pick = self.random.choice
        return pick((pick(self.things), self.random.random(), "text", (pick(self.things), 3), Level.INFO))

    def change(self) -> None:
        thing, value, number = self.random.choice(self.things), self.anything(), self.random.randrange(4)
        if isinstance(thing, (list, deque)):
            thing.append(value) if len(thing) < 6 else thing.clear()
        elif isinstance(thing, dict):
            thing[number] = value
            if len(thing) > 3:
                del thing[number]
        elif isinstance(thing, np.ndarray):
            thing[number] += 1.0
        elif isinstance(thing, bytearray):
            thing[number] = number * 17
        else:
            name = ("first", "second", "third", "fourth")[number]
            if hasattr(thing, name) and self.random.random() < 0.3:
                delattr(thing, name)
            else:
                setattr(thing, name, value)


@settings(deadline=None, max_examples=examples(60))
@given(st.integers(0, 10**9))
def test_any_graph_of_objects_comes_back_with_its_identities(seed: int) -> None:
    garden = Garden(seed)
    roots, kept = garden.things, list(garden.things)
    before = pickle.dumps(roots)
    copies = Copies([("roots", roots)], ())
    for _ in range(3):
        for _ in range(40):
            garden.change()
        roots.reverse()
        roots.append(object)
        copies.put_back()
        assert all(one is other for one, other in zip(roots, kept, strict=True))
        assert pickle.dumps(roots) == before  # pickle tells sharing from equality


def changed_and_back(thing: Any, change: Any) -> None:
    copies = Copies([("thing", thing)], ())
    change(thing)
    copies.put_back()


def test_slots_that_were_empty_are_empty_again() -> None:
    node = Node()
    node.first = 1

    def change(node: Any) -> None:
        del node.first
        node.second, node.more = 2, 3

    changed_and_back(node, change)
    assert (node.first, hasattr(node, "second"), vars(node)) == (1, False, {})


def test_what_guards_its_attributes_is_followed() -> None:
    loud, frozen = Loud(), Frozen([1])
    changed_and_back((loud, frozen), lambda both: (both[0].held.append(2), both[1].inside.clear()))
    assert (loud.held, frozen.inside) == ([1], [1])


def test_subclasses_of_containers_keep_both_parts() -> None:
    named, ordered, lists = Named([3]), OrderedDict(a=1, b=2), defaultdict(list, {"x": [1]})
    named.name = "mine"

    def change(_: object) -> None:
        named.append(4)
        named.name = "other"
        ordered.move_to_end("a")
        lists["y"].append(2)
        lists["x"].append(2)

    changed_and_back([named, ordered, lists], change)
    assert (list(named), named.name) == ([3], "mine")
    assert list(ordered) == ["a", "b"]
    assert lists == {"x": [1]}
    assert lists["new"] == []


def test_arrays_and_their_views_are_one() -> None:
    whole = np.arange(12.0).reshape(3, 4)
    views = whole[1], whole.T, whole[:, ::2], whole.view(np.uint64)
    copies = Copies([("views", views)], ())
    assert len(copies) == 1
    whole[...] = -1.0
    copies.put_back()
    assert (whole == np.arange(12.0).reshape(3, 4)).all()
    frozen = np.zeros(3)
    frozen.flags.writeable = False
    assert len(Copies([("frozen", [frozen])], ())) == 1  # the list


def test_memory_that_is_shared_comes_back() -> None:
    memory = memoryview(bytearray(b"\1\2\3\4\5\6\7\0" * 2))
    numbers = memory.cast("d")
    copies = Copies([("numbers", [numbers, memory.toreadonly()])], ())
    numbers[1] = 3.5
    copies.put_back()
    assert bytes(memory) == b"\1\2\3\4\5\6\7\0" * 2


def test_a_column_of_an_array_seen_as_memory_is_copied_with_the_array() -> None:
    table = np.arange(12.0).reshape(3, 4)
    column: Any = table[:, 1].data
    copies = Copies([("columns", [column, table[:, 2].data])], ())
    column[2] = 3.5
    table[0] = -1.0
    copies.put_back()
    assert (table == np.arange(12.0).reshape(3, 4)).all()


@pytest.mark.parametrize(
    "stream", [np.random.default_rng(1), random.Random(1), np.random.Generator(np.random.MT19937(1))]
)
def test_random_streams_go_on_from_where_they_were(stream: Any) -> None:
    stream.random()
    copies = Copies([("stream", stream)], ())
    drawn = [stream.random() for _ in range(700)]
    copies.put_back()
    assert [stream.random() for _ in range(700)] == drawn


def test_what_the_package_keeps_in_closures_is_followed_and_what_users_keep_is_not() -> None:
    first, second = Command[None]("first"), Command[None]("second")
    whole, log = all_of(first, second), list[str]()
    first.on_end(lambda: log.append("ended"))
    copies = Copies([("first", first)], ())
    first.finish(None)
    assert log == ["ended"]
    copies.put_back()
    assert (first.busy, whole.busy, log) == (True, True, ["ended"])
    first.abort()
    assert whole.aborted
    copies.put_back()
    assert (first.busy, whole.busy) == (True, True)


def test_methods_and_partials_lead_to_their_objects() -> None:
    one, two, three = [1], {"a": 1}, Node()
    roots = [one.append, functools.partial(print, two), MappingProxyType({"node": three}), frozenset({(1, 2)}), {1, 2}]
    copies = Copies([("roots", roots)], ())
    one.append(2)
    two.clear()
    three.first = 5
    roots[-1].add(9)  # type: ignore[attr-defined]
    copies.put_back()
    assert (one, two, hasattr(three, "first"), roots[-1]) == ([1], {"a": 1}, False, {1, 2})


def test_what_is_pinned_or_settled_is_left_alone() -> None:
    pinned, settled, node = [1], Node(), Node()
    settled.first = "before"
    node.first = (pinned, settled)
    copies = Copies([("node", node)], [pinned], lambda thing: thing is settled)
    pinned.append(2)
    settled.first = "after"
    copies.put_back()
    assert (pinned, settled.first) == ([1, 2], "after")


def generator() -> Any:
    yield


class Described:
    """One that says of itself and of what it holds that it never changes."""

    UNCHANGING = True

    def __init__(self) -> None:
        self.held = [1]


def test_what_says_that_it_never_changes_is_left_alone() -> None:
    described, changing = Described(), [1]
    copies = Copies([("root", [described, changing])], [])
    described.held.append(2)
    changing.append(2)
    copies.put_back()
    assert (described.held, changing) == ([1, 2], [1])


class Holds:
    """A user's class with something that cannot be seen."""

    def __init__(self) -> None:
        self.lock = threading.Lock()


@pytest.mark.parametrize(
    ("thing", "path"),
    [
        (lambda: {"a": [0, generator()]}, r"root\['a'\]\[1\] is a generator,"),
        (lambda: [itertools.count()], r"root\[0\] is a itertools.count,"),
        (Holds, r"root.lock is a _thread.lock,"),
        (lambda: np.array([[]], dtype=object), r"root is a numpy.ndarray,"),
        (lambda: memoryview(bytes(8))[::2], r"root is a memoryview,"),
        (threading.local, r"root is a _thread._local,"),
    ],
)
def test_what_cannot_be_seen_is_refused_by_its_path(thing: Any, path: str) -> None:
    with pytest.raises(
        NotCopyable, match=rf"^{path} which cannot be copied; keep it in a global or a closure instead$"
    ):
        Copies([("root", thing())], ())


def test_a_long_chain_is_no_matter() -> None:
    first = last = Command[None]("first")
    for number in range(examples(50_000)):
        by = Command[None](f"{number}")
        last.abort(by)
        last = by
    copies = Copies([("first", first)], ())
    last.finish(None)
    copies.put_back()
    assert last.busy
