"""Areas: what programs and the outside see of each other is whole, in order, and of one tick."""

import struct
import threading
import zlib
from collections.abc import Callable
from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.command import Ledger
from motionlayer.event import EventLog, Level
from motionlayer.runtime import Areas, Mailbox, MailboxFull, Receipt, Run, TaskConfig
from motionlayer.runtime._areas import Area
from tests.runtime.bare import bare

SIZE = 100


def packed(number: int) -> bytes:
    """Return a struct of `SIZE` bytes: a number, bytes that follow from it, and a check field over both."""
    body = struct.pack("<q88s", number, bytes((number + index) & 0xFF for index in range(88)))
    return body + struct.pack("<I", zlib.crc32(body))


def unpacked(data: bytes | memoryview) -> int:
    """Return the number of a whole struct, -1 for one of which two were mixed; 0 before the first."""
    number: int = struct.unpack_from("<q", data)[0]
    whole = bytes(data) == (packed(number) if number else bytes(SIZE))
    return number if whole else -1


def areas() -> tuple[Areas, Mailbox, Ledger]:
    ledger = Ledger()
    box = Mailbox(ledger, EventLog())
    return Areas(box, ledger), box, ledger


@settings(deadline=None)
@given(st.lists(st.tuples(st.integers(0, 2), st.binary(min_size=4, max_size=4)), max_size=30))
def test_the_outside_reads_all_areas_as_they_were_at_the_end_of_the_last_tick(writes: list[tuple[int, bytes]]) -> None:
    image, _, _ = areas()
    parts = [image.add(name, 4) for name in "abc"]
    views = [area.claim() for area in parts]
    published, tick = (-1, [bytes(4)] * 3), 0
    for index, data in writes:
        assert [area.read_with_tick() for area in parts] == [(published[0], each) for each in published[1]]
        views[index][:] = data
        assert parts[index].view == data
        if data[0] & 1:  # the end of a tick
            image.publish(tick)
            published, tick = (tick, [bytes(view) for view in views]), tick + 1
    assert [area.read() for area in parts] == published[1]


def test_a_copy_that_was_disturbed_is_made_again() -> None:
    image, _, _ = areas()
    area = image.add("a", 4)
    view = area.claim()
    image.publish(0)
    halves = image._published._halves
    disturbances = [3, 2, 1, 0]

    class Disturbed:
        """A half that is written several times between the look at the counter and the copy."""

        def __init__(self, half: int) -> None:
            self.half = half

        def __getitem__(self, where: slice) -> memoryview:
            for _ in range(disturbances.pop(0) if disturbances else 0):
                begin_next()
            return halves[self.half][where]

        def __setitem__(self, where: slice, data: memoryview) -> None:
            halves[self.half][where] = data

    ticks = iter(range(1, 100))

    def begin_next() -> None:
        tick = next(ticks)
        view[:] = bytes([tick] * 4)
        image.publish(tick)

    image._published._halves = (Disturbed(0), Disturbed(1))  # type: ignore[assignment]
    tick, data = area.read_with_tick()
    # Disturbed thrice and twice: again. Disturbed once: the other half was written, this one is whole.
    assert (tick, data) == (5, bytes([5] * 4))
    assert disturbances == [0]


def test_programs_of_a_tick_see_one_another_at_once_and_the_outside_sees_the_end_of_the_tick() -> None:
    run = bare()
    area = run.areas.add("shared", 8)
    inside, outside = list[int](), list[tuple[int, bytes]]()

    def first(run: Run) -> None:
        struct.pack_into("<q", area.claim(), 0, run.tick + 1)
        outside.append(area.read_with_tick())

    def second(_: Run) -> None:
        inside.append(struct.unpack("<q", area.view)[0])

    run.cyclic(first)
    run.cyclic(second)
    run.step(3)
    assert inside == [1, 2, 3]
    assert outside == [(-1, bytes(8)), (0, struct.pack("<q", 1)), (1, struct.pack("<q", 2))]
    assert area.read_with_tick() == (2, struct.pack("<q", 3))


