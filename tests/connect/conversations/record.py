"""Record what real clients say, and what they are answered: `python -m tests.connect.conversations.record [NAME]`.

After every frame a tick passes, so that the conversation can be repeated without a client and without time.
"""

import asyncio
import json
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pyads
from pyads import PLCTYPE_DINT, PLCTYPE_LREAL, NotificationAttrib

from motionlayer.bench.campaign._ads_device import Device, Peer
from motionlayer.connect.ads import Watcher
from motionlayer.connect.ads._frame import Splitter, framed
from tests.connect import clients

FOLDER = Path(__file__).parent


class Recorder(asyncio.Protocol):
    """A server that writes down what it hears and says."""

    def __init__(self, device: Device, said: list[list[str]]) -> None:
        self._device = device
        self._said = said
        self._splitter = Splitter()

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.Transport)
        self._transport = transport
        self._peer: Peer = self._device.connect()

    def data_received(self, data: bytes) -> None:
        for frame in self._splitter.feed(data):
            raw = framed(frame.data, frame.command)
            self._peer.connection.receive(raw)
            self._device.tick()
            answer, self._peer.received = self._peer.received, b""
            self._said.append([raw.hex(), answer.hex()])
            self._transport.write(answer)


def with_pyads(port: int) -> None:
    plc = pyads.Connection("127.0.0.1.1.1", 851, f"127.0.0.1:{port}")
    with plc:
        plc.read_state()
        plc.read_device_info()
        plc.get_all_symbols()
        plc.write_by_name("GVL.Count", 77, PLCTYPE_DINT)
        plc.read_by_name("GVL.Count", PLCTYPE_DINT)
        plc.read_by_name("GVL.All.sText", pyads.PLCTYPE_STRING)
        plc.write_list_by_name({"GVL.Count": 5, "GVL.Inners[1].rValue": 1.5})
        plc.read_list_by_name(["GVL.Count", "GVL.Inners[1].rValue"])
        plc.get_symbol("GVL.Inners[2].rValue").write(2.5)
        for _ in range(2):
            handles = plc.add_device_notification("GVL.Count", NotificationAttrib(4), lambda *_: None)
            for _ in range(5):
                plc.read_by_name("GVL.Inners[1].rValue", PLCTYPE_LREAL)
            plc.del_device_notification(*handles)
        try:
            plc.read_by_name("GVL.Nothing", PLCTYPE_DINT)
        except pyads.ADSError:
            plc.write_control(6, 0, 0, PLCTYPE_DINT)


def with_watch(port: int) -> None:
    with Watcher("127.0.0.1", port) as watcher:
        for name in ("GVL.All", "GVL.Inners", "GVL.Count"):
            watcher.watch(name, 0.01)


def with_node(port: int) -> None:
    clients.node(FOLDER / "node.mjs", str(port))


def with_cpp(port: int) -> None:
    with tempfile.TemporaryDirectory() as folder:
        clients.run([str(clients.compiled(FOLDER / "client.cpp", Path(folder))), str(port)], FOLDER)


CLIENTS: dict[str, Callable[[int], None]] = {
    "pyads": with_pyads,
    "watch": with_watch,
    "node": with_node,
    "cpp": with_cpp,
}


async def record(client: Callable[[int], Any]) -> list[list[str]]:
    """Let a client talk; return requests and what each was followed by."""
    said: list[list[str]] = []
    device = Device()
    server = await asyncio.get_running_loop().create_server(lambda: Recorder(device, said), "127.0.0.1", 0)
    port = server.sockets[0].getsockname()[1]
    await asyncio.to_thread(client, port)
    server.close()
    return said


def main() -> None:
    for name in sys.argv[1:] or CLIENTS:
        said = asyncio.run(record(CLIENTS[name]))
        text = "[\n" + ",\n".join(json.dumps(one) for one in said) + "\n]\n"
        (FOLDER / f"{name}.json").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
