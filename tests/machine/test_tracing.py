"""What the header of a trace carries: enough to run it again, and to tell whether it still is the same."""

import hashlib
import os
from pathlib import Path

import pytest

from motionlayer import Machine, Simulation, replay
from motionlayer.event import Input, Level
from motionlayer.machine._programs import Source, load_program

MACHINE = {
    "format": 1,
    "name": "one",
    "seed": 7,
    "axis": {"X": {"max_velocity": 1000.0, "max_acceleration": 8000.0, "max_jerk": 1e5}},
}
PROGRAM = """
async def wait(run):
    await run.sleep(0.01)

def poll(run):
    pass
"""


def test_the_header_is_enough_to_load_machine_and_programs_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "some.py").write_text(PROGRAM)
    monkeypatch.chdir(tmp_path)
    sources = [Source("w", Path("some.py"), "wait"), Source("p", Path("some.py"), "poll", "main")]
    with Simulation(Machine.from_dict(MACHINE), seed=3, programs=[load_program(source) for source in sources]) as run:
        run.step(20)
    header = run.trace.header
    monkeypatch.chdir(os.sep)
    for told, source in zip(header["programs"], sources, strict=True):
        path = Path(told["path"])
        assert path.is_absolute()
        assert told["sha256"] == hashlib.sha256(path.read_bytes()).hexdigest()
        again = Source(told["name"], path, told["function"], told["task"], told["prefix"])
        assert again == source._replace(file=path)
        assert load_program(again).sha256 == told["sha256"]
    assert Machine.from_dict(header["machine"]).description == run.machine.description
    assert (header["seed"], header["base_cycle_ns"], header["format"]) == (3, 1_000_000, 1)


def test_the_path_of_a_program_is_no_part_of_the_hash(tmp_path: Path) -> None:
    hashes = set()
    for name in ("a", "b"):
        file = tmp_path / name / "some.py"
        file.parent.mkdir()
        file.write_text(PROGRAM)
        program = load_program(Source("w", file, "wait"))
        with Simulation(Machine.from_dict(MACHINE), programs=[program]) as run:
            run.step(20)
        assert run.trace.header["programs"][0]["path"] == str(file)
        hashes.add(run.trace.hash)
    assert len(hashes) == 1


def test_trouble_of_the_writer_reaches_the_run_as_an_input() -> None:
    """When it comes depends on the computer; a replay is given it, and has no trouble of its own."""
    with Simulation(Machine.from_dict(MACHINE)) as run:
        run.step(5)
        assert run._tracing is not None
        run._tracing._warn("rows of the trace are missing")
        run.step(5)
    trace = run.trace
    assert trace.inputs == (Input(5, "trace", b"rows of the trace are missing"),)
    (event,) = [event for event in trace.events if event.level is Level.WARNING]
    assert (event.tick, event.source, event.text) == (5, "trace", "rows of the trace are missing")
    assert replay(trace).same
