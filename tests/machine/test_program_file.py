"""Program files are looked at, not run, when a machine is checked."""

from pathlib import Path

import pytest

from motionlayer.machine import MachineError, load_description

MACHINE = """\
format = 1
name = "one"
[axis.X]
max_velocity = 1000.0
max_acceleration = 8000.0
max_jerk = 100000.0
[program.p]
file = "p.py"
function = "pick"
"""


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("async def pik(run): ...\n", 9, 'program.p.function = "pick": no such function in p.py; did you mean pik?'),
        ("def pick(run, a, b): ...\n", 9, "takes neither the run alone nor run and memory; write `def pick(run)` or"),
        ("def pick(*, run): ...\n", 9, "takes neither the run alone nor run and memory"),
        ("def pick(): ...\n", 9, "takes neither the run alone nor run and memory"),
        ("async def pick(): ...\n", 9, "does not take the run; write `async def pick(run)`"),
        ("async def pick(run):\n  if\n", 8, 'program.p.file = "p.py": not valid Python: line 2: invalid syntax'),
        ("", 9, "no such function in p.py"),
    ],
)
def test_a_program_that_cannot_be_started_is_found(tmp_path: Path, text: str, line: int, said: str) -> None:
    (tmp_path / "m.toml").write_text(MACHINE)
    (tmp_path / "p.py").write_text(text)
    with pytest.raises(MachineError) as caught:
        load_description(tmp_path / "m.toml")
    (finding,) = caught.value.findings
    assert finding.line == line
    assert said in str(finding)


@pytest.mark.parametrize(
    "text",
    [
        "async def pick(run): ...\n",
        "def pick(run): ...\n",
        "def pick(run, memory): ...\n",
        "def pick(run, speed=1.0, *rest, more=2): ...\n",
        "def pick(*arguments): ...\n",
        "@made\ndef pick(): ...\n",
        "from lib import pick\n",
        "from lib import *\n",
        "pick = make()\n",
    ],
)
def test_what_can_be_a_program_or_only_running_it_would_tell_is_taken(tmp_path: Path, text: str) -> None:
    (tmp_path / "m.toml").write_text(MACHINE)
    (tmp_path / "p.py").write_text(text)
    assert load_description(tmp_path / "m.toml").program["p"].function == "pick"


def test_no_task_calls_a_coroutine(tmp_path: Path) -> None:
    (tmp_path / "m.toml").write_text(MACHINE + 'task = "main"\n')
    (tmp_path / "p.py").write_text("async def pick(run): ...\n")
    with pytest.raises(MachineError) as caught:
        load_description(tmp_path / "m.toml")
    (finding,) = caught.value.findings
    assert finding.line == 10
    assert 'program.p.task = "main": pick is a coroutine function, which no task calls; remove the task' in str(finding)
