"""From text to speech: sound with timed words and phones."""

from ..core.progress import Progress, quiet
from ..core.speech.utterance import Utterance
from ..script import Script
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
    "align_recording",
    "feelings",
    "read",
    "read_transcript",
    "synthesize_line",
    "synthesize_script",
    "voices",
]


def align_recording(
    recording: Recording | LabelledRecording, progress: Progress = quiet
) -> tuple[Script, Utterance]:
    """Return the script to be performed, and the timed utterance of a recording (see `from_recording`).

    The aligner is loaded with the first recording: texts do without it.
    """
    from .from_recording import align_recording as align

    return align(recording, progress)
