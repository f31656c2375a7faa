"""`AxisNamespace`: the program MAIN, all axes with their command fields (motion-layer 1.2).

A cycle in which nothing is asked and nothing is under way costs a few tests and the kernel that fills Info: what
clients have written is told by the lists of touched elements, and a controller with nothing to do is not called.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from motionlayer.event import Level, Subdevice
from motionlayer.layer._answer import Waits
from motionlayer.layer._axis import AxisController
from motionlayer.layer._axis_job import FAILED, AxisPort
from motionlayer.layer._globals import AxisGlobals
from motionlayer.layer._inputs import check_data, check_options, overwrite
from motionlayer.layer._objects import axis_objects
from motionlayer.layer._selector import Selector
from motionlayer.layer._starting import Starting
from motionlayer.layer._startup import StartUp
from motionlayer.layer.info import AxisInfos

if TYPE_CHECKING:
    from motionlayer.iec import OutputArray
    from motionlayer.layer.types import Progress
    from motionlayer.nc import AxisRefs


class AxisNamespace:
    """The axes, the parameter selector and the start-up.

    Args:
        ports: the axes, in the order of their indices.
        images: their cyclic interface.
        variables: `GVL_AXIS`.
        e_init: `MAIN_AXIS.eInit`.
        waits: of the layer.
        starting: who waits for the end of the start-up.

    Attributes:
        axis: what control programs use.
        controllers: in the order of the indices.
        startup: brings the axes up, one after the other.
    """

    # Read in every cycle of every machine: quicker than with a dictionary.
    __slots__ = (
        "_active", "_awake", "_ctrl", "_data", "_infos", "_options", "_selector_ctrl", "_starting", "_starts",
        "_switches", "_waits", "axis", "controllers", "selector", "startup",
    )  # fmt: skip

    def __init__(
        self,
        ports: Sequence[AxisPort],
        images: "AxisRefs",
        variables: AxisGlobals,
        e_init: "OutputArray[Progress | int]",
        waits: Waits,
        starting: Starting,
    ) -> None:
        self._ctrl, self._data, self._options = variables.ctrl, variables.data, variables.options
        self._switches, self._selector_ctrl = variables.switches, variables.selector_ctrl
        self._waits = waits
        self._starting = starting
        self._starts = True
        self._infos = AxisInfos(images, variables.info)
        names = [port.ref.axis.name for port in ports]
        self.axis = axis_objects(names, variables, waits)
        self.controllers = [
            AxisController(port, one, self._infos.flags, self._infos.errors)
            for port, one in zip(ports, axis_objects(names, variables, waits, by_layer=True), strict=True)
        ]
        self.startup = StartUp(self.controllers, variables.ctrl, e_init)
        self.selector = Selector(ports, variables.selector_ctrl, variables.selector_state, waits)
        self._active = list(self.controllers)
        self._awake = bytearray([1]) * len(self.controllers)

    def call(self, _tick: int) -> None:
        """Do the work of one cycle."""
        if self._data.touched or self._options.touched or self._switches.touched:
            self._take_inputs()
        if self._starts:
            self._start_up()
        if self._ctrl.touched:
            self._wake()
        if self._active:
            self._call_active()
        if self.selector.active or self._selector_ctrl.touched:
            self.selector.cycle()
        found = self._infos.fill()
        if found is not None:
            self._feed_switches(found.turned)
            self._tell_errors(found.errors)
        if self._waits.open:
            self._waits.look()

    def _start_up(self) -> None:
        """Go on with the start-up, and tell who waits for its end."""
        self.startup.go_on()
        if self.startup.done:
            self._starts = False
            self._starting.look()

    def _take_inputs(self) -> None:
        """Take up what clients have written, apart from commands."""
        for index in sorted(self._data.take()):
            check_data(self._data, index, self.controllers[index - 1].memory)
        for index in sorted(self._options.take()):
            check_options(self._options, index, self.controllers[index - 1].memory)
        for index in self._switches.take():
            self.controllers[index - 1].memory.switches_written = True

    def _feed_switches(self, places: list[int]) -> None:
        """Show the reference switches of drives as calibration cams, where no client writes these."""
        for place in places:
            if not self.controllers[place].memory.switches_written:
                overwrite(self._switches, place + 1, calibrate=bool(self._infos.switches[place]))
        self._switches.take()  # no client has written them

    def _wake(self) -> None:
        """Call those again whose command field was written, in the order of the indices."""
        for index in self._ctrl.take():
            self._awake[index - 1] = 1
        self._active = [one for one, awake in zip(self.controllers, self._awake, strict=True) if awake]

    def _call_active(self) -> None:
        """Call who has something to do."""
        before = self._active
        self._active = [one for one in before if one.call()]
        if len(self._active) != len(before):
            self._awake[:] = bytes(len(self._awake))
            for one in self._active:
                self._awake[one.place] = 1

    def _tell_errors(self, places: list[int]) -> None:
        """Tell of errors that axes have come to, with or without a command."""
        for place in places:
            job = self.controllers[place].memory
            error = job.axis.error
            job.tell(Level.ERROR, Subdevice.AxisCycle, FAILED, error.id if error is not None else 0)
