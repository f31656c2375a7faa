"""What tasks, programs and the base cycle must have in common."""

import difflib
from collections.abc import Iterator, Mapping

from motionlayer.machine._data import number, table
from motionlayer.machine._problem import Problem, value_text
from motionlayer.runtime import MAIN, TaskConfig, heaviest


def task_problems(data: object) -> Iterator[Problem]:
    """Yield what is wrong between tasks, programs and the base cycle."""
    tasks = table(data, "task")
    cycle = data.get("base_cycle_ns", 1_000_000) if isinstance(data, dict) else None
    if isinstance(cycle, int) and 50_000 <= cycle <= 100_000_000:  # else that alone is the problem
        found = list(_budget_problems(tasks, cycle))
        yield from found or _crowd_problems(tasks, cycle)
    known = [*tasks, *([MAIN] if MAIN not in tasks else [])]
    for name, program in table(data, "program").items():
        task = program.get("task") if isinstance(program, dict) else None
        if isinstance(task, str) and task and task not in known:
            near = difflib.get_close_matches(task, known, n=1)
            hint = f"did you mean {near[0]}?" if near else "tasks are " + ", ".join(known)
            yield Problem(("program", name, "task"), value_text(task), problem="no such task", hint=hint)


def _budget_problems(tasks: Mapping[str, object], cycle: int) -> Iterator[Problem]:
    for name, task in tasks.items():
        budget = number(task, "budget")
        if budget is not None and budget * 1e9 > cycle:
            yield Problem(
                ("task", name, "budget"),
                value_text(budget),
                f"at most the base cycle = {cycle * 1e-9:g} (s)",
                hint="a task is not interrupted, so one that takes longer delays the tick, however rarely it runs",
            )


def _crowd_problems(tasks: Mapping[str, object], cycle: int) -> Iterator[Problem]:
    """Yield a problem if the budgets of tasks that meet in one tick are longer than it."""
    configs = [one for one in (_config(name, task) for name, task in tasks.items()) if one is not None]
    if len(configs) < len(tasks):  # what is wrong with one may change the phases of all
        return
    crowd = heaviest(configs)
    total = sum(one.budget or 0.0 for one in crowd)
    if total * 1e9 > cycle * (1.0 + 1e-9):
        last, others = crowd[-1], ", ".join(one.name for one in crowd[:-1])
        yield Problem(
            ("task", last.name, "budget"),
            value_text(last.budget),
            problem=f"{total:g} s in one tick together with {others}, and the base cycle is {cycle * 1e-9:g} s",
            hint="lower the budgets, or let the tasks run in different ticks: every, phase",
        )


def _config(name: str, task: object) -> TaskConfig | None:
    """Return a task as it would be; None where the models find something wrong."""
    if not isinstance(task, dict):
        return None
    every, phase, budget = task.get("every", 1), task.get("phase"), number(task, "budget")
    right = (
        type(every) is int
        and every >= 1
        and (phase is None or (type(phase) is int and 0 <= phase < every))
        and (task.get("budget") is None or (budget is not None and budget > 0.0))
    )
    return TaskConfig(name, every, phase, budget) if right else None
