"""`motionlayer symbols`."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from motionlayer.cli._exit import say
from motionlayer.cli._options import machine_argument

if TYPE_CHECKING:
    from collections.abc import Iterator

    from motionlayer.connect.ads import Tree, TypeNode


@click.command(short_help="List the symbols of a machine.")
@machine_argument
@click.option(
    "--all",
    "members",
    is_flag=True,
    help="Also members of structures, of arrays those of the first element, and methods: inputs, outputs, bytes sent.",
)
def symbols(machine: Path, members: bool) -> None:
    """List what clients of MACHINE see by name: type, size in bytes, r (read), rw (and write) or x (call), comment.

    The programs of MACHINE run for one tick, in which they may declare symbols of their own.
    """
    from motionlayer.cli._first_tick import first_tick  # noqa: PLC0415 - help does without it

    with first_tick(machine) as run:
        tree = run.ads_tree
    for line in _lines(tree, members=members):
        say(line)


def _lines(tree: "Tree", *, members: bool) -> "Iterator[str]":
    for root in tree.roots:
        kind = tree.type_named(root.type)
        access = "rw" if root.writable else "r"
        yield _line(root.name, kind, access, root.comment)
        if members:
            for name, of, comment in _members(tree, root.name, kind):
                yield _line(name, of, access, comment)
            yield from _methods(tree, root.name, kind)


def _line(name: str, kind: "TypeNode", access: str, comment: str) -> str:
    return f"{name:<48} {kind.name:<40} {kind.size:>6} {access:<2} {comment}".rstrip()


def _members(tree: "Tree", name: str, kind: "TypeNode") -> "Iterator[tuple[str, TypeNode, str]]":
    """Yield the parts of a symbol; of an array the first element stands for all."""
    if kind.dimensions:
        of = tree.type_named(kind.base)
        if of.members:
            yield from _members(tree, f"{name}[{','.join(str(low) for low, _ in kind.dimensions)}]", of)
        return
    for member in kind.members:
        of, path = tree.type_named(member.type), f"{name}.{member.name}"
        yield path, of, member.comment
        yield from _members(tree, path, of)


def _methods(tree: "Tree", name: str, kind: "TypeNode") -> "Iterator[str]":
    """Yield the methods of a symbol, of an array those of the first element, with the bytes that a call sends."""
    if kind.dimensions:
        name, kind = f"{name}[{kind.dimensions[0][0]}]", tree.type_named(kind.base)
    for method in kind.methods:
        given, back = (
            ", ".join(f"{one.name} : {one.type}" for one in group) for group in (method.inputs, method.outputs)
        )
        size = sum(tree.type_named(one.type).size for one in method.inputs)
        text = f"{method.comment} ({given}){f' => {back}' if back else ''}"
        yield f"{f'{name}#{method.name}':<48} {method.returns:<40} {size:>6} x  {text}"
