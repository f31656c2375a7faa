"""A whole ADS server in a process of its own, for campaigns that attack it through its sockets.

The process holds the symbols of `Device`, a server with tight limits, and a cycle that goes on whatever happens. It
prints its TCP port, and lives until its input ends. What it says on its error output is a fault: nothing that a client
sends is worth a word there.
"""

import contextlib
import subprocess
import sys
import tempfile
import threading
from collections import deque
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

from motionlayer.bench.campaign._ads_device import RUN, declare
from motionlayer.command import Ledger
from motionlayer.connect import ADS
from motionlayer.connect.ads import (
    Access,
    Bridge,
    Contents,
    Hooks,
    Inside,
    Limits,
    Outcome,
    Plan,
    Status,
    placed,
    tree_of,
)
from motionlayer.connect.ads import net_id as parsed
from motionlayer.event import EventLog
from motionlayer.iec import SymbolTable
from motionlayer.runtime import Mailbox

CYCLE: Final = 0.001
"""Seconds from one cycle to the next."""

SILENCE: Final = 0.3
"""Seconds until a half-open connection is ended."""

UNSENT: Final = 256 * 1024
"""Bytes that a client may leave."""

REMEMBERED: Final = 100
"""Refusals."""

PAGE: Final = 4096

COMMAND: Final = (sys.executable, "-c", "from motionlayer.bench.campaign._ads_victim import main; main()")


class Served:
    """A server, and the side of a cycle that never stops; no machine.

    Args:
        limits: of its clients.
        access: who may do what.
        own_process: the server runs in a process of its own, else in a thread.

    Attributes:
        told: who was refused lately, and why.
    """

    def __init__(self, limits: Limits, access: Access, *, own_process: bool) -> None:
        self.symbols, self.ledger = SymbolTable(), Ledger()
        declare(self.symbols)
        self.told: deque[str] = deque(maxlen=REMEMBERED)
        self.inside = Inside(lambda: placed(self.symbols))
        self.mailbox = Mailbox(self.ledger, EventLog())
        self.mailbox.register(ADS, self.inside.apply)
        plan = Plan("127.0.0.1", 0, parsed("127.0.0.1.1.1"), round(CYCLE * 1e9), access, limits)
        hooks = Hooks(self._tell, lambda _write, reply: reply(Outcome(0)))
        self.bridge = Bridge(plan, self.mailbox, hooks, own_process=own_process)
        self.over = threading.Event()
        self.mailbox.attach(self.bridge)
        size = self.inside.size
        published = self.bridge.share(size, plan.cycle_ns)
        self.inside.begin(published, lambda tick: Status(tick * 10_000, RUN, 0, RUN))
        self.inside.publish(0)
        self.bridge.begin(Contents(tree_of(self.inside.places), size))
        self.thread = threading.Thread(target=self._cycle)
        self.thread.start()

    def _tell(self, who: str, why: str) -> None:
        self.told.append(f"{who}: {why}")

    def _cycle(self) -> None:
        while not self.over.wait(CYCLE):
            tick = self.ledger.tick
            self.mailbox.apply(tick)
            self.inside.publish(tick)
            self.mailbox.acknowledge(tick)
            self.ledger.tick = tick + 1

    def close(self) -> None:
        """End server and cycle."""
        self.over.set()
        self.thread.join()
        self.mailbox.close()
        self.inside.end()
        self.bridge.close()


def main() -> None:
    """Serve until the input ends."""
    served = Served(Limits(silence=SILENCE, unsent=UNSENT), Access(), own_process=False)
    print(served.bridge.port, flush=True)
    sys.stdin.read()
    served.close()


class Victim:
    """The process, as seen by who attacks it.

    Args:
        process: that runs `main`.
        errors: file that takes its error output.

    Attributes:
        port: TCP port of the server.

    Raises:
        RuntimeError: it does not begin.
    """

    def __init__(self, process: subprocess.Popen[str], errors: Path) -> None:
        self._process = process
        self._errors = errors
        assert process.stdout is not None
        line = process.stdout.readline()
        if not line:
            raise RuntimeError(f"the server does not begin: {errors.read_text(encoding='utf-8', errors='replace')}")
        self.port = int(line)

    def problems(self, patience: float = 0.0) -> list[str]:
        """Return what is wrong with the process itself: it has ended, or says something.

        Args:
            patience: seconds of wall time that it may take to end.
        """
        found = []
        with contextlib.suppress(subprocess.TimeoutExpired):
            found.append(f"the server has ended with {self._process.wait(patience)}")
        said = self._errors.read_text(encoding="utf-8", errors="replace").strip()
        if said:
            found.append(f"the server says: {said}")
        return found

    def resident(self) -> int:
        """Return the resident memory in bytes; 0 of a process that has ended."""
        with contextlib.suppress(OSError, IndexError):
            return int(Path(f"/proc/{self._process.pid}/statm").read_text(encoding="ascii").split()[1]) * PAGE
        return 0


@contextlib.contextmanager
def victim(command: Sequence[str] = COMMAND) -> Iterator[Victim]:
    """Let a server process live meanwhile.

    Args:
        command: that runs `main`, perhaps with a fault planted before.
    """
    with tempfile.TemporaryDirectory() as folder:
        errors = Path(folder) / "errors.txt"
        with errors.open("w", encoding="utf-8") as taken:
            process = subprocess.Popen(  # noqa: S603 - our own command
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=taken, text=True
            )
        try:
            yield Victim(process, errors)
        finally:
            process.kill()  # a server that hangs would not end by itself
            process.communicate()
