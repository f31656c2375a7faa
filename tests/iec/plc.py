"""A small controller for tests: it runs Structured Text as exported, with blocks of the system library by hand.

It knows what the exported units use and refuses the rest. Names are taken as written: Structured Text ignores their
case, and a unit that relied on it would fail here.
"""

import contextlib
import functools
import operator
import re
from collections.abc import Callable, Mapping
from typing import Any

from blark import transform as st
from blark.parse import parse_source_code

from .plc_memory import Kind, Memory, Place, Types

BINARY: Mapping[str, Callable[[Any, Any], Any]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "MOD": operator.mod,
    "=": operator.eq,
    "<>": operator.ne,
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
}


OF_VARIABLES: Mapping[str, Callable[[Place], int]] = {"ADR": lambda one: one.at, "SIZEOF": lambda one: one.kind.size}
OF_VALUES: Mapping[str, Callable[[Any], int]] = {"LEN": len, "TO_UDINT": int}
OF_MEMORY: Mapping[str, Callable[[Memory, Mapping[str, int]], int | None]] = {
    "MEMCPY": lambda memory, given: memory.copy(given["destAddr"], given["srcAddr"], given["n"]),
    "MEMCMP": lambda memory, given: memory.compare(given["pBuf1"], given["pBuf2"], given["n"]),
}


class Returned(Exception):  # noqa: N818 - no error
    """RETURN."""


@functools.cache
def parsed(text: str) -> Any:
    """Return the tree of a text; short ones are parsed much faster than long ones.

    Raises:
        Exception: it is no Structured Text.
    """
    result = parse_source_code(text)
    if result.exception is not None:
        raise result.exception
    return result.transform()


