"""From text to speech: sound, and what is said when."""

from .affect import feelings
from .engines.voices import voices
from .from_recording import LabelledRecording, Recording, hear
from .input import Input, read, read_transcript
from .say import say
from .synthesis import synthesize

__all__ = [
    "Input",
    "LabelledRecording",
    "Recording",
    "feelings",
    "hear",
    "read",
    "read_transcript",
    "say",
    "synthesize",
    "voices",
]
