"""`ControlSide`: the variables of a motion layer in another machine, used as if the layer were here.

Ctrl, Data … are objects here that programs write; they are published in output images. State, Info … are what the input
images say. Names, types and indices are those of the layer, so that the same program runs on both sides. What differs
is time: an answer takes as many cycles as the connection needs, there and back.

The layer brings its axes up by itself, and leaves AXIS_INIT in all command fields. So they begin with it here, too, and
nothing is given out until the start-up over there has ended, well or not: it is not disturbed, a program finds what it
would find beside the layer, and what it drops first is the first command that arrives. An axis that moves already is
not disturbed by AXIS_INIT either.
"""

from collections.abc import Sequence

from motionlayer.command import Command, Ledger
from motionlayer.layer._answer import Waits
from motionlayer.layer._constants import Features, Sizes
from motionlayer.layer._exchange import Exchange
from motionlayer.layer._globals import Globals
from motionlayer.layer._inputs import overwrite
from motionlayer.layer._mapping import MapOptions
from motionlayer.layer._mapping_build import Arrays, Outside, control_mapping, map_variables
from motionlayer.layer._objects import axis_objects
from motionlayer.layer._starting import Starting
from motionlayer.layer.types import AxisCommand, Progress
from motionlayer.runtime import Stage, Step


class ControlSide:
    """Ctrl and State of axes in another machine.

    Args:
        names: of the axes, in the order of their indices.
        sizes: how many of each kind there are; as in the map of the other machine.
        maps: what is mapped there for this machine.
        outside: where the images lie.
        ledger: the present tick, and who commands.
        simulated: variables that only a simulated machine has.

    Attributes:
        globals: all variables.
        symbols: all of them by name.
        mapping: the images.
        axis: the objects of `GVL_AXIS`, by index and by name.
        given: the tick from which on the output images mean something; None before.
    """

    def __init__(
        self,
        names: Sequence[str],
        sizes: Sizes,
        maps: Sequence[MapOptions],
        outside: Outside,
        ledger: Ledger,
        simulated: Arrays,
    ) -> None:
        self.globals = Globals(sizes, Features())
        self.symbols = self.globals.symbols
        self.mapping = map_variables(control_mapping, maps, self.globals, outside, ledger, simulated)
        self.given: int | None = None
        self._waits = Waits()
        self._starting = Starting(self._is_ready)
        self.axis = axis_objects(names, self.globals.axis, self._waits)
        for index in range(1, sizes.max_axis + 1):
            overwrite(self.globals.axis.ctrl, index, cmd=AxisCommand.INIT)
        self._states = [one.state for one in self.axis]
        self._exchanges = [Exchange(AxisCommand.INIT) for _ in self._states]
        for state, exchange in zip(self._states, self._exchanges, strict=True):
            state.exchange = exchange

    @property
    def ready(self) -> bool:
        """All axes have been brought up: `MAIN_AXIS.eInit` is 10000."""
        return self._is_ready()

    def _is_ready(self) -> bool:
        return int(self.globals.program.axis.value) == Progress.DONE

    def started(self) -> Command[None]:
        """Return what can be awaited until the layer is ready."""
        return self._starting.wait()

    def stages(self) -> list[Stage]:
        """Return what a tick calls."""
        return [
            Stage(Step.INPUTS, "MAPPING_in", self._copy_in),
            Stage(Step.OUTPUTS, "MAPPING_out", self._copy_out),
        ]

    def _copy_in(self, tick: int) -> None:
        """Show what the other machine has sent, and wake who waits for it."""
        self.mapping.copy_in(tick)
        for state, exchange in zip(self._states, self._exchanges, strict=True):
            exchange.take(state.code)
        if self._waits.open:
            self._waits.look()
        self._starting.look()

    def _copy_out(self, tick: int) -> None:
        """Let the other machine see what is written here, as soon as it is up."""
        if self.given is None and int(self.globals.program.axis.value) in (Progress.DONE, Progress.ERROR):
            self.given = tick
        if self.given is not None:
            for state, exchange in zip(self._states, self._exchanges, strict=True):
                exchange.give(state.asked)
            self.mapping.copy_out(tick)
