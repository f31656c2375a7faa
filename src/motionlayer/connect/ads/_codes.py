"""ADS return codes that the server sends, and the exception that carries one (ads 3)."""

import enum


class Code(enum.IntEnum):
    """ADS and AMS return codes, named as in the vendor's table."""

    NO_ERROR = 0x0000
    TARGET_PORT_NOT_FOUND = 0x0006
    TARGET_MACHINE_NOT_FOUND = 0x0007
    UNKNOWN_COMMAND = 0x0008
    INVALID_AMS_LENGTH = 0x000E
    NO_MEMORY = 0x0019
    MAILBOX_FULL = 0x0502
    PORT_IN_USE = 0x0506
    NO_MORE_PORTS = 0x0508
    DEVICE_ERROR = 0x0700
    SERVICE_NOT_SUPPORTED = 0x0701
    INVALID_GROUP = 0x0702
    INVALID_OFFSET = 0x0703
    NOT_PERMITTED = 0x0704
    INVALID_SIZE = 0x0705
    INVALID_DATA = 0x0706
    NOT_READY = 0x0707
    INVALID_PARAMETER = 0x070B
    NOT_FOUND = 0x070C
    SYNTAX = 0x070D
    SYMBOL_NOT_FOUND = 0x0710
    SYMBOL_VERSION_INVALID = 0x0711
    INVALID_STATE = 0x0712
    MODE_NOT_SUPPORTED = 0x0713
    NOTIFICATION_HANDLE_INVALID = 0x0714
    NO_MORE_HANDLES = 0x0716
    WATCH_SIZE = 0x0717
    TIMEOUT = 0x0719
    INVALID_ARRAY_INDEX = 0x0721
    ACCESS_DENIED = 0x0723


class AdsError(Exception):
    """A request that is answered with a return code.

    Attributes:
        code: sent to the client.
    """

    def __init__(self, code: Code, text: str = "") -> None:
        super().__init__(f"{code.name.lower().replace('_', ' ')} (0x{code:X})" + (f": {text}" if text else ""))
        self.code = code
