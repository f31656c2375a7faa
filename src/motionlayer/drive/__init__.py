"""Drives, without I/O: simulated ones, and the profiles of real ones.

`IdealDrives` stand where they should, in the same tick. `ServoDrives` have a position loop, a velocity loop and
mechanics; they lag, and can have a `Fault`. A drive reads the set rows of the store and writes the actual ones; it
knows nothing of axes.
"""

from motionlayer.drive._fault import FAULTS, Fault, FaultKind
from motionlayer.drive._ideal import IdealDrives
from motionlayer.drive._latch import Latches, LatchSignals
from motionlayer.drive._servo import Servo, ServoDrives
from motionlayer.drive._switch import ReferenceSwitch

__all__ = [
    "FAULTS",
    "Fault",
    "FaultKind",
    "IdealDrives",
    "LatchSignals",
    "Latches",
    "ReferenceSwitch",
    "Servo",
    "ServoDrives",
]
