"""One answer, one tick: sums, structures and notifications while the run goes on between any two reads."""

import struct
import tracemalloc
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.bench.campaign._ads_device import BEGIN, CYCLE_NS, Device
from motionlayer.connect.ads._group import FIRST
from motionlayer.runtime import Published
from tests.connect.ads_clients import CYCLIC, ON_CHANGE, Talk
from tests.effort import examples

NAMES = ("GVL.Count", "GVL.All.nDint", "GVL.All.aGrid[1,3]")
"""Variables that all hold the number of the tick."""


def hasty(monkeypatch: pytest.MonkeyPatch) -> Talk:
    """Return a client of a device whose run does a tick after every look at its image."""
    talk = Talk(Device())
    device, whole = talk.device, Published.whole

    def looked(published: Published, *where: slice) -> tuple[int, int, bytes]:
        found = whole(published, *where)
        for name in NAMES:
            device.symbols.write(name, device.next, "test")
        device.inside.publish(device.next)
        device.next += 1
        return found

    monkeypatch.setattr(Published, "whole", looked)
    talk.read(0x4040, 0, 1)  # from now on all variables hold their tick
    return talk


def places(talk: Talk) -> list[tuple[int, int, int]]:
    """Return group, offset and length of the variables."""
    found = (talk.read_write(0xF007, 0, 12, name.encode()) for name in NAMES)
    return [struct.unpack("<3I", data) for _, data in found]


@pytest.mark.parametrize("group", [0xF080, 0xF083, 0xF084])
@pytest.mark.parametrize("broken", [False, True], ids=["known", "with a part that is refused"])
def test_all_parts_of_a_sum_read_are_of_one_tick(monkeypatch: pytest.MonkeyPatch, group: int, broken: bool) -> None:
    talk = hasty(monkeypatch)
    parts = [*places(talk), *((0xF005, talk.handle(name), 4) for name in NAMES)]
    if broken:
        parts.insert(2, (0xDEAD, 0, 0))
    request = b"".join(struct.pack("<3I", *part) for part in parts)
    for _ in range(3):
        code, data = talk.read_write(group, len(parts), 1000, request)
        assert code == 0
        values = struct.unpack("<6i", data[-24:])
        assert len(set(values)) == 1


def test_all_that_a_sum_asks_by_name_is_of_one_tick(monkeypatch: pytest.MonkeyPatch) -> None:
    talk = hasty(monkeypatch)
    request = b"".join(struct.pack("<4I", 0xF004, 0, 4, len(name)) for name in NAMES) + "".join(NAMES).encode()
    code, data = talk.read_write(0xF082, 3, 100, request)
    assert code == 0
    assert len(set(struct.unpack("<3i", data[24:]))) == 1


def test_a_structure_is_of_one_tick(monkeypatch: pytest.MonkeyPatch) -> None:
    talk = hasty(monkeypatch)
    for _ in range(5):
        whole = talk.read(0xF005, talk.handle("GVL.All"), 0xFFFF)
        (_, root, _), *rest = struct.unpack("<3I", talk.read_write(0xF007, 0, 12, b"GVL.All")[1]), *places(talk)[1:]
        values = {whole[at - root : at - root + 4] for _, at, _ in rest}
        assert len(values) == 1


def test_a_handle_that_stands_for_something_else_is_read_anew() -> None:
    talk = Talk(Device())
    talk.device.symbols.write("GVL.Count", 5, "test")
    talk.device.symbols.write("GVL.All.nDint", 6, "test")
    talk.device.tick()
    handles = talk.device.router.services[851]._handles  # type: ignore[attr-defined]

    def value(name: str) -> bytes:
        """Read by a sum whose handle is always the same number."""
        handles._last = 41
        handle = talk.handle(name)
        assert handle == 42
        found = [talk.read_write(0xF080, 1, 8, struct.pack("<3I", 0xF005, handle, 4)) for _ in range(2)]
        assert talk.write(0xF006, 0, struct.pack("<I", handle)) == 0
        assert found[0] == found[1]
        return found[0][1]

    assert [value(name) for name in ("GVL.Count", "GVL.All.nDint")] == [bytes(4) + b"\5\0\0\0", bytes(4) + b"\6\0\0\0"]


PARTS = st.lists(
    st.tuples(st.sampled_from([0x4040, 0x4041, 0xF005, 0xDEAD]), st.integers(0, 500), st.integers(0, 60)), max_size=8
)


