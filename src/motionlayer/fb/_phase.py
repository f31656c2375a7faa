"""The life of a block that commands, over its calls (function-blocks 1.4).

A block that commands is in one of the phases of `Phase`. A rising edge of Execute begins, the end of the command
concludes, and what it concluded with is shown as long as Execute is TRUE, but in one call at least:

    ========= ================= ============================ ==========================================
    phase     at a call         next                         action
    ========= ================= ============================ ==========================================
    IDLE      rising edge       BUSY, or ERROR if refused     latch the inputs, issue the command
    BUSY      command ended     DONE, ABORTED or ERROR        show it; an edge in this call is swallowed
    BUSY      rising edge       BUSY                          none: a running command is never replaced
    DONE ...  Execute FALSE     IDLE                          clear the outputs
    DONE ...  rising edge       BUSY, or ERROR if refused     as from IDLE
    ========= ================= ============================ ==========================================
"""

import enum
from typing import Final


class Phase(enum.Enum):
    """Where a block that commands is."""

    IDLE = "idle"
    BUSY = "busy"
    DONE = "done"
    ABORTED = "aborted"
    ERROR = "error"


NEXT: Final[dict[Phase, frozenset[Phase]]] = {
    Phase.IDLE: frozenset({Phase.BUSY, Phase.ERROR}),
    Phase.BUSY: frozenset({Phase.DONE, Phase.ABORTED, Phase.ERROR}),
    Phase.DONE: frozenset({Phase.IDLE, Phase.BUSY, Phase.ERROR}),
    Phase.ABORTED: frozenset({Phase.IDLE, Phase.BUSY, Phase.ERROR}),
    Phase.ERROR: frozenset({Phase.IDLE, Phase.BUSY, Phase.ERROR}),
}
"""What may follow a phase; a block that does anything else is broken."""

SHOWN: Final[dict[Phase, tuple[bool, bool, bool]]] = {
    Phase.IDLE: (False, False, False),
    Phase.BUSY: (True, False, False),
    Phase.DONE: (False, True, False),
    Phase.ABORTED: (False, False, True),
    Phase.ERROR: (False, False, False),
}
"""Busy, Done and CommandAborted in each phase; Error and ErrorID come with what went wrong."""
