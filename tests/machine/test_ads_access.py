"""Who may, and how much: what pyads is answered by a run, and what the log of the run says."""

import contextlib
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from typing import Any

import pyads
import pytest
from pyads import PLCTYPE_LREAL, PLCTYPE_UINT
from tests.connect.ads_clients import Paced, connected, machine

from motionlayer import Simulation
from motionlayer.event import Level

OWN = "127.0.0.1.1.1"
"""The NetId that pyads takes for itself on this computer."""

VELOCITY = "GVL_AXIS.Data[1].rSetVelo"
NOT_PERMITTED, NO_MORE_HANDLES, MACHINE_NOT_FOUND = 1796, 1814, 7
STOP = 6
PATIENCE = 60.0


@contextlib.contextmanager
def served(**ads: Any) -> Iterator[Simulation]:
    with Simulation(machine(ads={"port": 0, **ads})) as run, Paced(run):
        yield run


def told(run: Simulation, text: str) -> bool:
    """Tell whether the log says something; it is a tick or two behind the answer."""
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        if any(text in event.text for event in tuple(run.events.ring) if event.level is Level.WARNING):
            return True
    return False


def code(error: pytest.ExceptionInfo[pyads.ADSError]) -> int:
    return int(error.value.err_code)


def test_who_may_only_read_reads_and_watches_and_changes_nothing() -> None:
    with served(read_only=[OWN]) as run:
        with connected(run.ads.port) as plc:
            assert plc.read_by_name(VELOCITY, PLCTYPE_LREAL) == 0.0
            handles = plc.add_device_notification(VELOCITY, pyads.NotificationAttrib(8), lambda *_: None)
            plc.del_device_notification(*handles)
            with pytest.raises(pyads.ADSError) as refused:
                plc.write_by_name(VELOCITY, 1.0, PLCTYPE_LREAL)
            assert code(refused) == NOT_PERMITTED
            with pytest.raises(pyads.ADSError) as refused:
                plc.write_control(STOP, 0, 0, PLCTYPE_UINT)
            assert code(refused) == NOT_PERMITTED
            (answer,) = plc.write_list_by_name({VELOCITY: 1.0}).values()
            assert answer != "no error"
            assert plc.read_by_name(VELOCITY, PLCTYPE_LREAL) == 0.0
        with connected(run.ads.port, 501) as nc, pytest.raises(pyads.ADSError) as refused:
            nc.write(0x4301, 0x01, 7, pyads.PLCTYPE_UDINT)
        assert code(refused) == NOT_PERMITTED
        with connected(run.ads.port, 10_000) as system, pytest.raises(pyads.ADSError) as refused:
            system.write_control(STOP, 0, 0, PLCTYPE_UINT)
        assert code(refused) == NOT_PERMITTED
        assert not run.paused
        assert told(run, "127.0.0.1 may only read")


def test_a_net_id_that_is_not_named_reaches_nothing() -> None:
    with served(net_ids=["10.0.0.1.1.1"]) as run:
        with connected(run.ads.port) as plc, pytest.raises(pyads.ADSError) as refused:
            plc.read_by_name(VELOCITY, PLCTYPE_LREAL)
        assert code(refused) == MACHINE_NOT_FOUND
        assert told(run, f"{OWN}:")
        assert told(run, "its NetId is not among those that may ask")


def test_handles_are_bounded_for_each_of_several_clients_on_one_connection() -> None:
    with served(limits={"handles": 3}) as run, connected(run.ads.port) as one, connected(run.ads.port) as two:
        for plc in (one, two):
            held = [plc.get_handle(VELOCITY) for _ in range(3)]
            with pytest.raises(pyads.ADSError) as refused:
                plc.get_handle(VELOCITY)
            assert code(refused) == NO_MORE_HANDLES
            plc.release_handle(held[0])
            plc.release_handle(plc.get_handle(VELOCITY))
        assert told(run, "holds 3 handles")


GRABBING = """
import sys, pyads
plc = pyads.Connection("127.0.0.1.1.1", 851, sys.argv[1])
plc.open()
handles = [plc.get_handle("GVL_AXIS.Data[1].rSetVelo") for _ in range(3)]
plc.add_device_notification("GVL_AXIS.Data[1].rSetVelo", pyads.NotificationAttrib(8), lambda *_: None)
print("has them", flush=True)
sys.stdin.read()
"""


@pytest.mark.slow
def test_what_a_client_held_that_was_killed_is_there_for_others() -> None:
    with served(limits={"all_handles": 4, "all_notifications": 1}) as run:
        grabbing = [sys.executable, "-c", GRABBING, f"127.0.0.1:{run.ads.port}"]
        with subprocess.Popen(grabbing, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
            assert process.stdout is not None
            assert process.stdout.readline() == "has them\n"
            with connected(run.ads.port) as plc:
                with pytest.raises(pyads.ADSError) as refused:
                    list(map(plc.get_handle, [VELOCITY] * 3))
                assert code(refused) == NO_MORE_HANDLES
            process.kill()
        with connected(run.ads.port) as plc:
            held = grabbed(plc, 3)
            assert len(held) == 3
            handles = plc.add_device_notification(VELOCITY, pyads.NotificationAttrib(8), lambda *_: None)
            plc.del_device_notification(*handles)


def grabbed(plc: pyads.Connection, count: int) -> list[int]:
    """Return handles; the server needs a moment to notice that a client is gone."""
    deadline = time.monotonic() + PATIENCE
    held: list[int] = []
    while len(held) < count and time.monotonic() < deadline:
        with contextlib.suppress(pyads.ADSError):
            held.append(plc.get_handle(VELOCITY))
    return held


def own_address() -> str:
    """Return an address of this computer that is not loopback."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.connect(("192.0.2.1", 9))  # sends nothing: only the route is looked up
        return str(probe.getsockname()[0])


@pytest.mark.slow
@pytest.mark.parametrize("let_in", [False, True])
def test_hosts_are_let_in_by_name_or_ended_at_once(let_in: bool) -> None:
    try:
        here = own_address()
    except OSError:
        pytest.skip("this computer has no address beside loopback, which is always let in")
    hosts = [here] if let_in else ["198.51.100.0/24"]
    with served(host="0.0.0.0", hosts=hosts) as run:  # noqa: S104 - that is what is tested
        plc = pyads.Connection(OWN, 851, f"{here}:{run.ads.port}")
        with contextlib.closing(plc):
            plc.open()
            plc.set_timeout(60_000 if let_in else 2000)
            if let_in:
                assert plc.read_state()[0] == 5
            else:
                with pytest.raises(pyads.ADSError):
                    plc.read_state()
        assert let_in or told(run, "its address is not allowed to connect")
