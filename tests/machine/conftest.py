from collections.abc import Callable
from pathlib import Path

import pytest


@pytest.fixture
def write(tmp_path: Path) -> Callable[[str], Path]:
    """Write a machine file beside the program it names; return its path."""

    def write(text: str) -> Path:
        (tmp_path / "pick.py").write_text("main = pick_and_place = pick = None\n", encoding="utf-8")
        path = tmp_path / "machine.toml"
        path.write_bytes(text.encode("utf-8", "surrogatepass"))
        return path

    return write
