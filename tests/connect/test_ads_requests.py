"""Requests to a device, packet by packet: answers, errors, sums, limits and access (ads 1 to 4, 6)."""

import ipaddress
import struct

import pytest

from motionlayer.bench.campaign import _ads_device
from motionlayer.bench.campaign._ads_device import Device, declare
from motionlayer.connect.ads import Access, Limits, net_id
from motionlayer.connect.ads._frame import Address, Packet, framed
from motionlayer.iec import LREAL, InputArray, SymbolTable
from tests.connect.ads_clients import CONTROL, DELETE, READ, READ_WRITE, SERVER, STATE, WRITE, Talk

DATA, BITS = 0x4040, 0x4041
U32 = struct.Struct("<I")


@pytest.fixture
def device() -> Device:
    return Device()


@pytest.fixture
def talk(device: Device) -> Talk:
    return Talk(device)


def place(device: Device, name: str) -> int:
    """Return the offset of a symbol in the image."""
    (found,) = (one.start for one in device.inside.places if one.symbol.name == name)
    return found


def test_a_write_is_answered_when_it_can_be_read(device: Device, talk: Talk) -> None:
    handle = talk.handle("GVL.Count")
    request = struct.pack("<3I", 0xF005, handle, 4) + struct.pack("<i", -5)
    talk.peer.connection.receive(talk.frame(WRITE, request))
    assert talk.answers() == []
    assert talk.read(0xF005, handle, 4) == bytes(4)
    device.tick()
    (answer,) = talk.answers()
    assert answer.data == bytes(4)
    assert talk.read(0xF005, handle, 4) == struct.pack("<i", -5)


def test_a_bit_is_written_beside_its_neighbour(device: Device, talk: Talk) -> None:
    flag, other = talk.handle("GVL.Inners[2].bFlag"), talk.handle("gvl.inners[2].BOTHER")
    assert talk.write(0xF005, other, b"\x01") == 0
    assert (talk.read(0xF005, flag, 1), talk.read(0xF005, other, 1)) == (b"\x00", b"\x01")
    assert talk.write(0xF005, flag, b"\x01") == 0
    assert talk.write(0xF005, other, b"\x00") == 0
    assert (talk.read(0xF005, flag, 1), talk.read(0xF005, other, 1)) == (b"\x01", b"\x00")
    at = place(device, "GVL.Inners") + 16
    assert talk.read(BITS, at * 8, 1) == b"\x01"
    assert talk.write(BITS, at * 8 + 1, b"\x01") == 0
    assert talk.read(DATA, at, 1) == b"\x03"


def test_a_structure_is_written_whole_or_not_at_all(device: Device, talk: Talk) -> None:
    handle, size = talk.handle("GVL.Inners[1]"), 16
    assert talk.write(0xF005, handle, bytes(size - 1)) == 0x705
    assert talk.write(0xF005, handle, b"\x01" + bytes(7) + struct.pack("<d", 2.5)) == 0
    inner = device.symbols.read("GVL.Inners[1]")
    assert (inner.flag, inner.value) == (True, 2.5)


@pytest.mark.parametrize(
    ("group", "offset", "length", "code"),
    [
        (0xDEAD, 0, 4, 0x702),
        (DATA, 100_000, 4, 0x703),
        (0xF005, 4711, 4, 0x710),
        (0xF100, 1, 2, 0x703),
        (0xF001, 0, 4, 0x702),
    ],
)
def test_what_cannot_be_read_is_answered_with_its_code(
    talk: Talk, group: int, offset: int, length: int, code: int
) -> None:
    answer = talk.ask(READ, struct.pack("<3I", group, offset, length))
    assert answer.data == struct.pack("<II", code, 0)


