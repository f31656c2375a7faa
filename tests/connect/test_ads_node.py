"""The npm package ads-client as it is, in Node.js, against a run. It is installed, or the test fails."""

import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from motionlayer import Simulation
from motionlayer.bench.campaign._ads_device import declare
from motionlayer.verify import assert_valid
from tests.connect import clients
from tests.connect.ads_clients import Paced, machine
from tests.connect.broker import free_port

SCRIPT = Path(__file__).with_name("node_client.mjs")
PARTS = [
    "tree",
    "everyTypeAlone",
    "everyTypeInOneStructure",
    "handlesAndSums",
    "notifications",
    "errors",
    "methods",
]


@pytest.mark.slow
def test_everything_that_the_client_does_works() -> None:
    clients.node_modules()
    with Simulation(machine()) as run:
        declare(run.symbols)
        with Paced(run):
            printed = clients.node(SCRIPT, f"127.0.0.1:{run.ads.port}", "all")
        assert printed.split() == PARTS
        assert run.axes["X"].set_position == 20.0
        trace = run.trace
    assert_valid(trace)


def wait_for_count(run: Simulation, value: int) -> None:
    end = time.monotonic() + clients.RUN_TIME
    while run.symbols.read("GVL.Count") != value:
        assert time.monotonic() < end, f"GVL.Count is not {value} within {clients.RUN_TIME} s"


@pytest.mark.slow
def test_the_client_comes_back_with_its_notifications_when_the_server_does() -> None:
    clients.node_modules()
    port = free_port()
    with ThreadPoolExecutor(1) as pool:
        for value in (1, 2):
            with Simulation(machine(ads={"port": port})) as run:
                declare(run.symbols)
                with Paced(run):
                    if value == 1:
                        printed = pool.submit(clients.node, SCRIPT, f"127.0.0.1:{port}", "reconnect")
                    wait_for_count(run, value)
                    if value == 2:
                        assert printed.result().split() == ["reconnect"]


@pytest.mark.slow
def test_the_client_restarts_the_run_and_goes_on_with_its_notifications() -> None:
    clients.node_modules()
    with Simulation(machine()) as run:
        declare(run.symbols)
        with Paced(run):
            printed = clients.node(SCRIPT, f"127.0.0.1:{run.ads.port}", "restarts")
        assert printed.split() == ["restarts"]
