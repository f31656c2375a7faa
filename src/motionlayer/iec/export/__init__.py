"""Declarations for the control side, in its own language: Structured Text, C, C#."""

from motionlayer.iec.export._c import c_header
from motionlayer.iec.export._csharp import csharp
from motionlayer.iec.export._declarations import Constant, Declarations, Start, Variable, VariableList
from motionlayer.iec.export._st import literal as st_literal
from motionlayer.iec.export._st import structured_text
from motionlayer.iec.export._twincat import twincat

__all__ = [
    "Constant",
    "Declarations",
    "Start",
    "Variable",
    "VariableList",
    "c_header",
    "csharp",
    "st_literal",
    "structured_text",
    "twincat",
]
