"""`MotionLayer`: everything of the motion layer, for one machine."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Final

from motionlayer.command import Command, Ledger
from motionlayer.event import EventLog
from motionlayer.layer._absent import AbsentFunctions, AbsentNamespace
from motionlayer.layer._answer import Waits
from motionlayer.layer._axes import AxisNamespace
from motionlayer.layer._axis_job import AxisPort
from motionlayer.layer._globals import Globals
from motionlayer.layer._mc_axis import McAxis
from motionlayer.layer._options import LayerOptions, Schedule
from motionlayer.layer._starting import Starting
from motionlayer.nc import axis_device
from motionlayer.runtime import Stage, Step

if TYPE_CHECKING:
    from motionlayer.fb import AXIS_REF
    from motionlayer.iec import OutputArray
    from motionlayer.layer._function_globals import CamGlobals, NciGlobals, SawGlobals
    from motionlayer.layer._interfaces import I_McAxis
    from motionlayer.nc import AxisRefs

ALWAYS: Final = Schedule()


class MotionLayer:
    """Builds all objects and symbols of the layer, and calls them in their order.

    Args:
        refs: the axes with their parameters, in the order of their indices 1, 2, 3 …
        images: the cyclic interface of the axes, `AxisStage.images`.
        events: where messages go.
        ledger: the present tick, and who commands.
        options: what the machine file says.

    Attributes:
        globals: all variables.
        symbols: all of them by name.
        axis: the objects of `GVL_AXIS`, by index and by name.

    Raises:
        ValueError: there is no axis, or not as many as `options.sizes` says.
    """

    def __init__(
        self,
        refs: "Sequence[AXIS_REF]",
        images: "AxisRefs",
        events: EventLog,
        ledger: Ledger,
        options: LayerOptions,
    ) -> None:
        if not refs or len(refs) != options.sizes.max_axis:
            raise ValueError(f"{len(refs)} axes, and sizes.max_axis = {options.sizes.max_axis}: give as many, from 1")
        patience = max(1, round(options.timeout / images.cycle_time))
        retries = options.sizes.max_retry
        self._ports = [
            AxisPort(ref, index, f"GVL_AXIS.Ctrl[{index}]", axis_device(index - 1), events, patience, retries)
            for index, ref in enumerate(refs, 1)
        ]
        self._ledger = ledger
        self._schedule = options.schedule
        self._waits = Waits()
        self._starting = Starting(self._is_ready)
        references = [ref.axis.config.home.position for ref in refs]
        self.globals = Globals(options.sizes, options.features, images, references)
        self.symbols = self.globals.symbols
        programs = self.globals.program
        self._axes = AxisNamespace(self._ports, images, self.globals.axis, programs.axis, self._waits, self._starting)
        self.axis = self._axes.axis
        self._nci = self._absent(programs.nci, self.globals.nci)
        self._cam = self._absent(programs.cam, self.globals.cam)
        self._saw = self._absent(programs.saw, self.globals.saw)
        self._functions = AbsentFunctions(programs.functions, self._is_ready)

    def _absent(self, e_init: "OutputArray[Any]", variables: "NciGlobals | CamGlobals | SawGlobals") -> AbsentNamespace:
        return AbsentNamespace(e_init, variables.ctrl, variables.state, self._is_ready)

    @property
    def ready(self) -> bool:
        """All axes have been brought up: `MAIN_AXIS.eInit` is 10000."""
        return self._is_ready()

    def _is_ready(self) -> bool:
        return self._axes.startup.done

    def started(self) -> Command[None]:
        """Return what can be awaited until the layer is ready."""
        return self._starting.wait()

    def interface(self, index: int) -> "I_McAxis":
        """Return the interface of an axis for one caller, who shares its memory with nobody.

        Raises:
            IndexError: there is no such axis.
        """
        return McAxis(self._ports[self.axis[index].index - 1])

    def stages(self) -> list[Stage]:
        """Return what a tick calls, in order: MAIN, FUNCTIONS, NCI, CAM, FLYING_SAW; mapping goes around them."""
        programs: list[tuple[str, str, Callable[[int], None]]] = [
            ("axis", "MAIN", self._axes.call),
            ("functions", "FUNCTIONS", self._functions.call),
            ("nci", "NCI", self._nci.call),
            ("cam", "CAM", self._cam.call),
            ("saw", "FLYING_SAW", self._saw.call),
        ]
        return [
            Stage(Step.LAYER, name, _scheduled(self._schedule.get(key, ALWAYS), call)) for key, name, call in programs
        ]


def _scheduled(schedule: Schedule, call: Callable[[int], None]) -> Callable[[int], None]:
    """Return what a stage calls; a namespace that is called in every tick costs nothing more."""
    if schedule == ALWAYS:
        return call

    def due(tick: int) -> None:
        if schedule.holds(tick):
            call(tick)

    return due
