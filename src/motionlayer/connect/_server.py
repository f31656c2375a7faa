"""What a run knows of servers, whether it has any."""

from typing import Final

ADS: Final = "ads"
"""The channel of the mailbox by which requests of ADS clients arrive."""


class ServerFailed(RuntimeError):  # noqa: N818 - the state, as a user would say it
    """The server could not begin: its address is taken, or does not exist."""
