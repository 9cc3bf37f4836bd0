"""From text to speech: sound with timed words and phones."""

from .affect import feelings
from .engines.voices import voices
from .from_recording import LabelledRecording, Recording, hear
from .input import Input, read, read_transcript
from .say import VOICE_SETTINGS, say
from .spoken import SpokenBefore
from .synthesis import synthesize

__all__ = [
    "VOICE_SETTINGS",
    "Input",
    "LabelledRecording",
    "Recording",
    "SpokenBefore",
    "feelings",
    "hear",
    "read",
    "read_transcript",
    "say",
    "synthesize",
    "voices",
]
