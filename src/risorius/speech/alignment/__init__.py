"""Forced alignment: when each phone of a known text is said in a recording."""

from .aligner import align

__all__ = ["align"]
