import json
import tomllib
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from motionlayer.machine._locate import line_of, locate, statement_start

TRICKY = '''\
# a comment with = and [brackets]
top = 1

"quoted.key" = "a # b"
'literal "key"' = 2
a.b."c.d" = """
[not.a.header]
x = 1 \\"""
still inside
"""
raw = \'\'\'
[nor.this]
\'\'\'
list = [  # comment ]
  [1, 2], "]",
  { x = 1, y.z = 2 },
]
inline = { p = 1, "q.r" = { s = 2 } }

[ late . sub ]   # before its parent
key = 1
[late]
key = 2
[[many]]
n = 1
[many.inner]
n = 2
[[many.deep]]
n = 3
[[many]]
n = 4
[[many.deep]]
n = 5
["ʎ".""]
u = "\u2028\u0085"
after = true
'''


def test_tricky_document() -> None:
    expected = {
        ("top",): 2,
        ("quoted.key",): 4,
        ('literal "key"',): 5,
        ("a", "b", "c.d"): 6,
        ("a", "b"): 6,
        ("raw",): 11,
        ("list",): 14,
        ("list", 2, "y", "z"): 14,
        ("inline", "q.r", "s"): 18,
        ("late", "sub"): 20,
        ("late", "sub", "key"): 21,
        ("late",): 22,
        ("late", "key"): 23,
        ("many",): 24,
        ("many", 0): 24,
        ("many", 0, "n"): 25,
        ("many", 0, "inner"): 26,
        ("many", 0, "inner", "n"): 27,
        ("many", 0, "deep", 0, "n"): 29,
        ("many", 1): 30,
        ("many", 1, "n"): 31,
        ("many", 1, "deep", 0, "n"): 33,
        ("ʎ", "", "u"): 35,
        ("ʎ", "", "after"): 36,
    }
    for text in (TRICKY, TRICKY.replace("\n", "\r\n")):
        lines = locate(text)
        assert {path: lines.get(path) for path in expected} == expected


def test_every_value_of_the_document_is_located() -> None:
    def paths(node: Any, path: tuple[str | int, ...] = ()) -> Any:
        items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
        for key, value in items:
            yield (*path, key)
            yield from paths(value, (*path, key))

    assert set(paths(tomllib.loads(TRICKY))) == set(locate(TRICKY)) - {()}


def test_what_is_not_there_is_found_at_the_table_around_it() -> None:
    lines = locate("a = 1\n[b.c]\nd = 2\n")
    assert line_of(("b", "c", "missing"), lines) == 2
    assert line_of(("b", "c", "d", 0), lines) == 3
    assert line_of(("missing", "x"), lines) == 1
    assert line_of(("a",), {}) is None


def test_start_of_a_statement_in_a_broken_text() -> None:
    text = "a = [\n1,\n2]\n\nb = [\n1\n\n"
    assert [statement_start(text, line) for line in (1, 3, 4, 5, 8)] == [1, 1, 4, 5, 5]


# Printable ASCII and some letters, so that JSON's way to quote is TOML's way too.
_NAMES = st.text(st.characters(min_codepoint=32, max_codepoint=0x2FF, exclude_characters="\x7f"), max_size=6)
_LITERALS = st.sampled_from(["1", '"x"', '"""\n[t]\na = 1\n"""', "[\n# ]\n1,\n]", "'''\n'''", "{ a = 1 }", "1 # ="])


@given(st.dictionaries(_NAMES, st.dictionaries(_NAMES, _LITERALS, max_size=4), max_size=4), st.booleans())
def test_keys_are_found_where_they_were_written(document: dict[str, dict[str, str]], nested: bool) -> None:
    text = ""
    expected: dict[tuple[str | int, ...], int] = {}

    def write(path: tuple[str, ...], line: str) -> None:
        nonlocal text
        expected[path] = text.count("\n") + 1
        text += line + "\n"

    for table, values in document.items():
        path = ("root", table) if nested else (table,)
        write(path, "[" + ".".join(json.dumps(key, ensure_ascii=False) for key in path) + "]")
        for key, literal in values.items():
            write((*path, key), f"{json.dumps(key, ensure_ascii=False)} = {literal}")
    lines = locate(text)
    assert {path: lines.get(path) for path in expected} == expected
