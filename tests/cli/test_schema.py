import json
from pathlib import Path

import pytest

from motionlayer.cli import ExitCode
from motionlayer.machine import machine_schema, module_schema
from tests.cli.support import call


def test_the_schema_goes_to_stdout() -> None:
    assert json.loads(call("schema").stdout) == machine_schema()
    assert json.loads(call("schema", "--module").stdout) == module_schema()


def test_the_schema_goes_to_a_file(tmp_path: Path) -> None:
    path = tmp_path / "machine.schema.json"
    for _ in range(2):  # of another version, it is replaced
        done = call("schema", "--out", path)
        assert (done.exit_code, done.stdout) == (ExitCode.OK, f"schema      {path}\n")
        assert json.loads(path.read_text(encoding="utf-8")) == machine_schema()


def test_a_machine_file_is_not_overwritten_by_a_slip(machine: Path) -> None:
    before = machine.read_text(encoding="utf-8")
    done = call("schema", "--out", machine)
    assert done.exit_code == ExitCode.USAGE
    assert "a schema is written as .json" in done.stderr
    assert machine.read_text(encoding="utf-8") == before


@pytest.mark.parametrize("name", ["no/folder.json", "."])
def test_where_it_cannot_be_written(tmp_path: Path, name: str) -> None:
    path = tmp_path / name if name != "." else tmp_path / "folder.json"
    if name == ".":
        path.mkdir()
    done = call("schema", "--out", path)
    assert done.exit_code == ExitCode.OUTPUT
    assert f"{path} cannot be written" in done.stderr
