import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from motionlayer.machine import Description, Finding, MachineError, check_description, load_description

GOOD = (Path(__file__).parent / "good.toml").read_text(encoding="utf-8")  # sets every field
Write = Callable[[str], Path]

_NOT_FINITE = ["nan", "inf", "-inf", "+nan", "1" + "0" * 400]
_NOT_A_NUMBER = ['"1"', "true", "[1.0]", "{}", "1979-05-27", '"""\n1"""']
_NOT_A_TEXT = ["0", "-1.5", "nan", "false", '["a"]', "{}", '""']
_TEXTS = {"name", "unit", "mode", "direction", "kind", "file", "function", "task", "paths", "group"}
_FROM_ZERO = {"seed", "phase"}
_ANY_SIGN = {"software_limit_min", "software_limit_max", "start_position", "position", "switch"}


def _fields() -> list[tuple[int, str, str]]:
    """Return (index of the line, table, key) of every plain field of GOOD."""
    found, table = [], ""
    for index, line in enumerate(GOOD.splitlines()):
        if line.startswith("["):
            table = line.strip("[]") + "."
        elif "=" in line and not table.startswith("trace"):
            found.append((index, table, line.split(" = ")[0]))
    return found


def _bad_literals(key: str) -> st.SearchStrategy[str]:
    if key in _TEXTS:
        return st.sampled_from(_NOT_A_TEXT)
    bad = st.sampled_from(_NOT_FINITE + _NOT_A_NUMBER)
    if key in _ANY_SIGN:
        return bad
    negative = st.floats(max_value=-5e-324, allow_infinity=False).map(repr)
    whole = st.integers(-(2**70), -1).map(str)
    return st.one_of(bad, negative, whole) if key in _FROM_ZERO else st.one_of(bad, negative, whole, st.just("0"))


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(field=st.sampled_from(_fields()), data=st.data(), padding=st.integers(0, 3))
def test_a_corrupted_field_is_named_alone_with_its_line(
    write: Write, field: tuple[int, str, str], data: st.DataObject, padding: int
) -> None:
    index, table, key = field
    lines = GOOD.splitlines()
    lines[index] = f"{key} = {data.draw(_bad_literals(key))}"
    text = "# padding\n" * padding + "\n".join(lines)
    with pytest.raises(MachineError) as caught:
        load_description(write(text))
    (finding,) = caught.value.findings
    assert (finding.line, finding.field) == (index + 1 + padding, table + key)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(field=st.sampled_from(_fields()), key=st.from_regex(r"[A-Za-z0-9_-]{1,12}", fullmatch=True))
def test_an_unknown_key_is_named_alone_with_its_line(write: Write, field: tuple[int, str, str], key: str) -> None:
    index, table, _ = field
    key += "_x"  # no field ends so
    lines = GOOD.splitlines()
    lines.insert(index + 1, f"{key} = 1")
    with pytest.raises(MachineError) as caught:
        load_description(write("\n".join(lines)))
    (finding,) = caught.value.findings
    assert (finding.line, finding.field) == (index + 2, table + key)
    assert "unknown key" in str(finding)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(
    index=st.integers(0, len(GOOD.splitlines()) - 1),
    junk=st.one_of(
        st.text(max_size=20), st.sampled_from(["[", "[[axis]]", '"""', "[axis.X]", "axis = 1", "X.X.X = 1"])
    ),
)
def test_any_text_is_read_or_refused_in_order(write: Write, index: int, junk: str) -> None:
    lines = GOOD.splitlines()
    lines.insert(index, junk)
    path = write("\n".join(lines))
    findings: tuple[Finding, ...] = ()
    try:
        load_description(path)
    except MachineError as error:
        findings = error.findings
    assert all(finding.line is not None for finding in findings)


_KEYS = st.one_of(
    st.sampled_from(["format", "name", "axis", "program", "trace", "signals", "resolution", "home", "file", "X", "x"]),
    st.sampled_from([*Description.model_fields, "[key]", "velocity", "max_velocity"]),
    st.text(max_size=3),
    st.integers(0, 3),
)
_VALUES: st.SearchStrategy[Any] = st.recursive(
    st.one_of(
        st.none(),
        st.booleans(),
        st.integers(),
        st.floats(),
        st.text(max_size=5),
        st.binary(max_size=3),
    ),
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(_KEYS, inner, max_size=4)),
    max_leaves=20,
)


@settings(deadline=None)
@given(st.dictionaries(_KEYS, _VALUES, max_size=5))
def test_any_data_is_checked_or_refused_in_order(data: dict[str, Any]) -> None:
    data["format"] = 1
    data["seed"] = math.nan
    with pytest.raises(MachineError) as caught:
        check_description(data)
    fields = [finding.field for finding in caught.value.findings]
    assert "seed" in fields
    assert all(part.isprintable() for part in str(caught.value).split("\n"))
