"""States of the interpreter of an NCI channel (motion-layer 2.3)."""

import enum


class InterpreterState(enum.IntEnum):
    """`E_NCI_INTERPRETER_STATE`."""

    INITFAILED = 0
    IDLE = 1
    READY = 2
    STARTED = 3
    SCANNING = 4
    RUNNING = 5
    STAY_RUNNING = 6
    WRITETABLE = 7
    SEARCHLINE = 8
    END = 9
    SINGLESTOP = 10
    ABORTING = 11
    ABORTED = 12
    FAULT = 13
    RESET = 14
    STOP = 15
    WAITFUNC = 16
    FLUSHBUFFERS = 17


class NciChannelError(enum.IntEnum):
    """`E_NCI_CHANNEL_ERROR`; used by nothing."""

    NULL = 0
    INVALID_REFERENCE_CHANNEL_REF = 1
    AXIS_CONFIGURATION_MISMATCH_MC_AXIS = 2
    AXIS_CONFIGURATION_MISMATCH_AUX_AXIS = 3
