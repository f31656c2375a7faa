"""Where the computer has no C++ compiler, one comes from the package index; a test that cannot have one fails."""

import shutil
from pathlib import Path

import pytest

from tests.connect import clients

SOURCE = """
extern "C" int puts(const char *);
struct Greeting { ~Greeting() { puts("compiled"); } };
int main() { Greeting greeting; return 0; }
"""


@pytest.mark.slow
def test_without_a_compiler_one_is_installed_that_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "which", lambda _name: None)
    command = clients.compiler()
    assert Path(command[0]).name == "zig"
    source, program = tmp_path / "main.cpp", tmp_path / "main"
    source.write_text(SOURCE, encoding="utf-8")
    # Without the C++ library, which takes minutes to build at the first call.
    clients.run(
        [*command, "-nostdlib++", "-fno-exceptions", str(source), "-o", str(program)], tmp_path, clients.INSTALL_TIME
    )
    assert clients.run([str(program)], tmp_path) == "compiled\n"


def test_an_installation_that_fails_is_a_failure(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(shutil, "which", lambda _name: None)
    monkeypatch.setattr(clients, "KEPT", tmp_path)
    monkeypatch.setenv("PIP_INDEX_URL", "http://127.0.0.1:1/")
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.setenv("PIP_FIND_LINKS", str(tmp_path))
    with pytest.raises(AssertionError, match="pip install"):
        clients.compiler()
