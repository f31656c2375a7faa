"""STRING and WSTRING: text of a fixed room, ended by a zero."""

import codecs
import functools
from typing import Any, Final

from motionlayer.iec._type import Scalar


def _windows_1252() -> str:
    """Return the character of each byte; the five that the code page leaves out are control characters, as in Windows.

    So every byte is a character, and what came in as bytes goes out as the same ones.
    """
    return "".join(bytes([byte]).decode("cp1252", "ignore") or chr(byte) for byte in range(256))


_CHARACTERS: Final = _windows_1252()
_CODES: Final = {ord(character): byte for byte, character in enumerate(_CHARACTERS)}


class String(Scalar[str]):
    """STRING(n): n characters of Windows-1252 and a zero.

    Bytes after the first zero mean nothing and are written as zeros. Without a zero the last byte is taken for it.

    Attributes:
        length: most characters.
    """

    def __init__(self, length: int) -> None:
        self.length = length
        super().__init__(f"STRING({length})", f"{length + 1}s", f"S{length + 1}", alignment=1)

    def initial(self) -> str:
        """Return the empty text."""
        return ""

    def check(self, value: object, who: str = "") -> str:
        """Return `value`, which must fit: text is not cut off in silence."""
        if not isinstance(value, str):
            raise TypeError(f"{who or self.name}: {value!r} must be text ({self.name})")
        text = str(value)
        try:
            used = self._used(text)
        except UnicodeEncodeError as error:
            wrong = text[error.start]
            raise ValueError(f"{who or self.name}: {wrong!r} is no character of Windows-1252 ({self.name})") from None
        if used > self.length:
            raise ValueError(f"{who or self.name}: {used} characters, at most {self.length} fit ({self.name})")
        if "\0" in text:
            raise ValueError(f"{who or self.name}: {text!r} must not contain the character 0, which ends a text")
        return text

    def encode(self, value: str) -> Any:  # noqa: ANN401
        """Return the bytes; `struct` fills up with zeros."""
        return codecs.charmap_encode(value, "strict", _CODES)[0]

    def decode(self, raw: bytes) -> str:
        """Return the text before the first zero."""
        return codecs.charmap_decode(raw[: self.length].partition(b"\0")[0], "strict", _CHARACTERS)[0]

    def _used(self, text: str) -> int:
        return len(self.encode(text))


class WString(String):
    """WSTRING(n): n 16-bit units of UTF-16 and a zero; a character beyond U+FFFF takes two units."""

    def __init__(self, length: int) -> None:
        Scalar.__init__(self, f"WSTRING({length})", f"{2 * length + 2}s", f"({length + 1},)<u2", alignment=2)
        self.length = length

    def encode(self, value: str) -> Any:  # noqa: ANN401
        """Return the bytes; half a surrogate pair, which a controller may well hold, stays what it is."""
        return value.encode("utf-16-le", "surrogatepass")

    def decode(self, raw: bytes) -> str:
        """Return the text before the first zero unit."""
        return raw[: 2 * self.length].decode("utf-16-le", "surrogatepass").partition("\0")[0]

    def _used(self, text: str) -> int:
        return len(self.encode(text)) // 2


@functools.cache
def STRING(length: int = 80) -> String:  # noqa: N802 - as it is declared
    """Return the type of a text of up to `length` characters of Windows-1252.

    Raises:
        ValueError: the length is not a whole number from 1 to 65535.
    """
    return String(_checked(length))


@functools.cache
def WSTRING(length: int = 80) -> WString:  # noqa: N802
    """Return the type of a text of up to `length` units of UTF-16.

    Raises:
        ValueError: the length is not a whole number from 1 to 65535.
    """
    return WString(_checked(length))


def _checked(length: int) -> int:
    if type(length) is not int or not 1 <= length <= 65535:
        raise ValueError(f"length of a text {length!r}: must be a whole number from 1 to 65535 (characters)")
    return length
