"""Packages that need not be installed."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..errors import RisoriusError


def optional(module: str, package: str) -> Any:
    """Return a module of a package that need not be installed; raise RisoriusError if it is not."""
    try:
        return import_module(module)
    except ImportError:
        raise RisoriusError(f"needs {package}; run pip install {package}") from None
