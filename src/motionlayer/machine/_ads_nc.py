"""What the NC ports of an ADS server show of the axes: rows in the published image, and the table that leads there.

Each axis has a row: its two cyclic images, then what the machine file says of it, then what is derived. The tables of
offsets (ads 8.1, 8.2, 8.4) name members of the row. What is not simulated is missing: reading it is answered with
0x703. In the structures its bytes are 0.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from motionlayer.connect.ads import (
    CYCLIC,
    FUNCTIONS,
    MOST_AXES,
    PARAMETERS,
    STATE,
    Area,
    Code,
    Item,
    NcContents,
    with_parts,
)
from motionlayer.fb import MC_AxisParameter as P
from motionlayer.iec import LREAL, STRING, UDINT, UINT, Field, OutputArray, Struct
from motionlayer.layer.types import AxisEncoderType, NcToPlc, PlcToNc
from motionlayer.nc import ControlDWord

if TYPE_CHECKING:
    from motionlayer.fb import AXIS_REF
    from motionlayer.nc import AxisConfig, AxisRefs

NAME: Final = "NC.Axis"
SERVO: Final = 1
FULL_OVERRIDE: Final = 1_000_000
ONLINE: Final = 256
"""Bytes of the online structure."""

ALL_PARAMETERS: Final = 1024
"""Bytes of the structure of all parameters, of which the beginning is known."""


class NcRow(Struct, iec="ST_NC_AXIS", pack=8):
    """What the NC ports know of an axis. u is its unit."""

    nc_to_plc = Field("NcToPlc", NcToPlc)
    plc_to_nc = Field("PlcToNc", PlcToNc)
    axis_id = Field("AxisId", UDINT)
    name = Field("Name", STRING(30))
    axis_type = Field("AxisType", UDINT, "1: continuous", default=SERVO)
    cycle_time = Field("CycleTime", UDINT, "µs")
    unit = Field("Unit", STRING(10))
    home_velocity = Field("HomeVelocity", LREAL, "towards the cam (u/s)")
    home_sync_velocity = Field("HomeSyncVelocity", LREAL, "off the cam (u/s)")
    manual_slow = Field("ManualSlow", LREAL, "u/s")
    manual_fast = Field("ManualFast", LREAL, "u/s")
    range_on = Field("RangeOn", UINT)
    range_window = Field("RangeWindow", LREAL, "u")
    max_velocity = Field("MaxVelocity", LREAL, "u/s")
    max_acceleration = Field("MaxAcceleration", LREAL, "u/s²")
    max_deceleration = Field("MaxDeceleration", LREAL, "u/s²")
    max_jerk = Field("MaxJerk", LREAL, "u/s³")
    limit_min_on = Field("LimitMinOn", UINT)
    limit_max_on = Field("LimitMaxOn", UINT)
    limit_min = Field("LimitMin", LREAL, "u")
    limit_max = Field("LimitMax", LREAL, "u")
    lag_on = Field("LagOn", UINT)
    lag = Field("Lag", LREAL, "u")
    cycles = Field("Cycles", UDINT, "counter of cycles")
    direction = Field("Direction", LREAL, "of the set velocity: -1, 0, 1")
    override = Field("Override", UDINT, "1000000 is 100 %")
    enable = Field("Enable", UINT, "bit of the control word, as the next three")
    feed_plus = Field("FeedPlus", UINT)
    feed_minus = Field("FeedMinus", UINT)
    homing_cam = Field("HomingCam", UINT)
    encoder_type = Field("EncoderType", UDINT, "see AxisEncoderType")
    nothing = Field("Nothing", UDINT, "always 0: no error of the encoder")


WRITABLE: Final[Mapping[int, P]] = {
    0x06: P.AxisCalibrationVelocityForward,
    0x07: P.AxisCalibrationVelocityBackward,
    0x08: P.AxisVeloManSlow,
    0x09: P.AxisVeloManFast,
    0x0F: P.AxisEnPositionRangeMonitoring,
    0x10: P.AxisPositionRangeWindow,
    0x27: P.AxisVeloMax,
    0x101: P.AxisMaximumAcceleration,
    0x102: P.AxisMaximumDeceleration,
    0x103: P.MaxJerk,
    0x1000B: P.AxisEnMinSoftPosLimit,
    0x1000C: P.AxisEnMaxSoftPosLimit,
    0x1000D: P.AxisMinSoftPosLimit,
    0x1000E: P.AxisMaxSoftPosLimit,
    0x20010: P.AxisEnPositionLagMonitoring,
    0x20012: P.AxisMaxPosLagValue,
}
"""Parameters that can be written, by offset."""

_PARAMETERS: Final = {
    0x01: "AxisId", 0x02: "Name", 0x03: "AxisType", 0x04: "CycleTime", 0x05: "Unit", 0x06: "HomeVelocity",
    0x07: "HomeSyncVelocity", 0x08: "ManualSlow", 0x09: "ManualFast", 0x0A: "MaxVelocity", 0x0F: "RangeOn",
    0x10: "RangeWindow", 0x27: "MaxVelocity", 0x101: "MaxAcceleration", 0x102: "MaxDeceleration", 0x103: "MaxJerk",
    0x10003: "EncoderType", 0x1000B: "LimitMinOn", 0x1000C: "LimitMaxOn", 0x1000D: "LimitMin", 0x1000E: "LimitMax",
    0x20010: "LagOn", 0x20012: "Lag",
}  # fmt: skip
_STATE: Final = {
    0x01: "NcToPlc.ErrorCode", 0x09: "Cycles", 0x0A: "NcToPlc.SetPos", 0x0B: "NcToPlc.ModuloSetPos",
    0x0C: "NcToPlc.ModuloSetTurns", 0x0D: "Direction", 0x0E: "NcToPlc.SetVelo", 0x0F: "NcToPlc.SetAcc",
    0x10: "NcToPlc.SetJerk", 0x10001: "Nothing", 0x10002: "NcToPlc.ActPos", 0x10003: "NcToPlc.ModuloActPos",
    0x10005: "NcToPlc.ActVelo", 0x10006: "NcToPlc.ActAcc", 0x2000F: "NcToPlc.PosDiff",
}  # fmt: skip
_ONLINE: Final = {
    0: "NcToPlc.ErrorCode", 8: "NcToPlc.ActPos", 16: "NcToPlc.ModuloActPos", 24: "NcToPlc.SetPos",
    32: "NcToPlc.ModuloSetPos", 40: "NcToPlc.ActVelo", 48: "NcToPlc.SetVelo", 56: "Override", 64: "NcToPlc.PosDiff",
    104: "NcToPlc.StateDWord", 108: "PlcToNc.ControlDWord", 112: "NcToPlc.CoupleState",
    116: "NcToPlc.ControlLoopIndex", 120: "NcToPlc.ActAcc", 128: "NcToPlc.SetAcc", 136: "NcToPlc.SetJerk",
    144: "NcToPlc.SetTorque", 152: "NcToPlc.ActTorque", 160: "NcToPlc.SetTorqueDerivative",
    168: "NcToPlc.TorqueOffset",
}  # fmt: skip
_CYCLIC: Final = {
    0x00: "PlcToNc", 0x01: "PlcToNc.ControlDWord", 0x02: "Enable", 0x03: "FeedPlus", 0x04: "FeedMinus",
    0x07: "HomingCam", 0x21: "Override", 0x80: "NcToPlc", 0x81: "NcToPlc.StateDWord",
}  # fmt: skip
_BITS: Final = {
    "Enable": int(ControlDWord.Enable),
    "FeedPlus": int(ControlDWord.FeedEnablePlus),
    "FeedMinus": int(ControlDWord.FeedEnableMinus),
    "HomingCam": int(ControlDWord.HomingSensor),
}
"""Members of the row that are bits of the control word; NumPy takes far longer for members of an enumeration."""

_BEGINNING: Final = {0: "AxisId", 4: "Name", 36: "AxisType"}
FUNCTION_SIZES: Final = {0x01: 0, 0x02: 0, 0x03: 0, 0x04: 16, 0x05: 16, 0x09: 24, 0x10: 0, 0x11: 16}
CYCLIC_SIZES: Final = {0x01: 4, 0x02: 2, 0x03: 2, 0x04: 2, 0x07: 2, 0x21: 4}
"""Bytes of what the functions take, and of what can be written of the cyclic data."""


def _place(path: str) -> tuple[int, int]:
    """Return first byte and length of a member of the row."""
    kind, at = NcRow.type, 0
    for name in path.split("."):
        member: Any = kind.field(name)
        kind, at = member.type, at + member.offset
    return at, kind.size


def _items(members: Mapping[int, str]) -> dict[int, Item]:
    """Return items that are one member each."""
    places = {offset: _place(path) for offset, path in members.items()}
    return {offset: Item(size, ((0, at, size),)) for offset, (at, size) in places.items()}


def _structure(size: int, members: Mapping[int, str]) -> Item:
    """Return an item that is put together from members, by their places in it."""
    return Item(size, tuple((at, *_place(path)) for at, path in members.items()))


def areas() -> dict[int, Area]:
    """Return what can be read and written, by base."""
    parameters = _items(_PARAMETERS)
    sizes = {offset: parameters[offset].size for offset in WRITABLE}
    return with_parts(
        {
            PARAMETERS: Area({0: _structure(ALL_PARAMETERS, _BEGINNING), **parameters}, sizes),
            STATE: Area({0: _structure(ONLINE, _ONLINE), **_items(_STATE)}, {}),
            FUNCTIONS: Area({}, FUNCTION_SIZES, Code.SERVICE_NOT_SUPPORTED),
            CYCLIC: Area(_items(_CYCLIC), CYCLIC_SIZES),
        }
    )


class NcRows(OutputArray[NcRow]):
    """The rows of all axes that have groups.

    Args:
        refs: all axes.
        images: their cyclic interface.
        tick: returns the present tick.
    """

    def __init__(self, refs: "Sequence[AXIS_REF]", images: "AxisRefs", tick: Callable[[], int]) -> None:
        axes = [ref.axis for ref in refs[:MOST_AXES]]
        super().__init__(NcRow, 1, len(axes), NAME)
        self._axes, self._images, self._tick = axes, images, tick
        self._configs: list[AxisConfig] = []
        rows = np.frombuffer(self.memory, np.uint8).reshape(len(axes), -1)
        (first, size), (second, other) = _place("NcToPlc"), _place("PlcToNc")
        self._nc_to_plc, self._plc_to_nc = rows[:, first : first + size], rows[:, second : second + other]
        self.array["AxisId"] = np.arange(1, len(axes) + 1)
        self.array["CycleTime"] = round(images.cycle_time * 1e6)
        count = len(axes)
        # Tables never move, so that views on them can be kept: making them takes longer than what is done with them.
        self._shown = images.nc_to_plc[:count].view(np.uint8).reshape(count, -1)
        self._asked = images.plc_to_nc[:count].view(np.uint8).reshape(count, -1)
        self._velocity, self._overrides = images.nc_to_plc["SetVelo"][:count], images.overrides[:count]
        self._cycles, self._direction = self.array["Cycles"], self.array["Direction"]
        self._known = b""
        self.publish()

    def contents(self, start: int) -> NcContents:
        """Return what a server is told, with the place of the rows in its image."""
        return NcContents(start, NcRow.type.size, self.count, areas())

    def publish(self) -> None:
        """Bring the rows up to date."""
        self._nc_to_plc[:] = self._shown
        self._cycles[:] = self._tick() & 0xFFFF_FFFF
        np.sign(self._velocity, out=self._direction, casting="unsafe")
        asked = self._asked.tobytes() + self._overrides.tobytes()
        if asked != self._known:
            self._known = asked
            self._show_asked()
        configs = [axis.config for axis in self._axes]
        if configs != self._configs:
            self._configs = configs
            for index, config in enumerate(configs, 1):
                _describe(self[index], config)

    def _show_asked(self) -> None:
        """Show what axes were asked for."""
        self._plc_to_nc[:] = self._asked
        words = self._images.plc_to_nc["ControlDWord"][: self.count]
        for name, bit in _BITS.items():
            self.array[name] = words & bit != 0
        self.array["Override"] = np.rint(self._overrides * FULL_OVERRIDE)


def _describe(row: NcRow, config: "AxisConfig") -> None:
    """Write what the configuration of an axis says; a monitor that is off has the value 0."""
    monitor, limits = config.monitor, (config.limit_min, config.limit_max)
    row.name, row.unit = _fitting(config.name, 30), _fitting(config.unit, 10)
    row.home_velocity, row.home_sync_velocity = config.home.velocity, config.home.sync_velocity
    row.manual_slow, row.manual_fast = config.manual.slow, config.manual.fast
    row.range_on, row.range_window = int(monitor.range_window is not None), monitor.range_window or 0.0
    row.max_velocity, row.max_acceleration = config.maximum.velocity, config.maximum.acceleration
    row.max_deceleration, row.max_jerk = config.maximum.deceleration, config.maximum.jerk
    row.limit_min_on, row.limit_max_on = (int(np.isfinite(one)) for one in limits)
    row.limit_min, row.limit_max = (one if np.isfinite(one) else 0.0 for one in limits)
    row.lag_on, row.lag = int(monitor.lag is not None), monitor.lag or 0.0
    encoder = AxisEncoderType.Simulation_Encoder if config.simulated else AxisEncoderType.TCom_Encoder_SoftDrive
    row.encoder_type = int(encoder)


def _fitting(text: str, room: int) -> str:
    return text.encode("cp1252", errors="replace")[:room].decode("cp1252")
