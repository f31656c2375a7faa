"""Errors: one enum of ids, and for each what it means, what to do, and who answers with it."""

from motionlayer.command._errors._id import ErrorId
from motionlayer.command._errors._ranges import ERRORS, RANGES, ErrorRange, range_of
from motionlayer.command._errors._text import ErrorText

__all__ = ["ERRORS", "RANGES", "ErrorId", "ErrorRange", "ErrorText", "range_of"]
