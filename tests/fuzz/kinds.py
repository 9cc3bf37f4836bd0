"""All kinds of spoilt input, complete once this is imported."""

from __future__ import annotations

from . import films, messages, readers  # noqa: F401  (they fill the table)
from .registry import READERS

__all__ = ["READERS"]
