"""Runs of machines with a motion layer and message files, and what they have said."""

from pathlib import Path
from typing import Any

from motionlayer import Machine, Simulation
from motionlayer.event import Device, Event, Kind, Level, Subdevice, device_of
from motionlayer.runtime import PATIENCE
from tests.machines import LINEAR

PREFIX = "GVL_MSG_AXIS."
AXIS = device_of(Device.Axis, 1)


def opened(
    folder: Path | None = None,
    *,
    axes: int = 1,
    layer: dict[str, Any] | None = None,
    patience: float = PATIENCE,
    **log: Any,
) -> Simulation:
    """Return a run with axes X, Y, Z, and with message files if there is a folder."""
    described: dict[str, Any] = {
        "format": 1,
        "name": "test",
        "axis": dict.fromkeys("XYZ"[:axes], LINEAR),
        "layer": layer or {},
    }
    if folder is not None:
        described["log"] = {"folder": str(folder), "start": "2025-10-24T13:00:00"} | log
    return Simulation(Machine.from_dict(described), patience=patience)


def started(folder: Path | None = None, **changes: Any) -> Simulation:
    """Return such a run, whose axes have been brought up and whose lists are empty."""
    run = opened(folder, **changes)
    run.step(5100)
    assert run.layer.ready
    assert (read(run, "MotionMessageState.State"), read(run, "MessageMotionIndex")) == (0, 0)
    return run


def read(run: Simulation, name: str) -> Any:
    """Return a variable of GVL_MSG_AXIS."""
    return run.symbols.read(PREFIX + name)


def say(run: Simulation, text: str = "text", level: Level = Level.INFO, *, device: int = AXIS, code: int = 0) -> None:
    """Say something of an axis now."""
    run.events.add(Event(run.tick, level, Kind.MESSAGE, "X", text, code, 0, device, Subdevice.AxisControl))


def lines(folder: Path) -> list[list[str]]:
    """Return the columns of all lines in the motion files, in their order; the run must be closed."""
    files = sorted(folder.rglob("*_MSG_PLC_*.txt"))
    return [line.split("\t") for file in files for line in file.read_text().splitlines()]
