"""Notifications: what is sampled when, what is sent together, and what bounds it (ads 2.1, 2.2)."""

import itertools
import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.bench.campaign._ads_device import BEGIN, CYCLE_NS, Device
from motionlayer.connect.ads import Limits
from motionlayer.connect.ads._group import FIRST
from tests.connect.ads_clients import ADD, CYCLIC, DELETE, ON_CHANGE, Talk
from tests.effort import examples


def stamp(tick: int) -> int:
    return BEGIN + tick * CYCLE_NS // 100


def number(value: int) -> bytes:
    return struct.pack("<i", value)


@pytest.fixture
def talk() -> Talk:
    return Talk(Device())


def test_the_first_sample_waits_until_the_client_knows_the_handle(talk: Talk) -> None:
    handle = talk.watch("GVL.Count", 4)
    for _ in range(FIRST - 1):
        talk.device.tick()
        assert talk.samples() == []
    talk.device.tick()
    assert talk.samples() == [(stamp(talk.device.next - 1), handle, number(0))]


def test_on_change_tells_changes_with_the_time_of_their_tick(talk: Talk) -> None:
    handle = talk.watch("GVL.Count", 4, ON_CHANGE)
    talk.device.tick(10)
    talk.samples()
    target = talk.handle("GVL.Count")
    request = struct.pack("<3I", 0xF005, target, 4)
    for value in (5, 5, 6):
        talk.peer.connection.receive(talk.frame(3, request + number(value)))
        talk.device.tick()
    now = talk.device.next
    assert talk.samples() == [(stamp(now - 3), handle, number(5)), (stamp(now - 1), handle, number(6))]


