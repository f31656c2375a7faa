"""Cyclic programs and tasks of a machine file."""

from pathlib import Path

import pytest

from motionlayer import Machine, Simulation
from motionlayer.machine import ProgramError, Source, load_program
from motionlayer.runtime import MAIN, CyclicProgram
from motionlayer.verify import assert_valid
from tests.machines import LINEAR

FILE = """\
format = 1
name = "tasks"
[axis.X]
max_velocity = 500.0
max_acceleration = 5000.0
max_jerk = 100_000.0
[task.slow]
every = 10
phase = 3
[program.count]
file = "programs.py"
function = "count"
task = "slow"
[program.drive]
file = "programs.py"
"""

PROGRAMS = """\
def count(run, memory):
    memory.ticks = [*getattr(memory, "ticks", []), run.tick]

def main(run):
    x = run.axes["X"]
    if run.tick == 0:
        x.enable()
    elif run.tick == 5:
        x.move_absolute(20.0)

async def sequence(run):
    await run.sleep(1.0)
"""


def load(tmp_path: Path, text: str = FILE, programs: str = PROGRAMS) -> Machine:
    (tmp_path / "m.toml").write_text(text)
    (tmp_path / "programs.py").write_text(programs)
    return Machine.load(tmp_path / "m.toml")


def test_a_machine_file_names_functions_and_their_tasks(tmp_path: Path) -> None:
    with Simulation(load(tmp_path)) as run:
        count, _ = run._scheduler.programs
        run.run(time=0.3)
        assert isinstance(count, CyclicProgram)
        assert count.memory.ticks == list(range(3, 300, 10))
        assert run.axes["X"].set_position == 20.0
        assert_valid(run.trace)


def test_the_same_machine_with_the_same_cyclic_programs_gives_the_same_hash(tmp_path: Path) -> None:
    loaded, hashes = load(tmp_path), set[str]()
    for _ in range(2):
        run = Simulation(loaded, trace=False)
        run.run(time=0.2)
        hashes.add(run.close())
    assert len(hashes) == 1


@pytest.mark.parametrize(
    ("task", "function", "said"),
    [("slow", "sequence", "is a coroutine function, which no task calls"), (None, "generate", "must be `async def")],
)
def test_a_function_that_is_no_program_is_refused_at_load(
    tmp_path: Path, task: str | None, function: str, said: str
) -> None:
    load(tmp_path, programs=PROGRAMS + "def generate(run):\n    yield\n")
    with pytest.raises(ProgramError, match=said):
        load_program(Source("p", tmp_path / "programs.py", function, task))


def test_a_task_in_python_is_the_one_of_the_file() -> None:
    data = {"format": 1, "name": "t", "axis": {"X": LINEAR}, "task": {"main": {"every": 2, "budget": 1e-4}}}
    run = Simulation(Machine.from_dict(data))
    assert list(run.tasks) == [MAIN]
    assert (run.tasks[MAIN].every, run.tasks[MAIN].budget_ns) == (2, 100_000)
