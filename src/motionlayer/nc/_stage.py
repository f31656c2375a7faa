"""The axes' part in a cycle."""

from collections.abc import Sequence

from motionlayer.command import ErrorId
from motionlayer.nc._axis import Axis
from motionlayer.nc._override import Overrides
from motionlayer.store import Store


class AxisStage:
    """Call the axes that have something to do, and no others.

    Args:
        axes: in order of their columns, which are 0, 1, 2 …
        store: setpoints and actual values.
    """

    def __init__(self, axes: Sequence[Axis], store: Store) -> None:
        self._axes = axes
        self._store = store
        self._overrides = Overrides(store)

    def inputs(self, _tick: int) -> None:
        """Take up what the drives reported."""
        changed = self._store.status_changed
        if changed:
            for column in changed:
                self._axes[column].drive_changed()
            changed.clear()

    def accept(self, _tick: int) -> None:
        """Put requested overrides in force, after all commands of the tick."""
        for column in self._overrides.apply():
            self._axes[column].fault(ErrorId.INTERNAL, "the motion cannot be planned with this override")

    def motion(self, tick: int) -> None:
        """Sample the setpoints of the next tick; let commands end."""
        for ended in self._store.sample(tick + 1):
            self._axes[ended.column].profile_ended(ended)