@pytest.mark.parametrize(("cycle", "ticks"), [(0.01, 10), (0.0, 1), (0.000_005, 1), (0.0101, 11)])
def test_cyclic_tells_a_value_every_so_many_ticks(talk: Talk, cycle: float, ticks: int) -> None:
    talk.watch("GVL.Count", 4, CYCLIC, cycle=cycle)
    talk.device.tick(ticks + FIRST)
    talk.samples()
    talk.device.tick(10 * ticks)
    stamps = [when for when, _, _ in talk.samples()]
    assert len(stamps) == 10
    assert {two - one for one, two in itertools.pairwise(stamps)} == {ticks * CYCLE_NS // 100}


def test_looks_that_come_late_do_not_shift_the_grid(talk: Talk) -> None:
    talk.watch("GVL.Count", 4, CYCLIC, cycle=0.01)
    device = talk.device
    device.tick(FIRST + 10)
    talk.samples()
    seen = 0
    for _ in range(20):
        for _ in range(7):  # the server looks at every seventh tick only
            device.inside.publish(device.next)
            device.next += 1
        device.lookout.look()
        seen += len(talk.samples())
    assert seen == 14


def test_samples_that_may_wait_are_sent_together(talk: Talk) -> None:
    talk.watch("GVL.Count", 4, CYCLIC, cycle=0.001, delay=0.010)
    talk.device.tick(FIRST)
    talk.peer.packets()
    counts = []
    for _ in range(40):
        talk.device.tick()
        counts.append(len([packet for packet in talk.peer.packets() if packet.command == 8]))
    assert sum(counts) in (3, 4)


def test_a_held_up_run_tells_changes_and_no_cycles(talk: Talk) -> None:
    changing, cyclic = talk.watch("GVL.Count", 4, ON_CHANGE, cycle=1.0), talk.watch("GVL.Shown", 32, CYCLIC)
    device = talk.device
    device.tick(5)
    talk.samples()
    device.next -= 1  # from now on the same tick is published again and again
    device.symbols.write("GVL.Count", 77, "test")
    for _ in range(5):
        device.tick()
        device.next -= 1
    assert talk.samples() == [(stamp(device.next), changing, number(77))]
    device.next += 1
    device.tick()
    assert [handle for _, handle, _ in talk.samples()] == [cyclic]


def test_a_run_that_begins_anew_goes_on_telling(talk: Talk) -> None:
    handle = talk.watch("GVL.Count", 4, CYCLIC, cycle=0.01)
    talk.device.tick(1000)
    talk.samples()
    talk.device.next = 0
    talk.device.tick(21)
    assert [one[:2] for one in talk.samples()] == [(stamp(tick), handle) for tick in (0, 10, 20)]


def test_bits_states_and_versions_can_be_watched(talk: Talk) -> None:
    bit = talk.watch("GVL.Inners[1].bOther", 1)
    data = [struct.pack("<6I16x", group, 0, length, ON_CHANGE, 0, 0) for group, length in ((0xF100, 4), (0xF008, 1))]
    state, version = (struct.unpack("<II", talk.ask(ADD, one).data)[1] for one in data)
    talk.device.tick(FIRST)
    found = {handle: value for _, handle, value in talk.samples()}
    assert found == {bit: b"\0", state: struct.pack("<HH", 5, 0), version: b"\x01"}
    talk.device.symbols.write("GVL.Inners[1].bOther", value=True, by="test")
    talk.device.tick()
    assert [(handle, value) for _, handle, value in talk.samples()] == [(bit, b"\x01")]


@pytest.mark.parametrize(
    ("length", "mode", "code"), [(4, 1, 0x713), (4, 0, 0x713), (4, 10, 0x713), (5, ON_CHANGE, 0x705), (0, 4, 0x705)]
)
def test_what_cannot_be_watched_is_refused(talk: Talk, length: int, mode: int, code: int) -> None:
    assert talk.result(ADD, talk.order("GVL.Count", length, mode)) == code


@pytest.mark.parametrize(
    ("limits", "code"),
    [(Limits(notifications=2), 0x716), (Limits(all_notifications=2), 0x716), (Limits(watched=10), 0x717)],
)
def test_notifications_are_bounded_and_room_comes_back(limits: Limits, code: int) -> None:
    talk = Talk(Device(limits))
    order = talk.order("GVL.Count", 4)
    first = struct.unpack("<II", talk.ask(ADD, order).data)[1]
    assert talk.result(ADD, order) == 0
    assert talk.result(ADD, order) == code
    assert talk.result(DELETE, struct.pack("<I", first)) == 0
    assert talk.result(ADD, order) == 0


def test_sums_begin_and_end_many(talk: Talk) -> None:
    order = talk.order("GVL.Count", 4)
    bad = struct.pack("<6I16x", 0xDEAD, 0, 4, 4, 0, 0)
    code, data = talk.read_write(0xF085, 3, 24, order + bad + order)
    one, two, three = struct.iter_unpack("<II", data)
    assert (code, one[0], two, three[0]) == (0, 0, (0x702, 0), 0)
    code, data = talk.read_write(0xF086, 3, 12, struct.pack("<3I", one[1], 4711, three[1]))
    assert (code, data) == (0, struct.pack("<3I", 0, 0x714, 0))
    assert len(talk.device.notifications) == 0


EVENTS = st.lists(st.sampled_from(["add", "cyclic", "delete", "write", "tick", "stand", "back"]), max_size=60)


@settings(max_examples=examples(150), deadline=None)
@given(EVENTS)
def test_on_change_never_tells_the_same_twice_and_never_misses_the_last(events: list[str]) -> None:
    talk = Talk(Device())
    device, value = talk.device, 0
    told: dict[int, bytes] = {}
    changing: list[int] = []
    for event in [*events, *["tick"] * (FIRST + 1)]:
        if event in ("add", "cyclic"):
            handle = talk.watch("GVL.Count", 4, ON_CHANGE if event == "add" else CYCLIC)
            changing += [handle] if event == "add" else []
        elif event == "delete" and changing:
            assert talk.result(DELETE, struct.pack("<I", changing.pop(0))) == 0
        elif event == "write":
            value += 1
            device.symbols.write("GVL.Count", value, "test")
        else:
            device.next = {"stand": max(device.next - 1, 0), "back": 0}.get(event, device.next)
            device.tick()
        for _, handle, data in talk.samples():
            if handle in changing:
                assert told.get(handle) != data
                told[handle] = data
    assert {told[handle] for handle in changing} <= {number(value)}
    assert set(changing) <= set(told)
