"""From maps to images: which elements of which arrays each image stands for, and who owns them."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Final, NamedTuple

from motionlayer.command import Ledger
from motionlayer.event import EventLog
from motionlayer.iec import InputArray, Variable
from motionlayer.layer._globals import Globals
from motionlayer.layer._mapping import ORIGINAL, ImageMapping, InputProgram, MapOptions, OutputProgram
from motionlayer.layer._mapping_image import CommandImage, Elements, InputImage, MirrorImage, OutputImage
from motionlayer.layer._mapping_symbols import add_symbols
from motionlayer.layer._mapping_table import INPUTS, OUTPUTS, SELECTOR, WRITTEN, Row
from motionlayer.layer._ownership import Access, Ownership
from motionlayer.runtime import Areas, Mailbox

START: Final = "MAIN_AXIS.eInit"
"""The process output that tells a controller when the layer is ready."""

Arrays = Mapping[str, Variable[Any]]
"""Variables by the names of their symbols."""


class Outside(NamedTuple):
    """Where images lie, and what is told about them."""

    areas: Areas
    mailbox: Mailbox
    events: EventLog


def layer_mapping(maps: Sequence[MapOptions], arrays: Arrays, outside: Outside) -> ImageMapping:
    """Return the programs of a motion layer: commands in, states out."""
    inputs, outputs = [], []
    for prefix in _prefixes(maps):
        name = f"{prefix}_in"
        images: list[InputImage] = []
        for row, array, places in _rows(WRITTEN, maps, prefix, arrays):
            assert isinstance(array, InputArray)
            area = outside.areas.add(f"{name}.{row.image}", array.size * len(places), outside=True)
            images.append(CommandImage(area, array, places, written=row.written))
        inputs.append(InputProgram(name, images, outside.events, outside.mailbox))
        name = f"{prefix}_out"
        shown = [
            _shown(f"{name}.{row.image}", array, places, outside)
            for row, array, places in _rows(OUTPUTS, maps, prefix, arrays)
        ]
        outputs.append(OutputProgram(name, shown, outside.events))
    return ImageMapping(inputs, outputs, [_shown(START, arrays[START], [0], outside)] if maps else [])


def control_mapping(maps: Sequence[MapOptions], arrays: Arrays, outside: Outside) -> ImageMapping:
    """Return the programs of a control side: what is in there is out here, and the reverse."""
    inputs, outputs = [], []
    for prefix in _prefixes(maps):
        name = f"{prefix}_in"
        rows = [(f"{name}.{row.image}", array, places) for row, array, places in _rows(OUTPUTS, maps, prefix, arrays)]
        images = [
            _mirror(image, array, places, outside) for image, array, places in [*rows, (START, arrays[START], [0])]
        ]
        inputs.append(InputProgram(name, images, outside.events, outside.mailbox))
        name = f"{prefix}_out"
        shown = [
            _shown(f"{name}.{row.image}", array, places, outside)
            for row, array, places in _rows(WRITTEN, maps, prefix, arrays)
        ]
        outputs.append(OutputProgram(name, shown, outside.events))
    return ImageMapping(inputs, outputs, [])


def map_variables(
    build: Callable[[Sequence[MapOptions], Arrays, Outside], ImageMapping],
    maps: Sequence[MapOptions],
    variables: Globals,
    outside: Outside,
    ledger: Ledger,
    simulated: Arrays,
) -> ImageMapping:
    """Return the images of all variables, which have owners and symbols from now on.

    Args:
        build: `layer_mapping` or `control_mapping`.
        maps: what is mapped.
        variables: of the layer.
        outside: where the images lie.
        ledger: the present tick, and who commands.
        simulated: variables beside those, which have no owner: everybody may write them.
    """
    arrays = variables.arrays
    mapping = build(maps, {**arrays, **simulated}, outside)
    own(mapping, arrays, Access(outside.events, ledger))
    add_symbols(mapping, variables.symbols)
    return mapping


def own(mapping: ImageMapping, arrays: Arrays, access: Access) -> None:
    """Give every element that clients write its owner: the image that it is mapped to, or access by symbol."""
    commands = {row.symbol for row in INPUTS if row.written} | {"GVL_AXIS.SelectorCtrl"}
    owners: dict[str, dict[int | None, str]] = {}
    for image in mapping.images:
        if isinstance(image, CommandImage):
            owners.setdefault(image.array.name, {}).update(dict.fromkeys(image.indices, image.name))
    for array in arrays.values():
        if isinstance(array, InputArray):
            Ownership(array, owners.get(array.name, {}), access, command=array.name in commands)


def _prefixes(maps: Sequence[MapOptions]) -> list[str]:
    """Return what the names of programs begin with; the original ones are always there, mapped or not."""
    return list(dict.fromkeys([ORIGINAL, *(one.prefix for one in maps)]))


def _rows(
    rows: Sequence[Row], maps: Sequence[MapOptions], prefix: str, arrays: Arrays
) -> Iterator[tuple[Row, Variable[Any], Sequence[int]]]:
    """Yield the rows of a program, in the order of the table, with the elements that they hold."""
    for row in [row for row in rows if row.symbol in arrays]:
        for one in maps:
            if one.prefix == prefix and row.group in one.groups:
                array = arrays[row.symbol]
                chosen = None if row.group == SELECTOR else one.indices
                # A trigger box may have no touch probe of the same index.
                places = range(len(array)) if chosen is None else [index - 1 for index in chosen if index <= len(array)]
                if places:
                    yield row, array, places


def _shown(name: str, array: Variable[Any], places: Sequence[int], outside: Outside) -> OutputImage:
    area = outside.areas.add(name, array.size * len(places))
    return OutputImage(area, Elements(array, places))


def _mirror(name: str, array: Variable[Any], places: Sequence[int], outside: Outside) -> InputImage:
    area = outside.areas.add(name, array.size * len(places), outside=True)
    return MirrorImage(area, Elements(array, places))
