"""The client of the rows `ads`: pyads, and the test server it brings. Runs with the interpreter of the peers.

Reads a job and its work as JSON from stdin and prints the answer; motionlayer is not installed here. The peer is a
process of its own, as our server is, so that neither shares an interpreter with the client.
"""

import contextlib
import gc
import importlib
import json
import statistics
import subprocess
import sys
from collections.abc import Callable, Iterator
from time import perf_counter
from typing import Any

NET_IDS = {"ours": "127.0.0.1.1.1", "peer": "127.0.0.1.1.2"}
PLC_PORT = 851
PEER = "peer"
ROUNDS = 10
PATIENCE_MS = 60_000  # a run answers after its first tick, which may have to compile the kernels


def serve() -> None:
    """Be the peer: the variables that our run has, in the server with the most abilities; ends with its stdin."""
    server = importlib.import_module("pyads.testserver")
    constants = importlib.import_module("pyads.constants")
    handler = server.AdvancedHandler()
    variables = [
        ("GVL.Count", 0, constants.ADST_INT32, "DINT"),
        ("GVL.Sample", bytes(32), constants.ADST_BIGTYPE, "ST_SAMPLE"),
    ]
    variables += [(f"GVL.Values[{index}]", 0.0, constants.ADST_REAL64, "LREAL") for index in range(1, 51)]
    for variable in variables:
        handler.add_variable(server.PLCVariable(*variable))
    with server.AdsTestServer(handler, port=0, logging=False) as running:
        print(running.server.getsockname()[1], flush=True)
        sys.stdin.read()


@contextlib.contextmanager
def peer() -> Iterator[int]:
    """Run the peer; yield its TCP port."""
    command = [sys.executable, "-I", __file__, PEER]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:  # noqa: S603
        assert process.stdout is not None
        try:
            yield int(process.stdout.readline())
        finally:
            process.kill()


@contextlib.contextmanager
def connected(who: str, port: int) -> Iterator[Any]:
    """Connect pyads."""
    connection = importlib.import_module("pyads").Connection(NET_IDS[who], PLC_PORT, f"127.0.0.1:{port}")
    connection.open()
    connection.set_timeout(PATIENCE_MS)
    try:
        yield connection
    finally:
        connection.close()


def read(plc: Any) -> Callable[[], object]:  # noqa: ANN401 - a module without types
    """Read 4 bytes by handle: one round trip."""
    kind = importlib.import_module("pyads").PLCTYPE_DINT
    handle = plc.get_handle("GVL.Count")
    return lambda: plc.read_by_name("", kind, handle=handle)


def write(plc: Any) -> Callable[[], object]:  # noqa: ANN401
    """Write 4 bytes by handle: one round trip."""
    kind = importlib.import_module("pyads").PLCTYPE_DINT
    handle = plc.get_handle("GVL.Count")
    values = iter(range(2**31))
    return lambda: plc.write_by_name("", next(values), kind, handle=handle)


def by_name(plc: Any) -> Callable[[], object]:  # noqa: ANN401
    """Read 4 bytes by name: pyads takes a handle, reads, and gives it back."""
    kind = importlib.import_module("pyads").PLCTYPE_DINT
    return lambda: plc.read_by_name("GVL.Count", kind)


def sum_50(plc: Any) -> Callable[[], object]:  # noqa: ANN401
    """Read 50 numbers in a sum command; pyads keeps where they lie."""
    names = [f"GVL.Values[{index}]" for index in range(1, 51)]
    return lambda: plc.read_list_by_name(names)


def struct_write(plc: Any) -> Callable[[], object]:  # noqa: ANN401
    """Write a structure by name: pyads takes a handle, writes, and gives it back."""
    kind = importlib.import_module("pyads").PLCTYPE_LREAL
    shape = tuple((f"rValue{number}", kind, 1) for number in range(1, 5))
    values = iter(range(2**31))
    names = [name for name, _, _ in shape]
    return lambda: plc.write_structure_by_name("GVL.Sample", dict.fromkeys(names, next(values)), shape)


ACTS: dict[str, Callable[[Any], Callable[[], object]]] = {
    act.__name__: act for act in (read, by_name, sum_50, struct_write)
}


def rates(work: dict[str, Any]) -> dict[str, float]:
    """Return calls a second of ours and of the peer, in turns, medians of `ROUNDS`.

    Args:
        work: `act`, `calls` in a turn, `port` of ours.
    """
    found: dict[str, list[float]] = {who: [] for who in NET_IDS}
    with contextlib.ExitStack() as stack:
        ports = {"ours": work["port"], "peer": stack.enter_context(peer())}
        acts = {who: ACTS[work["act"]](stack.enter_context(connected(who, port))) for who, port in ports.items()}
        for turn in range(ROUNDS + 1):
            for who, act in acts.items():
                begin = perf_counter()
                for _ in range(work["calls"]):
                    act()
                if turn:  # the first one warms up
                    found[who].append(work["calls"] / (perf_counter() - begin))
    return {who: statistics.median(values) for who, values in found.items()}


def latencies(work: dict[str, Any]) -> list[float]:
    """Return how long each write took until it was acknowledged, in seconds."""
    times = []
    with connected("ours", work["port"]) as plc:
        act = write(plc)
        for _ in range(work["calls"]):
            begin = perf_counter()
            act()
            times.append(perf_counter() - begin)
    return times


def upload(work: dict[str, Any]) -> list[float]:
    """Return how long each upload of all symbols took in seconds, with what pyads makes of them; then their number."""
    times, count = [], 0
    with connected("ours", work["port"]) as plc:
        for _ in range(work["calls"]):
            begin = perf_counter()
            count = len(plc.get_all_symbols())
            times.append(perf_counter() - begin)
    return [*times, count]


JOBS: dict[str, Callable[[dict[str, Any]], dict[str, float] | list[float]]] = {
    "rates": rates,
    "latencies": latencies,
    "upload": upload,
}


def main() -> None:
    """Be the peer, or do what is asked for."""
    if sys.argv[1:] == [PEER]:
        serve()
        return
    work = json.load(sys.stdin)
    gc.disable()
    json.dump(JOBS[work.pop("job")](work), sys.stdout)


if __name__ == "__main__":
    main()
