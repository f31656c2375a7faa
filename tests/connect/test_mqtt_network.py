"""A network of MQTT topics without a broker: what is answered, to whom, and what is held for how long."""

import struct
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from motionlayer.bench.campaign._ads_device import BEGIN, Device
from motionlayer.connect.ads import Access, Limits, net_id
from motionlayer.connect.ads._frame import Address, Packet
from motionlayer.connect.ads._mqtt import Membership
from motionlayer.connect.ads._mqtt_network import Network, info, is_online
from motionlayer.connect.ads._plan import Mqtt
from tests.connect.ads_clients import ADD, CYCLIC, READ, READ_WRITE, SERVER, STATE, WRITE, samples

NETWORK = "Plant/Hall"
REQUESTS = f"{NETWORK}/127.0.0.1.1.1/ams"


class Members:
    """Clients of a network without a broker."""

    def __init__(self, limits: Limits = Limits(), access: Access = Access()) -> None:  # noqa: B008 - frozen
        self.device = Device(limits, access)
        self.published: list[tuple[str, bytes]] = []
        self.network = Network(NETWORK, self.device.router, lambda *one: self.published.append(one))

    def send(
        self, number: int, command: int, data: bytes = b"", target: Address = SERVER, port: int = 40_000, flags: int = 4
    ) -> None:
        packet = Packet(target, Address(net_id(f"1.1.1.1.1.{number}"), port), command, flags, 0, 77, data)
        assert self.network.take(REQUESTS, packet.pack())

    def ask(self, number: int, command: int, data: bytes = b"", **fields: Any) -> Packet:
        """Send a request, let a tick pass, and return the answer."""
        self.published.clear()
        self.send(number, command, data, **fields)
        self.device.tick()
        answers = [(topic, Packet.parse(raw)) for topic, raw in self.published]
        ((topic, answer),) = [(topic, one) for topic, one in answers if one is not None and one.command != 8]
        assert topic == f"{NETWORK}/1.1.1.1.1.{number}/ams/res"
        assert answer.invoke_id == 77
        return answer

    def handle(self, number: int, name: str, port: int = 40_000) -> int:
        data = struct.pack("<4I", 0xF003, 0, 4, len(name)) + name.encode()
        return int.from_bytes(self.ask(number, READ_WRITE, data, port=port).data[8:], "little")

    def samples(self, number: int) -> list[tuple[int, int, bytes]]:
        packets = [Packet.parse(raw) for topic, raw in self.published if topic.endswith(f".{number}/ams/res")]
        return [one for packet in packets if packet is not None and packet.command == 8 for one in samples(packet.data)]


def test_requests_come_as_bare_packets_and_are_answered_on_the_topic_of_who_asks() -> None:
    members = Members()
    assert members.ask(2, STATE).data == struct.pack("<IHH", 0, 5, 0)
    handle = members.handle(2, "GVL.Count")
    assert members.ask(2, WRITE, struct.pack("<3Ii", 0xF005, handle, 4, 9)).data[:4] == bytes(4)
    assert members.ask(2, READ, struct.pack("<3I", 0xF005, handle, 4)).data[8:] == struct.pack("<i", 9)


def test_a_packet_for_another_net_id_finds_nobody_here() -> None:
    assert Members().ask(2, STATE, target=Address(net_id("5.5.5.5.1.1"), 851)).error == 7


def test_what_is_no_request_is_not_answered() -> None:
    members = Members()
    members.send(2, STATE, flags=5)
    members.send(2, STATE, flags=6)
    assert members.network.take(REQUESTS, b"short")
    assert members.network.take(f"{NETWORK}/here/info", info("x", online=False))
    assert members.published == []


def test_who_goes_offline_releases_what_it_held_and_nobody_else_does() -> None:
    members = Members()
    for number in (2, 3):
        order = struct.pack("<6I16x", 0xF005, members.handle(number, "GVL.Shown"), 32, CYCLIC, 0, 0)
        assert members.ask(number, ADD, order).data[:4] == bytes(4)
    members.device.tick(5)
    assert members.samples(2)
    members.network.take(f"{NETWORK}/1.1.1.1.1.2/info", info("two", online=False))
    members.published.clear()
    members.device.tick(5)
    assert members.samples(2) == []
    stamps = [stamp for stamp, _, _ in members.samples(3)]
    assert stamps == [BEGIN + 10_000 * tick for tick in range(members.device.next - 5, members.device.next)]
    assert len(members.device.notifications) == 1
    members.network.close()
    assert len(members.device.notifications) == 0


def test_there_is_room_for_new_clients_as_long_as_one_holds_nothing() -> None:
    members = Members(Limits(connections=3))
    for port in range(40_000, 40_010):
        assert members.ask(2, STATE, port=port).error == 0
    for number in (2, 3, 4):
        members.handle(number, "GVL.Count")
    assert members.ask(5, STATE).error == 0x19
    assert members.device.told == ["1.1.1.1.1.5:40000 at MQTT: too many clients"]
    members.network.take(f"{NETWORK}/1.1.1.1.1.3/info", info("three", online=False))
    assert members.ask(5, STATE).error == 0


def test_access_is_by_net_id() -> None:
    members = Members(access=Access(net_ids=frozenset({net_id("1.1.1.1.1.2")})))
    assert members.ask(2, STATE).error == 0
    assert members.ask(3, STATE).error == 7


def test_the_late_will_of_an_earlier_connection_is_contradicted() -> None:
    network = Members().network
    assert not network.take(network.info, info("we", online=False))
    assert network.take(network.info, info("we", online=True))


def test_info_says_who_is_there() -> None:
    payload = info('a "b" <c>', online=True)
    assert is_online(payload) is True
    assert b"<c>" not in payload
    assert is_online(info("", online=False)) is False
    assert is_online(b"<info><online>perhaps</online></info>") is None


@given(st.binary(max_size=200), st.integers(0, 0xFFFF), st.integers(0, 0xFFFF))
def test_nothing_that_is_published_disturbs_the_others(data: bytes, command: int, flags: int) -> None:
    members = Members()
    members.network.take(REQUESTS, data)
    members.network.take(f"{NETWORK}/{data.hex()}/info", data)
    members.send(2, command, data, flags=flags)
    members.device.tick()
    assert members.ask(3, STATE).error == 0


def test_answers_that_the_broker_does_not_take_are_lost_and_told() -> None:
    device = Device(Limits(unsent=1000))
    member = Membership(Mqtt("broker", 1883, NETWORK, "m"), device.router)
    member._connected = True
    for _ in range(3):
        member._put("topic", bytes(400))
    assert len(member._outgoing) == 2
    assert device.told == [
        "MQTT broker broker:1883: takes nothing that is sent to it; 400 bytes for topic are lost",
    ]
