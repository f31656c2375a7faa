"""Numbers of the protocol: commands, and the index groups of symbols and sums (ads 2, 4 to 6)."""

from typing import Final

DEVICE_INFO: Final = 1
READ: Final = 2
WRITE: Final = 3
STATE: Final = 4
CONTROL: Final = 5
ADD_NOTIFICATION: Final = 6
DELETE_NOTIFICATION: Final = 7
NOTIFICATION: Final = 8
READ_WRITE: Final = 9

HANDLE_BY_NAME: Final = 0xF003
VALUE_BY_NAME: Final = 0xF004
VALUE_BY_HANDLE: Final = 0xF005
RELEASE_HANDLE: Final = 0xF006
INFO_BY_NAME: Final = 0xF007
VERSION: Final = 0xF008
ENTRY_BY_NAME: Final = 0xF009
UPLOAD: Final = 0xF00B
UPLOAD_INFO: Final = 0xF00C
TYPE_UPLOAD: Final = 0xF00E
UPLOAD_INFO_LONG: Final = 0xF00F
TYPE_BY_NAME: Final = 0xF011
DEVICE_DATA: Final = 0xF100
DATA_AREA: Final = 0x4040
DATA_BITS: Final = 0x4041
DATA_SIZE: Final = 0x4045

SUM_READ: Final = 0xF080
SUM_WRITE: Final = 0xF081
SUM_READ_WRITE: Final = 0xF082
SUM_READ_EX: Final = 0xF083
SUM_READ_EX_2: Final = 0xF084
SUM_ADD_NOTIFICATIONS: Final = 0xF085
SUM_DELETE_NOTIFICATIONS: Final = 0xF086
SUMS: Final = range(SUM_READ, SUM_DELETE_NOTIFICATIONS + 1)
