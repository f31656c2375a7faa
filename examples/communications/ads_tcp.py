"""The command ReadWrite of pyads with plain bytes on both sides."""

from ctypes import c_ubyte

import pyads
from pyads.constants import ADSIGRP_SUMUP_READ, ADSIGRP_SUMUP_WRITE
from pyads.structs import SAdsSumRequest

from motionlayer.machine import ReadWrite


def read_write_of(plc: pyads.Connection) -> ReadWrite:
    """Return ReadWrite of a connection; pyads wants to have the data of sum commands in types of its own."""

    def read_write(group: int, offset: int, length: int, data: bytes) -> bytes:
        value: object = data
        if group == ADSIGRP_SUMUP_READ:
            value = (SAdsSumRequest * offset).from_buffer_copy(data)
        elif group == ADSIGRP_SUMUP_WRITE:
            value = bytearray(data)
        kinds = c_ubyte * length, c_ubyte * len(data)
        return bytes(plc.read_write(group, offset, kinds[0], value, kinds[1], return_ctypes=True, check_length=False))

    return read_write
