"""What a homing may ask for that is not as the machine description says (function-blocks 2.10, ST_HomingOptions)."""

from collections.abc import Mapping
from typing import Any, Final, TypedDict

from motionlayer.command import ErrorId
from motionlayer.nc._config import AxisConfig, Direction, HomeConfig, HomingMode
from motionlayer.nc._keywords import only_known
from motionlayer.nc._limits import bad_place
from motionlayer.nc._motion import Refusal, bad_speed, member, number

SIGNS: Final = {Direction.POSITIVE: 1.0, Direction.NEGATIVE: -1.0}
DIRECTIONS: Final = {sign: direction.name for direction, sign in SIGNS.items()}


class HomeKeywords(TypedDict, total=False):
    """How to find the reference; what is left out is as the machine description says.

    Attributes:
        method: in which way, see `HomingMode`.
        search_direction: POSITIVE or NEGATIVE; UNDEFINED is that of the description. The direction off the cam turns
            with it, unless it is given too.
        search_velocity: towards the switch or the cam, u/s.
        sync_direction: off the cam, in the same way.
        sync_velocity: off the cam, u/s.
        cam: the signal of a cam that the program reads, at the beginning; `HomeCommand.cam()` tells its changes.
        clear_lag: with `Calibration.DIRECT` the actual position becomes the set position too.
    """

    method: HomingMode | None
    search_direction: Direction
    search_velocity: float | None
    sync_direction: Direction
    sync_velocity: float | None
    cam: bool
    clear_lag: bool


def asked_home(config: AxisConfig, position: float | None, keywords: Mapping[str, Any]) -> HomeConfig | Refusal:
    """Return how to home, or why not so.

    Args:
        config: of the axis.
        position: of the reference, u; None for that of the description.
        keywords: see `HomeKeywords`.

    Raises:
        TypeError: a keyword is unknown, or has a value of another type.
    """
    only_known("home", HomeKeywords, keywords)
    home, method = config.home, keywords.get("method")
    mode = home.mode if method is None else member("method", method, HomingMode)
    place = home.position if position is None else position
    fast, slow = (number(name, keywords.get(name)) for name in ("search_velocity", "sync_velocity"))
    search, sync = (
        member(name, keywords.get(name, Direction.UNDEFINED), Direction)
        for name in ("search_direction", "sync_direction")
    )
    checks = (
        bad_place("position", place, config.unit),
        _bad_direction("search_direction", search),
        _bad_direction("sync_direction", sync),
        bad_speed("search_velocity", fast, config.maximum.velocity, config.unit),
        bad_speed("sync_velocity", slow, config.maximum.velocity, config.unit),
    )
    refusal = next((one for one in checks if one is not None), None)
    if refusal is not None:
        return refusal
    direction = SIGNS.get(search, home.direction)
    return home._replace(
        mode=mode,
        position=place,
        velocity=home.velocity if fast is None else fast,
        direction=direction,
        sync_velocity=home.sync_velocity if slow is None else slow,
        sync_direction=SIGNS.get(sync, home.sync_direction * home.direction * direction),
    )


def told(home: HomeConfig, usual: HomeConfig) -> str:
    """Return the text of a message: the reference position, and all that is not as the description says."""
    values = {
        "method": home.mode.name,
        "search_direction": DIRECTIONS[home.direction],
        "search_velocity": str(home.velocity),
        "sync_direction": DIRECTIONS[home.sync_direction],
        "sync_velocity": str(home.sync_velocity),
    }
    default = ("mode", "direction", "velocity", "sync_direction", "sync_velocity")
    unusual = [
        f"{name}={text}"
        for (name, text), field in zip(values.items(), default, strict=True)
        if getattr(home, field) != getattr(usual, field)
    ]
    return f"home({', '.join([f'position={home.position}', *unusual])})"


def _bad_direction(name: str, direction: Direction) -> Refusal | None:
    if direction in SIGNS or direction is Direction.UNDEFINED:
        return None
    return Refusal(ErrorId.MODE_INVALID, f"{name} = {direction.name}, allowed: POSITIVE, NEGATIVE, UNDEFINED")