@settings(max_examples=examples(150), deadline=None)
@given(PARTS, st.sampled_from([0xF080, 0xF083, 0xF084]))
def test_a_sum_answers_what_its_parts_answer_alone(parts: list[tuple[int, int, int]], group: int) -> None:
    talk = Talk(Device())
    talk.handle("GVL.All")
    expected: list[tuple[int, bytes]] = []
    for part in parts:
        data = talk.ask(2, struct.pack("<3I", *part)).data
        expected.append((struct.unpack_from("<I", data)[0], data[8:]))
    request = b"".join(struct.pack("<3I", *part) for part in parts)
    for _ in range(2):
        code, data = talk.read_write(group, len(parts), 0xFFFF, request)
        assert (code, data) == (0, expected_sum(group, parts, expected))


def expected_sum(group: int, parts: list[tuple[int, int, int]], found: list[tuple[int, bytes]]) -> bytes:
    """Return the answer of a sum by the rule (ads 6); without parts F080 gives the values alone, and there are none."""
    numbers = [code for code, _ in found] if group == 0xF080 else [n for code, data in found for n in (code, len(data))]
    values = [
        data.ljust(0 if group == 0xF084 else size, b"\0") for (_, _, size), (_, data) in zip(parts, found, strict=True)
    ]
    return struct.pack(f"<{len(numbers)}I", *numbers) + b"".join(values)


def test_what_a_client_asks_for_once_is_not_kept_for_ever() -> None:
    talk = Talk(Device())
    tracemalloc.start()
    try:
        before, _ = tracemalloc.get_traced_memory()
        for start in range(30):  # sums as long as those that are kept, each another one
            assert talk.read_write(0xF080, 2700, 8, struct.pack("<3I", 0x4040, start, 4) * 2700)[0] == 0
        grown = tracemalloc.get_traced_memory()[0] - before
    finally:
        tracemalloc.stop()
    assert grown < 3_000_000


def run_on(device: Device, ticks: int) -> None:
    """Let the run go on while the server is kept from looking; all variables hold the number of the tick."""
    for _ in range(ticks):
        for name in NAMES:
            device.symbols.write(name, device.next, "test")
        device.inside.publish(device.next)
        device.next += 1


def tick_of(stamp: int) -> int:
    return (stamp - BEGIN) * 100 // CYCLE_NS


@settings(max_examples=examples(60), deadline=None)
@given(st.lists(st.integers(0, 16), max_size=25), st.integers(1, 5))
def test_a_server_that_looks_late_loses_no_sample(bursts: list[int], cycle: int) -> None:
    talk = Talk(Device())
    device = talk.device
    watched = [talk.watch(name, 4, mode, cycle=cycle * 1e-3) for name in NAMES for mode in (CYCLIC, ON_CHANGE)]
    for _ in range(20):
        run_on(device, 1)
        device.lookout.look()
    begun = talk.samples()
    for burst in bursts:
        run_on(device, burst)
        device.lookout.look()
    found: dict[int, list[int]] = {handle: [] for handle in watched}
    for stamp, handle, value in [*begun, *talk.samples()]:
        assert struct.unpack("<i", value)[0] == tick_of(stamp)  # the value is that of the tick of its stamp
        found[handle].append(tick_of(stamp))
    for ticks in found.values():
        assert ticks[1:] == list(range(ticks[1], device.next, cycle))  # the first one waits for the client instead
    assert device.lookout.lost == 0


def test_what_is_lost_is_counted_and_told() -> None:
    talk = Talk(Device())
    device = talk.device
    talk.watch("GVL.Count", 4, CYCLIC)
    device.tick(10)
    talk.samples()
    depth: Any = device.lookout._history.depth
    run_on(device, depth + 7)
    device.lookout.look()
    assert device.lookout.lost == 7
    assert any("7 publications were overwritten" in text for text in device.told)
    assert [tick_of(stamp) for stamp, _, _ in talk.samples()] == list(range(device.next - depth, device.next))


def test_a_publication_that_was_kept_before_something_was_watched_does_not_show_it() -> None:
    talk = Talk(Device())
    device = talk.device
    handle = talk.watch("GVL.Count", 4, CYCLIC)
    version = device.lookout._history.version
    for _ in range(FIRST):
        device.notifications.wait()
    image = device.image.snapshot().data
    device.notifications.look(5, BEGIN, image, version - 1)  # the run was held up by the system while it published
    assert talk.samples() == []
    device.notifications.look(6, BEGIN, image, version)
    assert [found for _, found, _ in talk.samples()] == [handle]
