"""Fewer garbage collections: by default they take a tenth of a command that lives for seconds."""

from __future__ import annotations

import gc

_YOUNG = 10_000
"""New objects after which Python looks for garbage: at its own 700 that takes a twentieth of a picture."""


def collect_seldom() -> None:
    """Collect garbage less often: loaded and planned objects live on, and few refer to themselves."""
    gc.set_threshold(_YOUNG)


def collect_no_more() -> None:
    """Call it last: else Python looks at all there is once more as it ends, for .15 s after a picture."""
    gc.freeze()
