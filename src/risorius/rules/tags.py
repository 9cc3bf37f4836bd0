"""Words of tags in transcripts (`data/tags.toml`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache, cached_property

from .load import load


@dataclass(frozen=True)
class TagTable:
    """Words by language: with which a tag begins or ends that names a sound, `sounds`, or begins, `openings`;
    `labels`: those before a colon that name no speaker.
    """

    sounds: Mapping[str, str]
    openings: Mapping[str, str]
    labels: Mapping[str, str]

    @cached_property
    def sound_words(self) -> frozenset[str]:
        """All words of `sounds`."""
        return _words(self.sounds)

    @cached_property
    def opening_words(self) -> frozenset[str]:
        """All words of `openings`."""
        return _words(self.openings)

    @cached_property
    def label_words(self) -> frozenset[str]:
        """All words of `labels`."""
        return _words(self.labels)


def _words(table: Mapping[str, str]) -> frozenset[str]:
    return frozenset(word for words in table.values() for word in words.split())


@cache
def tag_table() -> TagTable:
    """Return the package's table."""
    return load(TagTable, "tags.toml")
