"""motionlayer: a motion runtime.

>>> from motionlayer import Machine, Simulation

The names here are loaded when they are first used, so that `import motionlayer` costs nothing.
"""

import importlib
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0.dev0"

if TYPE_CHECKING:
    from motionlayer.command import Command, CommandAborted, CommandError, MotionError, all_of, any_of
    from motionlayer.drive import Fault
    from motionlayer.machine import Loopback, Machine, MachineError, MachineRun, RealTime, Replay, Simulation, replay
    from motionlayer.nc import AxisState, Direction, stopping
    from motionlayer.record import Trace

_HOME = {
    "Command": "command",
    "CommandAborted": "command",
    "CommandError": "command",
    "MotionError": "command",
    "all_of": "command",
    "any_of": "command",
    "Fault": "drive",
    "Loopback": "machine",
    "Machine": "machine",
    "MachineError": "machine",
    "MachineRun": "machine",
    "RealTime": "machine",
    "Replay": "machine",
    "Simulation": "machine",
    "replay": "machine",
    "AxisState": "nc",
    "Direction": "nc",
    "stopping": "nc",
    "Trace": "record",
}

__all__ = [
    "AxisState",
    "Command",
    "CommandAborted",
    "CommandError",
    "Direction",
    "Fault",
    "Loopback",
    "Machine",
    "MachineError",
    "MachineRun",
    "MotionError",
    "RealTime",
    "Replay",
    "Simulation",
    "Trace",
    "all_of",
    "any_of",
    "replay",
    "stopping",
]


def __getattr__(name: str) -> Any:  # noqa: ANN401 - whatever is asked for
    if name not in _HOME:
        raise AttributeError(f"module 'motionlayer' has no attribute {name!r}")
    return getattr(importlib.import_module(f"motionlayer.{_HOME[name]}"), name)


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