class Block:
    """A function block, or a function, with its memory.

    Args:
        text: it, and its methods, as plain text.
        types: of its variables.
        memory: where they lie.
        outside: variables and blocks that it uses; blocks are callable.
    """

    def __init__(self, text: str, types: Types, memory: Memory, outside: Mapping[str, Any]) -> None:
        self.types, self.memory, self.outside = types, memory, outside
        texts = re.split(r"\n(?=METHOD )", text)
        unit, *methods = (item for part in texts for item in parsed(part).items)
        self.name, self.body = str(unit.name), unit.body
        self.methods = {str(one.name): one for one in methods}
        self.constants: dict[str, int] = {}
        self.variables = self._room(texts[0])
        self.declared = dict(zip(self.methods, texts[1:], strict=True))
        self.locals: dict[str, Place] = {}

    def __call__(self, **inputs: Any) -> Any:
        """Run one cycle; return what a function returns."""
        if not self.methods and self.name not in self.variables:
            self.variables[self.name] = self.memory.room(self.types.known["UINT"])
        for name, value in inputs.items():
            self[name] = value
        self._run(self.body)
        return self[self.name] if self.name in self.variables else None

    def __getitem__(self, name: str) -> Any:
        return self.memory.read(self.variables[name])

    def __setitem__(self, name: str, value: Any) -> None:
        self.memory.write(self.variables[name], value)

    def _room(self, text: str) -> dict[str, Place]:
        """Return places for the declared variables, with their start values."""
        found = {}
        text = re.sub(r"//[^\n]*", "", text)
        for head, body in re.findall(r"\bVAR(_INPUT|_OUTPUT| CONSTANT|)\n(.*?)END_VAR", text, re.DOTALL):
            for name, of, start in re.findall(r"(\w+) : ([^;:]*?)(?: := ([^;]*))?;", body):
                if of in self.outside:
                    continue  # a block that is there
                value = self._constant(start) if start else None
                if head == " CONSTANT":
                    self.constants[name] = int(value or 0)
                found[name] = place = self.memory.room(self.types.of(of, self.constants))
                if value is not None:
                    self.memory.write(place, value)
        return found

    def _constant(self, text: str) -> int:
        time = re.fullmatch(r"T#(\d+)S", text)
        return int(time[1]) * 1000 if time else int(text.replace("16#", "0x"), 0)

    def _run(self, statements: Any) -> None:
        with contextlib.suppress(Returned):
            self._all(statements)

    def _all(self, statements: Any) -> None:
        for one in statements.statements if statements else ():
            self._do(one)

    def _do(self, one: Any) -> None:
        match one:
            case st.AssignmentStatement(variables=[target], expression=value):
                place = self._place(target)
                self.memory.write(place, self._value(value))
            case st.IfStatement():
                self._if(one)
            case st.CaseStatement():
                self._case(one)
            case st.ForStatement():
                place = self._place(one.control)
                for value in range(self._value(one.from_), self._value(one.to) + 1):
                    self.memory.write(place, value)
                    self._all(one.statements)
            case st.FunctionCallStatement():
                self._call(one)
            case st.ReturnStatement():
                raise Returned
            case _:
                raise NotImplementedError(str(one))

    def _if(self, one: Any) -> None:
        for branch in (one, *one.else_ifs):
            if self._value(branch.if_expression):
                self._all(branch.statements)
                return
        if one.else_clause is not None:
            self._all(one.else_clause.statements)

    def _case(self, one: Any) -> None:
        value = self._value(one.expression)
        for branch in one.cases:
            if any(self._value(match) == value for match in branch.matches):
                self._all(branch.statements)
                return
        raise AssertionError(f"no branch for {value}")

    def _value(self, one: Any) -> Any:
        found: Any
        match one:
            case st.Integer():
                found = int(str(one.value))
            case st.Boolean():
                found = str(one.value) == "TRUE"
            case st.String():
                found = str(one.value)[1:-1]
            case st.ParenthesizedExpression():
                found = self._value(one.expr)
            case st.UnaryOperation(op="NOT"):
                found = not self._value(one.expr)
            case st.BinaryOperation():
                found = self._binary(one)
            case st.FunctionCall():
                found = self._call(one)
            case _:
                found = self._named(one)
        return found

    def _named(self, one: Any) -> Any:
        """Return a member of an enumeration, an output of a block, or the value of a variable."""
        name = str(one.name if isinstance(one, st.EnumeratedValue) else one)
        if name in self.types.numbers:
            return self.types.numbers[name]
        owner, dot, member = name.partition(".")
        if dot and callable(self.outside.get(owner)):
            return getattr(self.outside[owner], member)
        return self.memory.read(self._place(one))

    def _binary(self, one: Any) -> Any:
        op = str(one.op).upper()
        if op in ("AND", "OR"):  # both sides, as controllers do
            left, right = bool(self._value(one.left)), bool(self._value(one.right))
            return left and right if op == "AND" else left or right
        return BINARY[op](self._value(one.left), self._value(one.right))

    def _place(self, one: Any) -> Place:
        if str(one) in self.outside:
            found = self.outside[str(one)]
            assert isinstance(found, Place)
            return found
        name = str(one.name.name if isinstance(one, st.MultiElementVariable) else one.name)
        place = self.locals.get(name) or self.variables[name]
        for element in getattr(one, "elements", ()):
            if isinstance(element, st.FieldSelector):
                offset, kind = place.kind.fields[str(element.field)]
                place = Place(kind, place.at + offset)
            else:
                (subscript,) = element.subscripts
                place = _element(place, self._value(subscript))
        return place

    def _call(self, one: Any) -> Any:
        name = str(one.name)
        if name in OF_VARIABLES:
            return OF_VARIABLES[name](self._place(_single(one)))
        if name in OF_VALUES:
            return OF_VALUES[name](self._value(_single(one)))
        given = {str(part.name): self._value(part.value) for part in one.parameters}
        if name in OF_MEMORY:
            return OF_MEMORY[name](self.memory, given)
        return self._method(name, given) if name in self.methods else self.outside[name](**given)

    def _method(self, name: str, given: Mapping[str, Any]) -> Any:
        before, end = self.locals, self.memory.end
        self.locals = self._room(self.declared[name])
        returns = re.search(rf"METHOD PRIVATE {name} : (\w+)", self.declared[name])
        if returns:
            self.locals[name] = self.memory.room(self.types.known[returns[1]])
        for place in self.locals.values():
            self.memory.data[place.at : place.at + place.kind.size] = bytes(place.kind.size)
        for key, value in given.items():
            self.memory.write(self.locals[key], value)
        self._run(self.methods[name].body)
        result = self.memory.read(self.locals[name]) if returns else None
        self.locals, self.memory.end = before, end
        return result


def _single(call: Any) -> Any:
    (part,) = call.parameters
    return part.value


def _element(place: Place, index: int) -> Place:
    of = place.kind.of
    assert of is not None
    at = (index - place.kind.low) * of.size
    assert 0 <= at < place.kind.size, f"index {index} is out of bounds"
    return Place(of, place.at + at)


def area(size: int) -> Kind:
    """Return the type of a variable that is only copied."""
    return Kind(size, 8)
