"""Whatever takes time is a `Command`: one life cycle, one set of outputs, one table of errors.

A command is *busy* from the call on and *active* while the object really works on it. It ends exactly once: done,
in error, or aborted by another one. PLCopen outputs, planar feedback and the layer's progress are views of it.
"""

from motionlayer.command._combinations import all_of, any_of
from motionlayer.command._command import Command, CommandAborted, CommandError, Ledger, MotionError, ObjectInfo
from motionlayer.command._errors import ERRORS, RANGES, ErrorId, ErrorRange, ErrorText, range_of
from motionlayer.command._keywords import only_known

__all__ = [
    "ERRORS",
    "RANGES",
    "Command",
    "CommandAborted",
    "CommandError",
    "ErrorId",
    "ErrorRange",
    "ErrorText",
    "Ledger",
    "MotionError",
    "ObjectInfo",
    "all_of",
    "any_of",
    "only_known",
    "range_of",
]
