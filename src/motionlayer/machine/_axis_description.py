"""Tables of an axis beside its limits: modulo view and manual motion."""

from pydantic import Field

from motionlayer.machine._fields import Table, Velocity, Width, Window


class ModuloDescription(Table):
    """The modulo view of the position: `[axis.X.modulo]`. Linear axes may be seen so too."""

    period: Window = Field(default=360.0, description="Modulo period (u), > 0.")
    tolerance: Width = Field(
        default=0.0,
        description="Half width of the window around the target (u) in which move_modulo() from rest takes the nearest "
        "way, also against the direction.",
    )


class ManualDescription(Table):
    """Manual motion: `[axis.X.manual]`."""

    slow: Velocity | None = Field(
        default=None,
        description="Slow manual velocity (u/s), > 0 and at most max_velocity; default: a twentieth of max_velocity.",
    )
    fast: Velocity | None = Field(
        default=None,
        description="Fast manual velocity (u/s), > 0 and at most max_velocity; default: 0.3 of max_velocity.",
    )
    forward: Window = Field(default=1.0, description="Step of inching in positive direction (u), > 0.")
    backward: Window = Field(default=1.0, description="Step of inching in negative direction (u), > 0.")
