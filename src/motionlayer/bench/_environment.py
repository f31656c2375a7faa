"""The environment of the peers: set up once in the user's cache, and scripts that run in it."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

PINS: Final = {"numpy": "2.4.6", "pyads": "3.6.0", "pyplcopen": "0.21.0", "ruckig": "0.19.4", "scipy": "1.17.1"}
"""The measured versions, and what the linear program needs."""

SETUP_PATIENCE: Final = 180.0
SCRIPT_PATIENCE: Final = 300.0
"""Seconds of wall time."""


class PeersMissing(Exception):  # noqa: N818 - nothing is wrong with us
    """A peer cannot be measured; the message says why."""


def folder() -> Path:
    """Return where the environment lives: below `XDG_CACHE_HOME`, else `~/.cache`."""
    home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(home) / "motionlayer" / "peers" / f"python-{sys.version_info.major}.{sys.version_info.minor}"


def tell(line: str) -> None:
    """Print a line of progress."""
    print(line, file=sys.stderr, flush=True)


class Environment:
    """An interpreter that has the peers; set up when the first script runs, and tried once.

    Args:
        python: interpreter that has them; the environment in the user's cache where left out.
        say: called with a line of progress.
    """

    def __init__(self, python: Path | None = None, say: Callable[[str], None] = tell) -> None:
        self._python = python
        self._say = say
        self._missing: PeersMissing | None = None

    def run(self, script: Path, work: dict[str, Any]) -> Any:  # noqa: ANN401 - JSON
        """Run a script with work as JSON on its stdin; return the JSON that it prints.

        Raises:
            PeersMissing: the environment cannot be set up, or the script fails.
        """
        if self._missing is not None:
            raise self._missing
        if self._python is None:
            try:
                self._python = self.set_up()
            except PeersMissing as missing:
                self._missing = missing
                raise
        return json.loads(_call([str(self._python), "-I", str(script)], SCRIPT_PATIENCE, json.dumps(work)))

    def set_up(self) -> Path:
        """Return the interpreter of the environment, set up if it is not there or has other versions.

        Raises:
            PeersMissing: it cannot be set up.
        """
        wanted = [f"{name}=={version}" for name, version in PINS.items()]
        home = folder()
        python, done = home / "bin" / "python", home / "installed.json"
        if done.is_file() and done.read_text(encoding="utf-8") == json.dumps(wanted):
            return python
        self._say(f"setting up the peers in {home}")
        _call([sys.executable, "-m", "venv", "--clear", str(home)], SETUP_PATIENCE)
        pip = [str(python), "-m", "pip", "--quiet", "--disable-pip-version-check", "install"]
        pip += ["--only-binary", ":all:", "--no-deps", "--retries", "1", "--timeout", "10"]
        missing = False
        for requirement in wanted:  # one by one: a peer without a wheel does not take the others with it
            try:
                _call([*pip, requirement], SETUP_PATIENCE)
            except PeersMissing as error:
                missing = True
                self._say(f"{requirement}: {error}")
        if not missing:
            done.write_text(json.dumps(wanted), encoding="utf-8")
        return python


def _call(command: list[str], patience: float, text: str = "") -> str:
    """Run a command; return what it prints.

    Raises:
        PeersMissing: it is not there, fails or hangs.
    """
    try:
        ended = subprocess.run(  # noqa: S603 - python and pip with constant arguments
            command, input=text, capture_output=True, text=True, timeout=patience, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise PeersMissing(str(error)) from error
    if ended.returncode:
        raise PeersMissing((ended.stderr.strip() or f"exit code {ended.returncode}").splitlines()[-1])
    return ended.stdout
