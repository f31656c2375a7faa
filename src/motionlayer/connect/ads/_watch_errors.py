"""What a `Watcher` raises."""


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
