"""What can be said of a program file without running it: its syntax, and whether it has the function."""

import ast
import difflib
from collections.abc import Iterator
from pathlib import Path


def function_problem(path: Path, function: str) -> tuple[str, str, str] | None:
    """Return (field, problem, hint) if a Python file cannot give `async def function(run)`.

    A name that is imported or assigned is left to the run: only running the file would tell.
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
        programs = [name for name, node in names.items() if isinstance(node, ast.AsyncFunctionDef)]
        near = difflib.get_close_matches(function, programs, n=1) or programs[:1]
        return "function", f"no such function in {path.name}", f"did you mean {near[0]}?" if near else ""
    if isinstance(names.get(function), ast.FunctionDef):
        return "function", "not a coroutine function", f"write `async def {function}(run)`"
    return None


def _names(tree: ast.Module) -> Iterator[tuple[str, ast.AST]]:
    """Yield every name that a module binds anywhere: too many rather than one too few."""
    for node in ast.walk(tree):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            yield node.name, node
        elif isinstance(node, (ast.Import, ast.ImportFrom)):
            yield from ((alias.asname or alias.name, node) for alias in node.names)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id, node
