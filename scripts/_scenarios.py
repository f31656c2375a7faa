"""Scenarios of the timing diagrams: per block, what is called when. One table; the pictures are what comes of it."""

from dataclasses import dataclass, field
from typing import Any, Final

from motionlayer import fb
from motionlayer.fb import MC_AxisParameter as P
from motionlayer.nc import BufferMode, Direction, JogMode

LIMITS: Final = {
    "max_velocity": 500.0,
    "max_acceleration": 5000.0,
    "max_jerk": 100_000.0,
    "software_limit_min": -800.0,
    "software_limit_max": 800.0,
}
SERVO: Final = {"drive": {"kind": "servo", "position_gain": 50.0, "ready_delay": 0.008}}
SWITCH: Final = {"home": {"mode": "switch", "switch": -15.0, "velocity": 80.0, "position": 20.0}}
ON: Final = {"Enable": True, "Enable_Positive": True, "Enable_Negative": True}

SLOWLY_OFF: Final = fb.ST_HomingOptions(SyncVelocity=20.0, ReferenceMode=fb.E_EncoderReferenceMode.PLCCAM)

SET_V: Final = ("SetVelo", "velocity")
SET_P: Final = ("SetPos", "position")


@dataclass(frozen=True)
class Scenario:
    """What a diagram shows.

    Attributes:
        text: below the picture.
        blocks: the blocks by name; the first is that of the page.
        steps: (ms, name of the block, inputs that change).
        length: ms.
        lanes: signals shown, as `name.Signal`; all that are TRUE at some time where left out.
        curves: (field of `NcToPlc` or `name.Output`, name with unit).
        axis: more keys of the axis.
        fault: (ms, kind) of what happens to the drive.
        powered: the axis is ready at the beginning.
        persistent: the machine file names a file for persistent parameters.
    """

    text: str
    blocks: dict[str, type[fb.Block]]
    steps: tuple[tuple[int, str, dict[str, Any]], ...]
    length: int
    lanes: tuple[str, ...] = ()
    curves: tuple[tuple[str, str], ...] = (SET_V,)
    axis: dict[str, Any] = field(default_factory=dict)
    fault: tuple[int, str] | None = None
    powered: bool = True
    persistent: bool = False


def go(**inputs: Any) -> dict[str, Any]:  # noqa: ANN401 - inputs of any type
    """Return the inputs that start a block."""
    return {"Execute": True} | inputs


END: Final = {"Execute": False}

