"""`ErrorText`: what is said about an error."""

from typing import NamedTuple


class ErrorText(NamedTuple):
    """What an error means, and what to do about it.

    Attributes:
        text: what happened.
        advice: the way out; where a file leaves it out, the advice of its range is put in.
        raised: who answers with it, and for what; empty for an error that is listed to explain other controllers.
    """

    text: str
    advice: str = ""
    raised: str = ""
