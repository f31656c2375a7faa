"""Diagrams of jobs, drawn from their tables."""

from collections.abc import Callable
from typing import Any

from motionlayer.layer._job import JobTable, Transition, always, nothing


def mermaid(table: JobTable[Any]) -> str:
    """Return a job as a state diagram of Mermaid.

    An arrow has the names of its condition and, behind the stroke, of its action; rows between the same two steps share
    one. Rows that stay in their step stand in its box, as does what it is shown as where that is another one.
    """
    boxes = {step: [f"shown as {shown.name}"] for step, shown in table.shown.items() if shown is not step}
    arrows: dict[tuple[str, str], list[str]] = {}
    for row in table.rows:
        if row.next is row.step:
            boxes.setdefault(row.step, []).append(_label(row))
        else:
            arrows.setdefault((row.step.name, row.next.name), []).append(_label(row))
    lines = ["stateDiagram-v2", f"    [*] --> {table.first.name}"]
    lines += [f"    {step.name} : {'<br>'.join([step.name, *texts])}" for step, texts in boxes.items()]
    for (step, after), labels in arrows.items():
        text = "<br>".join(label for label in labels if label)
        lines.append(f"    {step} --> {after}{' : ' if text else ''}{text}")
    reached = {row.next for row in table.rows}
    lines += [f"    {end.name} --> [*]" for end in sorted(table.ends) if end in reached]
    return "\n".join(lines) + "\n"


def _label(row: Transition[Any]) -> str:
    when = "" if row.when is always else _words(row.when)
    do = "" if row.do is nothing else f"/ {_words(row.do)}"
    return f"{when} {do}".strip()


def _words(function: Callable[..., object]) -> str:
    return function.__name__.strip("_<>").replace("_", " ")
