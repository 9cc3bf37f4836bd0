"""From text to speech: sound, and what is said when."""

from .affect import feelings
from .engines.voices import voices
from .say import say
from .synthesis import synthesize

__all__ = ["feelings", "say", "synthesize", "voices"]
