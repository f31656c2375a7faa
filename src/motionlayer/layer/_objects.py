"""What a control program sees: the objects of a namespace, by index and by name."""

import difflib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Final, Generic, TypeVar

from motionlayer.iec import OutputArray
from motionlayer.layer._answer import ObjectState, Waits
from motionlayer.layer._globals import AxisGlobals
from motionlayer.layer.types import (
    AxisCommand,
    AxisCtrl,
    AxisInfo,
    AxisState,
    GearIn,
    Homing,
    LimitSwitches,
    MotionOptions,
    MoveData,
    NcParameter,
)

if TYPE_CHECKING:
    from motionlayer.iec import Struct

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class AxisObject:
    """One axis of `GVL_AXIS`; the same on the motion side and on a control side.

    Attributes:
        index: from 1.
        name: of the axis.
        ctrl: command; drop it into `ctrl.cmd`.
        state: what has become of it.
        info: what the axis does.
        data: positions, velocities, dynamics, override.
        options: buffer mode, distance.
        home: homing.
        gear: coupling.
        nc_parameter_in: parameter to be read or written.
        nc_parameter_out: parameter read or written.
        limit_switches: switches of the machine.
    """

    index: int
    name: str
    ctrl: AxisCtrl
    state: ObjectState
    info: AxisInfo
    data: MoveData
    options: MotionOptions
    home: Homing
    gear: GearIn
    nc_parameter_in: NcParameter
    nc_parameter_out: NcParameter
    limit_switches: LimitSwitches

    async def do(self, command: int) -> int:
        """Give a command and wait until it is done; one that the command field holds already is given anew, after NULL.

        Args:
            command: number of the command. What it is to be done with is written before.

        Returns:
            The state.

        Raises:
            LayerError: it fails, does not exist, or is replaced.
            ValueError: no state has room for the number of the command.
        """
        if self.ctrl.cmd == command:
            self.ctrl.cmd = AxisCommand.NULL
            await self.state.done(AxisCommand.NULL).settled()
        self.ctrl.cmd = command
        return await self.state.done(command)


KINDS: Final[dict[str, Any]] = {
    one.name: AxisState if one.name == "state" else one.type
    for one in fields(AxisObject)
    if one.name not in ("index", "name")
}
"""Structures of an axis by attribute."""


def axis_object(index: int, name: str, parts: "Mapping[str, Struct]", waits: Waits) -> AxisObject:
    """Return an axis of which some parts lie somewhere, and the others belong to it alone.

    Args:
        index: from 1.
        name: of the axis.
        parts: structures by attribute; `state` is the `AxisState`.
        waits: of the layer.
    """
    every: dict[str, Any] = {key: parts[key] if key in parts else kind() for key, kind in KINDS.items()}
    ctrl, info = every["ctrl"], every["info"]
    state = ObjectState(name, AxisCommand, lambda: int(ctrl.cmd), every["state"], lambda: int(info.error_id), waits)
    return AxisObject(index, name, **(every | {"state": state}))


class Objects(Generic[T]):
    """Objects by index, from 1, and by name.

    Args:
        what: they are, for messages: `axis`.
        found: the objects by name, in the order of their indices.
    """

    def __init__(self, what: str, found: Mapping[str, T]) -> None:
        self._what = what
        self._names = dict(found)
        self._all = tuple(found.values())

    def __getitem__(self, key: int | str) -> T:
        if isinstance(key, str):
            return self._by_name(key)
        if type(key) is int and 1 <= key <= len(self._all):
            return self._all[key - 1]
        raise IndexError(f"{self._what}[{key!r}]: indices go from 1 to {len(self._all)}")

    def _by_name(self, name: str) -> T:
        found = self._names.get(name)
        if found is None:
            near = {one.lower(): one for one in self._names}
            best = difflib.get_close_matches(name.lower(), near, n=1)
            hint = f"did you mean {near[best[0]]!r}?" if best else f"there are {', '.join(self._names)}"
            raise KeyError(f"no {self._what} {name!r}; {hint}")
        return found

    def __iter__(self) -> Iterator[T]:
        return iter(self._all)

    def __len__(self) -> int:
        return len(self._all)


PARTS: Final = {
    "ctrl": "ctrl",
    "state": "state",
    "info": "info",
    "data": "data",
    "options": "options",
    "home": "homing",
    "gear": "gear",
    "nc_parameter_in": "parameter_in",
    "nc_parameter_out": "parameter_out",
    "limit_switches": "switches",
}
"""What an `AxisObject` has, and the variable of `GVL_AXIS` it is an element of."""


def axis_objects(
    names: Sequence[str], variables: AxisGlobals, waits: Waits, *, by_layer: bool = False
) -> Objects[AxisObject]:
    """Return the axes as control programs use them, on either side.

    Args:
        names: of the axes, in the order of their indices.
        variables: `GVL_AXIS`.
        waits: of the layer.
        by_layer: they are for the layer itself, which writes what programs can only read: states and Info.
    """

    def part(of: str, index: int) -> Any:  # noqa: ANN401 - the structures of `AxisObject`
        array = getattr(variables, of)
        return array.shown(index) if isinstance(array, OutputArray) and not by_layer else array[index]

    return Objects(
        "axis",
        {
            name: axis_object(index, name, {key: part(of, index) for key, of in PARTS.items()}, waits)
            for index, name in enumerate(names, 1)
        },
    )
