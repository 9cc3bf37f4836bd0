"""Progress reports of long work."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[..., None]
"""Called with a stage's name, and how many of how many frames are done if that is known."""


def quiet(stage: str, done: int = 0, total: int = 0) -> None:
    """Say nothing."""
