"""What other processes do, and what the end of one leaves: with real processes."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from motionlayer.record.log import LogError, LogFolder
from motionlayer.record.log._log import INTERVAL
from tests.record.log.support import files, message, opened, texts

SOURCE = Path(__file__).resolve().parents[3]
TAIL = "tail"
FILE = "2025_10_24/851_MSG_PLC_2025_10_24.txt"

WRITER = """
import sys, time
from pathlib import Path
from tests.record.log.support import message, opened
log = opened(Path(sys.argv[1]))
number = 0
while True:
    log(message(number, f"number {number}"))
    number += 1
    if number % 100 == 0:
        print(number, time.monotonic(), flush=True)
        time.sleep(0.001)
"""


def python(code: str, folder: Path) -> subprocess.Popen[str]:
    paths = f"{SOURCE}{os.pathsep}{SOURCE / 'src'}"
    environment = {**os.environ, "PYTHONPATH": paths}
    return subprocess.Popen(
        [sys.executable, "-c", code, str(folder)], env=environment, stdout=subprocess.PIPE, text=True
    )


@pytest.mark.slow
@pytest.mark.parametrize("seconds", [0.05, 0.31, 0.77])
def test_a_killed_run_loses_no_more_than_an_interval_and_leaves_no_lock(tmp_path: Path, seconds: float) -> None:
    writer = python(WRITER, tmp_path)
    assert writer.stdout is not None
    writer.stdout.readline()  # it has begun
    time.sleep(seconds)
    writer.send_signal(signal.SIGKILL)
    killed = time.monotonic()
    said = [(int(number), float(at)) for number, at in re.findall(r"(\d+) ([\d.]+)\n", writer.stdout.read())]
    writer.stdout.close()
    writer.wait()
    old = max((number for number, at in said if at < killed - 2 * INTERVAL), default=0)
    written = texts([line for line in (tmp_path / FILE).read_text().split("\n") if line.count("\t") == 5])
    assert written == [f"number {number}" for number in range(len(written))]
    assert len(written) >= old
    log = opened(tmp_path)  # the lock went with the process
    log(message(0, "after"))
    log.close()
    assert files(tmp_path)[FILE][-1].endswith("\tafter")


def test_an_interpreter_that_ends_without_closing_writes_everything(tmp_path: Path) -> None:
    writer = python(
        "import sys\nfrom pathlib import Path\nfrom tests.record.log.support import message, opened\n"
        "log = opened(Path(sys.argv[1]))\nfor number in range(5000):\n    log(message(number, str(number)))\n"
        "raise SystemExit(3)",
        tmp_path,
    )
    writer.communicate(timeout=60)
    assert writer.returncode == 3
    assert texts(files(tmp_path)[FILE]) == [str(number) for number in range(5000)]


def test_a_reader_that_is_killed_changes_nothing(tmp_path: Path) -> None:
    log = opened(tmp_path)
    reader = subprocess.Popen([TAIL, "-n", "+1", "-f", tmp_path / FILE], stdout=subprocess.PIPE, text=True)
    assert reader.stdout is not None
    log(message(0, "0"))
    assert reader.stdout.readline().endswith("\t0\n")
    reader.kill()
    reader.wait()
    reader.stdout.close()
    for number in range(1, 1000):
        log(message(number, str(number)))
    log.close()
    assert texts(files(tmp_path)[FILE]) == [str(number) for number in range(1000)]
    assert (log.missing, log.trouble) == (0, "")


def test_a_second_run_of_another_process_is_refused_by_its_name(tmp_path: Path) -> None:
    writer = python(WRITER, tmp_path)
    assert writer.stdout is not None
    writer.stdout.readline()
    with pytest.raises(LogError, match=rf"the run of process {writer.pid} writes there; wait for its end, or name"):
        LogFolder(tmp_path)
    writer.kill()
    writer.wait()
    writer.stdout.close()
    LogFolder(tmp_path).close()


def test_a_second_run_of_this_process_is_refused(tmp_path: Path) -> None:
    folder = LogFolder(tmp_path)
    with pytest.raises(LogError, match="another run of this process writes there; close"):
        LogFolder(tmp_path)
    folder.close()