def test_the_outside_writes_the_whole_area_in_the_next_tick() -> None:
    run = bare()
    area = run.areas.add("setpoint", 2, outside=True)
    seen: list[bytes] = []
    run.cyclic(lambda _: seen.append(bytes(area.view)))
    run.step()
    receipt = area.post(b"ab")
    assert area.read() == bytes(2)
    run.step()
    assert seen == [bytes(2), b"ab"]
    assert receipt.wait(0.0) == 1
    assert area.read_with_tick() == (1, b"ab")


def test_a_recorded_write_of_a_wrong_size_changes_nothing() -> None:
    run = bare()
    area = run.areas.add("setpoint", 2, outside=True)
    receipt = run.mailbox.post(area.channel, b"abc")
    run.step()
    with pytest.raises(ValueError, match="area setpoint: 3 bytes, must be 2: an area is written as a whole"):
        receipt.wait(0.0)
    assert area.read() == bytes(2)
    assert run.events.last(Level.WARNING)


def refusals(outside: Area, inside: Area) -> list[tuple[Callable[[], object], type[Exception], str]]:
    return [
        (outside.claim, PermissionError, "area out belongs to the outside"),
        (lambda: inside.post(bytes(4)), PermissionError, "area in belongs to the programs"),
        (lambda: outside.post(bytes(3)), ValueError, "area out: 3 bytes, must be 4"),
        (lambda: inside.view.__setitem__(0, 1), TypeError, "read-only"),
    ]


@pytest.mark.parametrize("index", range(4))
def test_the_other_side_may_not_write(index: int) -> None:
    image, _, _ = areas()
    call, error, said = refusals(image.add("out", 4, outside=True), image.add("in", 4))[index]
    with pytest.raises(error, match=said):
        call()


def test_an_area_has_one_writer_until_that_ends() -> None:
    run = bare(failed=lambda _: None)
    area = run.areas.add("a", 1)

    def writer(_: Run) -> None:
        area.claim()[0] = 1

    def other(_: Run) -> None:
        area.claim()[0] = 2

    first, refused = run.cyclic(writer), run.cyclic(other)
    run.step()
    assert isinstance(refused.failure, PermissionError)
    assert "area a belongs to program writer" in str(refused.failure)
    assert area.read() == b"\x01"
    first.cancel()
    run.step()
    run.cyclic(other)
    run.step()
    assert area.read() == b"\x02"


def test_what_was_claimed_before_the_programs_is_not_theirs() -> None:
    run = bare(failed=lambda _: None)
    area = run.areas.add("a", 1)
    assert area.claim() is area.claim()

    def writer(_: Run) -> None:
        area.claim()

    program = run.cyclic(writer)
    run.step()
    assert isinstance(program.failure, PermissionError)


@pytest.mark.parametrize(
    ("name", "size", "said"),
    [
        ("", 1, "an area needs a name"),
        ("there", 1, "area 'there': there is one already"),
        ("a", 0, r"area a: size 0 must be a whole number from 1 to 1073741824 \(bytes\)"),
        ("a", 2**31, "must be a whole number"),
        ("a", True, "must be a whole number"),
        ("a", 1.0, "must be a whole number"),
    ],
)
def test_an_area_that_cannot_be_is_refused(name: str, size: int, said: str) -> None:
    image, _, _ = areas()
    image.add("there", 1)
    with pytest.raises(ValueError, match=said):
        image.add(name, size)
    assert list(image) == ["there"]


def test_areas_are_made_in_the_first_tick_at_the_latest() -> None:
    run = bare()

    async def program() -> None:
        run.areas.add("in time", 1)
        await run.sleep(0.0)
        with pytest.raises(RuntimeError, match="area late: areas are made before the end of the first tick"):
            run.areas.add("late", 1)

    run.run(program())
    assert len(run.areas) == 1
    with pytest.raises(KeyError, match="no area 'late'; this run has in time"):
        _ = run.areas["late"]


# The property of the whole: programs at 1, 3 and 10 ticks and two outside writers exchange structs with check fields.


