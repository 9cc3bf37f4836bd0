"""Find how much of a text has been said in a piece of its recording that ends in a pause."""

from __future__ import annotations

from ...core.speech.audio import Audio
from ..resampled import Resampled
from .decoder import with_decoders
from .lexicon import read_transcript

# Marks that may stand before a pause.
_MARKS = ".!?,;:\u2026\u2013\u2014\u3002\uff0c\uff01\uff1f\u3001"
# Words of the text that are sought: nobody says more in a second.
_FASTEST = 5.5


def text_progress(audio: Audio, text: str, language: str | None = None) -> int:
    """Return how many characters of `text`, from its beginning, are said in `audio`, whole words.

    The sound ends in a pause: if the words before and after the one that seems to be the last have a mark
    behind them and it has none, it is that one. Raises InputError for a text that cannot be spoken,
    SpeechError if the aligner fails.
    """
    _, words = read_transcript(text, language)
    ahead = [word.readings for word in words[: 2 + round(_FASTEST * audio.duration)]]
    sound = Resampled(audio).read(0.0, audio.duration)
    count = len(with_decoders(lambda decoders: decoders.follow_words(sound, ahead)))
    starts = [word.word.source_start for word in words] + [len(text)]
    ends = [word.word.source_end for word in words]

    def is_marked(number: int) -> bool:
        return number == len(words) or any(mark in text[ends[number - 1] : starts[number]] for mark in _MARKS)

    nearest = [number for number in (count, count - 1, count + 1) if 1 <= number <= len(words)]
    found = next((number for number in nearest if is_marked(number)), count)
    return starts[found] if count else 0
