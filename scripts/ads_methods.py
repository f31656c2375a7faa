"""Write docs/ads-methods.md: the methods of axes that ADS clients call, with the bytes that go there and back.

`--check` writes nothing and fails if the page is not what the code says.
"""

import sys
from collections.abc import Iterable, Iterator
from typing import Final

from _generated import ROOT, current

from motionlayer import Machine, Simulation
from motionlayer.connect.ads import Tree
from motionlayer.connect.ads._nodes import MethodNode

NOTE: Final = "<!-- Written by scripts/ads_methods.py from the code; do not edit. -->"
SYMBOL: Final = "FB_MOTION_AXIS"

HEAD: Final = """\
# Methods of axes, by ADS

`GVL_MOTION.Axis[i]` is an object for each axis, with or without `[layer]`. Its methods are the [blocks](blocks.md) of
the same names, executed once: a call gives the axis a command, in the next tick, and tells whether it was taken.
`motionlayer symbols MACHINE --all` lists them, too.

**A call** is a ReadWrite (command 9) on the handle of the name `GVL_MOTION.Axis[1]#MoveAbsolute`: index group 0xF005,
index offset the handle. The inputs are sent in the order of the table, packed, without gaps, little-endian; what comes
back is packed in the same way: first what the method returns, then its outputs. Units are those of the axis, u.

**What comes back** is the `ErrorID`, 0 where the axis has taken the command, else the [error](errors.md); then, of the
methods that give a command, its number `Command`. From then on the members of the object show what becomes of it, until
the next call that is taken. Who shares an axis with others looks at `Command` first.

- 0.0 for `Acceleration`, `Deceleration`, `Jerk` is what the machine file says, or what the running command has.
  A velocity has to be given.
- `Home`: 1.7e308 for `Position` is the position of the machine file.
- `Stop` does not hold the axis: once it rests, the next command is taken.
- Modes are those of the compiled interface: [MC_BufferMode](layer-types.md#mc_buffermode) 0, 1, 18 to 21;
  [MC_HomingMode](layer-types.md#mc_homingmode) 0, 4, 7, 8; [MC_Direction](layer-types.md#mc_direction) 1, 2, 3, 4.
  Others are refused with 0x429F or 0x4B04; the log names them.

In Python with pyads, which knows no methods but sends what it is given:

```python
import struct
import threading

import pyads

from motionlayer import Machine, RealTime

axis = {"max_velocity": 500.0, "max_acceleration": 5000.0, "max_jerk": 100_000.0}
machine = Machine.from_dict({"format": 1, "name": "served", "axis": {"X": axis}, "ads": {"port": 0}})
BY_HANDLE = 0xF005


def call(plc, method, inputs, results, *values):
    \"\"\"Call a method of the first axis; inputs and results in the signs of `struct`.\"\"\"
    data = struct.pack("<" + inputs, *values)
    handle = plc.get_handle(f"GVL_MOTION.Axis[1]#{method}")
    back, there = pyads.PLCTYPE_BYTE * struct.calcsize("<" + results), pyads.PLCTYPE_BYTE * len(data)
    answer = plc.read_write(BY_HANDLE, handle, back, there(*data), there, return_ctypes=True)
    plc.release_handle(handle)
    return struct.unpack("<" + results, bytes(answer))


def client(run):
    with pyads.Connection("127.0.0.1.1.1", 851, f"127.0.0.1:{run.ads.port}") as plc:
        (error,) = call(plc, "Power", "3?", "I", True, True, True)
        error, command = call(plc, "MoveAbsolute", "5dh", "II", 20.0, 400.0, 0.0, 0.0, 0.0, 0)
        while plc.read_by_name("GVL_MOTION.Axis[1].Busy", pyads.PLCTYPE_BOOL):
            pass
        print(error, plc.read_by_name("GVL_MOTION.Axis[1].Done", pyads.PLCTYPE_BOOL))
        error, command = call(plc, "MoveAbsolute", "5dh", "II", 20.0, 0.0, 0.0, 0.0, 0.0, 0)
        print(hex(error), command)
    run.stop("the client is done")


with RealTime(machine) as run:
    thread = threading.Thread(target=client, args=(run,))
    thread.start()
    run.run(time=60.0)
    thread.join()
# → 0 True
# → 0x4221 0
```

In Node.js with ads-client, which reads the types of inputs and outputs, so that nothing is packed by hand:

```js
@NODE@
```

.NET: `InvokeRpcMethod("GVL_MOTION.Axis[1]", "Halt", new object[] { 0.0, 0.0, (short)0 })` of the vendor's client sends
the same; this one is not run by a test. Written in Structured Text the ReadWrite is an `ADSRDWRTEX`.

Tests: `tests/connect/test_ads_rpc.py`, `tests/connect/test_ads_node.py`.
"""

