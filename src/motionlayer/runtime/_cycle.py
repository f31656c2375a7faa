"""The steps of a tick and the stages that fill them."""

import enum
from collections.abc import Callable
from typing import NamedTuple


class Step(enum.IntEnum):
    """When a stage runs within tick n.

    ======== ========================================================================================
    INPUTS   actual values, drive status, what came from outside
    PROGRAMS the scheduler; nothing else
    LAYER    changed Ctrl to jobs, jobs to commands
    ACCEPT   what the commands of the tick have asked for in common: overrides
    CAPTURE  everything valid at n is complete: set values, states and limits; read-only
    MOTION   setpoints of n+1; commands end
    OUTPUTS  setpoints to the drives; images published
    OBSERVE  read-only
    ======== ========================================================================================
    """

    INPUTS = 1
    PROGRAMS = 2
    LAYER = 3
    ACCEPT = 4
    CAPTURE = 5
    MOTION = 6
    OUTPUTS = 7
    OBSERVE = 8


class Stage(NamedTuple):
    """Work of one part in every tick.

    Attributes:
        step: when it runs; stages of one step run in the order in which they were handed over.
        name: for messages and statistics.
        run: called with the tick.
    """

    step: Step
    name: str
    run: Callable[[int], None]


def in_order(stages: list[Stage]) -> tuple[Stage, ...]:
    """Return the stages of one tick in the order in which they run."""
    return tuple(sorted(stages, key=lambda stage: stage.step))
