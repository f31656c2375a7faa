"""Write docs/layer-states.md: the jobs of the motion layer, as diagrams and row by row, from the tables that run.

`--check` writes nothing and fails if the page is not what the code says.
"""

import re
import sys
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Final

from _generated import ROOT, current

from motionlayer.layer import AXIS_JOBS, START_UP, AxisCommand, JobTable, Transition, always, mermaid, nothing
from motionlayer.layer._axis_jobs import NO_INIT
from motionlayer.layer._messages_writer import INIT, WRITE

NOTE: Final = "<!-- Written by scripts/layer_states.py from the code; do not edit. -->"

HEAD: Final = """\
# States of the motion layer

What each command does, step by step, from the tables that the code runs on (`motionlayer.layer.AXIS_JOBS`, `START_UP`).
What the commands are for, and how state and step belong together, tells [the guide](layer.md).

- A job is called once in a cycle. The rows of its step are looked at from above; the first one whose condition holds is
  taken. Where none holds the job stays where it is.
- A step below the present one in the table is gone through *in the same call*. One above it, or the same again, waits
  for *the next call*.
- State shows the command plus the step that the call **before** has left, or what the step is *shown as*.
- An arrow of a diagram says `condition / action`; an arrow that says nothing is always taken. Rows between the same two
  steps share an arrow; rows that stay in their step stand in its box.
- *A call later*: the step shows for one cycle at least, as with a function block that is called with Execute FALSE
  once.
"""

SECTIONS: Final[Mapping[str, str]] = {
    "Commands of an axis": "The step INIT is entered when the command is dropped. DONE and ERROR end the job; it is "
    "not called any more.",
    "Before AXIS_INIT": "Every command but AXIS_INIT, as long as that is not done: State is 1009, then 9009.",
    "Start-up": "`MAIN_AXIS.eInit`; one row per call. The client waits for DONE.",
    "Message writer": "`GVL_MSG_AXIS.MotionMessageState` and `MetricMessageState`; the layer commands both itself.",
}


def pages() -> dict[str, str]:
    """Return the page by its name below docs/."""
    lines = [NOTE, "", HEAD]
    for title, text in SECTIONS.items():
        lines += [f"## {title}", "", text, ""]
        for heading, table in _tables(title):
            lines += _job(heading, table)
    return {"layer-states.md": "\n".join(lines).rstrip() + "\n"}


def _tables(title: str) -> Iterator[tuple[str, JobTable[Any]]]:
    if title == "Commands of an axis":
        yield from ((f"{int(number)} AXIS_{AxisCommand(number).name}", job) for number, job in AXIS_JOBS.items())
    elif title == "Before AXIS_INIT":
        yield "9 AXIS_NO_INIT", NO_INIT
    elif title == "Start-up":
        yield "MAIN_AXIS", START_UP
    else:
        yield "10 MSG_CTRL_INIT", INIT
        yield "50 MSG_CTRL_WRITE", WRITE


def _job(heading: str, table: JobTable[Any]) -> Iterator[str]:
    yield from [f"### {heading}", "", "```mermaid", *mermaid(table).splitlines(), "```", ""]
    if table.prepare is not nothing:
        yield from [f"When the command is dropped: {_sentence(table.prepare)}.", ""]
    yield from ["| step | shown as | condition | action | next |", "|---|---|---|---|---|"]
    before = None
    for row, taken in zip(_in_order(table), (one for step in table.steps for one in table.by_step[step]), strict=True):
        step = "" if row.step is before else row.step.name
        shown = table.shown[row.step].name if step and table.shown[row.step] is not row.step else ""
        before = row.step
        when = "" if row.when is always else _sentence(row.when)
        do = "" if row.do is nothing else _sentence(row.do)
        later = "" if taken.goes_on or row.next in table.ends else ", next call"
        yield f"| {step} | {shown} | {when} | {do} | {row.next.name}{later} |"
    yield ""


def _in_order(table: JobTable[Any]) -> list[Transition[Any]]:
    return [row for step in table.steps for row in table.rows if row.step is step]


def _sentence(function: Callable[..., object]) -> str:
    """Return what a docstring says first, without the kind of the function and its reasons."""
    text = " ".join((function.__doc__ or "").split("\n\n")[0].split()).partition(": ")[2]
    return re.split(r";| \(|, so that", text)[0].rstrip(".").replace("|", r"\|")


if __name__ == "__main__":
    sys.exit(current(__doc__ or "", "scripts/layer_states.py", ROOT / "docs", pages()))
