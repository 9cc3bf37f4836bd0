"""Sessions without a server."""

from __future__ import annotations

from risorius.core.progress import quiet
from risorius.studio.wire import requests, shared

from .conftest import LINE


def perform(session, script=LINE, choices=None, emotions=(), **source):
    asked = requests.Perform(shared.Source(script, **source), choices or shared.Choices(), emotions)
    return session.perform(asked, quiet)


def edit(session, asked):
    return session.edit(asked, quiet)


def state(session):
    """Return what a page sees of a take, its number aside."""
    live = session.current
    return [sorted(live.blocks), [str(b) for b in live.blocks.values()], live.curves]
