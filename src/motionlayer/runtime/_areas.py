"""Byte areas shared with the outside: the process image of a run.

Inside, an area is plain memory that changes only in the step of its owner: a program writes the areas that it has
claimed, step INPUTS those that belong to the outside. The programs of a tick see one another's writes at once; nothing
runs beside them, so they never see half a write.

Outside, every area is read as it was at the end of the last finished tick: step OUTPUTS copies all areas into a double
buffer (`Published`), from which any thread reads without a wait.
"""

from collections.abc import Iterator, Mapping
from typing import Final

from motionlayer.command import Command, Ledger
from motionlayer.runtime._mailbox import Mailbox
from motionlayer.runtime._published import Published
from motionlayer.runtime._receipt import Receipt

MAX_SIZE: Final = 2**30
"""Largest size of an area in bytes."""


class Area:
    """A named byte area of fixed size; made by `Areas.add`.

    Attributes:
        name: its name.
        size: in bytes.
        outside: it is written from outside, and programs read it; otherwise the reverse.
        view: its bytes as programs see them now, read-only; for the cycle thread.
        memory: the same to be written, for its owner and step INPUTS.
        place: where it lies among all areas.
        written: it belongs to the outside, which has written it.
    """

    def __init__(self, areas: "Areas", name: str, size: int, start: int, *, outside: bool) -> None:
        self.name = name
        self.size = size
        self.outside = outside
        self._areas = areas
        self.place = slice(start, start + size)
        self.memory = memoryview(bytearray(size))
        self.view = self.memory.toreadonly()
        self.written = False
        self._claimed = False
        self._owner: Command[object] | None = None

    @property
    def channel(self) -> str:
        """The channel of the mailbox that writes an area of the outside."""
        return f"area.{self.name}"

    def claim(self) -> memoryview:
        """Return the memory of the area, to be written; the program that runs now owns the area until it ends.

        Claimed outside a program, by a stage or the script that made the run, it is theirs for good.

        Raises:
            PermissionError: the area belongs to the outside or to another program.
        """
        issuer, owner = self._areas.issuer, self._owner
        if self.outside:
            raise PermissionError(f"area {self.name} belongs to the outside: read its view, or add one without outside")
        if self._claimed and owner is not issuer and (owner is None or owner.busy):
            whose = f"program {owner.name}" if owner is not None else "what claimed it before the programs ran"
            raise PermissionError(f"area {self.name} belongs to {whose}: add an area for each writer")
        self._claimed, self._owner = True, issuer
        return self.memory

    def post(self, data: bytes | bytearray | memoryview) -> Receipt:
        """Write the whole area from outside, in the next tick; any thread may call this.

        Raises:
            PermissionError: the area belongs to the programs.
            ValueError: the data has not the size of the area.
            MailboxFull: too many inputs wait already.
        """
        if not self.outside:
            raise PermissionError(f"area {self.name} belongs to the programs: add it with outside=True to write it")
        self._check(data)
        return self._areas.mailbox.post(self.channel, data)

    def read(self) -> bytes:
        """Return the bytes of the last finished tick, zeros before the first; for any thread, without a wait."""
        return self.read_with_tick()[1]

    def read_with_tick(self) -> tuple[int, bytes]:
        """Return the last finished tick (-1 before the first) and the bytes at its end; any thread may call this."""
        return self._areas.read(self.place)

    def write(self, data: bytes) -> None:
        """Take in what was posted; the handler of the channel."""
        self._check(data)
        self.memory[:] = data
        self.written = True

    def _check(self, data: bytes | bytearray | memoryview) -> None:
        if len(data) != self.size:
            raise ValueError(f"area {self.name}: {len(data)} bytes, must be {self.size}: an area is written as a whole")


class Areas(Mapping[str, Area]):
    """All areas of a run by name, and what the outside sees of them.

    Args:
        mailbox: what the outside writes through.
        ledger: tells the program that runs now.
    """

    def __init__(self, mailbox: Mailbox, ledger: Ledger) -> None:
        self.mailbox = mailbox
        self._ledger = ledger
        self._areas: dict[str, Area] = {}
        self._size = 0
        self._allocate()

    def __getitem__(self, name: str) -> Area:
        if name not in self._areas:
            raise KeyError(f"no area {name!r}; this run has {', '.join(self._areas) or 'none'}")
        return self._areas[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._areas)

    def __len__(self) -> int:
        return len(self._areas)

    @property
    def issuer(self) -> Command[object] | None:
        """The program that runs now."""
        return self._ledger.issuer

    def add(self, name: str, size: int, *, outside: bool = False) -> Area:
        """Make an area, filled with zeros; until the first tick has ended, since memory does not move in a run.

        Args:
            name: unique within the run.
            size: in bytes, 1 to `MAX_SIZE`.
            outside: True is written by `post` alone, False by the program that claims it.

        Raises:
            ValueError: the name is taken or empty, or the size is out of range.
            RuntimeError: the first tick has ended.
        """
        if not name or name in self._areas:
            raise ValueError(f"area {name!r}: " + ("there is one already" if name else "an area needs a name"))
        if type(size) is not int or not 1 <= size <= MAX_SIZE:
            raise ValueError(f"area {name}: size {size!r} must be a whole number from 1 to {MAX_SIZE} (bytes)")
        if self._ledger.tick > 0:
            raise RuntimeError(f"area {name}: areas are made before the end of the first tick")
        area = self._areas[name] = Area(self, name, size, self._size, outside=outside)
        if outside:
            self.mailbox.register(area.channel, area.write)
        self._size += size
        self._allocate()
        return area

    def publish(self, tick: int) -> None:
        """Let the outside see this tick; a stage of step OUTPUTS."""
        if not self._size:
            return
        image = self._published.begin(tick)
        for area in self._areas.values():
            image[area.place] = area.memory
        self._published.finish()

    def read(self, where: slice) -> tuple[int, bytes]:
        """Return the last published tick and a slice of what was published."""
        return self._published.read(where)

    def _allocate(self) -> None:
        self._published = Published(memoryview(bytearray(Published.size_of(self._size))))
