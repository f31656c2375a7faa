"""Machine description: file → checked description → a run.

A machine file is TOML, `format = 1`. It is checked completely before anything runs: each model checks its own
table, relations between tables are checked beside the models, and all problems come in one `MachineError`,
each with file, line, field, value and what is allowed. This is the only part that knows all others.
What needs the motion layer or ADS is imported when it is asked for: a run without them starts sooner.
"""

import importlib
from typing import TYPE_CHECKING, Any

from motionlayer.connect import ServerFailed
from motionlayer.machine._ads_description import AdsDescription
from motionlayer.machine._description import Description
from motionlayer.machine._errors import Finding, MachineError, OldName
from motionlayer.machine._load import check_description, doubtful, load_description
from motionlayer.machine._log_description import LogDescription
from motionlayer.machine._machine import Machine
from motionlayer.machine._machine_run import MachineRun
from motionlayer.machine._mqtt_description import MqttDescription
from motionlayer.machine._programs import Loaded, ProgramError, Source, load_program, parse_source, sources_of
from motionlayer.machine._realtime import REALTIME_PATIENCE, RealTime
from motionlayer.machine._recorded import ReplayError
from motionlayer.machine._replay import Replay, replay
from motionlayer.machine._run_keywords import RealTimeKeywords, RunKeywords, SimulationKeywords
from motionlayer.machine._schema import MachineFile, machine_schema, module_schema
from motionlayer.machine._simulation import Simulation

if TYPE_CHECKING:
    from motionlayer.machine._ads_link import AdsLink, LinkError, ReadWrite
    from motionlayer.machine._drive_symbols import DriveFault
    from motionlayer.machine._interface import interface
    from motionlayer.machine._loopback import Loopback

_HOME = {
    "AdsLink": "_ads_link",
    "DriveFault": "_drive_symbols",
    "LinkError": "_ads_link",
    "Loopback": "_loopback",
    "ReadWrite": "_ads_link",
    "interface": "_interface",
}

__all__ = [
    "REALTIME_PATIENCE",
    "AdsDescription",
    "AdsLink",
    "Description",
    "DriveFault",
    "Finding",
    "LinkError",
    "Loaded",
    "LogDescription",
    "Loopback",
    "Machine",
    "MachineError",
    "MachineFile",
    "MachineRun",
    "MqttDescription",
    "OldName",
    "ProgramError",
    "ReadWrite",
    "RealTime",
    "RealTimeKeywords",
    "Replay",
    "ReplayError",
    "RunKeywords",
    "ServerFailed",
    "Simulation",
    "SimulationKeywords",
    "Source",
    "check_description",
    "doubtful",
    "interface",
    "load_description",
    "load_program",
    "machine_schema",
    "module_schema",
    "parse_source",
    "replay",
    "sources_of",
]


def __getattr__(name: str) -> Any:  # noqa: ANN401 - whatever is asked for
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"{__name__}.{_HOME[name]}"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
