"""`ImageMapping`: byte images of commands and states, copied at the edges of the cycle (motion-layer 7).

```
INPUTS    mailbox, buses → areas → [MAPPING_AXIS_in] → Ctrl, Data …
PROGRAMS  control programs
LAYER     MAIN, FUNCTIONS, NCI, CAM, FLYING_SAW
OUTPUTS   State, Info … → [MAPPING_AXIS_out] → areas, buses
```
Each map has a pair of programs. Before it copies, a program compares the sizes of images and partners; one that differs
holds up the whole program, as in the original, since an image of another size is one of another declaration. All groups
and images are checked alike (D50). Nothing is decoded that has not changed: an idle image costs a comparison.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from motionlayer.event import Device, Event, EventLog, Kind, Level, Subdevice
from motionlayer.iec import BOOL, STRING, InputArray, OutputArray
from motionlayer.layer._mapping_image import Image, InputImage, OutputImage, Port
from motionlayer.layer._mapping_table import SELECTOR, SWITCHES
from motionlayer.runtime import Mailbox

ORIGINAL: Final = "MAPPING_AXIS"
"""Name of the programs of the maps that hold all objects of their group."""

NONE_ACTIVE: Final = "NO_MAPPING_ACTIVE"
DONE: Final = "CHECK_DONE"


@dataclass(frozen=True, slots=True)
class MapOptions:
    """Objects that one controller reaches by images.

    Attributes:
        name: begins the names of its images.
        group: one of `GROUPS`.
        indices: of the objects, in the order of the images; None: all of them, and the names of the original.
        selector: it also holds the parameter selector.
        switches: it also holds the limit switches of its axes.
    """

    name: str
    group: str
    indices: tuple[int, ...] | None = None
    selector: bool = False
    switches: bool = False

    @property
    def groups(self) -> tuple[str, ...]:
        """Groups of rows that it holds."""
        return self.group, *([SELECTOR] if self.selector else []), *([SWITCHES] if self.switches else [])

    @property
    def prefix(self) -> str:
        """What the names of its programs begin with."""
        return ORIGINAL if self.indices is None else self.name


class Check:
    """Compares the sizes of the images of a program with those of their partners.

    Attributes:
        shown: the result, `sMappingCheck`.
    """

    def __init__(self, program: str, images: Sequence[Image], events: EventLog) -> None:
        self.shown = OutputArray(STRING(80), None, None, f"{program}.sMappingCheck")
        self.shown.value = self.text = DONE if images else NONE_ACTIVE
        self._program = program
        self._images = images
        self._events = events

    def passes(self, tick: int) -> bool:
        """Tell whether the program may copy; a new result is told in the log."""
        wrong = next((image for image in self._images if not image.fits), None)
        text = (DONE if self._images else NONE_ACTIVE) if wrong is None else f"{wrong.label} CHECK_ERROR"
        if text != self.text or (wrong is not None and wrong.port.size != wrong.sizes[1]):
            self.shown.value = self.text = text
            for image in self._images:
                image.show_sizes()
            level, told = Level.INFO, f"{self._program}.sMappingCheck: {text}"
            if wrong is not None:
                level = Level.ERROR
                told += f": {wrong.port.size} bytes attached, must be {len(wrong.partner)}; nothing is copied"
            device, part = Device.Device_MainAxis, Subdevice.General
            self._events.add(Event(tick, level, Kind.MESSAGE, self._program, told, 0, 0, device, part))
        return wrong is None


class InputProgram:
    """`MAPPING_AXIS_in`.

    Attributes:
        name: as above, or of the map.
        images: in the order in which they are copied.
        check: of their sizes.
        blocked: `bMappingBlocked`: nothing is copied in; states are copied out all the same.
    """

    def __init__(self, name: str, images: Sequence[InputImage], events: EventLog, mailbox: Mailbox) -> None:
        self.name = name
        self.images = images
        self.blocked = InputArray(BOOL, None, None, f"{name}.bMappingBlocked")
        self.check = Check(name, images, events)
        self._mailbox = mailbox

    def run(self, tick: int) -> None:
        """Copy in what is new."""
        if self.check.passes(tick):
            for image in self.images:
                image.look(self._mailbox)
            if not self.blocked.value:
                for image in self.images:
                    image.take()


class OutputProgram:
    """`MAPPING_AXIS_out`.

    Attributes:
        name: as above, or of the map.
        images: in the order in which they are copied.
        check: of their sizes.
    """

    def __init__(self, name: str, images: Sequence[OutputImage], events: EventLog) -> None:
        self.name = name
        self.images = images
        self.check = Check(name, images, events)

    def run(self, tick: int) -> None:
        """Copy out."""
        if self.check.passes(tick):
            for image in self.images:
                image.give()


class ImageMapping:
    """All programs and images of a run.

    Args:
        inputs: in the order in which they run.
        outputs: in the order in which they run.
        others: outputs that belong to no program, and are copied last.
    """

    def __init__(
        self, inputs: Sequence[InputProgram], outputs: Sequence[OutputProgram], others: Sequence[OutputImage] = ()
    ) -> None:
        self.inputs = {one.name: one for one in inputs}
        self.outputs = {one.name: one for one in outputs}
        self._reading = [one for one in inputs if one.images]
        self._showing = [one for one in outputs if one.images]
        self._others = others
        read: list[Image] = [image for one in inputs for image in one.images]
        shown: list[Image] = [image for one in outputs for image in one.images]
        self._images = {image.name: image for image in [*read, *shown, *others]}

    @property
    def images(self) -> Iterator[Image]:
        """All images, in the order in which they are copied."""
        return iter(self._images.values())

    @property
    def symbols(self) -> frozenset[str]:
        """Names of the variables that images hold, some of their elements or all."""
        return frozenset(image.partner.array.name for image in self.images)

    @property
    def ports(self) -> Iterator[Port]:
        """What belongs to buses, and not into a snapshot."""
        return (image.port for image in self.images)

    def attach(self, name: str, memory: bytearray | memoryview, *, written: bool = False) -> None:
        """Let a bus read or write an image in memory of its own, which is touched only inside of ticks.

        An image of another size than its partner holds up the program that copies it, see `sMappingCheck`.

        Args:
            name: of the image, `MAPPING_AXIS_in.AxisCtrl`.
            memory: of the bus; it must be writable for an output.
            written: of an input: the controller has written it already. Otherwise it is taken over as soon as its bytes
                change, so that zeros of a partner that is not there yet count for nothing.

        Raises:
            KeyError: there is no such image.
            ValueError: it has memory already, or the memory of an output is read-only.
        """
        image = self[name]
        view = memoryview(memory).cast("B")
        if image.port.memory is not None:
            raise ValueError(f"{name}: memory is attached already; detach it first")
        if isinstance(image, OutputImage) and view.readonly:
            raise ValueError(f"{name}: the memory is read-only; an output is written in every tick")
        image.port.first = None if written else bytes(view)
        image.port.memory = view

    def detach(self, name: str) -> None:
        """Leave the memory of a bus alone; an input keeps what it has.

        Raises:
            KeyError: there is no such image.
        """
        self[name].port.memory = None

    def __getitem__(self, name: str) -> Image:
        if name not in self._images:
            raise KeyError(f"no image {name!r}; this run has {', '.join(self._images) or 'none'}")
        return self._images[name]

    def copy_in(self, tick: int) -> None:
        """Run the input programs; a stage of step INPUTS."""
        for program in self._reading:
            program.run(tick)

    def copy_out(self, tick: int) -> None:
        """Run the output programs; a stage of step OUTPUTS."""
        for program in self._showing:
            program.run(tick)
        for image in self._others:
            image.give()
