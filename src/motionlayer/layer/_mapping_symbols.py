"""Symbols of the mapping programs: images, results of the check, and what is mapped (motion-layer 7)."""

import types
from collections.abc import Iterator
from typing import Any, Final, NoReturn, cast

from motionlayer.iec import (
    BOOL,
    BYTE,
    Array,
    Bytes,
    Field,
    InputArray,
    OutputArray,
    SymbolTable,
    Union,
    Variable,
)
from motionlayer.layer._mapping import ORIGINAL, ImageMapping, InputProgram, OutputProgram
from motionlayer.layer._mapping_image import Image, InputImage
from motionlayer.layer._mapping_table import GROUPS, OUTPUTS, WRITTEN

_GROUP_OF: Final = {row.image: row.group for row in (*WRITTEN, *OUTPUTS)}


class ImageSource:
    """An image as a variable: a union of the structures and of equally many bytes.

    It cannot be written by symbol: an input belongs to whoever is connected, an output to the layer.

    Args:
        image: as bytes.
    """

    writable: Final = False

    def __init__(self, image: Image) -> None:
        self.type = _union(image).type
        self.memory = image.area.memory
        self._name = image.name

    def read(self, offset: int, size: int) -> bytes:
        """Return bytes of the image."""
        return bytes(self.memory[offset : offset + size])

    def write(self, _offset: int, _data: Bytes, by: str, /) -> NoReturn:
        """Refuse to write.

        Raises:
            PermissionError: always.
        """
        raise PermissionError(f"{self._name} is an image: {by} can only read it; write the structures by symbol")


def add_symbols(mapping: ImageMapping, symbols: SymbolTable) -> None:
    """Add the variables of all mapping programs."""
    for one in mapping.inputs.values():
        _add(symbols, one, one.blocked, "true: nothing is copied in")
        _add_program(symbols, one)
    for other in mapping.outputs.values():
        _add_program(symbols, other)


def _add_program(symbols: SymbolTable, program: InputProgram | OutputProgram) -> None:
    _add(symbols, program, program.check.shown, "result of the check of sizes")
    for variable in _bypasses(program):
        _add(symbols, program, variable, "the group is not mapped here")
    for image in program.images:
        if not image.name.startswith(program.name):  # of MAIN_AXIS, which has a symbol of its own
            continue
        _add(symbols, program, image.sizes, "bytes of the image, and of its partner")
        name, comment = image.name, "image of the other side" if isinstance(image, InputImage) else "image"
        symbols.add(name, ImageSource(image), comment=comment, aliases=_aliases(name))


def _bypasses(program: InputProgram | OutputProgram) -> Iterator[OutputArray[bool]]:
    """Yield what tells whether each group is mapped."""
    mapped = {_GROUP_OF.get(image.label) for image in program.images}
    for group in GROUPS:
        variable: OutputArray[bool] = OutputArray(BOOL, None, None, f"{program.name}.bBypassMapping{group.title()}")
        variable.value = group not in mapped
        yield variable


def _add(
    symbols: SymbolTable,
    program: InputProgram | OutputProgram,
    variable: Variable[Any],
    comment: str,
) -> None:
    assert isinstance(variable, InputArray | OutputArray)
    symbols.add(variable.name, variable, comment=f"{program.name}: {comment}", aliases=_aliases(variable.name))


def _aliases(name: str) -> list[str]:
    """Return the name on the slides (motion-layer 1.7)."""
    return [name.replace(ORIGINAL, "MAPPING", 1)] if name.startswith(f"{ORIGINAL}_") else []


def _union(image: Image) -> type[Union]:
    """Return the type of an image: `Data`, the structures, and `byCtrl` or `byState`, their bytes."""
    array = image.partner.array
    count, bound = len(image.partner) // array.size, (1, array.size)
    data: Any = array.of if array.low is None else Array(array.of, (1, count))
    by: Any = Array(BYTE, bound) if array.low is None else Array(Array(BYTE, bound), (1, count))
    # The original calls the R parameters `byCtrl` on both sides.
    as_command = isinstance(image, InputImage) or image.label == "NciRparameters"
    body = {
        "__module__": __name__,
        "__doc__": f"Image {image.name}.",
        "data": Field("Data", data, "structures"),
        "raw": Field("byCtrl" if as_command else "byState", by, "bytes"),
    }
    name = image.name.replace(".", "_")
    made = types.new_class(name, (Union,), {"iec": f"U_{name}", "pack": 2}, lambda space: space.update(body))
    return cast("type[Union]", made)
