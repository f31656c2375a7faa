"""`E_EncoderReferenceMode`: what a homing takes as reference (function-blocks 2.10)."""

import enum
from collections.abc import Mapping
from typing import Final

from motionlayer import nc


class E_EncoderReferenceMode(enum.IntEnum):  # noqa: N801 - the name of the interface
    """What the reference is, once the cam was found."""

    DEFAULT = 0
    """What the machine description says."""
    PLCCAM = 1
    """The edge at which the axis leaves the cam."""
    HARDWARESYNC = 2
    """The zero pulse behind it."""
    HARDWARELATCHPOS = 3
    """The rising edge of the latch input behind it, caught by hardware."""
    HARDWARELATCHNEG = 4
    """The falling one."""
    SOFTWARESYNC = 5
    """The overflow of the encoder's count behind it."""
    SOFTDRIVELATCHPOS = 6
    """The rising edge of the latch input behind it, as the program of the drive sees it."""
    SOFTDRIVELATCHNEG = 7
    """The falling one."""


HOMING_METHODS: Final[Mapping[E_EncoderReferenceMode, nc.HomingMode | None]] = {
    E_EncoderReferenceMode.DEFAULT: None,
    E_EncoderReferenceMode.PLCCAM: nc.HomingMode.CAM,
    E_EncoderReferenceMode.HARDWARESYNC: nc.HomingMode.INDEX,
    E_EncoderReferenceMode.HARDWARELATCHPOS: nc.HomingMode.LATCH_POSITIVE,
    E_EncoderReferenceMode.HARDWARELATCHNEG: nc.HomingMode.LATCH_NEGATIVE,
    E_EncoderReferenceMode.SOFTWARESYNC: nc.HomingMode.SOFTWARE_SYNC,
    E_EncoderReferenceMode.SOFTDRIVELATCHPOS: nc.HomingMode.SOFT_LATCH_POSITIVE,
    E_EncoderReferenceMode.SOFTDRIVELATCHNEG: nc.HomingMode.SOFT_LATCH_NEGATIVE,
}
"""How the axis homes in each reference mode; None: as the machine file says."""

_NUMBERS: Final = {method: mode for mode, method in HOMING_METHODS.items() if method is not None}


def reference_mode(method: nc.HomingMode) -> E_EncoderReferenceMode:
    """Return the number of a way to home; DEFAULT for those that the interface has no number for."""
    return _NUMBERS.get(method, E_EncoderReferenceMode.DEFAULT)
