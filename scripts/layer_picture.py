"""Draw docs/images/layer.svg: commands of an axis, and what its State and Info show, from a run.

`--check` writes nothing and fails if the picture is not what the run shows.
"""

import sys
from typing import Any, Final

from _generated import ROOT, current
from _timing import Band, Curve, Lane, diagram

from motionlayer import Machine, Simulation
from motionlayer.drive import Fault
from motionlayer.layer import AxisCommand, Progress
from motionlayer.layer.types import BufferMode

MACHINE: Final[dict[str, Any]] = {
    "format": 1,
    "name": "picture",
    "layer": {},
    "axis": {
        "X": {
            "max_velocity": 500.0,
            "max_acceleration": 5000.0,
            "max_jerk": 100_000.0,
            "drive": {"kind": "servo", "position_gain": 100.0, "ready_delay": 0.05},
        }
    },
}
FAULT: Final = 1240
LENGTH: Final = 1560

STEPS: Final[dict[int, dict[str, object]]] = {
    20: {"cmd": AxisCommand.ENABLE},
    140: {"cmd": AxisCommand.MOVE_POS, "position": 60.0, "velocity": 400.0},
    460: {"cmd": AxisCommand.MOVE_BUFFER, "position": 120.0, "buffer_mode": BufferMode.BLENDING_LOW},
    600: {"position": 180.0},
    740: {"position": 240.0},
    1020: {"progress": Progress.DONE},
    1100: {"cmd": AxisCommand.MOVE_POS, "position": 0.0},
    1380: {"cmd": AxisCommand.IDLE},
}
"""What a client writes, by the millisecond."""

INFO: Final = {"bReady": "ready", "bBusy": "busy", "bError": "error"}


class _Seen:
    """What the client has written and read, per cycle."""

    def __init__(self) -> None:
        self.commands: list[str] = []
        self.shown: list[str] = []
        self.progress: list[str] = []
        self.info: dict[str, list[bool]] = {name: [] for name in INFO}
        self.curves: dict[str, list[float]] = {"act. position, mm": [], "act. velocity, mm/s": []}

    def look(self, axis: Any) -> None:  # noqa: ANN401 - an axis of the layer
        """Note what there is in this cycle."""
        command, progress = axis.state.split()
        self.commands.append(AxisCommand(axis.ctrl.cmd).name)
        self.shown.append(AxisCommand(command).name)
        self.progress.append(Progress(progress).name)
        for name, attribute in INFO.items():
            self.info[name].append(getattr(axis.info, attribute))
        for values, value in zip(self.curves.values(), (axis.info.position, axis.info.velocity), strict=True):
            values.append(value)

    def drawn(self) -> str:
        """Return the picture."""
        marks = dict.fromkeys(self.progress, "in") | {"DONE": "out", "ERROR": "bad"}
        lanes: list[Lane | Band] = [
            Band("GVL_AXIS.Ctrl[1]", "eCmd", "in", self.commands),
            Band("GVL_AXIS.State[1].eState", "command", "out", self.shown),
            Band("GVL_AXIS.State[1].eState", "progress", "out", self.progress, marks),
        ]
        lanes += [
            Lane("GVL_AXIS.Info[1]", name, "bad" if name == "bError" else "out", values)
            for name, values in self.info.items()
        ]
        curves = [Curve(name, values) for name, values in self.curves.items()]
        return diagram("State and Info of an axis while it carries out commands", lanes, curves, 1.0)


def picture() -> str:
    """Run the commands and draw what was seen."""
    run, seen = Simulation(Machine.from_dict(MACHINE), trace=None), _Seen()
    axis = run.layer.axis[1]
    while not run.layer.ready:
        run.step()
    run.inject("X", Fault("drive_error"), run.tick + FAULT)
    for tick in range(LENGTH):
        for name, value in STEPS.get(tick, {}).items():
            owner = next(one for one in (axis.ctrl, axis.data, axis.options) if hasattr(one, name))
            setattr(owner, name, value)
        run.step()
        seen.look(axis)
    return seen.drawn()


def pages() -> dict[str, str]:
    """Return the picture by its name below docs/images/."""
    return {"layer.svg": picture()}


if __name__ == "__main__":
    sys.exit(current(__doc__ or "", "scripts/layer_picture.py", ROOT / "docs" / "images", pages()))
