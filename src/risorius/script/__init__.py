"""Read a user's input into a script: lines to say, and marks to show, each with its place in the source."""

from .anchor import Anchor
from .model import Mark, MarkKind, Script, SpokenLine
from .movements import movements_of
from .read import parse_script, read_script
from .states import felt_in, information_in, listening_in

__all__ = [
    "Anchor", "Mark", "MarkKind", "Script", "SpokenLine",
    "felt_in", "information_in", "listening_in", "movements_of", "parse_script", "read_script",
]  # fmt: skip
