"""From text to speech: sound, and what is said when."""

from .say import say
from .synthesis import synthesize
from .voices import voices

__all__ = ["say", "synthesize", "voices"]
