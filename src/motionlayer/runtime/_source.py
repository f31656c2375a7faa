"""`Source`: somebody outside whose inputs the cycle fetches itself.

A thread that posts wakes up, takes the interpreter from the cycle, and gives it back; so does one that waits for
receipts. Who has many inputs, and needs them to be in the next tick, is asked by the cycle instead: what has come is
fetched before inputs are applied, and all outcomes of a tick are told at its end.
"""

from typing import Protocol


class Sleeper(Protocol):
    """How a run that is held up waits."""

    def sleep(self, seconds: float) -> None:
        """Return after a time, or as soon as there is something to do; for the thread of the cycle."""

    def stir(self) -> None:
        """Let who sleeps look at once; for any thread."""


class Source(Sleeper, Protocol):
    """Inputs from outside, fetched by the thread of the cycle; neither call ever waits."""

    def fetch(self) -> None:
        """Post what has come to the mailbox, in its order."""

    def tell(self) -> None:
        """Tell the outcomes of what was fetched last; all its receipts are settled."""
