"""Info of all axes: one kernel per cycle.

It has a folder of its own, because kernels are compiled anew with every change of a file beside them.
"""

from motionlayer.layer.info._infos import AxisInfos, Flag, Found

__all__ = ["AxisInfos", "Flag", "Found"]
