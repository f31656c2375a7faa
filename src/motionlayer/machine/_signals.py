"""The signals of a machine: which value of the store has which name and unit in a trace."""

from fnmatch import fnmatchcase
from typing import Final

from motionlayer.machine._description import SIGNALS, Description
from motionlayer.record import Signal
from motionlayer.store import Q, Store

ROWS: Final = {
    "set_position": (Q.SET_P, ""),
    "set_velocity": (Q.SET_V, "/s"),
    "set_acceleration": (Q.SET_A, "/s²"),
    "set_jerk": (Q.SET_J, "/s³"),
    "actual_position": (Q.ACTUAL_P, ""),
    "lag": (Q.LAG, ""),
    "max_velocity": (Q.MAX_V, "/s"),
    "max_acceleration": (Q.MAX_A, "/s²"),
    "max_deceleration": (Q.MAX_D, "/s²"),
    "max_jerk": (Q.MAX_J, "/s³"),
    "software_limit_min": (Q.MIN_P, ""),
    "software_limit_max": (Q.MAX_P, ""),
    "state": (Q.STATE, None),
    "override": (Q.OVERRIDE, None),
    "enable": (Q.ENABLE, None),
    "ready": (Q.READY, None),
}
"""Row of the store and what is appended to the unit of the axis; None for plain numbers."""

assert tuple(ROWS) == SIGNALS


def signals_of(description: Description, store: Store) -> list[Signal]:
    """Return what the trace section selects, axis by axis."""
    columns = store.table.shape[1]
    chosen = []
    for column, (axis, entry) in enumerate(description.axis.items()):
        for signal, (row, per) in ROWS.items():
            name = f"{axis}.{signal}"
            if any(fnmatchcase(name, pattern) for pattern in description.trace.signals):
                unit = "1" if per is None else entry.unit + per
                chosen.append(Signal(name, unit, row * columns + column, _resolution(description, name)))
    return chosen


def _resolution(description: Description, name: str) -> float:
    """The last pattern that matches decides."""
    value = 0.0
    for pattern, resolution in description.trace.resolution.items():
        if fnmatchcase(name, pattern):
            value = resolution
    return value
