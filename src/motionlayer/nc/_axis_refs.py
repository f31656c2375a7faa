"""`AxisRefs`: the cyclic interface of all axes, as one buffer per direction."""

import functools
import math
import operator
from typing import TYPE_CHECKING, Any

import numpy as np

from motionlayer.nc._actual import ActualMotion
from motionlayer.nc._axis_ref import NCTOPLC_AXIS_REF, PLCTONC_AXIS_REF, OpModeDWord
from motionlayer.nc._axis_ref_kernels import fill
from motionlayer.nc._config import AxisConfig
from motionlayer.store import Q, Store

if TYPE_CHECKING:
    from numpy.typing import NDArray


def op_mode(config: AxisConfig) -> OpModeDWord:
    """Return which monitors of an axis are on, and of what kind it is."""
    monitor = config.monitor
    watched = {
        OpModeDWord.PositionAreaMonitoring: monitor.range_window is not None,
        OpModeDWord.TargetPositionMonitoring: monitor.target_window is not None,
        OpModeDWord.PEHTimeMonitoring: monitor.target_timeout is not None,
        OpModeDWord.MotionMonitoring: monitor.motion_window is not None,
        OpModeDWord.Modulo: config.modulo.described,
        OpModeDWord.SimulationAxis: config.simulated,
        OpModeDWord.PositionLagMonitoring: monitor.lag is not None,
        OpModeDWord.VeloLagMonitoring: monitor.velocity_lag is not None,
        OpModeDWord.SoftLimitMinMonitoring: math.isfinite(config.limit_min),
        OpModeDWord.SoftLimitMaxMonitoring: math.isfinite(config.limit_max),
    }
    return functools.reduce(operator.or_, (bit for bit, on in watched.items() if on), OpModeDWord(0))


class AxisRefs:
    """`NcToPlc` and `PlcToNc` of all axes; the buffers never move.

    What is shown is what the last finished cycle has come to: the setpoints that it generated, and the actual values
    that its drives then reported (function-blocks 1.6). A block sees it until the next inputs, whatever is commanded.

    Args:
        store: where the values are; axes are its first columns.
        actual: how fast the axes move by what their drives report.
        modulo: modulo period per axis, u, > 0.
        op_mode: `OpModeDWord` per axis without the cycle counter.

    Attributes:
        nc_to_plc: structured array `NCTOPLC_AXIS_REF`, one element per axis.
        plc_to_nc: structured array `PLCTONC_AXIS_REF`, one element per axis.
        switches: reference switches of the drives, one element per axis; 1.0 is on.
        overrides: velocity overrides in force, one element per axis, 0 to 1.
        cycle_time: s.
    """

    def __init__(self, store: Store, actual: ActualMotion, modulo: list[float], op_mode: list[int]) -> None:
        count = len(modulo)
        self.nc_to_plc: NDArray[Any] = np.zeros(count, dtype=NCTOPLC_AXIS_REF)
        self.plc_to_nc: NDArray[Any] = np.zeros(count, dtype=PLCTONC_AXIS_REF)
        self.switches: NDArray[np.float64] = store.table[Q.HOME_INPUT, :count]
        self.overrides: NDArray[np.float64] = store.table[Q.OVERRIDE, :count]
        self.cycle_time = store.dt
        self._store = store
        raw = self.nc_to_plc.view(np.uint8).reshape(count, NCTOPLC_AXIS_REF.itemsize)
        self._views = raw.view(np.float64), raw.view(np.int32), raw.view(np.uint16)
        self._cycle_ns = round(store.dt * 1e9)
        self._op_mode = np.array(op_mode, dtype=np.int32)
        self._actual = actual
        self._periods = np.array(modulo, dtype=np.float64)
        self.nc_to_plc["AxisId"] = np.arange(1, count + 1)

    def configure(self, index: int, config: AxisConfig) -> None:
        """Show an axis by another configuration."""
        self._periods[index] = config.modulo.period
        self._op_mode[index] = op_mode(config)

    def fill(self, tick: int) -> None:
        """Show what is valid at `tick`."""
        fill(self._store.table, *self._views, self._actual.rows, self._periods, self._op_mode, tick, self._cycle_ns)
