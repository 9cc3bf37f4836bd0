"""What runs every day and what only `pytest --full` runs.

Every day hypothesis tries a quarter of the examples, the same ones in each run of one state of the tests, so
that what fails is due to the change at hand. `--full` tries all of them, new ones in each run; a failure
prints the line that reproduces it. No example is timed: the machine may be busy.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Any, TypeVar

import pytest
from hypothesis import HealthCheck, settings

T = TypeVar("T")
_FULL = 100
_UNTIMED = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow]}
settings.register_profile("full", max_examples=_FULL, print_blob=True, **_UNTIMED)
settings.register_profile("everyday", max_examples=_FULL // 4, derandomize=True, **_UNTIMED)


def examples(full: int, **others: Any) -> settings:
    """Return the settings of a test that tries `full` examples under `--full`, and a share of them else."""
    share = settings.default.max_examples / _FULL
    return settings(max_examples=max(1, round(full * share)), **others)


def samples(full: T, everyday: T) -> T:
    """Return what a test takes of many, or how finely it samples: `full` under `--full`, `everyday` else."""
    return full if settings.default.max_examples == _FULL else everyday


def everyday(values: Iterable[Any], kept: Collection[Any]) -> list[Any]:
    """Return parameters of a test: `kept` run every day, the other values under `--full` only."""
    return [value if value in kept else pytest.param(value, marks=pytest.mark.full) for value in values]
