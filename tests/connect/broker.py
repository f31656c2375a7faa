"""An MQTT broker in a process of its own, which a test can end and start again."""

import contextlib
import socket
import subprocess
import sys
from collections.abc import Iterator

SCRIPT = """
import asyncio, sys, tempfile
from amqtt.broker import Broker
from pwdlib.hashers.argon2 import Argon2Hasher
port, user, password = sys.argv[1:]
async def main(file):
    file.write(user + ":" + Argon2Hasher().hash(password))
    file.flush()
    kind, config = ("FileAuthPlugin", {"password_file": file.name}) if user else ("AnonymousAuthPlugin", {})
    listener = {"type": "tcp", "bind": "127.0.0.1:" + port}
    plugins = {"amqtt.plugins.authentication." + kind: config}
    broker = Broker({"listeners": {"default": listener}, "plugins": plugins})
    await broker.start()
    print("ready", flush=True)
    await asyncio.get_running_loop().run_in_executor(None, sys.stdin.read)
with tempfile.NamedTemporaryFile("w") as file:
    asyncio.run(main(file))
"""


def free_port() -> int:
    """Return a TCP port that nobody has."""
    with socket.create_server(("127.0.0.1", 0)) as one:
        port: int = one.getsockname()[1]
        return port


@contextlib.contextmanager
def broker(port: int, user: str = "", password: str = "") -> Iterator[None]:
    """Let a broker run on a port meanwhile, for all or for one user; it forgets everything in the end."""
    process = subprocess.Popen(
        [sys.executable, "-c", SCRIPT, str(port), user, password],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    )
    assert process.stdin is not None
    assert process.stdout is not None
    try:
        assert process.stdout.readline() == b"ready\n"
        yield
    finally:
        process.kill()
        process.communicate()
