import pickle
from collections.abc import Callable
from pathlib import Path

import pytest

from motionlayer.machine import Finding, MachineError, check_description, load_description

AXIS = "[axis.X]\nmax_velocity = 10.0\nmax_acceleration = 10.0\nmax_jerk = 10.0\n"
GOOD = (Path(__file__).parent / "good.toml").read_text(encoding="utf-8")  # sets every field
Write = Callable[[str], Path]

HEAD = 'format = 1\nname = "m"\n'
SERVO = '[axis.X.drive]\nkind = "servo"\nposition_gain = 50\n'
FAULT = SERVO + '[[fault]]\naxis = "X"\nkind = "blocked"\ntick = 3\n'


def findings_of(write: Write, text: str) -> tuple[Finding, ...]:
    with pytest.raises(MachineError) as caught:
        load_description(write(text))
    return caught.value.findings


# text → (line, field, fragment of the message) of the one finding
BAD = [
    # numbers
    (
        HEAD + AXIS.replace("10.0", "-5.0", 1),
        4,
        "axis.X.max_velocity",
        "= -5.0: must be greater than 0 (mm/s)",
    ),
    (
        HEAD + AXIS + "velocity = 11\n",
        7,
        "axis.X.velocity",
        "= 11: must be at most max_velocity = 10.0 (mm/s)",
    ),
    (HEAD + AXIS + "acceleration = 11\n", 7, "axis.X.acceleration", "at most max_acceleration = 10.0"),
    (HEAD + AXIS + "deceleration = 11\n", 7, "axis.X.deceleration", "at most max_deceleration = 10.0"),
    (HEAD + AXIS + "jerk = 11\n", 7, "axis.X.jerk", "at most max_jerk = 10.0 (mm/s³)"),
    (
        HEAD + AXIS + "start_position = inf\n",
        7,
        "axis.X.start_position",
        "= inf: must be a finite number (mm)",
    ),
    (HEAD + AXIS + "start_position = 1e61\n", 7, "axis.X.start_position", "= 1e+61: must be from -1e+60 to 1e+60 (mm)"),
    (HEAD + AXIS + "jerk = 1e-61\n", 7, "axis.X.jerk", "= 1e-61: must be from 1e-60 to 1e+60 (mm/s³)"),
    (HEAD + AXIS + "start_position = true\n", 7, "axis.X.start_position", "= true: must be a finite number"),
    (HEAD + "base_cycle_ns = 5\n" + AXIS, 3, "base_cycle_ns", "must be from 50_000 to 100_000_000 (ns)"),
    (HEAD + "base_cycle_ns = 1e6\n" + AXIS, 3, "base_cycle_ns", "must be a whole number from 50_000"),
    (HEAD + "seed = -1\n" + AXIS, 3, "seed", "must be from 0 to"),
    (
        HEAD + AXIS + "software_limit_min = 5\nsoftware_limit_max = 5\n",
        8,
        "axis.X.software_limit_max",
        "must be greater than software_limit_min = 5.0 (mm)",
    ),
    # homing
    (
        HEAD + AXIS + "[axis.X.home]\nvelocity = 10.5\n",
        8,
        "axis.X.home.velocity",
        "at most max_velocity = 10.0",
    ),
    (
        HEAD + AXIS + "[axis.X.home]\nvelocity = inf\n",
        8,
        "axis.X.home.velocity",
        "= inf: must be a finite number",
    ),
    (HEAD + AXIS + '[axis.X.home]\nmode = "switch"\n', 7, "axis.X.home.switch", "missing; must be a finite"),
    (
        HEAD + AXIS + '[axis.X.home]\nmode = "software_sync"\nswitch = 1\n',
        7,
        "axis.X.home.turn",
        'mode = "software_sync" needs it',
    ),
    (
        HEAD + AXIS + '[axis.X.home]\nmode = "soft_latch_negative"\nswitch = 1\n',
        7,
        "axis.X.home.latch",
        'mode = "soft_latch_negative" needs it',
    ),
    (HEAD + AXIS + "[axis.X.home]\nturn = 0\n", 8, "axis.X.home.turn", "= 0: must be greater than 0 (mm)"),
    (HEAD + AXIS + "[axis.X.home]\nlatch_width = 1\n", 8, "axis.X.home.latch_width", "left out without latch"),
    (HEAD + AXIS + '[axis.X.home]\nmode = "swich"\n', 8, "axis.X.home.mode", 'one of "direct", "switch"'),
    (HEAD + AXIS + '[axis.X.drive]\nkind = "step"\n', 8, "axis.X.drive.kind", 'one of "ideal", "servo"'),
    # drives
    (HEAD + AXIS + '[axis.X.drive]\nkind = "servo"\n', 7, "axis.X.drive.position_gain", 'kind = "servo" needs it'),
    (HEAD + AXIS + "[axis.X.drive]\nbacklash = 1\n", 8, "axis.X.drive.backlash", "an ideal drive has no such thing"),
    (HEAD + AXIS + SERVO + "backlash = -1\n", 10, "axis.X.drive.backlash", "= -1: must be at least 0 (mm)"),
    (
        HEAD + AXIS + SERVO + "dead_time = 0.0015\n",
        10,
        "axis.X.drive.dead_time",
        "a whole number of base cycles of 0.001",
    ),
    (HEAD + AXIS + SERVO + "ready_delay = 2\n", 10, "axis.X.drive.ready_delay", "at most 1000 base cycles = 1 (s)"),
    (HEAD + AXIS + SERVO.replace("50", "2000"), 9, "axis.X.drive.position_gain", "must be less than 2000, where"),
    (HEAD + AXIS + SERVO + "velocity_feed_forward = 1.5\n", 10, "axis.X.drive.velocity_feed_forward", "from 0 to 1"),
    (
        HEAD + AXIS + "[axis.X.monitor]\ntarget_timeout = 1\n",
        8,
        "axis.X.monitor.target_timeout",
        "without target_window",
    ),
    (HEAD + AXIS + "[axis.X.monitor]\nsoftware_limits = 1\n", 8, "axis.X.monitor.software_limits", "true or false"),
    (HEAD + AXIS + '[group.all]\naxes = ["X", "Y"]\n', 8, "group.all.axes[1]", '= "Y": no such axis'),
    (HEAD + AXIS + "[group.all]\naxes = []\n", 8, "group.all.axes", "with at least one entry"),
    (HEAD + AXIS + FAULT.replace("tick = 3\n", ""), 10, "fault[0]", "no tick or time"),
    (HEAD + AXIS + FAULT + "time = 1.0\n", 10, "fault[0]", "one of tick and time"),
    (HEAD + AXIS + FAULT.replace("blocked", "bolcked"), 12, "fault[0].kind", "must be one of"),
    (HEAD + AXIS + FAULT.replace('"X"', '"Z"'), 11, "fault[0].axis", "no such axis"),
    (HEAD + AXIS + FAULT.partition("\n[[")[2].join(["[[", ""]), 8, "fault[0].axis", "its drive is ideal"),
    (HEAD + AXIS + FAULT + "value = 1.0\n", 14, "fault[0].value", "only an encoder_jump takes one"),
    (HEAD + AXIS + FAULT.replace("blocked", "encoder_jump"), 10, "fault[0].value", "missing"),
    # keys and tables
    (HEAD + AXIS + "max_velocty = 1\n", 7, "axis.X.max_velocty", "unknown key; did you mean max_velocity?"),
    (HEAD + AXIS + SERVO + "max_torque = 1\n", 10, "axis.X.drive.max_torque", "did you mean max_acceleration?"),
    (HEAD + AXIS + "qqqq = 1\n", 7, "axis.X.qqqq", "max_velocity, max_acceleration"),
    (
        HEAD + AXIS.replace("max_jerk", "max_jrek"),
        6,
        "axis.X.max_jrek",
        "unknown key; did you mean max_jerk?",
    ),
    (
        HEAD + AXIS.replace("max_jerk", "jerk"),
        3,
        "axis.X.max_jerk",
        "missing; must be a finite number greater",
    ),
    (
        HEAD + AXIS + "[axis.x]\nmax_velocity=1\nmax_acceleration=1\nmax_jerk=1\n",
        7,
        "axis.x",
        "differs from axis.X",
    ),
    (HEAD + AXIS.replace("[axis.X]", "[axis.1X]"), 3, "axis.1X", "not beginning with a digit"),
    (HEAD + AXIS.replace("[axis.X]", "[axis.a__b]"), 3, "axis.a__b", "single underscores"),
    (HEAD + AXIS.replace("[axis.X]", '[axis."X\\n"]'), 3, 'axis."X\\n"', "not a name of an axis"),
    (HEAD + "axis = 3\n", 3, "axis", "= 3: must be a table with at least one entry"),
    (HEAD + "[axis]\n", 3, "axis", "= {}: must be a table with at least one entry"),
    (HEAD, 1, "axis", "missing; must be a table with at least one entry"),
    ('format = 1\nname = ""\n' + AXIS, 2, "name", "must be a text that is not empty"),
    # format
    ('name = "m"\n' + AXIS, 1, "format", "missing; formats understood: 1"),
    (
        'name = "m"\nformat = 2\nnew = 3\n',
        2,
        "format",
        "= 2: not a format this version understands; formats unders",
    ),
    ('name = "m"\nformat = true\n' + AXIS, 2, "format", "formats understood: 1"),
    # tasks
    (HEAD + AXIS + "[task.a]\nevery = 0\n", 8, "task.a.every", "= 0: must be from 1 to 1_000_000"),
    (HEAD + AXIS + "[task.a]\nevery = 1.5\n", 8, "task.a.every", "must be a whole number from 1 to"),
    (HEAD + AXIS + "[task.a]\nevery = 4\nphase = 4\n", 9, "task.a.phase", "= 4: must be from 0 to every - 1 = 3"),
    (HEAD + AXIS + "[task.a]\nphase = -1\n", 8, "task.a.phase", "= -1: must be at least 0"),
    (HEAD + AXIS + "[task.a]\nbudget = 0\n", 8, "task.a.budget", "= 0: must be greater than 0 (s)"),
    (
        HEAD + AXIS + "[task.a]\nevery = 10\nbudget = 0.0011\n",
        9,
        "task.a.budget",
        "= 0.0011: must be at most the base cycle = 0.001 (s)",
    ),
    (
        HEAD + "base_cycle_ns = 1\n" + AXIS + "[task.a]\nbudget = 0.5\n",
        3,
        "base_cycle_ns",
        "= 1: must be from 50_000 to 100_000_000 (ns)",
    ),
    (
        HEAD + AXIS + "[task.a]\nbudget = 0.0006\n[task.b]\nevery = 10\nbudget = 0.0005\n",
        11,
        "task.b.budget",
        "= 0.0005: 0.0011 s in one tick together with a, and the base cycle is 0.001 s\n    lower the budgets",
    ),
    (
        HEAD + AXIS + '[task.fast]\n[program.a]\nfile = "pick.py"\ntask = "fats"\n',
        10,
        "program.a.task",
        '= "fats": no such task; did you mean fast?',
    ),
    (HEAD + AXIS + '[program.a]\nfile = "pick.py"\ntask = "x"\n', 9, "program.a.task", "tasks are main"),
    # programs and trace
    (HEAD + AXIS + "[program.a]\n", 7, "program.a.file", "missing; must be a text"),
    (HEAD + AXIS + '[program.a]\nfile = "no.py"\n', 8, "program.a.file", '= "no.py": no such file'),
    (HEAD + AXIS + '[program.a]\nfile = "."\n', 8, "program.a.file", "not a file"),
    (HEAD + AXIS + '[program.a]\nfile = "\\u0000"\n', 8, "program.a.file", '"\\u0000"'),
    (
        HEAD + AXIS + '[program.a]\nfile = "pick.py"\nfunction = "a b"\n',
        9,
        "program.a.function",
        "Python function",
    ),
    (
        HEAD + AXIS + '[trace]\nsignals = ["X.*", "X.set_postion"]\n',
        8,
        "trace.signals[1]",
        "mean X.set_position?",
    ),
    (HEAD + AXIS + '[trace]\nsignals = "*"\n', 8, "trace.signals", '= "*": must be a list'),
    (HEAD + AXIS + '[trace]\nsignals = [\n"*",\n3]\n', 8, "trace.signals[1]", "= 3: must be a text"),
    (HEAD + AXIS + '[trace.resolution]\n"Y.*" = 1\n', 8, 'trace.resolution."Y.*"', "matches no signal"),
    (HEAD + AXIS + '[trace.resolution]\n"*" = 0\n', 8, 'trace.resolution."*"', "= 0: must be greater than 0"),
    # TOML itself
    (HEAD + AXIS + "[axis.X]\n", 7, "", "already defined"),
    (HEAD + AXIS + "max_jerk = 1\n", 7, "", "already defined"),
    (HEAD + AXIS + "max_jerk = [\n1,\n]\n", 7, "", "already defined"),
    (HEAD + "[axis.X\n", 3, "", "not valid TOML: expected ']'"),
    (HEAD + "a b\n", 3, "", "not valid TOML"),
    (HEAD + AXIS.replace("= 10.0", "= 10,5", 1), 4, "", "numbers have a decimal point, and no separator but _"),
    (HEAD + "a = -1,5 # mm\n", 3, "", "numbers have a decimal point, and no separator but _"),
    (HEAD + "a = [\n1,\n2 3]\n", 5, "", "not valid TOML"),
    (HEAD + "a = [1,\n2\n\n", 3, "", "not valid TOML: unclosed array"),
    (HEAD + "a = " + "9" * 5000 + "\n", 3, "", "not valid TOML"),
    (HEAD + "a = " + "[" * 100_000 + "\n", None, "", "nested too deeply"),
]


