"""The same kernels compiled, with bounds checks and as plain Python: the same bits."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import motionlayer
from tests.effort import thinned

SOURCES = Path(motionlayer.__file__).parent.parent
WORKLOAD = Path(__file__).with_name("workload.py")
MODES = ("compiled", "checked", "plain")


def python(mode: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-W", "error", *arguments],
        env={**os.environ, "PYTHONPATH": str(SOURCES), "MOTIONLAYER_KERNELS": mode},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize("modes", [MODES[::2], pytest.param(MODES, marks=pytest.mark.slow)], ids=", ".join)
def test_all_modes_give_the_same_bits(modes: tuple[str, ...]) -> None:
    runs = {mode: python(mode, str(WORKLOAD)) for mode in modes}
    assert all(run.returncode == 0 for run in runs.values()), {mode: run.stderr for mode, run in runs.items()}
    assert all(len(run.stdout.strip()) == 64 for run in runs.values())
    assert len({run.stdout for run in runs.values()}) == 1, {mode: run.stdout for mode, run in runs.items()}


def test_plain_mode_does_without_numba() -> None:
    code = "import sys, motionlayer.profile, motionlayer.store; print('numba' in sys.modules)"
    assert python("plain", "-c", code).stdout == "False\n"
    assert python("compiled", "-c", code).stdout == "True\n"


@pytest.mark.slow
def test_checked_mode_finds_an_index_out_of_bounds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MOTIONLAYER_CACHE", str(tmp_path / "cache"))
    script = tmp_path / "beyond.py"
    script.write_text(
        "import numpy as np\n"
        "from motionlayer._kernel import kernel\n\n\n"
        "@kernel\n"
        "def beyond(values):\n"
        "    return values[3]\n\n\n"
        "beyond(np.zeros(3))\n"
    )
    for mode in ("checked", "plain"):
        run = python(mode, str(script))
        assert run.returncode == 1
        assert "IndexError" in run.stderr


@pytest.mark.parametrize("mode", thinned(["", "fast", "Compiled"], 3))
def test_unknown_mode_is_one_clear_error(mode: str) -> None:
    run = python(mode, "-c", "import motionlayer.profile")
    assert run.returncode == 1
    last = run.stderr.strip().splitlines()[-1]
    assert last == f"ImportError: MOTIONLAYER_KERNELS is {mode!r}; possible are compiled, checked, plain"
