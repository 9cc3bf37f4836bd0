"""The types of numpy arrays, one for each kind of number; docstrings give the shapes and the units.

`Array` is what is computed with. Narrower types are used if memory or speed matters.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
"""64-bit floating-point numbers: all stages compute with them."""

Float32Array = npt.NDArray[np.float32]
"""32-bit floating-point numbers: meshes, pictures and files hold them."""

FloatArray = npt.NDArray[np.floating]
"""Floating-point numbers of any size: for functions that convert their input."""

BoolArray = npt.NDArray[np.bool_]
"""True or false."""

IndexArray = npt.NDArray[np.intp]
"""Positions in another array, as numpy returns them (64 bits on 64-bit machines)."""

IntArray = npt.NDArray[np.integer]
"""Whole numbers of any size, with or without sign: for functions that only read them."""

UIntArray = npt.NDArray[np.unsignedinteger]
"""Whole numbers of any size without sign."""

Int8Array = npt.NDArray[np.int8]
"""Whole numbers from -128 to 127."""

Int16Array = npt.NDArray[np.int16]
"""Whole numbers from -32,768 to 32,767: samples of sound, packed positions."""

Int32Array = npt.NDArray[np.int32]
"""Whole numbers of 32 bits: corners of triangles, fixed-point pixels."""

Int64Array = npt.NDArray[np.int64]
"""Whole numbers of 64 bits."""

ByteArray = npt.NDArray[np.uint8]
"""Whole numbers from 0 to 255: pictures, flags, small indices."""

UInt16Array = npt.NDArray[np.uint16]
"""Whole numbers from 0 to 65,535."""

UInt32Array = npt.NDArray[np.uint32]
"""Whole numbers from 0 to 2³² - 1: indices in kernels (numba tests signed ones for negative values)."""

UInt64Array = npt.NDArray[np.uint64]
"""Whole numbers from 0 to 2⁶⁴ - 1: sets of up to 64 members, one bit each."""

AnyArray = npt.NDArray[Any]
"""An array of any type of number."""
