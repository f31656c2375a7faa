"""What was published between two looks of a reader: kept where it is watched, for as long as it was promised."""

from collections.abc import Iterator

from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.runtime import GRAIN, History
from tests.effort import examples

SIZE = 5 * GRAIN - 100
DEPTH = 8


class Pair:
    """A writer and a reader of the same memory, each with its own view of it."""

    def __init__(self) -> None:
        block = bytearray(History.size_of(SIZE, DEPTH))
        self.writer = History(memoryview(block), SIZE, DEPTH)
        self.reader = History(memoryview(block), SIZE, DEPTH)
        self.image = memoryview(bytearray(SIZE))
        self.count = 0

    def publish(self) -> None:
        """Publish bytes that tell their number; the tick is ten times that."""
        self.count += 1
        self.writer.keep(self.count, 10 * self.count, memoryview(bytes([self.count % 256]) * SIZE))

    def watch(self, *grains: int, watched: bool = True) -> int:
        self.reader.mark(grains, watched=watched)
        return self.reader.version


def test_what_nobody_watches_is_not_kept() -> None:
    pair = Pair()
    pair.publish()
    assert pair.reader.tick(1) is None
    assert pair.reader.read(1, pair.image) is None


def test_watched_grains_are_kept_and_no_others() -> None:
    pair = Pair()
    version = pair.watch(1, 4)
    pair.publish()
    assert pair.reader.tick(1) == 10
    assert pair.reader.read(1, pair.image) == version
    whole = bytes(pair.image)
    assert whole[GRAIN : 2 * GRAIN] == b"\1" * GRAIN
    assert whole[4 * GRAIN :] == b"\1" * (SIZE - 4 * GRAIN)
    assert not any(whole[:GRAIN])
    assert not any(whole[2 * GRAIN : 4 * GRAIN])


def test_what_is_watched_later_is_in_publications_of_its_version_only() -> None:
    pair = Pair()
    first = pair.watch(0)
    pair.publish()
    second = pair.watch(3)
    pair.publish()
    assert [pair.reader.read(count, pair.image) for count in (1, 2)] == [first, second]
    third = pair.watch(0, watched=False)
    pair.publish()
    assert pair.reader.read(3, pair.image) == third > second > first
    assert bytes(pair.image[3 * GRAIN : 4 * GRAIN]) == b"\3" * GRAIN
    assert bytes(pair.image[:GRAIN]) == b"\2" * GRAIN


def test_a_publication_that_is_overwritten_while_it_is_read_is_noticed() -> None:
    pair = Pair()
    pair.watch(0, 2)

    class Disturbing(list[slice]):
        def __iter__(self) -> Iterator[slice]:
            yield slice(0, GRAIN)
            for _ in range(DEPTH):
                pair.publish()
            yield slice(2 * GRAIN, 3 * GRAIN)

    pair.publish()
    pair.reader._runs = Disturbing()
    assert pair.reader.read(1, pair.image) is None


@settings(max_examples=examples(200), deadline=None)
@given(st.lists(st.integers(0, 2 * DEPTH), max_size=20))
def test_a_reader_finds_all_that_came_since_its_last_look_up_to_the_depth(bursts: list[int]) -> None:
    pair = Pair()
    pair.watch(0)
    seen = 0
    for burst in bursts:
        for _ in range(burst):
            pair.publish()
        for count in range(seen + 1, pair.count + 1):
            version = pair.reader.read(count, pair.image)
            assert (version is not None) == (count > pair.count - DEPTH)
            if version is not None:
                assert (pair.reader.tick(count), pair.image[0]) == (10 * count, count % 256)
        seen = pair.count
