"""Conflict policies by name, one file each: `inhibit`, `graded`, `attenuate`, `sum`."""

from __future__ import annotations

from . import attenuate, graded, inhibit, plain_sum

__all__ = ["attenuate", "graded", "inhibit", "plain_sum"]
