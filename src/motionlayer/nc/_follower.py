"""What waits in the buffer of an axis: the command, and when it begins."""

from dataclasses import dataclass
from typing import NamedTuple

from motionlayer.nc._config import BufferMode
from motionlayer.nc._motion import Job
from motionlayer.nc._through import Way


class Buffering(NamedTuple):
    """When a command begins that is given while another one runs.

    Attributes:
        mode: see `BufferMode`.
        position: of the joint, where a blending mode shall not use the target of the running command, u.
    """

    mode: BufferMode = BufferMode.ABORTING
    position: float | None = None

    @property
    def blends(self) -> bool:
        """The running command is handed over without rest."""
        return self.mode not in (BufferMode.ABORTING, BufferMode.BUFFERED)


AT_ONCE = Buffering()


@dataclass(slots=True)
class Follower:
    """What waits for the running job.

    Attributes:
        job: the follower.
        buffering: how it follows.
        way: its plan, where it is appended; None where it waits for more than the setpoint of the running job.
        heading: direction in which the joint is passed in motion; 0 where the running job comes to rest there.
        held: override 0 has braked the running job while this one waits.
        beyond: it has carried the running job past the joint, or as good as past it: nothing comes back to it.
    """

    job: Job
    buffering: Buffering
    way: Way | None = None
    heading: float = 0.0
    held: bool = False
    beyond: bool = False
