"""The examples of ADS clients move an axis, in Python, Node.js and C++; what they have moved is judged."""

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from motionlayer import Machine, Simulation
from motionlayer.machine import AdsDescription
from motionlayer.verify import assert_valid
from tests.connect import clients
from tests.connect.ads_clients import Paced

Client = Callable[[Path, str], str]
"""Runs a client in a folder, with the address of the server; returns what it prints."""


def in_python(folder: Path, address: str) -> str:
    return clients.run([sys.executable, str(clients.EXAMPLES / "python" / "client.py"), address], folder)


def in_node(_folder: Path, address: str) -> str:
    return clients.node(clients.EXAMPLES / "node" / "client.mjs", address)


def in_cpp(folder: Path, address: str) -> str:
    return clients.run([str(clients.compiled(clients.EXAMPLES / "cpp" / "client.cpp", folder)), address], folder)


@pytest.mark.parametrize(
    "client", [in_python, pytest.param(in_node, marks=pytest.mark.slow), pytest.param(in_cpp, marks=pytest.mark.slow)]
)
def test_a_client_moves_an_axis_to_three_positions(client: Client, tmp_path: Path) -> None:
    described = Machine.load(clients.EXAMPLES / "machine.toml")
    with Simulation(described, ads=AdsDescription(port=0)) as run:
        with Paced(run):
            printed = client(tmp_path, f"127.0.0.1:{run.ads.port}")
        found = [float(line.split()[1]) for line in printed.splitlines() if line.startswith("position")]
        assert found == pytest.approx([100.0, 250.0, 0.0], abs=0.1)
        assert run.axes["X"].set_position == 0.0
        trace = run.trace
    assert trace["X.set_position"].max() == pytest.approx(250.0, abs=1e-3)
    assert_valid(trace)
