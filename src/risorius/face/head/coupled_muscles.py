"""Links between muscles: fibres that interleave pull each other along (paper B, section 6.3).

A table assigns each ordered pair of muscles a weight from 0 (no link) to 1 (fully linked); a linked muscle
contracts at least by the weight times the other. Links do not chain: an activation that a link adds pulls no
further muscle. They change the activations before the skin is displaced, but not the parameters.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import lru_cache
from importlib import resources
from pathlib import Path

import numpy as np

from ...core.arrays import Array, UInt32Array
from ...core.muscle_coupling import Link
from ...core.parameters import INDEX
from ...machine.kernels.jit import kernel
from ...reading.toml import load_file

FILE = "links.toml"


@dataclass(frozen=True, slots=True)
class LinkTable:
    """A file of links."""

    link: tuple[Link, ...] = field(default=())


@dataclass(frozen=True, slots=True)
class Links:
    """A compiled table of links: `first`, `second` (k,) columns of the parameters, `weight` (k,) 0..1."""

    first: UInt32Array
    second: UInt32Array
    weight: Array

    @classmethod
    def of(cls, links: Iterable[Link]) -> Links:
        """Compile the rows `links`; of two rows for one pair, the later one counts."""
        weights = {(INDEX[a.name], INDEX[b.name]): row.weight for row in links for a, b in row.pairs()}
        pairs = np.array(list(weights), np.uint32).reshape(-1, 2)
        first, second = (np.ascontiguousarray(column) for column in pairs.T)
        return cls(first, second, np.array(list(weights.values()), np.float64))

    def apply(self, values: Array, out: Array) -> Array:
        """Write `values` (46,) with all linked activations to `out` (46,) and return it."""
        _apply(self.first, self.second, self.weight, values, out)
        return out


NO_LINKS = Links.of(())


def load_links(path: Path | None = None) -> Links:
    """Return the links of a file, or of the standard head.

    Raises InputError, or ParameterError for a muscle, with file and line, if the table does not fit.
    """
    return Links.of(link_rows(path))


def link_rows(path: Path | None = None) -> tuple[Link, ...]:
    """Return the rows of a file of links, or of the standard head's; raises as `load_links`."""
    file = path or Path(str(resources.files("risorius") / "heads" / "standard" / FILE))
    return _load(file, file.stat().st_mtime_ns if file.is_file() else 0)


@lru_cache(maxsize=8)
def _load(path: Path, _changed: int) -> tuple[Link, ...]:
    return load_file(LinkTable, path).link


@kernel("u4[:], u4[:], f8[:], f8[:], f8[:]")
def _apply(first: UInt32Array, second: UInt32Array, weight: Array, values: Array, out: Array) -> None:
    # A loop, because for a slice numba would compile a check of the lengths that is longer than the kernel.
    for k in range(len(values)):
        out[k] = values[k]
    for k in range(len(weight)):
        out[second[k]] = max(out[second[k]], weight[k] * values[first[k]])
