"""The elementary types of IEC 61131-3, and BIT.

Times and dates are whole numbers as a controller holds them, so that every value goes to bytes and back unchanged:
TIME in ms, LTIME in ns, TOD in ms since midnight, DATE and DT in s since 1970-01-01 (a DATE is a multiple of 86400).
"""

import operator
import struct
from typing import Final

import numpy as np

from motionlayer.iec._type import Got, Scalar

_SINGLE: Final = struct.Struct("<f")


class Elementary(Scalar[Got]):
    """A type that the language has by itself."""


class Boolean(Elementary[bool]):
    """BOOL: a byte, 0 or 1; read as true when it is not 0."""

    def __init__(self) -> None:
        super().__init__("BOOL", "?", "?")

    def initial(self) -> bool:
        """Return False."""
        return False

    def check(self, value: object, who: str = "") -> bool:
        """Return `value`, which must be a bool: whole numbers are not taken for one."""
        if value is True or value is False:
            return value
        if isinstance(value, np.bool_):
            return bool(value)
        raise TypeError(f"{who or self.name}: {value!r} must be True or False ({self.name})")


class Bit(Boolean):
    """BIT: a BOOL that shares its byte with the BITs beside it; a member of a structure only."""

    def __init__(self) -> None:
        super().__init__()
        self.name = "BIT"


class Integer(Elementary[int]):
    """A whole number, or a string of bits as one.

    Attributes:
        low: smallest value.
        high: largest value.
        unit: of times and dates, empty otherwise.
    """

    def __init__(self, name: str, code: str, unit: str = "") -> None:
        size = struct.calcsize("<" + code)
        super().__init__(name, code, f"<{'i' if code.islower() else 'u'}{size}")
        self.low: Final = -(2 ** (8 * size - 1)) if code.islower() else 0
        self.high: Final = 2 ** (8 * size - 1) - 1 if code.islower() else 2 ** (8 * size) - 1
        self.unit: Final = unit

    def initial(self) -> int:
        """Return 0."""
        return 0

    def check(self, value: object, who: str = "") -> int:
        """Return `value` as a plain int."""
        if type(value) is int:
            number = value
        elif isinstance(value, (bool, np.bool_)) or not hasattr(value, "__index__"):
            raise TypeError(f"{who or self.name}: {value!r} must be a whole number ({self.name})")
        else:
            number = operator.index(value)
        if self.low <= number <= self.high:
            return number
        unit = f" {self.unit}" if self.unit else ""
        raise ValueError(f"{who or self.name}: {number} must be {self.low} to {self.high}{unit} ({self.name})")


class Real(Elementary[float]):
    """LREAL: a floating-point number, NaN and infinity among them."""

    def __init__(self, name: str = "LREAL", code: str = "d") -> None:
        super().__init__(name, code, f"<f{struct.calcsize('<' + code)}")

    def initial(self) -> float:
        """Return 0.0."""
        return 0.0

    def check(self, value: object, who: str = "") -> float:
        """Return `value` as a float; a whole number is taken too."""
        if type(value) is float:
            return value
        if isinstance(value, bool) or not isinstance(value, int | float | np.integer | np.floating):
            raise TypeError(f"{who or self.name}: {value!r} must be a number ({self.name})")
        try:
            return float(value)
        except OverflowError:
            raise ValueError(f"{who or self.name}: {value} must be -1.8e308 to 1.8e308 ({self.name})") from None


class Single(Real):
    """REAL: of single precision; a value is rounded when it is written, so that reading it tells what is sent."""

    def __init__(self) -> None:
        super().__init__("REAL", "f")

    def check(self, value: object, who: str = "") -> float:
        """Return `value` as the nearest float of single precision."""
        number = super().check(value, who)
        try:
            rounded: float = _SINGLE.unpack(_SINGLE.pack(number))[0]
        except OverflowError:
            raise ValueError(f"{who or self.name}: {number} must be -3.4e38 to 3.4e38 ({self.name})") from None
        return rounded


BOOL: Final = Boolean()
BIT: Final = Bit()
BYTE: Final = Integer("BYTE", "B")
WORD: Final = Integer("WORD", "H")
DWORD: Final = Integer("DWORD", "I")
LWORD: Final = Integer("LWORD", "Q")
SINT: Final = Integer("SINT", "b")
USINT: Final = Integer("USINT", "B")
INT: Final = Integer("INT", "h")
UINT: Final = Integer("UINT", "H")
DINT: Final = Integer("DINT", "i")
UDINT: Final = Integer("UDINT", "I")
LINT: Final = Integer("LINT", "q")
ULINT: Final = Integer("ULINT", "Q")
REAL: Final = Single()
LREAL: Final = Real()
TIME: Final = Integer("TIME", "I", "ms")
LTIME: Final = Integer("LTIME", "Q", "ns")
DATE: Final = Integer("DATE", "I", "s since 1970-01-01")
TOD: Final = Integer("TOD", "I", "ms since midnight")
DT: Final = Integer("DT", "I", "s since 1970-01-01")
