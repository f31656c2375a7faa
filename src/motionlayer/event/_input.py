"""`Input`: what came from outside, as a record."""

from typing import NamedTuple


class Input(NamedTuple):
    """Something from outside that changed the run; fed back at its tick it makes the same run again.

    Attributes:
        tick: the tick in whose step INPUTS it was applied.
        channel: who takes it in, the name of a channel of the mailbox.
        payload: bytes that only this channel understands.
    """

    tick: int
    channel: str
    payload: bytes
