"""The keywords of a run, declared once: those of every run of a machine, and what each kind of run adds."""

import os
from collections.abc import Mapping, Sequence
from typing import Any, Final, TypedDict

from motionlayer.command import only_known
from motionlayer.machine._ads_description import AdsDescription
from motionlayer.machine._log_description import LogDescription
from motionlayer.machine._machine import Machine
from motionlayer.machine._programs import Loaded
from motionlayer.runtime import PATIENCE, Clock


class RunKeywords(TypedDict, total=False):
    """What every run of a machine can be told.

    Attributes:
        seed: of everything random; that of the machine description where left out.
        trace: True, as where left out, keeps the trace in memory, a path writes it to that file, False records nothing
            but the hash, None not even that.
        programs: started in tick 0, in order; those of the machine description where left out.
        patience: wall time after which a program that does not yield ends the run, s; where left out 10, in real time
            1.
        log: the message files; True, as where left out: as the machine description says, False: none.
        ads: the ADS server; likewise.
    """

    seed: int | None
    trace: bool | str | os.PathLike[str] | None
    programs: Sequence[Loaded] | None
    patience: float
    log: LogDescription | bool
    ads: AdsDescription | bool


class SimulationKeywords(RunKeywords, total=False):
    """The same, and whether to measure.

    Attributes:
        statistics: measure what the ticks cost, for `run.statistics`; nothing in the run depends on it. False where
            left out.
    """

    statistics: bool


class RealTimeKeywords(RunKeywords, total=False):
    """The same, and which clock at what speed.

    A writer of the trace that does not keep up leaves a gap and never delays a tick; messages that find no room are
    left out, and counted in the file.

    Attributes:
        speed: seconds of the run in a second of the clock, 0.01 to 1000; 1 where left out.
        clock: paces the run; that of the computer where left out.
    """

    speed: float
    clock: Clock


USUAL: Final[RunKeywords] = {
    "seed": None, "trace": True, "programs": None, "patience": PATIENCE, "log": True, "ads": True,
}  # fmt: skip
"""What holds where a keyword is left out."""


def require_call(called: str, machine: object, declared: type, keywords: Mapping[str, Any]) -> None:
    """Refuse what is no machine, and keywords that there are not.

    Args:
        called: the kind of run, for the message.
        machine: what was given as one.
        declared: the TypedDict of its keywords.
        keywords: what was given.

    Raises:
        TypeError: it is something else, or a keyword is unknown; the message names what was called.
    """
    if not isinstance(machine, Machine):
        raise TypeError(f"{called}({machine!r}): give a machine, as in {called}(Machine.load({machine!r}))")
    only_known(called, declared, keywords)
