"""ADS over MQTT: a run with a real broker between it and its clients."""

import struct
import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest
from examples.communications.ads_mqtt import AdsError, MqttAds

from motionlayer import Simulation, replay
from motionlayer.connect.ads._mqtt_network import info, is_online
from motionlayer.event import Level
from motionlayer.machine import MachineError
from tests.connect.ads_clients import Paced, connected, machine
from tests.connect.broker import broker, free_port

NETWORK = "Plant/Hall"
MOST = 50
"""Notifications of a client."""
SERVER_ID, LAST = "5.1.1.1.1.1", "5.9.9.9.1."


def client(port: int, number: int) -> MqttAds:
    one = MqttAds(("127.0.0.1", port), SERVER_ID, f"{LAST}{number}", NETWORK)
    assert one.online.wait(60.0)
    return one


def handle_of(one: MqttAds, name: str) -> int:
    return int.from_bytes(one.read_write(0xF003, 0, 4, name.encode()), "little")


def add_up(one: MqttAds, axis: int) -> float:
    """Write two values in one sum, and read them in another."""
    handles = [handle_of(one, f"GVL_AXIS.Data[{axis}].{name}") for name in ("rSetPos", "rSetVelo")]
    orders = b"".join(struct.pack("<3I", 0xF005, handle, 8) for handle in handles)
    total = 0.0
    for value in range(20):
        written = one.read_write(0xF081, 2, 8, orders + struct.pack("<2d", value, axis))
        assert written == bytes(8)
        values = struct.unpack("<2d", one.read_write(0xF080, 2, 24, orders)[8:])
        assert values == (value, axis)
        total += sum(values)
    return total


@pytest.fixture(scope="module")
def served() -> Iterator[tuple[Simulation, int]]:
    """A run that goes on, and the port of its broker."""
    port = free_port()
    limits, mqtt = {"notifications": MOST}, {"port": port, "network": NETWORK}
    described = machine(ads={"port": 0, "net_id": SERVER_ID, "limits": limits, "mqtt": mqtt})
    with broker(port), Simulation(described) as run, Paced(run):
        yield run, port


