"""Compiled kernels: the only part that imports numba.

A kernel is a plain Python function over float64 arrays and scalars. Decorated with `kernel` it is compiled on
first use and kept in a cache on disk; the same source, uncompiled, is the reference in the tests. What a
kernel may use is limited so that both give the same bits: `+ - * / sqrt abs min max` and comparisons; no powers,
no `hypot`, no `np.sum` or `dot`, no parallel loops, no division by zero.

The mode is read once, from the environment variable `MOTIONLAYER_KERNELS`:

========== =======================================================================================
`compiled` (default) numba, cached
`checked`  numba with bounds checks, cached apart
`plain`    Python itself: slow; numba is not imported
========== =======================================================================================

numba notices a changed source file, but not a changed callee or constant in another file. The cache therefore lies
in a folder named after a hash of every file beside a kernel and of the versions of numba, llvmlite and NumPy. A kernel
takes its constants from such folders only.
"""

from motionlayer._kernel._compile import MODE, cache_folder, is_cached, kernel, mark_cached

__all__ = ["MODE", "cache_folder", "is_cached", "kernel", "mark_cached"]
