"""Types of IEC 61131-3, declared once in Python: values, bytes, NumPy types and symbols follow."""

from motionlayer.iec._array import Array, ArrayValue
from motionlayer.iec._bounds import Bounds, Index
from motionlayer.iec._compound import Compound, CompoundType
from motionlayer.iec._elementary import (
    BIT,
    BOOL,
    BYTE,
    DATE,
    DINT,
    DT,
    DWORD,
    INT,
    LINT,
    LREAL,
    LTIME,
    LWORD,
    REAL,
    SINT,
    TIME,
    TOD,
    UDINT,
    UINT,
    ULINT,
    USINT,
    WORD,
    Bit,
    Boolean,
    Elementary,
    Integer,
    Real,
)
from motionlayer.iec._enumeration import Enumeration
from motionlayer.iec._field import Field
from motionlayer.iec._input_array import InputArray
from motionlayer.iec._layout import Member
from motionlayer.iec._method import Method, Parameter
from motionlayer.iec._output_array import OutputArray
from motionlayer.iec._string import STRING, WSTRING, String, WString
from motionlayer.iec._struct import Struct, Union
from motionlayer.iec._struct_type import StructType
from motionlayer.iec._symbol_table import Named, Place, Source, Symbol, SymbolTable
from motionlayer.iec._type import Bytes, ElementGuard, Guard, IecType, Memory, Scalar
from motionlayer.iec._variable import Variable

__all__ = [
    "BIT", "BOOL", "BYTE", "DATE", "DINT", "DT", "DWORD", "INT", "LINT", "LREAL", "LTIME", "LWORD", "REAL", "SINT",
    "STRING", "TIME", "TOD", "UDINT", "UINT", "ULINT", "USINT", "WORD", "WSTRING", "Array", "ArrayValue", "Bit",
    "Boolean", "Bounds", "Bytes", "Compound", "CompoundType", "ElementGuard", "Elementary", "Enumeration", "Field",
    "Guard", "IecType", "Index", "InputArray", "Integer", "Member", "Memory", "Method", "Named", "OutputArray",
    "Parameter", "Place", "Real", "Scalar", "Source", "String", "Struct", "StructType", "Symbol", "SymbolTable",
    "Union", "Variable", "WString",
]  # fmt: skip
