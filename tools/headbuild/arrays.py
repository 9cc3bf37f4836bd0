"""The array type of the builder; shapes and units stand in the docstrings."""

from typing import Any

import numpy.typing as npt

Array = npt.NDArray[Any]
