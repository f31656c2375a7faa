"""One image: bytes that a controller writes or reads, and the elements of an array that they stand for.

An image is an area of the run, so that any thread may post or read it, every write is recorded, and a replay does the
same. A bus attaches memory of its own instead: it is looked at, or written, once in a tick, between the ticks of the
bus. What is new there enters the run as an input of the area, as if it had been posted.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any

import numpy as np

from motionlayer.iec import UDINT, InputArray, OutputArray, Variable
from motionlayer.runtime import Area, Mailbox


class Port:
    """Where a bus may attach memory; not part of snapshots, since it belongs to the bus.

    Attributes:
        memory: the bytes of the bus, None without one.
        first: of an input, what lay there before anybody had written it; None: it has been written.
    """

    def __init__(self) -> None:
        self.memory: memoryview | None = None
        self.first: bytes | None = None

    @property
    def size(self) -> int | None:
        """Bytes of the bus, None without one."""
        return None if self.memory is None else len(self.memory)


class Elements:
    """Some elements of an array as bytes, one behind the other.

    Args:
        array: whose.
        places: of the elements in the array, from 0, in the order of the image.

    Attributes:
        array: as given.
        size: of an element in bytes.
    """

    def __init__(self, array: Variable[Any], places: Sequence[int]) -> None:
        self.array = array
        self._inputs = array if isinstance(array, InputArray) else None
        size = self.size = array.size
        self._count = len(places)
        whole = memoryview(array.memory).cast("B")
        first, last = places[0], places[-1]
        in_a_row = list(places) == list(range(first, last + 1))
        self._slice = whole[first * size : (last + 1) * size] if in_a_row else None
        self._rows = np.frombuffer(whole, np.uint8).reshape(-1, size)
        self._places = np.array(places)

    def __len__(self) -> int:
        return self.size * self._count

    def __bytes__(self) -> bytes:
        if self._inputs is not None:
            self._inputs.publish()
        return bytes(self._slice) if self._slice is not None else self._rows[self._places].tobytes()

    def copy_to(self, target: memoryview) -> None:
        """Write them into memory of the same size."""
        if self._inputs is not None:
            self._inputs.publish()
        target[:] = self._slice if self._slice is not None else self._rows[self._places].tobytes()

    def copy_from(self, data: memoryview) -> None:
        """Overwrite them with memory of the same size."""
        inputs, size = self._inputs, self.size
        if inputs is not None:
            for row, place in enumerate(self._places.tolist()):
                inputs.accept(inputs.index(place), data, row * size)
        elif self._slice is not None:
            self._slice[:] = data
        else:
            self._rows[self._places] = np.frombuffer(data, np.uint8).reshape(-1, self.size)

    def overwrite(self, new: bytes, old: bytes) -> tuple[list[int], bytes]:
        """Overwrite those in which two images differ; return their places in the array, and their new bytes."""
        fresh = np.frombuffer(new, np.uint8).reshape(-1, self.size)
        changed = (fresh != np.frombuffer(old, np.uint8).reshape(-1, self.size)).any(axis=1)
        places, rows = self._places[changed], fresh[changed]
        self._rows[places] = rows
        return places.tolist(), rows.tobytes()


class Image:
    """What inputs and outputs have in common.

    Args:
        area: its bytes, named `MAPPING_AXIS_in.AxisCtrl`.
        partner: what it is copied to or from.

    Attributes:
        area, partner: as given.
        port: where a bus attaches its memory.
        sizes: `szAxisCtrl`, bytes of the image and of its partner.
    """

    def __init__(self, area: Area, partner: Elements) -> None:
        self.area = area
        self.partner = partner
        self.port = Port()
        self.sizes: OutputArray[int] = OutputArray(UDINT, 1, 2, self.name.replace(".", ".sz", 1))
        self.show_sizes()

    @property
    def name(self) -> str:
        """The name of the area."""
        return self.area.name

    @property
    def label(self) -> str:
        """The name without the program, `AxisCtrl`."""
        return self.name.partition(".")[2]

    @property
    def fits(self) -> bool:
        """What is attached has the size of its partner."""
        memory = self.port.memory
        return memory is None or len(memory) == self.area.size

    def show_sizes(self) -> None:
        """Show the bytes of the image, those of the bus where one is attached, and of its partner."""
        size = self.port.size
        self.sizes[1], self.sizes[2] = self.area.size if size is None else size, len(self.partner)


class InputImage(Image, ABC):
    """An image that the other side writes.

    As long as it has not, the image is not taken: zeros of a partner that is not there would overwrite the declared
    start values (D52).
    """

    def look(self, mailbox: Mailbox) -> None:
        """Take in what is new on the bus."""
        port, area = self.port, self.area
        if port.memory is None:
            return
        data = bytes(port.memory)
        if data == port.first:
            return
        port.first = None
        if not area.written or data != bytes(area.memory):
            mailbox.note(area.channel, data)
            area.write(data)

    @abstractmethod
    def take(self) -> None:
        """Copy from the area what is new."""


class CommandImage(InputImage):
    """An image of what clients write: elements that have changed are decoded.

    Args:
        area: its bytes, named `MAPPING_AXIS_in.AxisCtrl`.
        array: what it is copied to.
        places: of the elements there, from 0, in the order of the image.
        written: see `Row`.

    Attributes:
        array: as given.
        indices: of its elements, in the order of the image; None is the index of a single object.
    """

    def __init__(self, area: Area, array: InputArray[Any], places: Sequence[int], *, written: bool = False) -> None:
        super().__init__(area, Elements(array, places))
        self.array = array
        self.indices = [array.index(place) for place in places]
        self._written = written
        self._taken: bytes | None = None

    def take(self) -> None:
        """Decode what differs from what was taken last, or from what stands there."""
        area = self.area
        if not area.written:
            return
        new, old = bytes(area.memory), self._taken
        if self._written or old is None:
            old = bytes(self.partner)
        self._taken = new
        if new == old:
            return
        self.array.decode(*self.partner.overwrite(new, old))


class MirrorImage(InputImage):
    """An image of what the layer on the other side writes: its bytes are what is shown here.

    Args:
        area: its bytes, named `MAPPING_AXIS_in.AxisState`.
        partner: what shows them.
    """

    def take(self) -> None:
        """Show the bytes."""
        if self.area.written:
            self.partner.copy_from(self.area.memory)


class OutputImage(Image):
    """An image that the other side reads.

    Args:
        area: its bytes, named `MAPPING_AXIS_out.AxisState`.
        partner: what it is copied from.
    """

    def __init__(self, area: Area, partner: Elements) -> None:
        super().__init__(area, partner)
        self._target = area.claim()

    def give(self) -> None:
        """Copy to the area, and to the bus."""
        target, memory = self._target, self.port.memory
        self.partner.copy_to(target)
        if memory is not None:
            memory[:] = target
