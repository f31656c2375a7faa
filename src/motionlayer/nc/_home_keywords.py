"""What a homing may ask for that is not as the machine description says (function-blocks 2.10, ST_HomingOptions)."""

from collections.abc import Mapping
from typing import Any, Final, TypedDict

from motionlayer.command import ErrorId, only_known
from motionlayer.nc._arguments import bad_speed, member, number
from motionlayer.nc._config import AxisConfig, Direction, HomeConfig, HomingMode
from motionlayer.nc._homing import LATCHES
from motionlayer.nc._limits import bad_place
from motionlayer.nc._motion import Refusal

SIGNS: Final = {Direction.POSITIVE: 1.0, Direction.NEGATIVE: -1.0}
DIRECTIONS: Final = {sign: direction.name for direction, sign in SIGNS.items()}
NEEDED: Final = {HomingMode.INDEX: "pulse_period", HomingMode.SOFTWARE_SYNC: "turn"}
"""Key of the machine description that gives a drive what it latches; `latch` for the other modes that do."""


class HomeKeywords(TypedDict, total=False):
    """How to find the reference; what is left out is as the machine description says.

    Attributes:
        method: in which way, see `HomingMode`; one for which the drive has nothing to latch is refused.
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
        _bad_method(mode, home),
        _bad_direction("search_direction", search),
        _bad_direction("sync_direction", sync),
        bad_speed("search_velocity", fast, config.maximum.velocity, config.unit),
        bad_speed("sync_velocity", slow, config.maximum.velocity, config.unit),
    )
    refusal = next((one for one in checks if one is not None), None)
    if refusal is not None:
        return refusal
    turned = _turned(home, SIGNS.get(search, home.direction))
    return turned._replace(
        mode=mode,
        position=place,
        velocity=home.velocity if fast is None else fast,
        sync_velocity=home.sync_velocity if slow is None else slow,
        sync_direction=SIGNS.get(sync, turned.sync_direction),
    )


def _turned(home: HomeConfig, direction: float) -> HomeConfig:
    """Return a homing that searches in a direction; the direction off the cam turns with it."""
    return home._replace(direction=direction, sync_direction=home.sync_direction * home.direction * direction)


def told(home: HomeConfig, usual: HomeConfig) -> str:
    """Return the text of a message: the reference position, and all that is not as the description says.

    The direction off the cam is told where it is not the one that comes with the direction of the search.
    """
    plain = _turned(usual, home.direction)._replace(direction=usual.direction)
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
        if getattr(home, field) != getattr(plain, field)
    ]
    return f"home({', '.join([f'position={home.position}', *unusual])})"


def _bad_method(mode: HomingMode, home: HomeConfig) -> Refusal | None:
    if mode not in LATCHES or mode in home.latches:
        return None
    allowed = [one.name for one in HomingMode if one not in LATCHES or one in home.latches]
    key = NEEDED.get(mode, "latch")
    detail = f"method = {mode.name}, allowed: {', '.join(allowed)}; the drive has no signal for it: no home.{key}"
    return Refusal(ErrorId.REFERENCE_MODE, detail)


def _bad_direction(name: str, direction: Direction) -> Refusal | None:
    if direction in SIGNS or direction is Direction.UNDEFINED:
        return None
    return Refusal(ErrorId.MODE_INVALID, f"{name} = {direction.name}, allowed: POSITIVE, NEGATIVE, UNDEFINED")
