import hashlib
import os
import sys
from pathlib import Path

import pytest

from motionlayer.machine import ProgramError, load_program, parse_source

PROGRAM = "from pathlib import Path\nWORD = {word!r}\n\n\nasync def main(run):\n    print(WORD, Path(__file__).name)\n"


def test_the_text_that_is_recorded_is_the_one_that_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Bytecode is kept by time (whole seconds) and size of its source: both stay as they were here."""
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    file = tmp_path / "p.py"
    for word in ("one", "two"):
        file.write_text(PROGRAM.format(word=word), encoding="utf-8")
        os.utime(file, (1e9, 1e9))
        loaded = load_program(parse_source(str(file)))
        names = loaded.function.__globals__
        assert (names["WORD"], Path(names["__file__"])) == (word, file)
        assert loaded.sha256 == hashlib.sha256(file.read_bytes()).hexdigest()


def test_a_file_that_is_no_python_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "p.txt"
    file.write_text("async def main(run): ...\n", encoding="utf-8")
    with pytest.raises(ProgramError, match=r"p\.txt is not a Python file; its name must end in \.py"):
        load_program(parse_source(str(file)))


def test_an_error_of_the_import_is_that_of_the_program(tmp_path: Path) -> None:
    file = tmp_path / "p.py"
    file.write_text("x = 1\ny = (\n", encoding="utf-8")
    with pytest.raises(ProgramError, match=r"p\.py: SyntaxError: .*p\.py, line 2"):
        load_program(parse_source(str(file)))
