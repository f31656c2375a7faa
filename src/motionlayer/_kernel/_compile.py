"""The decorator `kernel`, its modes and its cache."""

import functools
import hashlib
import os
import sys
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any, Final, ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")

PACKAGE: Final = Path(__file__).resolve().parent.parent
MODES: Final = ("compiled", "checked", "plain")
MODE: Final = os.environ.get("MOTIONLAYER_KERNELS", "compiled")
if MODE not in MODES:
    raise ImportError(f"MOTIONLAYER_KERNELS is {MODE!r}; possible are {', '.join(MODES)}")


def _sources() -> list[Path]:
    """Return what compiled kernels are made of: the decorator, and every file of a folder that holds a kernel.

    Constants are compiled in, and they come from files beside the kernels that hold none themselves.
    """
    folders = {source.parent for source in PACKAGE.rglob("*.py") if b"\n@kernel" in source.read_bytes()}
    return sorted(source for folder in {*folders, Path(__file__).resolve().parent} for source in folder.glob("*.py"))


@functools.cache
def cache_folder() -> Path:
    """Return the folder that holds the compiled kernels of exactly these sources and versions.

    Below `MOTIONLAYER_CACHE`, else `XDG_CACHE_HOME`, else `~/.cache`.
    """
    digest = hashlib.sha256()
    for source in _sources():
        digest.update(source.relative_to(PACKAGE).as_posix().encode() + b"\0" + source.read_bytes())
    names = ("numba", "llvmlite", "numpy")
    digest.update(" ".join([MODE, sys.version, *(f"{name} {version(name)}" for name in names)]).encode())
    own = os.environ.get("MOTIONLAYER_CACHE")
    home = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    base = Path(own) if own else Path(home) / "motionlayer"
    return base / "kernels" / digest.hexdigest()[:16]


def is_cached() -> bool:
    """Tell whether a run has filled the cache of these sources before (always true in mode `plain`)."""
    return MODE == "plain" or (cache_folder() / "complete").exists()


def mark_cached() -> None:
    """Note that the kernels a run needs have been compiled; the next start will be quick."""
    if MODE != "plain" and cache_folder().is_dir():
        (cache_folder() / "complete").touch()


def kernel(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a function of arrays and scalars for the cycle (mode `plain`: leave it as it is).

    No fast-math, so that compiled and plain give the same bits. The GIL is kept: a kernel of microseconds that
    releases it would wait up to a switch interval to get it back.
    """
    if MODE == "plain":
        return function
    return _compiled(function)


def _compiled(function: Callable[P, R]) -> Callable[P, R]:
    import numba  # noqa: PLC0415 - plain mode and clients do without it

    options: dict[str, Any] = {"error_model": "numpy", "boundscheck": MODE == "checked"}
    config: Any = numba.config
    before = config.CACHE_DIR
    config.CACHE_DIR = str(cache_folder())  # read when the function is decorated, and by nobody else then
    try:
        dispatcher: Callable[P, R] = numba.njit(cache=True, **options)(function)
    finally:
        config.CACHE_DIR = before
    return dispatcher