@pytest.mark.parametrize(("text", "line", "field", "fragment"), BAD, ids=[f"{case[2]}: {case[3]}" for case in BAD])
def test_one_bad_thing_is_named_with_its_line(
    write: Write, text: str, line: int | None, field: str, fragment: str
) -> None:
    (finding,) = findings_of(write, text)
    assert (finding.line, finding.field) == (line, field)
    assert fragment in str(finding)


@pytest.mark.parametrize("content", ["missing", "folder", "latin-1", "utf-16", "nul"])
def test_a_file_that_cannot_be_read_gives_one_clear_message(tmp_path: Path, content: str) -> None:
    path = tmp_path / "machine.toml"
    expected = {
        "missing": "no such file",
        "folder": "a folder, not a machine file",
        "latin-1": "not UTF-8 text",
        "utf-16": "not UTF-8 text",
        "nul": "cannot be read",
    }
    if content == "folder":
        path.mkdir()
    elif content == "nul":
        path = tmp_path / "a\0b"
    elif content != "missing":
        path.write_bytes('format = 1\nname = "Tür"\n'.encode(content))
    with pytest.raises(MachineError, match=expected[content]) as caught:
        load_description(path)
    (finding,) = caught.value.findings
    assert finding.line == {"latin-1": 2, "utf-16": 1}.get(content)


