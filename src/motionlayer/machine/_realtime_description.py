"""The table `[realtime]`: what a real-time run asks of the computer."""

from pydantic import Field

from motionlayer.machine._fields import Table

LONGEST_SPIN_US = 1000


class RealTimeDescription(Table):
    """What a real-time run asks of the computer: `[realtime]`. A simulation does not look at it."""

    priority: int = Field(
        default=40,
        ge=0,
        le=99,
        description="Priority under SCHED_FIFO, 1 to 99, where the system allows it; 0: an ordinary thread.",
    )
    lock_memory: bool = Field(default=True, description="Keep the memory from being swapped out, where allowed.")
    spin_us: int = Field(
        default=100,
        ge=0,
        le=LONGEST_SPIN_US,
        description="Longest time to spin before a tick (µs), at most a quarter of it; never under SCHED_FIFO.",
        json_schema_extra={"x-unit": "µs"},
    )
