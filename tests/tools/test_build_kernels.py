"""The package's file holds every kernel, made of the present sources."""

from __future__ import annotations

import json

import build_kernels  # type: ignore[import-not-found]
import pytest

from risorius.core.kernels import shipped


def test_the_file_is_that_of_the_sources() -> None:
    wanted = set(build_kernels.kernels())
    index = json.loads(shipped._archive().read(shipped.INDEX))
    held = {entry["kernel"] for entry in index["entries"]}
    changed = sorted({*shipped.stale(), *(wanted ^ held)})
    if changed:
        names = ", ".join(changed)
        pytest.fail(f"run python tools/build_kernels.py, for these have changed: {names}", pytrace=False)