@pytest.mark.parametrize(
    ("name", "code"),
    [("GVL.Nothing", 0x710), ("GVL.Inners[4]", 0x721), ("GVL.Inners[", 0x70D), ("GVL.Count.x", 0x710), ("", 0x710)],
)
def test_what_has_no_name_is_answered_with_its_code(talk: Talk, name: str, code: int) -> None:
    for group in (0xF003, 0xF004, 0xF007, 0xF009):
        assert talk.read_write(group, 0, 100, name.encode()) == (code, b"")


def test_only_one_symbol_that_clients_write_can_be_written_by_its_address(device: Device, talk: Talk) -> None:
    shown, count = place(device, "GVL.Shown"), place(device, "GVL.Count")
    assert talk.write(DATA, shown, bytes(8)) == 0x704
    assert talk.write(DATA, count, bytes(4)) == 0
    assert talk.write(DATA, count - 4, bytes(8)) == 0x705
    assert talk.write(0xF005, talk.handle("GVL.Shown[2]"), bytes(8)) == 0x704
    assert len(device.told) == 2
    assert all("127.0.0.1.1.2:30002 at 127.0.0.1" in text and "GVL.Shown" in text for text in device.told)


@pytest.mark.parametrize(
    ("target", "code"),
    [(Address(SERVER.net_id, 4711), 6), (Address(bytes(6), 851), 7), (Address(net_id("9.9.9.9.1.1"), 10_000), 7)],
)
def test_nobody_at_an_address_is_an_error_of_the_header(talk: Talk, target: Address, code: int) -> None:
    answer = talk.ask(STATE, target=target)
    assert (answer.error, answer.data, answer.source) == (code, b"", target)


def test_an_unknown_command_and_a_wrong_length_are_errors_of_the_header(talk: Talk) -> None:
    assert talk.ask(77).error == 8
    raw = bytearray(talk.frame(READ, struct.pack("<3I", DATA, 0, 4)))
    raw[26:30] = U32.pack(400)
    talk.peer.connection.receive(bytes(raw))
    (answer,) = talk.answers()
    assert answer.error == 0x0E


def test_what_wants_no_answer_gets_none(device: Device, talk: Talk) -> None:
    handle = talk.handle("GVL.Count")
    request = struct.pack("<3I", 0xF005, handle, 4) + struct.pack("<i", 9)
    talk.peer.connection.receive(talk.frame(WRITE, request, flags=4 | 2))
    device.tick()
    assert talk.answers() == []
    assert device.symbols.read("GVL.Count") == 9


@pytest.mark.parametrize("command", [0, 1, 2, 3, 4, 5, 6, 7, 9, 10, 11])
def test_a_request_that_is_too_short_is_refused(talk: Talk, command: int) -> None:
    if command in (1, STATE):
        assert talk.result(command) == 0
    else:
        assert talk.result(command, b"\x01") in (0x705, 0x08)


def test_states_are_asked_for_and_refused(device: Device, talk: Talk) -> None:
    system = Address(SERVER.net_id, 10_000)
    assert talk.result(CONTROL, struct.pack("<HHI", 6, 0, 0)) == 0
    assert talk.result(CONTROL, struct.pack("<HHI", 16, 0, 0), system) == 0
    assert talk.result(CONTROL, struct.pack("<HHI", 11, 0, 0), system) == 0x712
    assert device.outbox.controls == [6, 16]
    status = talk.ask(READ, struct.pack("<3I", 0xF0, 0, 16), system).data[8:]
    assert struct.unpack_from("<3H", status) == (5, 0, 1)


def test_a_sum_of_reads_keeps_the_bytes_of_those_that_fail(talk: Talk) -> None:
    handle = talk.handle("GVL.Count")
    talk.write(0xF005, handle, struct.pack("<i", 3))
    heads = struct.pack("<9I", 0xF005, handle, 4, 0xDEAD, 0, 2, 0xF005, handle, 4)
    three = struct.pack("<i", 3)
    assert talk.read_write(0xF080, 3, 100, heads) == (0, struct.pack("<3I", 0, 0x702, 0) + three + bytes(2) + three)
    both = struct.pack("<6I", 0, 4, 0x702, 0, 0, 4)
    assert talk.read_write(0xF083, 3, 100, heads) == (0, both + three + bytes(2) + three)
    assert talk.read_write(0xF084, 3, 100, heads) == (0, both + three + three)
    assert talk.read_write(0xF080, 0, 100, heads) == (0, three + bytes(2) + three)


