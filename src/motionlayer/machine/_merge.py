"""Putting the tables of a module, names already with prefix, beside those of the file that includes it."""

from typing import Any

from pydantic import ValidationError

from motionlayer.machine._data import table
from motionlayer.machine._description import TraceDescription
from motionlayer.machine._fragment import Flat, Report
from motionlayer.machine._names import LISTS, NAMED
from motionlayer.machine._problem import Problem, value_text
from motionlayer.machine._words import table_problems


def merge(flat: Flat, module: Flat, report: Report) -> None:
    """Add a module to what includes it: own tables first, then those of the modules in their order."""
    _merge_trace(flat, module, report)
    for section in NAMED:
        if _mergeable(flat, module, section, (dict,), report):
            _merge_named(flat, module, section, report)
    for section in LISTS:
        if _mergeable(flat, module, section, (list, tuple), report):
            own = flat.data.get(section, [])
            for index in range(len(module.data[section])):
                flat.origins[section, len(own) + index] = module.origin((section, index))
            flat.data[section] = [*own, *module.data[section]]


def _mergeable(flat: Flat, module: Flat, section: str, kinds: tuple[type, ...], report: Report) -> bool:
    """Tell whether both sides are what they must be; a side that is not is reported, here or by the models."""
    if section not in module.data:
        return False
    value = module.data[section]
    if not isinstance(value, kinds):
        allowed = "a table" if dict in kinds else "a list"
        report.findings.append(module.origin((section,)).finding(Problem((section,), value_text(value), allowed)))
        report.unread = True
        return False
    return isinstance(flat.data.get(section, kinds[0]()), kinds)


def _merge_named(flat: Flat, module: Flat, section: str, report: Report) -> None:
    own: dict[Any, Any] = flat.data.get(section, {})
    for name in module.data[section]:
        path = (section, name)
        if name in own:
            problem = f"{section} {name} is already defined at {flat.origin(path).place}"
            hint = "include one of them with another prefix"
            report.findings.append(module.origin(path).finding(Problem(path, problem=problem, hint=hint)))
    flat.data[section] = own | {name: entry for name, entry in module.data[section].items() if name not in own}
    for where, origin in module.origins.items():
        if where[:1] == (section,) and len(where) > 1 and where[1] not in own:
            flat.origins[where] = origin


def _merge_trace(flat: Flat, module: Flat, report: Report) -> None:
    """Join what is traced. Who names no signals wants all of its axes, beside one that names some."""
    ours, theirs = flat.data.get("trace", {}), _checked_trace(module, report)
    if not isinstance(ours, dict):
        return
    trace = dict(ours)
    if "signals" in ours or "signals" in theirs:
        left, right = _signals(flat, ours), _signals(module, theirs)
        trace["signals"] = [*left, *right]
        for index in range(len(theirs.get("signals", ()))):
            flat.origins["trace", "signals", len(left) + index] = module.origin(("trace", "signals", index))
    own, more = table(ours, "resolution"), theirs.get("resolution", {})
    if more:
        # The last pattern that matches decides: the file itself, before its modules.
        added = {pattern: value for pattern, value in more.items() if pattern not in own}
        trace["resolution"] = added | own
        for pattern in added:
            flat.origins["trace", "resolution", pattern] = module.origin(("trace", "resolution", pattern))
    if trace:
        flat.data["trace"] = trace


def _checked_trace(module: Flat, report: Report) -> dict[str, Any]:
    """Return `[trace]` of a module; one that is wrong is reported, since nothing of it would reach the models."""
    trace = module.data.get("trace", {})
    try:
        TraceDescription.model_validate(trace)
    except ValidationError as error:
        for problem in table_problems(error, ("trace",)):
            report.findings.append(module.origin(problem.path).finding(problem))
        report.unread = True
        return {}
    found: dict[str, Any] = trace
    return found


def _signals(flat: Flat, trace: dict[str, Any]) -> list[Any]:
    """Return the patterns of a side."""
    signals = trace.get("signals", [f"{axis}.*" for axis in table(flat.data, "axis")])
    return list(signals) if isinstance(signals, list | tuple) else [signals]