def test_an_unreadable_file_is_named(tmp_path: Path) -> None:
    path = tmp_path / "loop.toml"
    path.symlink_to(path)
    with pytest.raises(MachineError, match="cannot be read: too many levels of symbolic links"):
        load_description(path)


def test_all_problems_come_at_once_in_the_order_of_the_file(write: Write) -> None:
    text = (
        GOOD.replace("seed = 7", "sed = 7")
        .replace("max_velocity = 1500.0", "max_velocity = nan")
        .replace("velocity = 50.0", "velocity = 600.0")
        .replace("max_velocity = 500.0", "max_velocity = 500.0\nhome.velocity = 501")
        .replace('"pick.py"', '"nick.py"')
        .replace('"*.set_position"', '"Z.*"')
    )
    assert [(finding.line, finding.field) for finding in findings_of(write, text)] == [
        (4, "sed"),
        (8, "axis.X.max_velocity"),
        (32, "axis.Y.home.velocity"),
        (37, "program.pick.file"),
        (42, "trace.signals[1]"),
    ]


def test_the_text_has_one_block_for_each_problem(write: Write) -> None:
    path = write(HEAD + AXIS + "velocity = 0\nqqqq = 1\n")
    with pytest.raises(MachineError) as caught:
        load_description(path)
    lines = str(caught.value).splitlines()
    assert lines[0] == f"{path}:7: axis.X.velocity = 0: must be greater than 0 (mm/s)"
    assert lines[1] == f"{path}:8: axis.X.qqqq: unknown key"
    assert lines[2].startswith("    known keys: unit, max_velocity")
    assert max(len(line) for line in lines[2:]) <= 110


def test_error_survives_a_process_border() -> None:
    error = MachineError([Finding("m.toml", 3, "seed", "-1", "from 0 to 9")])
    assert pickle.loads(pickle.dumps(error)).findings == error.findings  # noqa: S301 - our own bytes


def test_data_without_a_file_gives_the_same_text_without_place() -> None:
    axis = {"max_velocity": -5.0, "max_acceleration": 1.0, "max_jerk": 1.0}
    with pytest.raises(MachineError) as caught:
        check_description({"format": 1, "name": "m", "axis": {"X": axis}})
    assert str(caught.value) == "axis.X.max_velocity = -5.0: must be greater than 0 (mm/s)"


def test_a_number_python_will_not_write_is_refused_in_order() -> None:
    with pytest.raises(MachineError) as caught:
        check_description({"format": 1, "name": "m", "axis": {}, "seed": -(10**9999)})
    assert "seed = a huge integer: must be from 0" in str(caught.value)


def test_control_characters_do_not_reach_the_terminal() -> None:
    with pytest.raises(MachineError) as caught:
        check_description({"format": 1, "name": "m", "axis": {}, "\x1b[31m": 1, "seed": "\x1b\x07"})
    assert all(character.isprintable() or character == "\n" for character in str(caught.value))
