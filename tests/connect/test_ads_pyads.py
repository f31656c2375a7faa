"""pyads as it is, against a run: all types, sums, notifications, several clients, a connection that comes back."""

import contextlib
import ctypes
import datetime as dt
import queue
import socket
from collections.abc import Iterator
from typing import Any

import pyads
import pytest

from motionlayer import Simulation
from motionlayer.bench.campaign._ads_device import declare
from tests.connect.ads_clients import Paced, connected, machine


@pytest.fixture(scope="module")
def port() -> Iterator[int]:
    with Simulation(machine()) as run:
        declare(run.symbols)
        with Paced(run):
            yield run.ads.port


@pytest.fixture
def plc(port: int) -> Iterator[pyads.Connection]:
    with connected(port) as connection:
        yield connection


VALUES: list[tuple[str, Any, Any]] = [
    ("bBool", pyads.PLCTYPE_BOOL, True),
    ("nByte", pyads.PLCTYPE_BYTE, 200),
    ("nSint", pyads.PLCTYPE_SINT, -100),
    ("nUsint", pyads.PLCTYPE_USINT, 255),
    ("nInt", pyads.PLCTYPE_INT, -30_000),
    ("nUint", pyads.PLCTYPE_UINT, 60_000),
    ("nWord", pyads.PLCTYPE_WORD, 0xABCD),
    ("nDint", pyads.PLCTYPE_DINT, -(2**31)),
    ("nUdint", pyads.PLCTYPE_UDINT, 2**32 - 1),
    ("nDword", pyads.PLCTYPE_DWORD, 0xDEADBEEF),
    ("nLint", pyads.PLCTYPE_LINT, -(2**63)),
    ("nUlint", pyads.PLCTYPE_ULINT, 2**64 - 1),
    ("nLword", pyads.PLCTYPE_ULINT, 2**63),
    ("rReal", pyads.PLCTYPE_REAL, 0.5),
    ("rLreal", pyads.PLCTYPE_LREAL, 1e-300),
    ("tTime", pyads.PLCTYPE_TIME, 86_400_000),
    ("tLtime", pyads.PLCTYPE_ULINT, 10**15),
    ("dDate", pyads.PLCTYPE_DATE, 19_000 * 86_400),
    ("dDt", pyads.PLCTYPE_DT, 1_700_000_000),
    ("dTod", pyads.PLCTYPE_TOD, 86_399_999),
    ("sText", pyads.PLCTYPE_STRING, "größer"),
    ("wsText", pyads.PLCTYPE_WSTRING, "→ Ω"),
    ("eColour", pyads.PLCTYPE_INT, -1),
    ("aNumbers", pyads.PLCTYPE_INT * 4, [1, -2, 3, -4]),
    ("aGrid[1,3]", pyads.PLCTYPE_DINT, 77),
    ("stInner.rValue", pyads.PLCTYPE_LREAL, 2.25),
    ("stInner.bOther", pyads.PLCTYPE_BOOL, True),
]


@pytest.mark.parametrize(("name", "kind", "value"), VALUES)
def test_every_type_is_written_and_read_back(plc: pyads.Connection, name: str, kind: Any, value: Any) -> None:
    written = value.encode("cp1252").ljust(21, b"\0") if kind is pyads.PLCTYPE_STRING else value
    if kind is pyads.PLCTYPE_STRING:
        plc.write_by_name(f"GVL.All.{name}", list(written), ctypes.c_ubyte * 21)
        raw = plc.read_by_name(f"GVL.All.{name}", ctypes.c_ubyte * 21)
        assert bytes(raw) == written
    elif kind is pyads.PLCTYPE_WSTRING:
        raw = value.encode("utf-16-le").ljust(22, b"\0")
        plc.write_by_name(f"GVL.All.{name}", list(raw), ctypes.c_ubyte * 22)
        assert plc.read_by_name(f"GVL.All.{name}", kind) == value
    else:
        plc.write_by_name(f"GVL.All.{name}", value, kind)
        assert plc.read_by_name(f"GVL.All.{name}", kind) == value


def test_a_structure_is_read_and_written_as_a_whole(plc: pyads.Connection) -> None:
    inner = (("bFlag", pyads.PLCTYPE_USINT, 1), ("pad", pyads.PLCTYPE_USINT, 7), ("rValue", pyads.PLCTYPE_LREAL, 1))
    written = {"bFlag": 3, "pad": [0] * 7, "rValue": -2.5}
    plc.write_structure_by_name("GVL.Inners[3]", written, inner)
    assert plc.read_structure_by_name("GVL.Inners[3]", inner) == written
    assert plc.read_by_name("GVL.Inners[3].bOther", pyads.PLCTYPE_BOOL) is True


