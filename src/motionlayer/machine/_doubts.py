"""What a machine file may say, and what can hardly be meant: told by `motionlayer check`, refused by nobody."""

import re
from collections.abc import Iterator
from typing import Final

from motionlayer.machine._axis_description import AxisDescription
from motionlayer.machine._description import Description
from motionlayer.machine._problem import KeyPath, Problem, value_text

_HERE: Final = re.compile(r"localhost|[\d.]+|.*:.*")
"""An address, or the name that every computer has for itself."""


def doubts(description: Description) -> Iterator[Problem]:
    """Yield what can hardly be meant, axis by axis, then of the machine."""
    for name, axis in description.axis.items():
        path = ("axis", name)
        yield from _weak_drive(path, axis)
        yield from _start_outside(path, axis)
        yield from _switch_out_of_reach(path, axis)
    if description.ads is not None:
        yield from _other_host(description.ads.host)


def _weak_drive(path: KeyPath, axis: AxisDescription) -> Iterator[Problem]:
    torque, asked = axis.weak_torque, max(axis.max_acceleration, axis.max_deceleration)
    if torque is not None:
        yield Problem(
            (*path, "drive", "max_acceleration"),
            value_text(torque),
            problem=f"less than the {value_text(asked)} that the axis may ask for (u/s²)",
            hint="the torque does not allow it, and the drive lags: lower max_acceleration and max_deceleration",
        )


def _start_outside(path: KeyPath, axis: AxisDescription) -> Iterator[Problem]:
    if axis.home.mode != "direct":
        return  # homing defines the positions of the axis anew
    low, high, start = axis.software_limit_min, axis.software_limit_max, axis.start_position
    if (low is not None and start < low) or (high is not None and start > high):
        yield Problem((*path, "start_position"), value_text(start), problem="outside of the software limits")


def _switch_out_of_reach(path: KeyPath, axis: AxisDescription) -> Iterator[Problem]:
    switch, travel = axis.home.switch, axis.longest_search
    if axis.home.mode == "direct" or switch is None:
        return
    way = abs(switch - axis.start_position)
    if way > travel:
        yield Problem(
            (*path, "home", "switch"),
            value_text(switch),
            problem=f"{way:.9g} from start_position, and a search goes {travel:.9g} (u)",
            hint="homing ends with 0x429C there: give home.travel, or another start_position",
        )


def _other_host(host: str) -> Iterator[Problem]:
    if not _HERE.fullmatch(host):
        yield Problem(
            ("ads", "host"),
            value_text(host),
            problem="a name, where the server needs an address of this computer",
            hint="0.0.0.0 takes all of them; which clients may connect is said by ads.hosts",
        )
