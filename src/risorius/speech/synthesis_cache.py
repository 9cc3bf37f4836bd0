"""Keep earlier speech, so that a text that has grown or changed is not spoken anew."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass, field

from .engines.protocol import Rendition, SpeechRequest
from .prosody.pitch_cache import PitchCache


class RenditionCache(OrderedDict[SpeechRequest, Rendition]):
    """The latest `most` stretches that a voice has spoken, by request."""

    def __init__(self, most: int = 64) -> None:
        super().__init__()
        self._most = most

    def __setitem__(self, request: SpeechRequest, rendition: Rendition) -> None:
        super().__setitem__(request, rendition)
        while len(self) > self._most:
            self.popitem(last=False)


@dataclass(frozen=True, slots=True)
class SynthesisCache:
    """The sound and the pitch of one engine's speech; both are the same when it is spoken again."""

    renditions: RenditionCache = field(default_factory=RenditionCache)
    pitch: PitchCache = field(default_factory=PitchCache)
