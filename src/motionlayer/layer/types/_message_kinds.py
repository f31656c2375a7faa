"""Message lists and their writer (motion-layer 2.5). Types of messages are `motionlayer.event.Level`."""

import enum


class MessageCommand(enum.IntEnum):
    """`E_MESSAGE_CTRL`, and the same members `E_MESSAGE_STATE`: what the writer of a list is told."""

    NULL = 0
    INIT = 10
    IDLE = 30
    WRITE = 50


class MessageFlow(enum.IntEnum):
    """`E_MESSAGE_FLOW`: steps of the writer."""

    INIT = 0
    ROOT = 10
    ROOT_CREATE = 11
    ROOT_CREATE_BUSY = 12
    FOLDER = 13
    FOLDER_CREATE = 14
    FOLDER_CREATE_BUSY = 15
    FILE_CREATE_DONE = 16
    LINE_START = 100
    LINE_BUILD = 101
    LINE_CHECK = 102
    WRITE_FILE_BUSY = 200
    WRITE_FILE_END = 201
    WRITE_FILE_DONE = 1000


class MessageBatch(enum.IntEnum):
    """`E_MESSAGE_BATCH`; used by no message."""

    NULL = 0
    JOB_STARTED = 1
    NEXT_IN_JOB = 2
    JOB_DONE = 3