SCENARIOS: Final[dict[str, Scenario]] = {
    "MC_Power": Scenario(
        "The drive takes 9 ms until it is ready. At 60 ms `Enable` falls in motion: the axis brakes first.",
        {"power": fb.MC_Power, "move": fb.MC_MoveVelocity},
        ((5, "power", ON), (20, "move", go(Velocity=100.0)), (60, "power", {"Enable": False})),
        200,
        axis=SERVO,
        powered=False,
    ),
    "MC_Reset": Scenario(
        "The drive fails in motion, the axis goes into ErrorStop. When the cause is gone, the reset clears both; "
        "MC_Power, still enabled, switches the drive on again.",
        {"reset": fb.MC_Reset, "move": fb.MC_MoveVelocity, "power": fb.MC_Power},
        ((2, "move", go(Velocity=200.0)), (150, "reset", go()), (200, "move", END), (230, "reset", END)),
        260,
        curves=(("ActVelo", "act. velocity"),),
        axis=SERVO,
        fault=(80, "drive_error"),
    ),
    "MC_SetOverride": Scenario(
        "The override scales the running motion, and holds it at 0.",
        {"override": fb.MC_SetOverride, "move": fb.MC_MoveVelocity},
        (
            (5, "move", go(Velocity=200.0)),
            (5, "override", {"Enable": True}),
            (150, "override", {"VelFactor": 0.5}),
            (250, "override", {"VelFactor": 0.0}),
            (380, "override", {"VelFactor": 1.0}),
        ),
        500,
    ),
    "MC_MoveAbsolute": Scenario(
        "The second block takes over; the first shows `CommandAborted` as long as its `Execute` is TRUE. The third "
        "waits for the second one, `Busy` but not `Active`.",
        {"first": fb.MC_MoveAbsolute, "second": fb.MC_MoveAbsolute, "third": fb.MC_MoveAbsolute},
        (
            (10, "first", go(Position=400.0, Velocity=400.0)),
            (250, "second", go(Position=150.0, Velocity=300.0)),
            (330, "third", go(Position=220.0, Velocity=200.0, BufferMode=BufferMode.BUFFERED)),
            (350, "first", END),
            (800, "second", END),
        ),
        1300,
        curves=(SET_P, SET_V),
    ),
    "MC_MoveRelative": Scenario(
        "`Execute` may fall before the end: then `Done` is TRUE in one call. An edge while it is busy is ignored.",
        {"move": fb.MC_MoveRelative},
        (
            (10, "move", go(Distance=60.0, Velocity=300.0)),
            (60, "move", END),
            (120, "move", go()),
            (160, "move", END),
            (420, "move", go(Distance=-20.0)),
        ),
        700,
        curves=(SET_P, SET_V),
    ),
    "MC_MoveAdditive": Scenario(
        "The first move is on its way to 200 when the second adds 50 to that target.",
        {"additive": fb.MC_MoveAdditive, "first": fb.MC_MoveAbsolute},
        ((10, "first", go(Position=200.0, Velocity=300.0)), (300, "additive", go(Distance=50.0, Velocity=300.0))),
        1100,
        curves=(SET_P, SET_V),
    ),
    "MC_MoveModulo": Scenario(
        "From 90 to 0 in positive direction, then to 450 in negative direction: one whole turn more.",
        {"move": fb.MC_MoveModulo},
        (
            (10, "move", go(Position=0.0, Direction=Direction.POSITIVE, Velocity=500.0)),
            (900, "move", END),
            (1000, "move", go(Position=450.0, Direction=Direction.NEGATIVE)),
        ),
        2600,
        curves=(SET_P, ("ModuloSetPos", "modulo position")),
        axis={"start_position": 90.0, "unit": "°"},
    ),
    "MC_MoveVelocity": Scenario(
        "`InVelocity` follows the velocity, `Busy` stays until MC_Halt takes over.",
        {"move": fb.MC_MoveVelocity, "override": fb.MC_SetOverride, "halt": fb.MC_Halt},
        (
            (10, "move", go(Velocity=200.0)),
            (10, "override", {"Enable": True}),
            (200, "override", {"VelFactor": 0.6}),
            (350, "halt", go()),
            (420, "move", END),
        ),
        500,
    ),
    "MC_MoveContinuousAbsolute": Scenario(
        "Past 100 with 80 u/s, and on with it.",
        {"move": fb.MC_MoveContinuousAbsolute, "halt": fb.MC_Halt},
        ((10, "move", go(Position=100.0, EndVelocity=80.0, Velocity=300.0)), (650, "halt", go()), (720, "move", END)),
        800,
        curves=(SET_P, SET_V),
    ),
    "MC_MoveContinuousRelative": Scenario(
        "At 150 u/s towards a place 60 behind the start, faster in time to pass it at 300 u/s, and on with that.",
        {"move": fb.MC_MoveContinuousRelative, "halt": fb.MC_Halt},
        ((10, "move", go(Distance=-60.0, EndVelocity=300.0, Velocity=150.0)), (600, "halt", go())),
        800,
        curves=(SET_P, SET_V),
    ),
    "MC_Halt": Scenario(
        "A halt may be taken over by another motion at any time; the second one runs to its end.",
        {"halt": fb.MC_Halt, "move": fb.MC_MoveVelocity},
        (
            (10, "move", go(Velocity=400.0)),
            (200, "halt", go(Deceleration=1500.0)),
            (290, "move", END),
            (300, "move", go()),
            (350, "halt", END),
            (450, "halt", go()),
        ),
        750,
    ),
    "MC_Stop": Scenario(
        "The axis stays locked as long as `Execute` is TRUE, also at rest: the move is refused. `Busy` and `Active` "
        "stay TRUE beside `Done`.",
        {"stop": fb.MC_Stop, "move": fb.MC_MoveVelocity, "late": fb.MC_MoveAbsolute},
        (
            (10, "move", go(Velocity=300.0)),
            (180, "stop", go()),
            (300, "late", go(Position=0.0, Velocity=100.0)),
            (350, "stop", END),
            (380, "late", END),
            (400, "late", go()),
        ),
        500,
    ),
    "MC_Jog": Scenario(
        "The axis moves while a key is held. The other key counts only when it rests again.",
        {"jog": fb.MC_Jog},
        (
            (10, "jog", {"JogForward": True, "Mode": JogMode.STANDARD_FAST}),
            (150, "jog", {"JogBackwards": True}),
            (250, "jog", {"JogForward": False, "JogBackwards": False}),
            (380, "jog", {"JogBackwards": True}),
            (520, "jog", {"JogBackwards": False}),
        ),
        650,
        curves=(SET_P, SET_V),
    ),
    "MC_Home": Scenario(
        "To the cam at -15, to rest on it, and slowly off it again: its falling edge is the reference, from which the "
        "position behind it is counted.",
        {"home": fb.MC_Home},
        ((10, "home", go(Options=SLOWLY_OFF)), (560, "home", END)),
        600,
        curves=(SET_V, ("HomingState", "HomingState"), SET_P),
        axis=SWITCH,
    ),
    "MC_SetPosition": Scenario(
        "The coordinate changes, the axis does not move.",
        {"set": fb.MC_SetPosition, "move": fb.MC_MoveAbsolute},
        (
            (10, "set", go(Position=100.0)),
            (30, "set", END),
            (50, "move", go(Position=130.0, Velocity=300.0)),
            (320, "set", go(Position=-80.0, Mode=True)),
        ),
        400,
        curves=(SET_P, SET_V),
    ),
    "MC_ReadStatus": Scenario(
        "Exactly one state is TRUE.",
        {"read": fb.MC_ReadStatus, "move": fb.MC_MoveAbsolute},
        ((20, "read", {"Enable": True}), (60, "move", go(Position=40.0, Velocity=250.0))),
        450,
        lanes=(
            "move.Execute",
            "read.Enable",
            "read.Valid",
            "read.StandStill",
            "read.DiscreteMotion",
            "read.Accelerating",
            "read.ConstantVelocity",
            "read.Decelerating",
        ),
    ),
    "MC_ReadAxisError": Scenario(
        "The drive fails: the number of the error shows until the reset.",
        {"read": fb.MC_ReadAxisError, "move": fb.MC_MoveVelocity, "reset": fb.MC_Reset},
        ((0, "read", {"Enable": True}), (5, "move", go(Velocity=100.0)), (160, "reset", go())),
        200,
        curves=(("read.AxisErrorID", "AxisErrorID"),),
        axis=SERVO,
        fault=(80, "drive_error"),
    ),
    "MC_ReadActualPosition": Scenario(
        "`Position` is valid as long as `Enable` is TRUE.",
        {"read": fb.MC_ReadActualPosition, "move": fb.MC_MoveAbsolute},
        (
            (10, "move", go(Position=60.0, Velocity=300.0)),
            (60, "read", {"Enable": True}),
            (350, "read", {"Enable": False}),
        ),
        450,
        curves=(SET_P, ("read.Position", "read.Position")),
    ),
    "MC_ReadActualVelocity": Scenario(
        "The actual velocity of a servo drive, which lags behind the set velocity.",
        {"read": fb.MC_ReadActualVelocity, "move": fb.MC_MoveAbsolute},
        ((0, "read", {"Enable": True}), (10, "move", go(Position=60.0, Velocity=300.0))),
        450,
        curves=(SET_V, ("read.ActualVelocity", "ActualVelocity")),
        axis=SERVO,
    ),
    "MC_ReadParameter": Scenario(
        "Once per edge of `Enable` unless `ReadMode` is READMODE_CYCLIC.",
        {"once": fb.MC_ReadParameter, "cyclic": fb.MC_ReadParameter, "move": fb.MC_MoveAbsolute},
        (
            (10, "move", go(Position=60.0, Velocity=300.0)),
            (100, "once", {"Enable": True, "ParameterNumber": P.CommandedPosition}),
            (100, "cyclic", {"Enable": True, "ParameterNumber": P.CommandedPosition, "ReadMode": 2}),
        ),
        450,
        curves=(("once.Value", "once.Value"), ("cyclic.Value", "cyclic.Value")),
    ),
    "MC_ReadBoolParameter": Scenario(
        "A bool parameter; asking for a number with this block is error 0x4B05.",
        {"read": fb.MC_ReadBoolParameter},
        (
            (5, "read", {"Enable": True, "ParameterNumber": P.EnableLimitPos}),
            (25, "read", {"Enable": False}),
            (35, "read", {"Enable": True, "ParameterNumber": P.SWLimitPos}),
        ),
        50,
        curves=(),
    ),
    "MC_WriteParameter": Scenario(
        "The velocity is lowered; the move that is given afterwards keeps to it, another one above it is refused.",
        {"write": fb.MC_WriteParameter, "move": fb.MC_MoveAbsolute},
        (
            (5, "write", go(ParameterNumber=P.AxisMaxVelocity, Value=200.0)),
            (20, "write", END),
            (30, "move", go(Position=40.0, Velocity=300.0)),
            (60, "move", END),
            (80, "move", go(Velocity=200.0)),
        ),
        400,
    ),
    "MC_WriteBoolParameter": Scenario(
        "Switching off a software limit that the machine description has is refused.",
        {"write": fb.MC_WriteBoolParameter},
        (
            (5, "write", go(ParameterNumber=P.EnableLimitPos, Value=True)),
            (15, "write", END),
            (25, "write", go(Value=False)),
            (35, "write", END),
        ),
        50,
        curves=(),
    ),
    "MC_WriteParameterPersistent": Scenario(
        "`Done` with the next call: the value holds, and is in the file. The second one, beyond the maximum of the "
        "machine file, is refused, and the file stays as it is.",
        {"write": fb.MC_WriteParameterPersistent},
        (
            (5, "write", go(ParameterNumber=P.AxisMaxVelocity, Value=200.0)),
            (15, "write", END),
            (25, "write", go(Value=600.0)),
            (35, "write", END),
        ),
        50,
        curves=(),
        persistent=True,
    ),
    "MC_WriteBoolParameterPersistent": Scenario(
        "The position lag stays watched, and the file says so from now on. A parameter of the other kind is refused.",
        {"write": fb.MC_WriteBoolParameterPersistent},
        (
            (5, "write", go(ParameterNumber=P.EnablePosLagMonitoring, Value=True)),
            (15, "write", END),
            (25, "write", go(ParameterNumber=P.MaxPositionLag)),
            (35, "write", END),
        ),
        50,
        curves=(),
        axis={"monitor": {"lag": 5.0}},
        persistent=True,
    ),
    "MC_OverrideFilter": Scenario(
        "A knob is turned: the filtered value follows in steps, 100 % passes at once.",
        {"knob": fb.MC_OverrideFilter},
        tuple((10 * k, "knob", {"OverrideValueRaw": 900 * k, "OverrideSteps": 20}) for k in range(40)),
        420,
        curves=(("knob.OverridePercentFiltered", "filtered, %"),),
    ),
}
"""Per block. A block that computes from its inputs alone has none."""
