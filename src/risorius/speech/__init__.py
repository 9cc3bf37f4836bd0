"""From text to speech: sound, and what is said when."""

from .affect import feelings
from .say import say
from .synthesis import synthesize
from .voices import voices

__all__ = ["feelings", "say", "synthesize", "voices"]
