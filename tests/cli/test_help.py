from typing import get_args

import pytest

from motionlayer import __version__, runtime
from motionlayer.cli import ExitCode
from motionlayer.cli._options import FASTEST, LEVELS, SLOWEST
from motionlayer.machine import LogDescription
from motionlayer.runtime import PATIENCE
from tests.cli.support import call, command, python

COMMANDS = ("check", "run", "verify", "plot", "bench", "new", "schema", "error")


@pytest.mark.parametrize("arguments", [[], *([name] for name in COMMANDS)])
def test_help_loads_neither_numpy_nor_the_validation_library(arguments: list[str]) -> None:
    code = (
        "import sys\nfrom motionlayer.cli import main\n"
        f"sys.argv[1:] = {[*arguments, '--help']}\n"
        "try:\n    main()\nexcept SystemExit as end:\n    assert end.code == 0\n"
        "print(sorted({'numpy', 'pydantic', 'numba', 'plotly', 'motionlayer.machine'} & set(sys.modules)))"
    )
    done = python("-c", code)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("Usage: motionlayer")
    assert done.stdout.splitlines()[-1] == "[]"


def test_the_help_names_every_exit_code_and_command() -> None:
    lines = call("--help").stdout.splitlines()
    for code in ExitCode:
        assert any(line.split(maxsplit=1) == [str(int(code)), code.meaning] for line in lines), code
    for name in COMMANDS:
        assert any(line.split(maxsplit=1)[:1] == [name] for line in lines), name


def test_the_help_of_run_names_the_patience_of_the_runtime() -> None:
    assert f"[{PATIENCE:g}]" in call("run", "--help").stdout


def test_what_the_help_knows_by_itself_is_what_the_runtime_takes() -> None:
    assert (SLOWEST, FASTEST) == (runtime.SLOWEST, runtime.FASTEST)
    assert get_args(LogDescription.model_fields["level"].annotation) == LEVELS


def test_version() -> None:
    done = command("--version")
    assert (done.returncode, done.stdout) == (0, f"motionlayer, version {__version__}\n")


def test_an_unknown_command_is_a_usage_error() -> None:
    assert call("fly").exit_code == ExitCode.USAGE


def test_a_wrong_kernel_mode_is_one_clear_error() -> None:
    done = command("check", "machine.toml", MOTIONLAYER_KERNELS="quick")
    assert done.returncode == ExitCode.USAGE
    assert done.stderr == "Error: MOTIONLAYER_KERNELS is 'quick'; possible are compiled, checked, plain\n"