def test_the_writes_of_a_sum_come_in_one_tick(device: Device, talk: Talk) -> None:
    count, value = talk.handle("GVL.Count"), talk.handle("GVL.Inners[1].rValue")
    data = struct.pack("<6I", 0xF005, count, 4, 0xF005, value, 8) + struct.pack("<id", 8, 1.5)
    request = struct.pack("<4I", 0xF081, 2, 8, len(data)) + data
    talk.peer.connection.receive(talk.frame(READ_WRITE, request))
    assert (device.symbols.read("GVL.Count"), device.symbols.read("GVL.Inners[1].rValue")) == (0, 0.0)
    device.tick()
    (answer,) = talk.answers()
    assert answer.data == struct.pack("<4I", 0, 8, 0, 0)
    assert (device.symbols.read("GVL.Count"), device.symbols.read("GVL.Inners[1].rValue")) == (8, 1.5)


def test_a_sum_of_both_gives_the_lengths_that_came_back(talk: Talk) -> None:
    names = b"GVL.Count", b"GVL.Nothing"
    data = struct.pack("<8I", 0xF003, 0, 4, len(names[0]), 0xF003, 0, 4, len(names[1])) + b"".join(names)
    code, answer = talk.read_write(0xF082, 2, 100, data)
    assert (code, struct.unpack_from("<4I", answer)) == (0, (0, 4, 0x710, 0))
    assert len(answer) == 20


@pytest.mark.parametrize("group", [0xF080, 0xF081, 0xF082, 0xF083, 0xF084, 0xF085, 0xF086])
def test_a_sum_that_says_more_than_it_holds_is_refused(talk: Talk, group: int) -> None:
    assert talk.read_write(group, 1000, 8, bytes(16)) == (0x705, b"")
    assert talk.read_write(group, 0xFFFF_FFFF, 8, bytes(16)) == (0x70B, b"")


@pytest.mark.parametrize(("group", "count"), [(0xF080, 2), (0xF080, 0), (0xF083, 2)])
def test_a_sum_does_not_make_an_answer_of_any_size(talk: Talk, group: int, count: int) -> None:
    heads = struct.pack("<6I", DATA, 0, 0xFFFF_FFFF, DATA, 0, 0xFFFF_FFFF)
    assert talk.read_write(group, count, 8, heads) == (0x705, b"")


def test_a_sum_of_large_symbols_is_cut_off() -> None:
    talk = Talk(Device())
    count = 10_000
    heads = struct.pack("<3I", 0xF00E, 0, 0xFFFF_FFFF) * count
    assert talk.read_write(0xF084, count, 8, heads) == (0x705, b"")


@pytest.mark.parametrize(("group", "count"), [(0xF080, 2700), (0xF080, 0), (0xF083, 2700), (0xF084, 2700)])
def test_a_sum_of_the_same_bytes_again_and_again_is_cut_off(
    monkeypatch: pytest.MonkeyPatch, group: int, count: int
) -> None:
    def with_many(symbols: SymbolTable) -> None:
        declare(symbols)
        symbols.add("GVL.Many", InputArray(LREAL, 1, 500, "GVL.Many"))

    monkeypatch.setattr(_ads_device, "declare", with_many)
    talk = Talk(Device())
    heads = struct.pack("<3I", DATA, 0, 4000)
    assert talk.read_write(group, 10 if count else 0, 8, heads * 10)[0] == 0
    assert talk.read_write(group, count, 8, heads * 2700) == (0x705, b"")


