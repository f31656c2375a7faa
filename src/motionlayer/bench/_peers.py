"""Peers: an environment of their own, set up once, and a script that runs in it."""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Final, NamedTuple

from motionlayer.bench import _load
from motionlayer.bench._row import Effort

PINS: Final = {"pyplcopen": "0.21.0", "ruckig": "0.19.4"}
"""The measured versions."""

SCRIPT: Final = Path(__file__).with_name("_peer_script.py")
SETUP_PATIENCE: Final = 180.0
SCRIPT_PATIENCE: Final = 120.0
"""Seconds of wall time."""

SLOW: Final = 10
"""A cycle of a thousand Python objects is measured so many times less often."""


class PeersMissing(Exception):  # noqa: N818 - nothing is wrong with us
    """No peer can be measured; the message says why."""


class PeerValues(NamedTuple):
    """Values by package, in µs, and why the others are missing."""

    values: dict[str, float]
    notes: list[str]


def measure(packages: Sequence[str], effort: Effort, python: Path | None, tell: Callable[[str], None]) -> PeerValues:
    """Measure the peers, as far as they can be had; never raises for one that cannot.

    Args:
        packages: keys of `PINS`.
        effort: see `Effort`.
        python: interpreter that has them; the environment in the user's cache where left out.
        tell: called with a line of progress.
    """
    try:
        answers = _ask(python or _environment(tell), packages, effort)
    except PeersMissing as missing:
        return PeerValues({}, [f"no peers: {missing}"])
    values = {name: float(answer["us"]) for name, answer in answers.items() if "us" in answer}
    notes = [f"no {name}: {answer['missing']}" for name, answer in answers.items() if "missing" in answer]
    return PeerValues(values, notes)


def folder() -> Path:
    """Return where the environment lives: below `XDG_CACHE_HOME`, else `~/.cache`."""
    home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(home) / "motionlayer" / "peers" / f"python-{sys.version_info.major}.{sys.version_info.minor}"


def _environment(tell: Callable[[str], None]) -> Path:
    """Return the interpreter of the environment, set up if it is not there or has other versions.

    Raises:
        PeersMissing: it cannot be set up.
    """
    wanted = [f"{name}=={version}" for name, version in PINS.items()]
    home = folder()
    python, done = home / "bin" / "python", home / "installed.json"
    if done.is_file() and done.read_text(encoding="utf-8") == json.dumps(wanted):
        return python
    tell(f"setting up the peers in {home}")
    _call([sys.executable, "-m", "venv", "--clear", str(home)], SETUP_PATIENCE)
    pip = [str(python), "-m", "pip", "--quiet", "--disable-pip-version-check", "install"]
    pip += ["--only-binary", ":all:", "--no-deps", "--retries", "1", "--timeout", "10"]
    missing = False
    for requirement in wanted:  # one by one: a peer without a wheel does not take the others with it
        try:
            _call([*pip, requirement], SETUP_PATIENCE)
        except PeersMissing as error:
            missing = True
            tell(f"{requirement}: {error}")
    if not missing:
        done.write_text(json.dumps(wanted), encoding="utf-8")
    return python


def _ask(python: Path, packages: Sequence[str], effort: Effort) -> dict[str, dict[str, str | float]]:
    """Run the script; return its answer by package: `us` or `missing`.

    Raises:
        PeersMissing: it does not run.
    """
    work = {
        "packages": list(packages),
        "cycles": max(1, effort.samples // SLOW),
        "axes": 1000,
        "targets": _load.targets(effort.samples),
        "velocity": _load.VELOCITY,
        "acceleration": _load.ACCELERATION,
        "jerk": _load.JERK,
        "pause": _load.MOVE_TICKS * _load.BASE_CYCLE,
    }
    text = _call([str(python), "-I", str(SCRIPT)], SCRIPT_PATIENCE, json.dumps(work))
    answers: dict[str, dict[str, str | float]] = json.loads(text)
    return answers


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
