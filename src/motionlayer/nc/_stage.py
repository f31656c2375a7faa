"""The axes' part in a cycle."""

from collections.abc import Sequence

from motionlayer.command import ErrorId
from motionlayer.nc._actual import ActualMotion
from motionlayer.nc._axis import Axis
from motionlayer.nc._axis_refs import AxisRefs, op_mode
from motionlayer.nc._monitors import Monitors
from motionlayer.nc._override import Overrides
from motionlayer.nc._reaction import ErrorGroup, react
from motionlayer.store import Store


class AxisStage:
    """Call the axes that have something to do, and no others.

    Args:
        axes: in order of their columns, which are 0, 1, 2 …
        store: setpoints and actual values.
        groups: what an error of one axis means for others.
    """

    def __init__(self, axes: Sequence[Axis], store: Store, groups: Sequence[ErrorGroup] = ()) -> None:
        self._axes = axes
        self._store = store
        self._overrides = Overrides(store)
        self._groups = groups
        self._faulted: list[int] = []
        configs = {column: axis.config.monitor for column, axis in enumerate(axes) if axis.config.monitor.any}
        self._monitors = Monitors(store, configs)
        self._actual = ActualMotion(store, len(axes))
        self._images: AxisRefs | None = None
        for axis in axes:
            axis.cycle.attach(self._monitors, self._faulted if groups else None, self._configured)

    @property
    def images(self) -> AxisRefs:
        """The cyclic interface of the axes; filled in every tick, from the first time it is asked for."""
        if self._images is None:
            configs = [axis.config for axis in self._axes]
            self._images = AxisRefs(
                self._store, self._actual, [one.modulo.period for one in configs], [op_mode(one) for one in configs]
            )
            self._images.fill(self._store.tick)
        return self._images

    def _configured(self, column: int) -> None:
        """Take up another configuration of an axis."""
        config = self._axes[column].config
        self._monitors.configure(column, config.monitor)
        if self._images is not None:
            self._images.configure(column, config)

    def inputs(self, tick: int) -> None:
        """Take up what the drives reported, and show it."""
        changed = self._store.status_changed
        if changed:
            for column in changed:
                self._axes[column].cycle.drive_changed()
            changed.clear()
        if self._faulted:
            react(self._groups, self._faulted, self._axes)
        self._actual.follow()
        if self._images is not None:
            self._images.fill(tick)

    def accept(self, _tick: int) -> None:
        """Put requested overrides in force, after all commands of the tick."""
        for column, failed in self._overrides.apply():
            if failed:
                self._axes[column].fault(ErrorId.INTERNAL, "the motion cannot be planned with this override")
            else:
                self._axes[column].cycle.override_changed()

    def motion(self, tick: int) -> None:
        """Look at the monitors of this tick, sample the setpoints of the next; let commands end."""
        seen = self._monitors.look()
        for ended in self._store.sample(tick + 1):
            self._axes[ended.column].cycle.profile_ended(ended)
        for one in seen:
            self._axes[one.column].cycle.monitored(one)
