"""Write the pages of the function blocks, docs/blocks/: inputs, outputs, and a timing diagram from a run.

`--check` writes nothing and fails if a page is not what the code says.
"""

import enum
import inspect
import re
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any, Final

from _generated import ROOT, current
from _scenarios import LIMITS, ON, SCENARIOS, Scenario
from _timing import Curve, Lane, diagram

from motionlayer import Machine, Simulation, fb
from motionlayer.drive import Fault
from motionlayer.fb._inputs import NAMES

DOCS: Final = ROOT / "docs" / "blocks"
NOTE: Final = "<!-- Written by scripts/blocks.py from the code and a run; do not edit. -->"
TYPES: Final = {bool: "BOOL", int: "UDINT", float: "LREAL"}
BAD: Final = ("Error", "CommandAborted", "ErrorStop")
LAST: Final = ("Done", "Valid", "Busy", "Active", "CommandAborted", "Error", "ErrorID")


def blocks() -> dict[str, type[fb.Block]]:
    """Return all blocks by name."""
    return {name: getattr(fb, name) for name in fb.__all__ if name.startswith("MC_") and _is_block(getattr(fb, name))}


def pages() -> dict[str, str]:
    """Return every generated file by its name below docs/blocks/."""
    made = {"parameters.md": "\n".join([NOTE, "", *_parameters()]) + "\n"}
    for name, block in blocks().items():
        scenario = SCENARIOS.get(name)
        made[f"{name}.md"] = "\n".join([NOTE, "", *_page(name, block, scenario)]).rstrip() + "\n"
        if scenario is not None:
            made[f"{name}.svg"] = picture(name, scenario)
    return made


def _is_block(found: object) -> bool:
    return isinstance(found, type) and issubclass(found, fb.Block)


# -- a run ----------------------------------------------------------------------------------------------------------


def picture(title: str, scenario: Scenario) -> str:
    """Run a scenario and draw what its blocks showed."""
    with tempfile.TemporaryDirectory() as folder:
        return _drawn(title, scenario, str(Path(folder) / "kept.toml"))


def _drawn(title: str, scenario: Scenario, kept: str) -> str:
    axis = LIMITS | scenario.axis
    table = {"format": 1, "name": "scenario", "axis": {"X": axis}}
    table |= {"persistent_file": kept} if scenario.persistent else {}
    run = Simulation(Machine.from_dict(table), trace=None)
    ref, made = run.axis_refs["X"], {}
    for name, block in scenario.blocks.items():
        made[name] = block(run if block is fb.MC_OverrideFilter else ref)  # type: ignore[call-arg]
    power: Any = made.get("power") or fb.MC_Power(ref)
    if scenario.powered:
        _cycles(run, 20, lambda: power(**ON))
    if scenario.fault is not None:
        run.inject("X", Fault(scenario.fault[1]), run.tick + scenario.fault[0])  # type: ignore[arg-type]
    start, seen = run.tick, _Seen(scenario, made)

    def main() -> None:
        for name, block in ({"power": power} | made).items():
            inputs = [new for at, which, new in scenario.steps if at == run.tick - start and which == name]
            block(**(inputs[0] if inputs else {}))
        seen.look(ref)

    _cycles(run, scenario.length, main)
    unit = axis.get("unit", "mm")
    return diagram(title, seen.lanes(), seen.curves(str(unit)), run.base_cycle_ns * 1e-6)


def _cycles(run: Simulation, ticks: int, main: Callable[[], object]) -> None:
    def called(_run: object) -> None:
        main()

    program = run.cyclic(called)
    run.step(ticks)
    program.cancel()
    if program.failure is not None:
        raise program.failure


class _Seen:
    """What the blocks of a scenario showed, per cycle."""

    def __init__(self, scenario: Scenario, made: dict[str, Any]) -> None:
        self._scenario = scenario
        self._made = made
        names = [(name, signal) for name, block in made.items() for signal in _booleans(block)]
        chosen = [tuple(lane.split(".")) for lane in scenario.lanes]
        self._flags: dict[tuple[str, ...], list[bool]] = {key: [] for key in chosen or names}
        self._values: dict[str, list[float]] = {source: [] for source, _ in scenario.curves}

    def look(self, ref: fb.AXIS_REF) -> None:
        """Note what there is in this cycle."""
        for (name, signal), values in self._flags.items():
            values.append(bool(getattr(self._made[name], signal)))
        for source, values in self._values.items():
            name, _, output = source.partition(".")
            values.append(float(getattr(self._made[name], output) if output else getattr(ref.NcToPlc, name)))

    def lanes(self) -> list[Lane]:
        """Return the lanes that are TRUE at some time, and all that were asked for."""
        found = []
        for (name, signal), values in self._flags.items():
            block = type(self._made[name])
            kind = "in" if signal in block.INPUTS else "bad" if signal in BAD else "out"
            if any(values) or self._scenario.lanes:
                found.append(Lane(f"{name} : {block.__name__}", signal, kind, values))
        return found

    def curves(self, unit: str) -> list[Curve]:
        """Return the curves; the unit of the axis is part of their names."""
        per = {"velocity": f", {unit}/s", "position": f", {unit}"}
        names = dict(self._scenario.curves)
        return [
            Curve(names[source] + per.get(names[source].split()[-1], ""), values)
            for source, values in self._values.items()
        ]


def _booleans(block: fb.Block) -> list[str]:
    """Return inputs and outputs that are TRUE or FALSE, in the order in which they are drawn."""
    inputs = [name for name, one in block.INPUTS.items() if one.type == "BOOL"]
    return inputs + [name for name in _outputs(block) if isinstance(getattr(block, name), bool)]


