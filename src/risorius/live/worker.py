"""The tasks of a worker that performs for live faces (`process_performer`)."""

from __future__ import annotations

import contextlib
import os
from functools import cache

from ..errors import RisoriusError
from ..settings import Settings
from .performer import LocalPerformer

_NICE = 5


def warm() -> None:
    """Load what the first request would wait for."""
    # A frame that is due goes before a sentence that is to join.
    if hasattr(os, "nice"):
        os.nice(_NICE)
    with contextlib.suppress(RisoriusError):  # whoever asks is told
        _performer().text("Hello.", (), Settings())


def perform(task: str, *arguments: object) -> object:
    """Perform by a method of the performer."""
    return getattr(_performer(), task)(*arguments)


@cache
def _performer() -> LocalPerformer:
    return LocalPerformer()
