"""From text to speech: sound with timed words and phones."""

from .affect import feelings
from .engines.voices import voices
from .from_recording import LabelledRecording, Recording, align_recording
from .input import Input, SpeechSource, read, read_transcript
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
    "align_recording",
    "read",
    "read_transcript",
    "synthesize_line",
    "synthesize_script",
    "voices",
]
