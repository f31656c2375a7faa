"""How namespaces reach each other: small protocols, and objects that answer NOT_EXIST where nothing is built in.

The names of the protocols are those of the interface (motion-layer 1.3). Every method of a job takes Execute and
returns its progress: FALSE prepares the job, TRUE takes it on. Whoever needs an axis asks the layer for an interface,
and gets a memory of its own with it (D15).
"""

from typing import TYPE_CHECKING, Final, Protocol

from motionlayer.layer.types._progress import Progress

if TYPE_CHECKING:
    from motionlayer.fb import AXIS_REF

NOT_EXIST: Final = Progress.NOT_EXIST


class I_McAxis(Protocol):  # noqa: N801 - here and below, the name of the interface
    """An axis, for other namespaces."""

    @property
    def axis_ref(self) -> "AXIS_REF":
        """The axis with its parameters."""

    @property
    def position(self) -> float:
        """Actual position, u."""

    @property
    def read_parameter_value(self) -> float:
        """What `read_parameter` has read last."""

    def disable(self, *, execute: bool) -> Progress:
        """Switch the drive off."""

    def enable(self, *, execute: bool) -> Progress:
        """Switch the drive on."""

    def reset(self, *, execute: bool) -> Progress:
        """Clear the errors of axis and drive."""

    def halt(self, deceleration: float = 0.0, jerk: float = 0.0, *, execute: bool) -> Progress:
        """Brake; 0 asks for the dynamics of the machine file."""

    def stop(self, deceleration: float = 0.0, jerk: float = 0.0, *, execute: bool) -> Progress:
        """Brake; the axis takes no other motion until it rests."""

    def read_parameter(self, number: int, *, execute: bool) -> Progress:
        """Read a parameter."""

    def write_parameter(self, number: int, value: float, *, execute: bool) -> Progress:
        """Write a parameter."""

    def write_parameter_persistent(self, number: int, value: float, *, execute: bool) -> Progress:
        """Write a parameter and keep it for the runs to come."""


class I_Nci_Ctrl(Protocol):  # noqa: N801
    """The command field of an NCI channel."""

    def call(self) -> Progress:
        """Do the work of one cycle."""


class I_NciChannel(Protocol):  # noqa: N801
    """An NCI channel."""

    def load(self, program: str, *, execute: bool) -> Progress:
        """Load a program."""

    def start(self, *, execute: bool) -> Progress:
        """Start it."""

    def stop(self, *, execute: bool) -> Progress:
        """Stop it."""


class I_Cam_Ctrl(Protocol):  # noqa: N801
    """The command field of a cam."""

    def call(self) -> Progress:
        """Do the work of one cycle."""


class I_Fly_Ctrl(Protocol):  # noqa: N801
    """The command field of a flying saw."""

    def call(self) -> Progress:
        """Do the work of one cycle."""


class I_TouchProbe(Protocol):  # noqa: N801
    """A touch probe."""

    def call(self) -> Progress:
        """Do the work of one cycle."""


class I_TriggerBox(Protocol):  # noqa: N801
    """A trigger box."""

    def call(self) -> Progress:
        """Do the work of one cycle."""


class Absent:
    """Stands where an object is not built in: an I_Nci_Ctrl, I_Cam_Ctrl, I_Fly_Ctrl, I_TouchProbe or I_TriggerBox."""

    def call(self) -> Progress:
        """Answer that there is nothing."""
        return NOT_EXIST


class AbsentChannel:
    """Stands where an NCI channel is not built in."""

    def load(self, program: str, *, execute: bool) -> Progress:  # noqa: ARG002 - nobody takes them
        """Answer that there is nothing."""
        return NOT_EXIST

    def start(self, *, execute: bool) -> Progress:  # noqa: ARG002
        """Answer that there is nothing."""
        return NOT_EXIST

    def stop(self, *, execute: bool) -> Progress:  # noqa: ARG002
        """Answer that there is nothing."""
        return NOT_EXIST
