"""Score to performance: paper A's two stages of combination, and the rule that speech owns the mouth."""

from __future__ import annotations

from .changes import changed_span, performance_after
from .explain import explain
from .explanation import Contribution, Explanation
from .plan import Plan, at, combine
from .summary import Tally, summarize
from .suppression import suppression
from .traces import Trace, traces

__all__ = [
    "Contribution", "Explanation", "Plan", "Tally", "Trace",
    "at", "changed_span", "combine", "explain", "performance_after", "summarize", "suppression", "traces",
]  # fmt: skip
