"""What `[layer]` and `[control]` have in common with axes, and maps with one another."""

from collections.abc import Iterator, Mapping
from typing import Final

from motionlayer.machine._data import table
from motionlayer.machine._problem import KeyPath, Problem, field_text, value_text

_OF_AXES: Final = ("axis", "cam", "saw")
_SIZES: Final = {"nci": {"max_nci_channels": 1}, "trigger": {"max_trigger_box": 12, "max_touch_probe": 12}}
_LARGEST: Final = 999

_Owners = dict[tuple[str, int], KeyPath]
"""Where an object was given away."""


def layer_problems(data: object) -> Iterator[Problem]:
    """Yield what is wrong between the motion layer, its maps, and the axes."""
    if not isinstance(data, dict):
        return
    yield from _axis_problems(data)
    if data.get("layer") is not None and data.get("control") is not None:  # in a dump, None is left out
        yield Problem(
            ("control",),
            problem="a machine has a motion layer of its own, or commands that of another one",
            hint="leave out [layer] or [control]; the axes of [control] are those of the other machine",
        )
    layer = table(data, "layer")
    yield from _phase_problems(layer)
    yield from _name_problems(table(data, "control").get("axes"))
    yield from _map_problems(layer, list(table(data, "axis")))


def _axis_problems(data: Mapping[str, object]) -> Iterator[Problem]:
    """A machine has axes, or commands those of another one."""
    allowed = "a table with at least one entry"
    if data.get("control") is not None or data.get("axis", {}) != {}:
        return
    if "axis" in data:
        yield Problem(("axis",), value_text({}), allowed)
    else:
        yield Problem(("axis",), problem="missing", allowed=allowed)


def _phase_problems(layer: Mapping[str, object]) -> Iterator[Problem]:
    if not isinstance(layer.get("divisor", {}), dict):  # that alone is the problem
        return
    divisors = table(layer, "divisor")
    for name, phase in table(layer, "phase").items():
        divisor = divisors.get(name, 1)
        if type(phase) is int and type(divisor) is int and phase >= divisor >= 1:
            yield Problem(("layer", "phase", name), value_text(phase), f"less than layer.divisor.{name} = {divisor}")


def _name_problems(names: object) -> Iterator[Problem]:
    """Axes of the other machine are told apart as those of this one."""
    first: dict[str, int] = {}
    for index, name in enumerate(names if isinstance(names, list | tuple) else []):
        if isinstance(name, str) and first.setdefault(name.upper(), index) != index:
            problem = f"the same name as {field_text(('control', 'axes', first[name.upper()]))}"
            yield Problem(("control", "axes", index), value_text(name), problem=problem)


def _map_problems(layer: Mapping[str, object], axes: list[str]) -> Iterator[Problem]:
    """Names of maps begin the names of images, and an object has one owner."""
    first: dict[str, KeyPath] = {}
    owners: _Owners = {}
    for name, one in table(layer, "map").items():
        at: KeyPath = ("layer", "map", name)
        if not (name.isidentifier() and name.isascii()) or name.upper() == "MAPPING_AXIS":
            allowed = "letters, digits and underscores, not beginning with a digit, and not MAPPING_AXIS"
            yield Problem(at, problem="not a name of a map", allowed=allowed)
        other = first.setdefault(name.upper(), at)
        if other != at:
            yield Problem(at, problem=f"differs from {field_text(other)} only in upper and lower case")
        group = one.get("group") if isinstance(one, dict) else None
        if isinstance(one, dict) and isinstance(group, str) and (group in _OF_AXES or group in _SIZES):
            yield from _object_problems(at, one, _count(group, layer, len(axes)), axes, owners)


def _object_problems(
    at: KeyPath, one: Mapping[str, object], count: int, axes: list[str], owners: _Owners
) -> Iterator[Problem]:
    """Yield objects that do not exist, or that another map has already."""
    group, objects, selector = str(one["group"]), one.get("objects"), one.get("selector")
    if isinstance(objects, list | tuple):
        for index, thing in enumerate(objects):
            number, problem = _number(thing, axes if group in _OF_AXES else [], count, (*at, "objects", index))
            yield from [problem] if problem is not None else []
            yield from [] if number is None else _taken(group, [number], (*at, "objects", index), owners)
    else:
        yield from _taken(group, range(1, count + 1), at, owners)
    if group == "axis" and selector is True:
        yield from _taken("selector", [0], (*at, "selector"), owners)


def _number(thing: object, axes: list[str], count: int, where: KeyPath) -> tuple[int | None, Problem | None]:
    """Return the index of an object, or what is wrong with it; neither where the models find its type wrong."""
    if isinstance(thing, str) and thing in axes:
        return axes.index(thing) + 1, None
    if isinstance(thing, str) and thing and axes:
        return None, Problem(where, value_text(thing), problem="no such axis", hint="axes are " + ", ".join(axes))
    if type(thing) is int and 1 <= thing <= count:
        return thing, None
    wrong_value = type(thing) is int or (isinstance(thing, str) and thing)
    return None, Problem(where, value_text(thing), f"an index from 1 to {count}") if wrong_value else None


def _count(group: str, layer: Mapping[str, object], axes: int) -> int:
    """Return how many objects of a group there are; where a size is wrong, that is the problem."""
    if group in _OF_AXES:
        return axes
    sizes = [layer.get(key, usual) for key, usual in _SIZES[group].items()]
    return max(size if type(size) is int and 1 <= size <= _LARGEST else _LARGEST for size in sizes)


def _taken(what: str, numbers: range | list[int], where: KeyPath, owners: _Owners) -> Iterator[Problem]:
    """Give objects away; yield the first that has an owner already."""
    others = [(number, owners.setdefault((what, number), where)) for number in numbers]
    for number, other in others:
        if other != where:
            yield Problem(
                where,
                problem=f"{'the parameter selector' if what == 'selector' else f'{what} {number}'} "
                f"belongs to {field_text(other)} already",
                hint="an object has one owner, or the images of two controllers would overwrite one another",
            )
            return
