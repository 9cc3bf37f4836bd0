"""From text to speech: sound with timed words and phones."""

from .affect import feelings
from .engines.voices import voices
from .input import Input, LabelledRecording, Recording, SpeechSource, read, read_transcript
from .synthesis import VOICE_SETTINGS, synthesize_line, synthesize_script
from .synthesis_cache import SynthesisCache

__all__ = [
    "VOICE_SETTINGS",
    "Input",
    "LabelledRecording",
    "Recording",
    "SpeechSource",
    "SynthesisCache",
    "feelings",
    "read",
    "read_transcript",
    "synthesize_line",
    "synthesize_script",
    "voices",
]
