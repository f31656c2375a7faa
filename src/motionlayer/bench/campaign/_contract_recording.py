"""`Recording`: a motion layer as seen from outside, cycle by cycle.

Structures are read as bytes, with the layouts that motion-layer 3.2 and 3.3 give.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motionlayer.event import Event
from motionlayer.record import Trace

CTRL: Final = np.dtype([("command", "<u2"), ("ends", "<u2")])
STATE: Final = np.dtype([("state", "<u2"), ("encoder", "<u4")])
INFO: Final = np.dtype(
    {
        "names": ["bits", "error_id", "position"],
        "formats": ["u1", "<u4", "<f8"],
        "offsets": [0, 2, 6],
        "itemsize": 38,
    }
)
DATA: Final = np.dtype(
    [(name, "<f8") for name in ("position", "velocity", "override", "acceleration", "deceleration", "jerk")]
    + [("direction", "<i2")]
)
OPTIONS: Final = np.dtype([("mode", "<u2"), ("distance", "<f8")])
SELECTOR_CTRL: Final = np.dtype(
    [
        ("selector", "<i2"),
        ("axis", "<u2"),
        ("command", "<u2"),
        ("ends", "<u2"),
        ("number", "<i2"),
        ("value", "<f8"),
    ]
)
SELECTOR_STATE: Final = np.dtype(
    {
        "names": ["axis", "axis_id", "state", "number", "value"],
        "formats": ["<u2", "<u4", "<u2", "<i2", "<f8"],
        "offsets": [0, 4, 8, 14, 16],
        "itemsize": 24,
    }
)

Rows = NDArray[np.void]


class Recording(NamedTuple):
    """All cycles; arrays have the shape (ticks, axes), of the selector (ticks,).

    Attributes:
        axes: their names.
        patience: ticks that switching may take.
        ctrl, options: commands and options as the layer has seen them.
        asked: move data as the client has written them.
        data: move data at the end of the cycle.
        state, info: as published.
        errors: error ids of the axes themselves at the end of the cycle.
        selector_ctrl, selector_state: of the parameter selector.
        events: of the axes' commands.
        trace: what the axes did.
    """

    axes: tuple[str, ...]
    patience: int
    ctrl: Rows
    options: Rows
    asked: Rows
    data: Rows
    state: Rows
    info: Rows
    errors: NDArray[np.int64]
    selector_ctrl: Rows
    selector_state: Rows
    events: tuple[Event, ...]
    trace: Trace
