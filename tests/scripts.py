"""The scripts of the checkout as modules, where a test wants more of them than a process gives."""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[1]


def script(name: str) -> ModuleType:
    """Return a script of scripts/, which finds what lies beside it while it is loaded."""
    spec = importlib.util.spec_from_file_location(name, ROOT / "scripts" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    path = sys.path.copy()
    sys.path.insert(0, str(ROOT / "scripts"))
    spec.loader.exec_module(module)
    sys.path[:] = path
    return module
