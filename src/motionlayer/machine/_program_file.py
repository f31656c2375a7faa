"""What can be said of a program file without running it: its syntax, and whether it has the function."""

import ast
import difflib
from collections.abc import Iterator
from pathlib import Path

Found = tuple[str, str, str]
"""Field, problem and hint."""


def function_problem(path: Path, function: str, *, cyclic_only: bool = False) -> Found | None:
    """Return (field, problem, hint) if a Python file cannot give a program.

    A name that is imported or assigned, or a function that is decorated, is left to the run: only running the file
    would tell.

    Args:
        path: the file.
        function: name of the function in it.
        cyclic_only: it names a task, which calls no coroutine.
    """
    try:
        tree = ast.parse(path.read_bytes())
    except OSError as error:
        return "file", f"cannot be read: {error.strerror}", ""
    except (SyntaxError, ValueError) as error:
        line = getattr(error, "lineno", None)
        return "file", "not valid Python" + (f": line {line}: {error.args[0]}" if line else ""), ""
    names = dict(_names(tree))
    if function not in names and "*" not in names:
        return _missing(path, function, names)
    return _misfit(function, names.get(function), cyclic_only=cyclic_only)


def _missing(path: Path, function: str, names: dict[str, ast.AST]) -> Found:
    coroutines = [name for name, node in names.items() if isinstance(node, ast.AsyncFunctionDef)]
    plain = [name for name, node in names.items() if isinstance(node, ast.FunctionDef)]
    near = difflib.get_close_matches(function, coroutines + plain, n=1) or coroutines[:1]
    return "function", f"no such function in {path.name}", f"did you mean {near[0]}?" if near else ""


def _misfit(function: str, node: ast.AST | None, *, cyclic_only: bool) -> Found | None:
    """Return what is wrong with a function that is there."""
    if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) or node.decorator_list:
        return None
    if isinstance(node, ast.AsyncFunctionDef):
        if cyclic_only:
            return "task", f"{function} is a coroutine function, which no task calls", "remove the task, or the `async`"
        return (
            None
            if _takes(node.args, 1)
            else ("function", "does not take the run", f"write `async def {function}(run)`")
        )
    if _takes(node.args, 1) or _takes(node.args, 2):
        return None
    offer = f"write `def {function}(run)` or `def {function}(run, memory)`"
    return "function", "takes neither the run alone nor run and memory", offer


def _takes(arguments: ast.arguments, count: int) -> bool:
    """Tell whether a function can be called with so many positional arguments, `prefix=…` and nothing else."""
    names = [one.arg for one in (*arguments.posonlyargs, *arguments.args)]
    required = names[: len(names) - len(arguments.defaults)]
    positional = names.index("prefix") if "prefix" in names else len(names)  # what follows takes keywords alone
    keywords = any(
        default is None and one.arg != "prefix"
        for one, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)
    )
    fits = len(required[:positional]) <= count and (count <= positional or arguments.vararg is not None)
    return fits and not required[positional + 1 :] and not keywords


def _names(tree: ast.Module) -> Iterator[tuple[str, ast.AST]]:
    """Yield every name that a module binds anywhere: too many rather than one too few."""
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            yield node.name, node
        elif isinstance(node, (ast.Import, ast.ImportFrom)):
            yield from ((alias.asname or alias.name, node) for alias in node.names)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id, node
