"""What a `Watcher` raises."""

import contextlib
import struct
from collections.abc import Iterator


class WatchError(Exception):
    """A device cannot be reached, or has refused something."""


class RefusedError(WatchError):
    """A device has answered with a code.

    Attributes:
        code: ADS return code.
    """

    def __init__(self, text: str, code: int) -> None:
        super().__init__(text)
        self.code = code


class Absent(WatchError):  # noqa: N818 - the state, as a user would say it
    """Nobody answers at an address."""


class Lost(WatchError):  # noqa: N818 - the state, as a user would say it
    """The connection to a device is lost, or it does not answer; it may come back."""


@contextlib.contextmanager
def readable(what: str) -> Iterator[None]:
    """Raise `WatchError` where bytes of a device cannot be read.

    Args:
        what: they belong to, for the message.
    """
    try:
        yield
    except (struct.error, IndexError, KeyError, UnicodeDecodeError) as error:
        raise WatchError(f"{what}: what the device has sent means nothing: {error}") from error