def test_symbols_are_uploaded_and_typed_by_the_client(plc: pyads.Connection) -> None:
    names = [symbol.name for symbol in plc.get_all_symbols()]
    assert {"GVL_AXIS.Ctrl", "GVL.All", "GVL.Count"} <= set(names)
    count = plc.get_symbol("GVL.Count")
    assert (count.symbol_type, count.comment) == ("DINT", "a number that clients write")
    count.write(12)
    assert count.read() == 12


def test_sums_read_and_write_many_at_once(plc: pyads.Connection) -> None:
    names = {f"GVL.Inners[{index}].rValue": float(index) for index in (1, 2, 3)}
    assert set(plc.write_list_by_name(names).values()) == {"no error"}
    assert plc.read_list_by_name(list(names)) == names
    assert plc.write_list_by_name({"GVL.Shown[1]": 1.0}) == {"GVL.Shown[1]": "reading/writing not permitted"}


@pytest.mark.parametrize(
    ("name", "code"), [("GVL.Nothing", 1808), ("GVL.Inners[9].rValue", 1825), ("GVL.Inners[", 1805)]
)
def test_errors_have_the_codes_that_clients_know(plc: pyads.Connection, name: str, code: int) -> None:
    with pytest.raises(pyads.ADSError, match=str(code)):
        plc.read_by_name(name, pyads.PLCTYPE_LREAL)


@pytest.mark.parametrize("mode", [pyads.ADSTRANS_SERVERCYCLE, pyads.ADSTRANS_SERVERONCHA])
def test_notifications_arrive(plc: pyads.Connection, mode: int) -> None:
    got: queue.SimpleQueue[tuple[dt.datetime, int]] = queue.SimpleQueue()

    @plc.notification(pyads.PLCTYPE_DINT)  # type: ignore[untyped-decorator]
    def told(_handle: int, _name: str, when: dt.datetime, value: int) -> None:
        got.put((when, value))

    plc.write_by_name("GVL.Count", 1, pyads.PLCTYPE_DINT)
    attributes = pyads.NotificationAttrib(4, trans_mode=mode, max_delay=0, cycle_time=5)
    handles = plc.add_device_notification("GVL.Count", attributes, told)
    assert got.get(timeout=60)[1] == 1
    plc.write_by_name("GVL.Count", 2, pyads.PLCTYPE_DINT)
    seen = [got.get(timeout=60)]
    while seen[-1][1] != 2:
        seen.append(got.get(timeout=60))
    plc.del_device_notification(*handles)
    times = [when for when, _ in seen]
    assert times == sorted(times)
    if mode == pyads.ADSTRANS_SERVERONCHA:
        assert len(seen) == 1


def test_clients_on_one_connection_do_not_disturb_one_another(port: int) -> None:
    with connected(port) as one, connected(port) as two:  # AdsLib has one TCP connection for both
        handle = one.get_handle("GVL.Count")
        one.write_by_name("", 5, pyads.PLCTYPE_DINT, handle=handle)
        assert two.read_by_name("GVL.Count", pyads.PLCTYPE_DINT) == 5
        two.close()
        assert one.read_by_name("", pyads.PLCTYPE_DINT, handle=handle) == 5


def test_a_client_that_is_opened_long_before_its_first_request_is_answered() -> None:
    with Simulation(machine(ads={"port": 0, "limits": {"silence": 0.05}})) as run:
        declare(run.symbols)
        with Paced(run), connected(run.ads.port) as plc, socket.create_connection(("127.0.0.1", run.ads.port)) as half:
            half.sendall(b"\0")
            with contextlib.suppress(ConnectionResetError):
                assert half.recv(1) == b""  # disconnected, as it says no more: so long has the other one been silent
            assert plc.read_by_name("GVL.Count", pyads.PLCTYPE_DINT) == 0


def test_a_client_comes_back_after_a_restart_of_the_server() -> None:
    port = 0
    for value in (3, 4):
        with Simulation(machine(ads={"port": port})) as run:
            declare(run.symbols)
            port = run.ads.port
            with Paced(run), connected(port) as plc:
                assert plc.read_by_name("GVL.Count", pyads.PLCTYPE_DINT) == 0
                plc.write_by_name("GVL.Count", value, pyads.PLCTYPE_DINT)
                assert plc.read_by_name("GVL.Count", pyads.PLCTYPE_DINT) == value
