"""Score to performance: paper A's two stages of combination, and the rule that speech owns the mouth."""

from __future__ import annotations

from .emotion_curves import emotion_curves
from .explain import explain
from .explanation import Contribution, Explanation
from .incremental import changed_span, recombine
from .plan import Plan, at, combine
from .summary import Tally, summarize
from .suppression import suppression
from .traces import Trace, traces

__all__ = [
    "Contribution", "Explanation", "Plan", "Tally", "Trace",
    "at", "changed_span", "combine", "emotion_curves", "explain", "recombine", "summarize",
    "suppression", "traces",
]  # fmt: skip
