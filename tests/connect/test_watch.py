"""`Watcher`: symbols watched as a whole, names that there are not, devices that go or are none."""

import socket
import threading
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.bench.campaign._ads_victim import Served
from motionlayer.connect.ads import Absent, Access, Limits, Lost, Watcher, WatchError
from motionlayer.connect.ads._frame import RESPONSE, Packet, framed
from motionlayer.connect.ads._hints import hint
from motionlayer.connect.ads._leaves import SymbolEntry, TypeEntry

PATIENCE = 10.0

LREAL = TypeEntry("LREAL", "", 8, 0, 5, False, (), (), {})
STATE = TypeEntry(
    "ST_STATE",
    "",
    16,
    0,
    65,
    False,
    (),
    (LREAL._replace(name="eState", type="LREAL"), LREAL._replace(name="rPos", type="LREAL")),
    {},
)
STATES = TypeEntry("ARRAY [1..3] OF ST_STATE", "ST_STATE", 48, 0, 65, False, ((1, 3),), (), {})
GRID = TypeEntry("ARRAY [0..1,-1..1] OF LREAL", "LREAL", 48, 0, 5, False, ((0, 2), (-1, 3)), (), {})
TYPES = {kind.name: kind for kind in (LREAL, STATE, STATES, GRID)}
SYMBOLS = [
    SymbolEntry("GVL_AXIS.State", STATES.name, 0, 0, 48),
    SymbolEntry("GVL_AXIS.Ctrl", LREAL.name, 0, 0, 8),
    SymbolEntry("GVL_AXIS.Grid", GRID.name, 0, 0, 48),
    SymbolEntry("MAIN_AXIS.eInit", LREAL.name, 0, 0, 8),
]


@pytest.mark.parametrize(
    ("name", "found"),
    [
        ("GVL_AXIS.Stat", "did you mean GVL_AXIS.State?"),
        ("gvl_axs.state[1].eState", "did you mean GVL_AXIS.State?"),
        ("MAINAXIS.eInit", "did you mean MAIN_AXIS.eInit?"),
        ("GVL_AXIS.Zebra", "did you mean GVL_AXIS.State or GVL_AXIS.Ctrl or GVL_AXIS.Grid?"),
        ("GVL_AXIS.State[1].eStat", "did you mean GVL_AXIS.State[1].eState?"),
        ("GVL_AXIS.State[1].Velocity", "GVL_AXIS.State[1] has eState, rPos"),
        ("GVL_AXIS.State[4]", "GVL_AXIS.State has the indices 1 to 3"),
        ("GVL_AXIS.State[x].eState", "GVL_AXIS.State has the indices 1 to 3"),
        ("GVL_AXIS.State.eState", "GVL_AXIS.State is an array with the indices 1 to 3"),
        ("GVL_AXIS.Grid[1]", "GVL_AXIS.Grid has the indices 0 to 1, -1 to 1"),
        ("GVL_AXIS.Ctrl[1]", "GVL_AXIS.Ctrl is no array"),
        ("GVL_AXIS.Ctrl.eCmd", "GVL_AXIS.Ctrl is no structure"),
        ("quite.Different", ""),
    ],
)
def test_a_name_that_there_is_not_is_answered_with_what_may_have_been_meant(name: str, found: str) -> None:
    assert hint(name, SYMBOLS, TYPES.__getitem__) == found


@given(st.text("GVL_AXIS.State[1]-,.()*\\\n", max_size=30))
def test_any_name_gets_a_hint_or_none(name: str) -> None:
    assert isinstance(hint(name, SYMBOLS, TYPES.__getitem__), str)


@pytest.fixture
def device() -> Any:
    made = Served(Limits(), Access(), own_process=False)
    yield made
    made.close()


def test_a_structure_is_one_notification_and_only_what_changes_is_shown(device: Served) -> None:
    with Watcher("127.0.0.1", device.bridge.port) as watcher:
        everything = watcher.watch("GVL.All", 0.001)
        first = list(watcher.samples(PATIENCE))
        assert [sample.leaf for sample in first] == list(everything)
        assert len(everything) == 36
        device.symbols.write("GVL.All.nInt", -5, "test")
        assert [(one.leaf.name, one.value) for one in watcher.samples(PATIENCE)] == [("GVL.All.nInt", -5)]
        device.symbols.write("GVL.All.stInner.bOther", True, "test")
        assert [(one.leaf.name, one.value) for one in watcher.samples(PATIENCE)] == [("GVL.All.stInner.bOther", True)]


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("GVL.Al", r"GVL\.Al: symbol not found \(0x710\); did you mean GVL\.All\?"),
        ("GVL.All.nIn", r"GVL\.All\.nIn: symbol not found \(0x710\); did you mean GVL\.All\.nInt"),
        ("GVL.Inners[7]", r"GVL\.Inners\[7\]: .*; GVL\.Inners has the indices 1 to 3"),
    ],
)
def test_a_wrong_name_is_told_with_a_hint(device: Served, name: str, told: str) -> None:
    with Watcher("127.0.0.1", device.bridge.port) as watcher, pytest.raises(WatchError, match=told):
        watcher.watch(name, 0.1)


def drain(watcher: Watcher) -> None:
    while list(watcher.samples(PATIENCE)):
        pass


def test_a_device_that_goes_is_lost_and_one_that_is_not_there_absent() -> None:
    made = Served(Limits(), Access(), own_process=False)
    port = made.bridge.port
    try:
        watcher = Watcher("127.0.0.1", port)
        watcher.watch("GVL.Count", 0.001)
    finally:
        made.close()
    with watcher, pytest.raises(Lost, match=r"ended the connection|is lost"):
        drain(watcher)
    with pytest.raises(Absent, match="Connection refused"):
        Watcher("127.0.0.1", port)


def watched(answer: Callable[[bytes], bytes]) -> None:
    """Watch a symbol of somebody who answers a request so."""
    with socket.create_server(("127.0.0.1", 0)) as server:

        def be_asked() -> None:
            stream, _ = server.accept()
            with stream:
                stream.sendall(answer(stream.recv(1024)))

        thread = threading.Thread(target=be_asked)
        thread.start()
        with Watcher(*server.getsockname()) as watcher:
            try:
                watcher.watch("GVL.Count", 0.1)
            finally:
                thread.join()


def test_who_is_no_ads_device_is_told() -> None:
    with pytest.raises(WatchError, match="is no ADS device"):
        watched(lambda _request: b"HTTP/1.1 400 Bad Request\r\n\r\n")


@pytest.mark.parametrize("said", [b"", b"\0\0", bytes(8), bytes(8) + b"\x40\0\0\0" * 7])
def test_answers_that_mean_nothing_are_one_clear_error(said: bytes) -> None:
    def answer(request: bytes) -> bytes:
        asked = Packet.parse(request[6:])
        assert asked is not None
        flags = asked.flags | RESPONSE
        return framed(Packet(asked.source, asked.target, asked.command, flags, 0, asked.invoke_id, said).pack())

    with pytest.raises(WatchError, match=r"GVL\.Count: what the device has sent means nothing"):
        watched(answer)
