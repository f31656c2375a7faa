"""A run whose only stages are the images of a few arrays; time passes by `step`."""

from typing import Any

from motionlayer.command import Ledger
from motionlayer.event import Event, EventLog, Level
from motionlayer.iec import DINT, InputArray, OutputArray, Variable
from motionlayer.layer._mapping import ImageMapping, MapOptions
from motionlayer.layer._mapping_build import START, Outside, control_mapping, layer_mapping, own
from motionlayer.layer._mapping_table import INPUTS, OUTPUTS
from motionlayer.layer._ownership import Access
from motionlayer.layer.types import AxisCtrl, AxisInfo, AxisState, MoveData
from motionlayer.runtime import Stage, Step, SteppedRun

KNOWN = {"GVL_AXIS.Ctrl": AxisCtrl, "GVL_AXIS.Data": MoveData, "GVL_AXIS.State": AxisState, "GVL_AXIS.Info": AxisInfo}


def arrays_of(axes: int, others: int = 2) -> dict[str, Variable[Any]]:
    """Return the arrays of the mapping table, those of axes with their types, and numbers for all else."""
    made: dict[str, Variable[Any]] = {}
    for kind, rows in ((InputArray, INPUTS), (OutputArray, OUTPUTS)):
        for row in rows:
            if row.group == "selector":
                made[row.symbol] = kind(DINT, None, None, row.symbol)
            else:
                count = axes if row.group in {"axis", "cam", "saw"} else others
                made[row.symbol] = kind(KNOWN.get(row.symbol, DINT), 1, count, row.symbol)
    made[START] = OutputArray(DINT, None, None, START)
    return made


class Mapped:
    """A layer that does nothing: arrays, their images and owners, in a run."""

    def __init__(self, *maps: MapOptions, axes: int = 3, control: bool = False) -> None:
        self.ledger, self.events = Ledger(), EventLog()
        self.run = SteppedRun(
            [], base_cycle_ns=1_000_000, ledger=self.ledger, events=self.events, on_failure=lambda _program: None
        )
        self.arrays = arrays_of(axes)
        outside = Outside(self.run.areas, self.run.mailbox, self.events)
        build = control_mapping if control else layer_mapping
        self.mapping: ImageMapping = build(maps, self.arrays, outside)
        own(self.mapping, self.arrays, Access(self.events, self.ledger))
        self.run._arrange(
            [
                Stage(Step.INPUTS, "mapping", self.mapping.copy_in),
                Stage(Step.OUTPUTS, "mapping", self.mapping.copy_out),
            ]
        )

    def post(self, image: str, data: bytes) -> None:
        self.run.areas[image].post(data)

    @property
    def messages(self) -> list[Event]:
        return self.events.last()

    @property
    def warnings(self) -> list[Event]:
        return self.events.last(Level.WARNING)

    def commands(self) -> list[int]:
        return [int(one.cmd) for one in self.arrays["GVL_AXIS.Ctrl"]]