NODE: Final = "tests/connect/node_client.mjs"


def pages() -> dict[str, str]:
    """Return the page by its name below docs/."""
    axis = {"max_velocity": 1.0, "max_acceleration": 1.0, "max_jerk": 1.0}
    machine = Machine.from_dict({"format": 1, "name": "page", "axis": {"X": axis}})
    with Simulation(machine, ads=False) as run:
        run.step()
        tree = run.ads_tree
    head = HEAD.replace("@NODE@", _node())
    lines = [NOTE, "", head, *_overview(tree)]
    for method in tree.type_named(SYMBOL).methods:
        lines += _method(tree, method)
    return {"ads-methods.md": "\n".join([*lines, *_object(tree)]).rstrip() + "\n"}


def _node() -> str:
    """Return what the test of the client does with methods, between its marks."""
    text = (ROOT / NODE).read_text(encoding="utf-8")
    return text.partition("// shown: methods\n")[2].partition("// end")[0].rstrip()


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> Iterator[str]:
    names = list(head)
    yield "| " + " | ".join(names) + " |"
    yield "|" + "---|" * len(names)
    for row in rows:
        yield "| " + " | ".join(row) + " |"
    yield ""


def _overview(tree: Tree) -> Iterator[str]:
    yield from ["## The methods", ""]
    rows = (
        [f"[{one.name}](#{one.name.lower()})", one.comment, *map(str, _sizes(tree, one))]
        for one in tree.type_named(SYMBOL).methods
    )
    yield from _table(["method", "", "bytes there", "bytes back"], rows)


def _sizes(tree: Tree, method: MethodNode) -> tuple[int, int]:
    there = sum(tree.type_named(one.type).size for one in method.inputs)
    return there, sum(tree.type_named(one).size for one in method.results)


def _method(tree: Tree, method: MethodNode) -> Iterator[str]:
    yield from [f"### {method.name}", "", method.comment, ""]
    rows = list(_places(tree, "there", [(one.name, one.type, one.comment) for one in method.inputs]))
    outputs = [(one.name, one.type, one.comment) for one in method.outputs]
    rows += _places(tree, "back", [("returned", method.returns, "ErrorID, 0: taken"), *outputs])
    yield from _table(["", "byte", "name", "type", "bytes", "meaning"], rows)


def _places(tree: Tree, way: str, parts: Iterable[tuple[str, str, str]]) -> Iterator[list[str]]:
    at = 0
    for name, kind, text in parts:
        size = tree.type_named(kind).size
        yield [way, str(at), f"`{name}`", kind, str(size), text]
        at += size


def _object(tree: Tree) -> Iterator[str]:
    kind = tree.type_named(SYMBOL)
    yield from ["## What the object shows", "", f"{kind.comment} {SYMBOL}, {kind.size} bytes, read only.", ""]
    rows = (
        [str(one.offset), f"`{one.name}`", one.type, str(tree.type_named(one.type).size), one.comment]
        for one in kind.members
    )
    yield from _table(["byte", "member", "type", "bytes", "meaning"], rows)


if __name__ == "__main__":
    sys.exit(current(__doc__ or "", "scripts/ads_methods.py", ROOT / "docs", pages()))
