"""Score to performance: paper A's two stages of combination, and the lips' rule over the mouth."""

from __future__ import annotations

from .changes import changed_span
from .explain import Explanation, Part, explain
from .plan import Plan, at, combine
from .summary import Tally, summarize
from .suppression import suppression
from .traces import Trace, traces

__all__ = [
    "Explanation", "Part", "Plan", "Tally", "Trace",
    "at", "changed_span", "combine", "explain", "summarize", "suppression", "traces",
]  # fmt: skip