def test_two_clients_read_and_write_at_the_same_time(served: tuple[Simulation, int]) -> None:
    clients = [client(served[1], number) for number in (1, 2)]
    totals: dict[int, float] = {}
    threads = [
        threading.Thread(target=lambda axis=axis, one=one: totals.update({axis: add_up(one, axis)}))
        for axis, one in enumerate(clients, 1)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for one in clients:
        one.close()
    assert totals == {1: 190.0 + 20, 2: 190.0 + 40}


def test_what_is_refused_is_answered_with_its_code(served: tuple[Simulation, int]) -> None:
    one = client(served[1], 3)
    with pytest.raises(AdsError, match="0x710"):
        handle_of(one, "GVL_AXIS.Nothing")
    state = handle_of(one, "GVL_AXIS.State[1]")
    assert one.read_write(0xF081, 1, 4, struct.pack("<3I6x", 0xF005, state, 6)) == struct.pack("<I", 0x704)
    one.close()


def test_every_change_is_notified_with_its_time(served: tuple[Simulation, int]) -> None:
    one = client(served[1], 4)
    handle = handle_of(one, "GVL_AXIS.Data[3].rSetVelo")
    order = struct.pack("<3I", 0xF005, handle, 8)
    got: list[tuple[int, float]] = []
    begun, ended = threading.Event(), threading.Event()

    def sample(stamp: int, value: bytes) -> None:
        got.append((stamp, *struct.unpack("<d", value)))
        begun.set()
        if got[-1][1] == 30.0:
            ended.set()

    watched = one.watch(0xF005, handle, 8, sample)
    assert begun.wait(60.0)
    for value in range(1, 31):
        one.read_write(0xF081, 1, 4, order + struct.pack("<d", value))
    assert ended.wait(60.0)
    one.forget(watched)
    one.close()
    values, stamps = [value for _, value in got], [stamp for stamp, _ in got]
    assert sorted(set(values)) == values
    assert sorted(set(stamps)) == stamps
    assert values[-1] == 30.0


def test_a_client_that_dies_is_missed(served: tuple[Simulation, int]) -> None:
    """Its socket breaks, the broker publishes its will, and the server has room for all its notifications again."""
    one = client(served[1], 5)
    handle = handle_of(one, "GVL_AXIS.State")
    for _ in range(MOST):
        one.watch(0xF005, handle, 18, lambda *_: None)
    with pytest.raises(AdsError, match="0x716"):
        one.watch(0xF005, handle, 18, lambda *_: None)
    connection = one._client.socket()
    assert connection is not None
    one._client.loop_stop()
    connection.close()
    again, deadline = client(served[1], 5), time.monotonic() + 60.0
    handle = handle_of(again, "GVL_AXIS.State")
    watches = 0
    while watches < MOST:
        try:
            again.watch(0xF005, handle, 18, lambda *_: None)
            watches += 1
        except AdsError:  # until the will has come
            assert time.monotonic() < deadline
    again.close()


def test_a_server_that_is_said_to_be_gone_says_that_it_is_not(served: tuple[Simulation, int]) -> None:
    """So does the will of its own connection before, when the broker notices late that this one is dead."""
    one, said = client(served[1], 6), []
    again = threading.Event()

    def received(_client: object, _data: object, message: Any) -> None:
        said.append(is_online(message.payload))
        if said[-2:] == [False, True]:
            again.set()

    one._client.on_message = received
    one._client.publish(f"{NETWORK}/{SERVER_ID}/info", info("a stranger", online=False), 1, retain=True)
    assert again.wait(60.0)
    one.close()


@pytest.mark.slow
def test_notifications_go_on_after_a_restart_of_the_broker() -> None:
    port = free_port()
    described = machine(ads={"port": 0, "net_id": SERVER_ID, "mqtt": {"port": port, "network": NETWORK}})
    got: list[float] = []
    came = threading.Event()

    def sample(_stamp: int, value: bytes) -> None:
        got.extend(struct.unpack("<d", value))
        came.set()

    with Simulation(described) as run, Paced(run):
        with broker(port):
            one = client(port, 7)
            order = 0xF005, handle_of(one, "GVL_AXIS.Data[1].rSetVelo"), 8
            one.watch(*order, sample)
            assert came.wait(60.0)
        one.online.clear()
        with broker(port):
            assert one.online.wait(60.0)
            came.clear()
            one.read_write(0xF081, 1, 4, struct.pack("<3Id", *order, 5.0))
            assert came.wait(60.0)
            one.close()
    assert got == [0.0, 5.0]
    repeated = replay(run.trace, [])
    assert repeated.same, repeated.difference


@pytest.mark.slow
def test_after_a_restart_of_the_broker_all_goes_on() -> None:
    port = free_port()
    mqtt = {"port": port, "network": NETWORK}
    with Simulation(machine(ads={"port": 0, "net_id": SERVER_ID, "mqtt": mqtt})) as run, Paced(run):
        for number in range(2):
            with broker(port):
                one = client(port, 7)
                assert add_up(one, 1 + number) == 190.0 + 20 * (1 + number)
                one.close()
        texts = [event.text for event in run.events.ring if event.level is Level.WARNING]
    assert 1 <= len(texts) <= 3  # it is told when the broker is missed, and not at every attempt
    assert all(f"MQTT broker 127.0.0.1:{port}: " in text and "trying again" in text for text in texts)


@pytest.mark.parametrize("network", ["", "a/+", "#", "/a", "a//b", "$SYS"])
def test_a_name_that_is_no_beginning_of_topics_is_refused(network: str) -> None:
    with pytest.raises(MachineError, match=r"ads\.mqtt\.network"):
        machine(ads={"mqtt": {"network": network}})


def test_a_broker_that_is_not_there_holds_nobody_up() -> None:
    mqtt = {"port": free_port()}
    with Simulation(machine(ads={"port": 0, "mqtt": mqtt})) as run, Paced(run):
        deadline = time.monotonic() + 60.0
        while not any("trying again" in event.text for event in tuple(run.events.ring)):
            assert time.monotonic() < deadline
        with connected(run.ads.port) as plc:
            assert plc.read_state() == (5, 0)


def test_user_and_password_come_from_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    port, login = free_port(), ("cell", "secret 7")
    described = machine(ads={"port": 0, "net_id": SERVER_ID, "mqtt": {"port": port, "network": NETWORK}})
    with broker(port, *login):
        monkeypatch.setenv("MOTIONLAYER_MQTT_USER", login[0])
        monkeypatch.setenv("MOTIONLAYER_MQTT_PASSWORD", "wrong")
        with Simulation(described) as run, Paced(run):
            deadline = time.monotonic() + 60.0
            while not any("Not authorized; trying again" in event.text for event in tuple(run.events.ring)):
                assert time.monotonic() < deadline
        monkeypatch.setenv("MOTIONLAYER_MQTT_PASSWORD", login[1])
        with Simulation(described) as run, Paced(run):
            one = MqttAds(("127.0.0.1", port), SERVER_ID, f"{LAST}8", NETWORK, login=login)
            assert one.online.wait(60.0)
            assert add_up(one, 1) == 190.0 + 20
            one.close()