# -- a page ---------------------------------------------------------------------------------------------------------


def _parameters() -> Iterator[str]:
    """Yield the lines of the page of the parameters."""
    yield from ["# Parameters of an axis", ""]
    yield "Read with [MC_ReadParameter](MC_ReadParameter.md), [MC_ReadBoolParameter](MC_ReadBoolParameter.md), written"
    yield "with [MC_WriteParameter](MC_WriteParameter.md), [MC_WriteBoolParameter](MC_WriteBoolParameter.md), by the"
    yield "numbers of `MC_AxisParameter`. A written value holds at once, for what is commanded from then on."
    yield from ["", "A value is written within what the machine file allows, never beyond: a velocity up to"]
    yield "`max_velocity`, a software limit inside the one that is there, a window no wider than the watched one. What"
    yield "the file has switched on stays on. Software limits and maxima are written only while the axis has no job."
    yield "Errors: 0x4B05 for a number that is not here, of the other kind or not to be written, 0x4B06 for a value"
    yield from ["out of its range, 0x4220 in motion.", ""]
    yield from ["| number | name | type | unit | written | meaning |", "|---|---|---|---|---|---|"]
    for number, entry in fb.PARAMETERS.items():
        written = "" if entry.write is None else "yes"
        yield f"| {int(number)} | {number.name} | {TYPES[entry.kind]} | {entry.unit} | {written} | {entry.text} |"


def _instance(block: type[fb.Block]) -> fb.Block:
    return block(_Clock()) if block is fb.MC_OverrideFilter else block()  # type: ignore[call-arg]


class _Clock:
    time = 0.0


def _page(name: str, block: type[fb.Block], scenario: Scenario | None) -> Iterator[str]:
    """Yield the lines of the page of a block."""
    summary, _, rest = (inspect.getdoc(block) or "").partition("\n")
    more = re.split(r"^(?:Args|Attributes):", rest, flags=re.MULTILINE)[0].strip()
    yield from [f"# {name}", "", summary, ""]
    if more:
        yield from [more, ""]
    if scenario is not None:
        yield from [f"![Timing diagram of {name}]({name}.svg)", "", scenario.text, ""]
    made = _instance(block)
    yield from ["## Inputs", "", "| name | type | default | meaning |", "|---|---|---|---|"]
    for one, entry in block.INPUTS.items():
        yield f"| `{one}` | {entry.type} | {_default(entry.default)} | {entry.text} |"
    yield from ["", "## Outputs", "", "| name | type | meaning |", "|---|---|---|"]
    for one, text in _outputs(made).items():
        assert "|" not in text, f"{name}.{one}: a bar would end the cell of the table"
        value = getattr(made, one)
        yield f"| `{one}` | {TYPES.get(type(value), type(value).__name__)} | {text} |"
    for entry in block.INPUTS.values():
        yield from _type(entry.type, entry.default)


def _default(default: object) -> str:
    if isinstance(default, enum.IntEnum):
        return f"{default.name} ({int(default)})"
    if isinstance(default, bool):
        return str(default).upper()
    return (
        ""
        if default is None or isinstance(default, type)
        else f"{default:g}"
        if isinstance(default, float)
        else str(default)
    )


def _type(name: str, default: object) -> Iterator[str]:
    """Yield members of an enumeration, or fields of a structure and then those of its enumerations."""
    if isinstance(default, enum.IntEnum):
        yield from ["", f"## {name}", "", "| number | name |", "|---|---|"]
        yield from (f"| {int(one)} | {one.name} |" for one in type(default))
    elif isinstance(default, type) and is_dataclass(default):
        texts = dict(_attributes(default))
        yield from ["", f"## {name}", "", "| field | default | meaning |", "|---|---|---|"]
        yield from (
            f"| `{one.name}` | {_default(one.default)} | {texts[one.name].rstrip('.')} |" for one in fields(default)
        )
        members = {NAMES.get(type(one.default), type(one.default).__name__): one.default for one in fields(default)}
        for inner, member in members.items():
            if isinstance(member, enum.IntEnum):
                yield from _type(inner, member)


def _outputs(block: fb.Block) -> dict[str, str]:
    """Return the outputs with their meaning: those of its own first, those that all have last."""
    found: dict[str, str] = {}
    for base in type(block).__mro__:
        for name, text in _attributes(base):
            if not name.isupper() and name not in found and name not in {*block.INPUTS, *type(block).HIDDEN}:
                found[name] = text.rstrip(".").replace("`ErrorId`", "the [errors](../errors.md)")
    own = [name for name in found if name not in LAST]
    return {name: found[name] for name in [*own, *(name for name in LAST if name in found)]}


def _attributes(of: type) -> Iterator[tuple[str, str]]:
    """Yield names and texts of the section `Attributes` of a docstring, and of documented properties."""
    section = re.search(r"^Attributes:\n((?: +.*\n?)+)", inspect.cleandoc(of.__doc__ or ""), re.MULTILINE)
    if section:
        for name, text in re.findall(r"^    (\w+): (.*(?:\n     +.*)*)", section[1], re.MULTILINE):
            yield name, " ".join(text.split())
    for name, member in vars(of).items():
        if isinstance(member, property) and not name.startswith("_"):
            yield name, " ".join((member.__doc__ or "").split())


if __name__ == "__main__":
    sys.exit(current(__doc__ or "", "scripts/blocks.py", DOCS, pages()))
