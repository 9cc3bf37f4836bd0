"""The lips of a score: lip models, contact goals, and the limits of speech on other channels."""

from __future__ import annotations

from . import dominance, effort, lookahead

__all__ = ["dominance", "effort", "lookahead"]
