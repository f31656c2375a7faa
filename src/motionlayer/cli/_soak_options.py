"""`SoakOptions`."""

from pathlib import Path
from typing import NamedTuple


class SoakOptions(NamedTuple):
    """What `motionlayer soak` was asked for.

    Attributes:
        machine: the machine file.
        cycles: ticks of the run, > 0.
        warm_up: ticks after which memory counts; None for a tenth.
        program: `FILE[:NAME]`, in the place of the programs of the machine file.
        seed: in the place of the seed of the machine file.
        realtime: in the time of a clock.
        speed: times real time; only with `realtime`.
        trace: file for the trace, whose end is judged.
        report: file for the report.
    """

    machine: Path
    cycles: int
    warm_up: int | None
    program: str | None
    seed: int | None
    realtime: bool
    speed: float | None
    trace: Path | None
    report: Path | None
