"""Old names of keys are read, with a warning that says where and what is new."""

import warnings
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.cli.support import call

from motionlayer.machine import MachineError, OldName, _renamed, load_description
from motionlayer.machine._fragment import Fragment, Report
from motionlayer.machine._renamed import Rename

Write = Callable[[str], Path]

TABLE = (
    Rename(("axis", "*", "speed"), ("axis", "*", "max_velocity"), "0.2"),
    Rename(("axis", "*", "reference"), ("axis", "*", "home", "position"), "0.2"),
    Rename(("fault", "*", "start"), ("fault", "*", "tick"), "0.2"),
    Rename(("random",), ("seed",), "0.3"),
)
TEXT = """\
format = 1
name = "m"
random = 5
[axis.X]
speed = 10.0
max_acceleration = 10.0
max_jerk = 10.0
reference = 3.0
drive = { kind = "servo", position_gain = 50 }
[[fault]]
axis = "X"
kind = "blocked"
start = 4
"""


@pytest.fixture(autouse=True)
def _injected(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_renamed, "RENAMED", TABLE)


def test_old_names_are_read_with_a_warning_for_each(write: Write) -> None:
    path = write(TEXT)
    with pytest.warns(OldName) as caught:
        description = load_description(path)
    x = description.axis["X"]
    assert (description.seed, x.max_velocity, x.home.position, description.fault[0].tick) == (5, 10.0, 3.0, 4)
    end = "; the next version does not read the old name"
    assert [str(one.message) for one in caught] == [
        f"{path}:3: random: called seed since 0.3{end}",
        f"{path}:5: axis.X.speed: called axis.X.max_velocity since 0.2{end}",
        f"{path}:8: axis.X.reference: called axis.X.home.position since 0.2{end}",
        f"{path}:13: fault[0].start: called fault[0].tick since 0.2{end}",
    ]


def test_todays_names_give_no_warning(write: Write) -> None:
    text = TEXT.replace("random", "seed").replace("speed", "max_velocity").replace("start", "tick")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        load_description(write(text.replace("reference = 3.0\n", "")))


def test_a_wrong_value_is_found_at_the_old_name(write: Write) -> None:
    with pytest.raises(MachineError) as caught:
        load_description(write(TEXT.replace("speed = 10.0", "speed = -1.0")))
    (finding,) = caught.value.findings
    assert (finding.line, finding.field, finding.value) == (5, "axis.X.speed", "-1.0")


def test_both_names_at_once_are_refused(write: Write) -> None:
    with pytest.raises(MachineError) as caught:
        load_description(write(TEXT.replace("speed = 10.0", "speed = 10.0\nmax_velocity = 10.0")))
    (finding,) = caught.value.findings
    assert (finding.line, finding.problem) == (5, "called axis.X.max_velocity since 0.2, which is there too")


def test_old_names_in_modules_and_in_what_is_set_there(write: Write) -> None:
    head, _, rest = TEXT.partition("random = 5\n")
    path = write(head + '[[module]]\nfile = "part.toml"\nprefix = "A_"\nset = { "axis.X.speed" = 7.0 }\n')
    (path.parent / "part.toml").write_text("format = 1\n" + rest, encoding="utf-8")
    with pytest.warns(OldName) as caught:
        description = load_description(path)
    assert (description.axis["A_X"].max_velocity, description.axis["A_X"].home.position) == (7.0, 3.0)
    texts = [str(one.message).replace(f"{path.parent}/", "") for one in caught]
    assert texts[0].startswith('machine.toml:6: module[0].set."axis.X.speed": called axis.X.max_velocity since 0.2')
    assert texts[1].startswith("part.toml:3: axis.X.speed: called axis.X.max_velocity since 0.2")
    assert texts[1].endswith('included at machine.toml:3 as "A_"')


def test_the_file_is_not_changed_by_reading_it() -> None:
    data = {"format": 1, "random": 5}
    fragment = Fragment(None, data)
    assert _renamed.modern(fragment, Report()).data == {"format": 1, "seed": 5}
    assert data == {"format": 1, "random": 5}


def test_the_command_line_says_it_too(write: Write) -> None:
    done = call("check", write(TEXT))
    assert done.exit_code == 0
    assert [line.split(": ")[0] for line in done.stderr.splitlines()] == ["Warning"] * 4


def test_the_table_of_this_version_is_well_formed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.undo()
    for rename in _renamed.RENAMED:
        assert rename.old.count("*") == rename.new.count("*")
        assert rename.old != rename.new
