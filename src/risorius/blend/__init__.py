"""Score to performance: paper A's two stages of combination, and the lips' rule over the mouth."""

from __future__ import annotations

from .explain import Explanation, Part, Tally, explain, summarize
from .plan import Plan, at, combine

__all__ = ["Explanation", "Part", "Plan", "Tally", "at", "combine", "explain", "summarize"]
