"""What turns the class of a structure into that of its views: attributes that read and write memory.

A view keeps its memory and where it begins; nested structures and arrays are views of their own, made with it.
"""

# ruff: noqa: SLF001 - the slots of a view are what these functions are for

from collections.abc import Mapping
from typing import Any, Final

from motionlayer.iec._compound import CompoundType, check_room, refuse_write
from motionlayer.iec._layout import Layout, Member
from motionlayer.iec._type import Bytes, Memory, Scalar
from motionlayer.iec._writer import Put


def view_namespace(layout: Layout, slots: tuple[str, ...] = ()) -> dict[str, Any]:
    """Return the namespace of a class of views, with more slots than the two of its own."""
    shown = {member.attribute: _shown(member) for member in layout.members if isinstance(member.type, Scalar)}
    return {"__slots__": ("_memory", "_start", *slots), **shown, **_METHODS}


def view_put(member: Member) -> Put:
    """Return what writes a checked value of a scalar member into the memory of a view."""
    offset = member.offset
    if member.bit is not None:
        return _bit_put(offset, 1 << member.bit)
    assert isinstance(member.type, Scalar)
    write, encode = member.type.write, member.type.encoder
    if encode is None:
        return lambda view, value: write(view._memory, view._start + offset, value)
    return lambda view, value: write(view._memory, view._start + offset, encode(value))


def look(view: Any, layout: Mapping[str, Member], memory: memoryview, start: int) -> None:  # noqa: ANN401
    """Let a new view look at memory.

    Raises:
        ValueError: it ends too early.
    """
    kind = view.type
    if memory.format != "B":
        memory = memory.cast("B")
    check_room(kind.name, kind.size, memory, start)
    object.__setattr__(view, "_memory", memory)
    object.__setattr__(view, "_start", start)
    object.__setattr__(view, "_guard", None)
    for attribute, member in layout.items():
        if isinstance(member.type, CompoundType):
            object.__setattr__(view, attribute, member.type.place(memory, start + member.offset))
    if memory.readonly:
        view.attach(refuse_write(kind.name))


def _shown(member: Member) -> property:
    offset = member.offset
    if member.bit is not None:
        mask = 1 << member.bit
        return property(lambda view: view._memory[view._start + offset] & mask != 0, doc=member.comment)
    assert isinstance(member.type, Scalar)
    read, decode = member.type.read, member.type.decoder
    if decode is None:
        return property(lambda view: read(view._memory, view._start + offset)[0], doc=member.comment)
    return property(lambda view: decode(read(view._memory, view._start + offset)[0]), doc=member.comment)


def _bit_put(offset: int, mask: int) -> Put:
    def put(view: Any, value: bool) -> None:  # noqa: ANN401
        memory, at = view._memory, view._start + offset
        memory[at] = memory[at] | mask if value else memory[at] & ~mask

    return put


def _pack_into(self: Any, memory: Memory, offset: int = 0) -> None:  # noqa: ANN401
    size = self.type.size
    check_room(self.type.name, size, memory, offset)
    memory[offset : offset + size] = self._memory[self._start : self._start + size]


def _unpack_from(self: Any, memory: Bytes, offset: int = 0) -> None:  # noqa: ANN401
    size = self.type.size
    check_room(self.type.name, size, memory, offset)
    self._memory[self._start : self._start + size] = memory[offset : offset + size]


_METHODS: Final = {"pack_into": _pack_into, "unpack_from": _unpack_from}