def test_a_client_that_is_gone_holds_nothing(device: Device, talk: Talk) -> None:
    talk.watch("GVL.Count", 4)
    talk.peer.connection.receive(framed(struct.pack("<H", 0), 0x1000))
    assert device.router.held() == 2
    talk.peer.connection.closed()
    assert device.router.held() == len(device.notifications) == 0
    device.tick(5)
    assert talk.peer.received.count(b"") > 0


def test_ports_are_given_once_and_freed() -> None:
    device = Device()
    one, two = Talk(device), Talk(device)
    wanted = framed(struct.pack("<H", 0), 0x1000)
    one.peer.connection.receive(wanted)
    two.peer.connection.receive(wanted)
    got = [struct.unpack_from("<H", peer.received, 12)[0] for peer in (one.peer, two.peer)]
    assert got[0] != got[1]
    assert min(got) >= 32768
    three = Talk(device)
    three.peer.connection.receive(framed(struct.pack("<H", got[0]), 0x1000))
    assert three.peer.connection.closing
    one.peer.connection.closed()
    four = Talk(device)
    four.peer.connection.receive(framed(struct.pack("<H", got[0]), 0x1000))
    assert not four.peer.connection.closing
    four.peer.connection.receive(framed(b"", 1))
    assert four.peer.connection.closing


@pytest.mark.parametrize(("limits", "name"), [(Limits(handles=2), "GVL.Count"), (Limits(all_handles=2), "GVL.Count")])
def test_handles_are_bounded(limits: Limits, name: str) -> None:
    device = Device(limits)
    talk = Talk(device)
    for _ in range(2):
        talk.handle(name)
    assert talk.read_write(0xF003, 0, 4, name.encode()) == (0x716, b"")
    assert "handles" in device.told[0]
    assert talk.write(0xF006, 0, U32.pack(1)) == 0
    assert talk.handle(name) == 3


def test_addresses_of_a_connection_are_bounded() -> None:
    device = Device(Limits(addresses=3))
    talk = Talk(device)
    errors = []
    for port in range(5):
        packet = Packet(SERVER, Address(talk.source.net_id, port), STATE, 4, 0, port, b"")
        talk.peer.connection.receive(framed(packet.pack()))
        errors += [answer.error for answer in talk.answers()]
    assert errors == [0, 0, 0, 0x19, 0x19]


def test_requests_that_wait_are_bounded() -> None:
    device = Device(Limits(waiting=3))
    talk = Talk(device)
    handle = talk.handle("GVL.Count")
    request = struct.pack("<3I", 0xF005, handle, 4) + bytes(4)
    for _ in range(5):
        talk.peer.connection.receive(talk.frame(WRITE, request))
    assert [U32.unpack(answer.data)[0] for answer in talk.answers()] == [0x502, 0x502]
    device.tick()
    assert [U32.unpack(answer.data)[0] for answer in talk.answers()] == [0, 0, 0]


def test_a_reader_may_read_and_nothing_else() -> None:
    device = Device(access=Access(read_only=frozenset({net_id("127.0.0.1.1.2")})))
    reader, writer = Talk(device, 2), Talk(device, 3)
    handle = reader.handle("GVL.Count")
    assert reader.read(0xF005, handle, 4) == bytes(4)
    assert reader.write(0xF005, handle, bytes(4)) == 0x704
    assert reader.result(CONTROL, struct.pack("<HHI", 6, 0, 0)) == 0x704
    data = struct.pack("<3I", 0xF005, handle, 4) + bytes(4)
    assert reader.read_write(0xF081, 1, 4, data) == (0, U32.pack(0x704))
    assert writer.write(0xF005, handle, bytes(4)) == 0
    assert device.outbox.controls == []
    assert any("may only read" in text for text in device.told)


