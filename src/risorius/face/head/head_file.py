"""The file format of a head (`head.npz`): named arrays and fields in int16, each checked when it is read."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...core.arrays import AnyArray, Array, Int32Array
from ...core.parameters import INDEX
from ...errors import HeadError, Place
from ...machine.npz import read_arrays

FORMAT = 1
JOINT, AND = "joint/", "+"  # how the names of fields of two muscles begin, and what stands between the two
ArrayShape = tuple[int | str, ...]


@dataclass(frozen=True, slots=True)
class HeadFile:
    """The arrays of one head file. Shapes are sizes, or a letter if any size above 0 is allowed."""

    path: Path
    arrays: dict[str, AnyArray]

    @classmethod
    def read(cls, path: Path) -> HeadFile:
        """Read all arrays; raise HeadError if the file is not a head file of this format."""
        try:
            arrays = read_arrays(path)
        except (OSError, ValueError) as error:
            raise HeadError(f"not a head file: {error}", Place(str(path))) from error
        file = cls(path, arrays)
        version = int(file.array("format", ()))
        if version != FORMAT:
            raise file.error("format", f"is {version}; expected {FORMAT}")
        return file

    def error(self, name: str, message: str) -> HeadError:
        """Return the error to raise about the array `name`."""
        return HeadError(f"array '{name}' {message}", Place(str(self.path)))

    def array(
        self, name: str, shape: ArrayShape, low: float | None = None, high: float | None = None
    ) -> Array:
        """Return a read-only float64 array; raise HeadError if it does not fit.

        It must exist with this shape, and its values must be finite and within the range.
        """
        raw = self._raw(name, shape)
        if raw.dtype.kind not in "fiub":
            raise self.error(name, f"is of type {raw.dtype}; expected numbers")
        values = np.asarray(raw, dtype=np.float64)
        if not np.isfinite(values).all():
            raise self.error(name, "holds a value that is not a finite number")
        if values.size and (
            (low is not None and values.min() < low) or (high is not None and values.max() > high)
        ):
            raise self.error(name, f"spans {values.min():g} to {values.max():g}; expected {low} to {high}")
        values.setflags(write=False)
        return values

    def indices(self, name: str, shape: ArrayShape, count: int) -> Int32Array:
        """Return a read-only int32 array of indices below `count`; raise HeadError if one is not below."""
        raw = self._raw(name, shape)
        if raw.dtype.kind not in "iu":
            raise self.error(name, f"is of type {raw.dtype}; expected whole numbers")
        if raw.size and (raw.min() < 0 or raw.max() >= count):
            raise self.error(name, f"points outside the {count} vertices")
        values = raw.astype(np.int32)
        values.setflags(write=False)
        return values

    def unit(self, name: str) -> Array:
        """Return a direction (3,); raise HeadError if its length is not 1."""
        values = self.array(name, (3,))
        if abs(float(np.linalg.norm(values)) - 1.0) > 1e-5:
            raise self.error(name, f"has length {np.linalg.norm(values):g}; expected 1")
        return values

    def field(self, name: str, count: int) -> tuple[Int32Array, Array]:
        """Return vertices (k,) and displacement (k, 3) of a field.

        Its arrays are `name/vertices`, `name/values` and `name/scale`.
        """
        vertices = self.indices(f"{name}/vertices", ("k",), count)
        steps = self.array(f"{name}/values", (len(vertices), 3))
        displacement = steps * float(self.array(f"{name}/scale", (), low=0.0))
        displacement.setflags(write=False)
        return vertices, displacement

    def joint_fields(self) -> dict[tuple[str, str], str]:
        """Return the fields that two muscles move together, by their names; older files have none."""
        names = {}
        for array in self.arrays:
            name, _, part = array.rpartition("/")
            if array.startswith(JOINT) and part == "vertices":
                first, _, second = name.removeprefix(JOINT).partition(AND)
                if first not in INDEX or second not in INDEX:
                    raise self.error(
                        array, f"is not named by two parameters; expected {JOINT}FIRST{AND}SECOND"
                    )
                names[first, second] = name
        return names

    def _raw(self, name: str, shape: ArrayShape) -> AnyArray:
        if name not in self.arrays:
            raise self.error(name, "is missing")
        actual = self.arrays[name].shape
        expected_text = "(" + ", ".join(str(size) for size in shape) + (",)" if len(shape) == 1 else ")")
        fits = len(actual) == len(shape) and all(
            (size > 0 if isinstance(expected, str) else size == expected)
            for size, expected in zip(actual, shape, strict=True)
        )
        if not fits:
            raise self.error(name, f"has shape {actual}; expected {expected_text}")
        return self.arrays[name]
