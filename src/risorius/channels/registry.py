"""The registration of channels, each with its builder."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from importlib import import_module

from ..core.channels import ChannelDeclaration
from ..core.movement import LipSegment, Movement
from .inputs import ChannelInputs, Context

Built = Iterable[Movement | LipSegment]
ChannelBuilder = Callable[[ChannelInputs, Context], Built]
_BUILDERS: dict[str, ChannelBuilder] = {}  # filled as the channels' modules are imported


def register(name: str, priority: float, build: ChannelBuilder | None = None, **declaration: object) -> None:
    """Register a channel, at the end of its file; all but the builder are written as literals.

    `core.channels` reads what is declared as text, see `ChannelDeclaration`: `rules`, `marks`, `exclusive`,
    `order`, and `timing`, which is (onset, offset, function).
    """
    if build is not None:
        _BUILDERS[name] = build


def builder_of(channel: ChannelDeclaration) -> ChannelBuilder:
    """Return the builder of a channel; its module is imported if it is not yet."""
    if channel.name not in _BUILDERS:
        import_module(channel.module)
    return _BUILDERS[channel.name]
