from pathlib import Path

import pytest

from motionlayer.cli import ExitCode
from tests.cli.support import MACHINE, call, program


@pytest.fixture(scope="session", autouse=True)
def _kernels(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Compile the kernels before any test looks at what stderr says."""
    path = tmp_path_factory.mktemp("kernels") / "machine.toml"
    path.write_text(MACHINE, encoding="utf-8")
    assert call("run", path, *program("main")).exit_code == ExitCode.OK


@pytest.fixture
def machine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A machine file without programs, in the working directory."""
    monkeypatch.chdir(tmp_path)
    path = Path("machine.toml")
    path.write_text(MACHINE, encoding="utf-8")
    return path
