"""Reference pages: the generated ones are what the code says, names in the written one exist."""

import builtins
import pkgutil
import re
from pathlib import Path
from types import ModuleType

import pytest

import motionlayer.layer
import motionlayer.machine
import motionlayer.record
import motionlayer.runtime
from motionlayer import Machine, Simulation
from motionlayer.machine import SimulationKeywords
from tests.scripts import ROOT, script


@pytest.fixture(scope="module")
def generator() -> ModuleType:
    return script("reference")


@pytest.mark.parametrize("name", ["states.md", "errors.md", "machine-keys.md", "cli.md"])
def test_a_generated_page_is_what_the_code_says(generator: ModuleType, name: str) -> None:
    assert (ROOT / "docs" / name).read_text() == generator.pages()[name], "run scripts/reference.py"


def sections() -> dict[str, list[str]]:
    """Return the names in the first column of the tables of reference.md, by heading."""
    text = (ROOT / "docs" / "reference.md").read_text()
    parts = re.split(r"^## (.*)$", text, flags=re.MULTILINE)[1:]
    found = {}
    for title, body in zip(parts[::2], parts[1::2], strict=True):
        cells = [line.split("|")[1] for line in body.splitlines() if line.startswith("|")]
        found[title] = [name for cell in cells for name in re.findall(r"`(?:\w+\.)?(\w+)", cell)]
    return found


@pytest.fixture(scope="module")
def known() -> dict[str, set[str]]:
    """Return the names that there are, by heading."""
    limits = {"max_velocity": 1000.0, "max_acceleration": 8000.0, "max_jerk": 1e5}
    with Simulation(Machine.from_dict({"format": 1, "name": "m", "axis": {"X": limits}})) as run:

        async def nothing() -> None:
            pass

        axis, program, cyclic = run.axes["X"], run.start(nothing()), run.cyclic(lambda _: None)
        command = axis.enable()
        run.run(time=0.1)
    trace = run.trace
    packages = (
        motionlayer,
        motionlayer.layer,
        motionlayer.machine,
        motionlayer.record,
        motionlayer.runtime,
        builtins,
    )
    return {
        "Axis": set(dir(axis)),
        "Command": {*dir(command), *dir(program), *dir(cyclic)},
        "Simulation": {*dir(run), *SimulationKeywords.__annotations__},
        "Trace": {*dir(trace), *(name.partition(".")[2] for name in trace)},
        "Exceptions": {name for package in packages for name in dir(package)},
    }


@pytest.mark.parametrize("title", ["Axis", "Command", "Simulation", "Trace", "Exceptions"])
def test_every_name_in_the_reference_exists(title: str, known: dict[str, set[str]]) -> None:
    names = sections()[title]
    assert len(names) > 7
    assert set(names) - known[title] == set()


INSIDE = {
    "Axis": {
        *("abandon", "braking", "buffered", "configure", "cycle", "fault", "ledger", "left_alone"),
        *("power_requested", "refuse", "under_way"),
    },
    "Command": {
        *("abort", "activate", "advice", "awaited", "cancelling", "close", "deadlines", "fail", "finish", "on_end"),
        *("part", "resume", "since", "value", "waits_for", "warned"),
    },
    "Simulation": {"ads_tree", "guest", "ticking"},
    "Trace": {"from_chunks", "get", "items", "keys", "tail", "values"},  # a mapping has these anyway
}
"""Names without an underscore that only other parts of motionlayer use: no user needs them."""


@pytest.mark.parametrize("title", list(INSIDE))
def test_every_public_name_is_in_the_reference(title: str, known: dict[str, set[str]]) -> None:
    public = {name for name in known[title] if not name.startswith("_")}
    assert public - set(sections()[title]) == INSIDE[title]


def test_every_place_in_the_code_that_move_names_exists() -> None:
    parts = "|".join(path.name for path in Path(motionlayer.__file__).parent.iterdir() if path.is_dir())
    names = re.findall(rf"`((?:{parts})(?:\.\w+)+)`", (ROOT / "docs" / "move.md").read_text())
    assert len(names) > 7
    for name in names:
        pkgutil.resolve_name(f"motionlayer.{name}")