def test_net_ids_that_are_not_named_are_refused() -> None:
    device = Device(access=Access(net_ids=frozenset({net_id("127.0.0.1.1.2")})))
    assert Talk(device, 2).ask(STATE).error == 0
    assert Talk(device, 3).ask(STATE).error == 7
    assert "its NetId is not among" in device.told[0]


@pytest.mark.parametrize(
    ("host", "admitted"),
    [("127.0.0.1", True), ("::1", True), ("192.168.1.7", True), ("192.168.2.7", False), ("::ffff:192.168.1.7", True)],
)
def test_hosts_are_let_in_by_name(host: str, admitted: bool) -> None:
    access = Access((ipaddress.ip_network("192.168.1.0/24"),))
    assert access.admits(host) is admitted
    assert Access().admits(host) is (host in {"127.0.0.1", "::1"})


def test_only_a_connection_that_leaves_a_frame_half_sent_is_stuck(talk: Talk) -> None:
    connection = talk.peer.connection
    assert not any(connection.stuck() for _ in range(3))  # a client may be quiet for as long as it likes
    whole = talk.frame(STATE)
    connection.receive(whole)
    assert not any(connection.stuck() for _ in range(3))
    connection.receive(whole[:10])
    assert not connection.stuck()  # it may have begun a moment ago
    connection.receive(whole[10:] + whole[:10])
    assert not connection.stuck()  # that is another frame
    assert connection.stuck()
    connection.receive(whole[10:])
    assert not connection.stuck()


def test_answers_that_nobody_takes_end_at_once(talk: Talk) -> None:
    sent = 0

    def full(data: bytes) -> None:
        nonlocal sent
        sent += len(data)
        talk.peer.connection.broken = sent > 100_000

    talk.peer.connection._send = full
    request = talk.frame(READ, struct.pack("<3I", 0xF00E, 0, 0xFFFF_FFFF))
    talk.peer.connection.receive(request * 5000)
    assert 100_000 < sent < 300_000


def test_a_notification_of_nobody_is_not_deleted(talk: Talk) -> None:
    assert talk.result(DELETE, U32.pack(4711)) == 0x714
    other = Talk(talk.device, 5)
    handle = other.watch("GVL.Count", 4)
    assert talk.result(DELETE, U32.pack(handle)) == 0x714
    assert other.result(DELETE, U32.pack(handle)) == 0


def told(device: Device, part: str) -> int:
    return sum(part in text for text in device.told)


def test_what_a_sum_refuses_is_logged_part_by_part() -> None:
    reader = Talk(Device(access=Access(read_only=frozenset({net_id("127.0.0.1.1.2")}))))
    handle = reader.handle("GVL.Count")
    code, answer = reader.read_write(0xF081, 2, 8, struct.pack("<6I", *(0xF005, handle, 4) * 2) + bytes(8))
    assert (code, struct.unpack("<2I", answer)) == (0, (0x704, 0x704))
    assert told(reader.device, "127.0.0.1.1.2:30002 at 127.0.0.1 may only read") == 2


def test_notifications_that_a_sum_refuses_are_logged() -> None:
    narrow = Talk(Device(Limits(watched=4)))
    orders = narrow.order("GVL.Count", 4) * 2
    code, answer = narrow.read_write(0xF085, 2, 16, orders)
    assert code == 0
    assert struct.unpack("<4I", answer)[::2] == (0, 0x717)
    assert told(narrow.device, "watch size (0x717)") == 1


def test_too_many_addresses_and_a_port_that_is_taken_are_logged() -> None:
    device = Device(Limits(addresses=1))
    one, peer = Talk(device), device.connect()
    assert one.result(STATE) == 0
    one.source = one.source._replace(port=31_000)
    assert one.result(STATE) == 0x19
    peer.connection.receive(framed(struct.pack("<H", 851), 0x1000))
    assert peer.connection.closing
    assert told(device, "too many addresses on one connection") == 1
    assert told(device, "AMS port 851 is taken") == 1
