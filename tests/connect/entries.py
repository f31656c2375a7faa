"""A reader of symbol and type entries, written from ads 5 and 7 alone: nothing here uses the code that wrote them."""

from dataclasses import dataclass, field

READ_ONLY, BIT_VALUE = 0x20, 0x02


class Bytes:
    """Bytes that are taken from the front."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.at = 0

    def take(self, count: int) -> bytes:
        piece = self.data[self.at : self.at + count]
        assert len(piece) == count, "an entry ends too early"
        self.at += count
        return piece

    def number(self, size: int, *, signed: bool = False) -> int:
        return int.from_bytes(self.take(size), "little", signed=signed)

    def text(self, length: int) -> str:
        raw = self.take(length + 1)
        assert raw[-1] == 0, "a text does not end with a zero"
        assert 0 not in raw[:-1]
        return raw[:-1].decode("cp1252")

    def part(self) -> "Bytes":
        """Take an entry that begins with its own length; that stays out."""
        length = self.number(4)
        return Bytes(self.take(length - 4))

    @property
    def rest(self) -> bytes:
        return self.data[self.at :]


@dataclass
class Parameter:
    name: str
    type: str
    size: int
    adst: int
    flags: int


@dataclass
class Method:
    name: str
    number: int
    returns: str
    return_size: int
    parameters: list[Parameter]


@dataclass
class Entry:
    """A type, or a member of one; a symbol has a group too."""

    name: str
    type: str
    comment: str
    size: int
    offset: int
    adst: int
    flags: int
    group: int = 0
    dimensions: list[tuple[int, int]] = field(default_factory=list)
    members: list["Entry"] = field(default_factory=list)
    values: dict[str, int] = field(default_factory=dict)
    methods: list[Method] = field(default_factory=list)
    attributes: dict[str, str] = field(default_factory=dict)


def _dimensions(data: Bytes, count: int) -> list[tuple[int, int]]:
    return [(data.number(4, signed=True), data.number(4)) for _ in range(count)]


def _attributes(data: Bytes) -> dict[str, str]:
    found = {}
    for _ in range(data.number(2)):
        name, value = data.number(1), data.number(1)
        key = data.text(name)
        found[key] = data.text(value)
    return found


def read_symbols(raw: bytes) -> list[Entry]:
    data, found = Bytes(raw), []
    while data.rest:
        one = data.part()
        group, offset, size, adst, flags = (one.number(4) for _ in range(5))
        lengths = [one.number(2) for _ in range(3)]
        name, kind, comment = (one.text(length) for length in lengths)
        entry = Entry(name, kind, comment, size, offset, adst, flags & 0xFFFF, group, _dimensions(one, flags >> 16))
        if flags & 0x1000:
            entry.attributes = _attributes(one)
        assert not one.rest
        found.append(entry)
    return found


def read_types(raw: bytes) -> list[Entry]:
    data, found = Bytes(raw), []
    while data.rest:
        found.append(_type(data.part()))
    return found


def _type(one: Bytes) -> Entry:
    assert one.number(4) == 1, "version of an entry"
    one.take(8)
    size, offset, adst, flags = (one.number(4) for _ in range(4))
    lengths = [one.number(2) for _ in range(3)]
    dimensions, members = one.number(2), one.number(2)
    name, kind, comment = (one.text(length) for length in lengths)
    entry = Entry(name, kind, comment, size, offset, adst, flags)
    entry.dimensions = _dimensions(one, dimensions)
    entry.members = [_type(one.part()) for _ in range(members)]
    if flags & 0x80:
        one.take(16)
    if flags & 0x800:
        entry.methods = [_method(one.part()) for _ in range(one.number(2))]
    if flags & 0x1000:
        entry.attributes = _attributes(one)
    if flags & 0x2000:
        for _ in range(one.number(2)):
            name = one.text(one.number(1))
            entry.values[name] = one.number(size, signed=adst in (2, 3, 16, 20))
    assert not one.rest, "an entry is longer than its parts"
    return entry


def _method(one: Bytes) -> Method:
    assert one.number(4) == 1
    number, size, _, _ = (one.number(4) for _ in range(4))
    one.take(16 + 8)
    lengths = [one.number(2) for _ in range(3)]
    count = one.number(2)
    name, returns, _ = (one.text(length) for length in lengths)
    parameters = [_parameter(one.part()) for _ in range(count)]
    assert not one.rest
    return Method(name, number, returns, size, parameters)


def _parameter(one: Bytes) -> Parameter:
    size, _, adst, flags, _ = (one.number(4) for _ in range(5))
    one.take(16 + 2)
    lengths = [one.number(2) for _ in range(3)]
    name, kind, _ = (one.text(length) for length in lengths)
    assert not one.rest
    return Parameter(name, kind, size, adst, flags)
