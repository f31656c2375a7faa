"""Where a server runs: in a process of its own, or in a thread of the run's."""

import os
import socket
import subprocess
import sys
import threading
from typing import Protocol

from motionlayer.connect.ads._serve import serve


class Launched(Protocol):
    """A server that was started; it has been given its end of the channel."""

    @property
    def pid(self) -> int | None:
        """Number of its process; None where it has none of its own."""

    def wait(self, seconds: float) -> None:
        """Wait for its end, which it has been told of; so long at most."""


class ServerProcess:
    """A server in a process of its own.

    It is no child of `multiprocessing`, which would run the script of the user once more to find it; and in a session
    of its own, so that Ctrl-C ends the run, and the run its server.

    Args:
        there: its end of the channel; given away.
        memory: file descriptor of the shared memory.
    """

    def __init__(self, there: socket.socket, memory: int) -> None:
        code = "from motionlayer.connect.ads._serve import main; main()"
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
        with there:
            files = there.fileno(), memory
            self._process = subprocess.Popen(  # noqa: S603 - this interpreter, constant arguments
                [sys.executable, "-c", code, *map(str, files)],
                pass_fds=files,
                stdin=subprocess.DEVNULL,
                env=environment,
                start_new_session=True,
            )

    @property
    def pid(self) -> int:
        """Number of its process."""
        return self._process.pid

    def wait(self, seconds: float) -> None:
        """Wait for its end; who does not end is killed."""
        try:
            self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()


class ServerThread:
    """A server in a thread; the arguments are those of `ServerProcess`."""

    pid = None

    def __init__(self, there: socket.socket, memory: int) -> None:
        self._thread = threading.Thread(target=serve, args=(there, memory), name="ads server", daemon=True)
        self._thread.start()

    def wait(self, seconds: float) -> None:
        """Wait for its end."""
        self._thread.join(seconds)