class Exchange:
    """Programs of three tasks, each with an area, and two writers outside, each with one; all read all others.

    Attributes:
        faults: what was torn or out of order.
        seen: the last number that each reader has seen of each area.
    """

    def __init__(self, run: Run, ticks: int) -> None:
        self.run = run
        self.faults: list[str] = []
        self.seen: dict[tuple[str, str], int] = {}
        self.over = threading.Event()
        self.inside = [run.areas.add(f"every {every}", SIZE) for every in (1, 3, 10)]
        self.outside = [run.areas.add(f"outside {index}", SIZE, outside=True) for index in range(2)]
        for area in self.inside:
            run.cyclic(self.program(area), task=area.name, name=area.name)
        self.threads = [threading.Thread(target=self.client, args=(area,), daemon=True) for area in self.outside]
        self.ticks = ticks

    def look(self, reader: str, area: Area, data: bytes | memoryview) -> None:
        """Check what a reader finds in an area: whole, and not older than what it has seen."""
        number, before = unpacked(data), self.seen.get((reader, area.name), 0)
        if not before <= number:
            self.faults.append(f"{reader} found {number} in {area.name} after {before}")
        self.seen[reader, area.name] = number

    def program(self, own: Area) -> Callable[[Run, SimpleNamespace], None]:
        def program(_: Run, memory: SimpleNamespace) -> None:
            memory.count = getattr(memory, "count", 0) + 1
            own.claim()[:] = packed(memory.count)
            for area in (*self.inside, *self.outside):
                if area is not own:
                    self.look(own.name, area, area.view)

        return program

    def client(self, own: Area) -> None:
        """Write without a pause and read the others; at most so many writes under way that none is refused."""
        count, under_way = 0, list[Receipt]()
        while not self.over.is_set():
            count += 1
            under_way.append(own.post(packed(count)))
            if len(under_way) == 100:
                under_way.pop(0).wait()
            for area in (*self.inside, *self.outside):
                self.look(f"reader of {own.name}", area, area.read())

    def play(self) -> None:
        for thread in self.threads:
            thread.start()
        self.run.step(self.ticks)
        self.over.set()
        while any(thread.is_alive() for thread in self.threads):  # they may still wait for a receipt
            self.run.step()


@pytest.mark.parametrize("ticks", [10_000, pytest.param(1_000_000, marks=pytest.mark.slow)])
def test_programs_and_outside_writers_exchange_whole_structs_in_order(ticks: int) -> None:
    run = bare(TaskConfig("every 1"), TaskConfig("every 3", 3), TaskConfig("every 10", 10))
    exchange = Exchange(run, ticks)
    exchange.play()
    assert not exchange.faults, exchange.faults[:5]
    for area, every in zip(exchange.inside, (1, 3, 10), strict=True):
        due = len(range(run.tasks[area.name].phase, run.tick, every))
        assert unpacked(area.read()) == due
    written = [exchange.seen["every 1", area.name] for area in exchange.outside]
    assert all(count > ticks / 1000 for count in written), written
    readers = {reader for reader, _ in exchange.seen}
    assert len(exchange.seen) == 3 * 4 + 2 * 5, readers


def test_the_check_of_the_exchange_finds_what_is_torn() -> None:
    assert unpacked(packed(7)) == 7
    assert unpacked(packed(7)[:50] + packed(8)[50:]) == -1
    assert unpacked(bytes(SIZE)) == 0


def test_a_full_mailbox_reaches_who_writes_an_area() -> None:
    ledger = Ledger()
    image = Areas(Mailbox(ledger, EventLog(), capacity=1), ledger)
    area = image.add("a", 1, outside=True)
    area.post(b"x")
    with pytest.raises(MailboxFull, match=r"channel area\.a"):
        area.post(b"y")


def test_an_area_of_the_outside_tells_whether_anybody_has_written_it() -> None:
    """Zeros that were written are not the zeros of an area that nobody has written."""
    made, box, _ = areas()
    there, own = made.add("there", 4, outside=True), made.add("own", 4)
    own.claim()[:] = b"abcd"

    def written(tick: int) -> list[bool]:
        box.apply(tick)
        return [there.written, own.written]

    assert written(0) == [False, False]
    there.post(bytes(4))
    assert written(1) == [True, False]
