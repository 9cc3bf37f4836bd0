"""From recorded speech to what it says: by its transcript, by labels, or by ear alone."""

from __future__ import annotations

from os import PathLike

from ..core.directions import Directions
from ..core.progress import Progress
from ..core.utterance import Utterance
from ..errors import InputError, Place, SpeechWarning, warn
from ..script import Script, SpokenLine, read_script
from ..script.files import names_something, read_text
from ..script.model import script_of
from ..script.textgrid import TextGrid, read_textgrid
from .alignment import align
from .prosody import measured
from .recordings.labelled import PHONE_TIERS, WORD_TIERS, found_tier, utterance_of_labels
from .recordings.phone_labels import is_silence
from .recordings.recognition import recognize
from .recordings.recording import read_recording
from .recordings.tone_labels import tells_accents, tells_boundaries
from .structure.accents import intone

LABELS_SUFFIX = ".textgrid"
TRANSCRIPT_SUFFIXES = (".txt", ".lab")
WEAKER = (
    "no transcript was given: words are guessed from the sound, which is weaker; check them in a TextGrid"
)

Recording = str | PathLike[str]


def holds_labels(given: str | None, text: bool = False) -> bool:
    """Tell whether an input names a TextGrid."""
    return given is not None and not text and given.lower().endswith(LABELS_SUFFIX)


def listen(
    given: str | None,
    audio: Recording | None,
    transcript: str | None,
    progress: Progress,
    *,
    text: bool = False,
    source: str = "text",
) -> tuple[Script, Utterance]:
    """Return what is to be performed, and what is said when, and how, in the recording `audio`.

    `given` may be a TextGrid, which alone needs no recording, or a script whose words are said; a
    `transcript`, a text or the name of its file, goes before those. Without either the words are recognized,
    with a warning (SpeechWarning). Raises InputError for what is missing or does not fit.
    """
    if audio is None and transcript is not None:
        raise InputError("a transcript needs its recording; expected --audio as well")
    if given is not None and holds_labels(given, text):
        if transcript is not None:
            raise InputError("a TextGrid has words of its own; expected no transcript", Place(given))
        utterance = _labelled(read_textgrid(given), audio, progress)
        return _script_of(utterance, given), utterance
    if audio is None:
        raise InputError("nothing to perform; expected a text, a file or --audio")
    script = None if given is None else read_script(given, text=text, source=source)
    if transcript is not None:
        utterance = hear(audio, read_transcript_text(transcript), progress)
    elif script is not None:
        utterance = with_written_tones(hear(audio, script.text, progress), script)
    else:
        utterance = hear(audio, None, progress)
    return script or _script_of(utterance, str(audio)), utterance


def hear(audio: Recording, transcript: str | None, progress: Progress) -> Utterance:
    """Return what is said when, and how, in a recording; its words are recognized where None are given."""
    recording = read_recording(audio)
    try:
        if transcript is None:
            progress("Recognizing …")
            warn(f"{audio}: {WEAKER}", SpeechWarning)
            return measured(recognize(recording))
        progress("Aligning …")
        return measured(align(recording, transcript))
    except InputError as error:
        raise error.at(Place(str(audio))) from None


def read_transcript_text(transcript: str) -> str:
    """Return a transcript, read from its file where it names one."""
    if transcript.lower().endswith(TRANSCRIPT_SUFFIXES) or (transcript and names_something(transcript)):
        return read_text(transcript)
    return transcript


def _labelled(grid: TextGrid, audio: Recording | None, progress: Progress) -> Utterance:
    words = found_tier(grid, WORD_TIERS)
    if audio is not None and words is not None and found_tier(grid, PHONE_TIERS) is None:
        return hear(audio, " ".join(w.text for w in words.labels if not is_silence(w.text)), progress)
    if audio is None:
        return utterance_of_labels(grid)
    utterance = utterance_of_labels(grid, read_recording(audio))
    progress("Listening …")
    return measured(utterance, accents=not tells_accents(grid), boundaries=not tells_boundaries(grid))


def with_written_tones(utterance: Utterance, script: Script) -> Utterance:
    """Return the utterance with the tones that the script has; where it has any, none are measured."""
    accents = [tone for line in script.lines for tone in line.directions.moved(line.source_offset).accents]
    ends = [tone for line in script.lines for tone in line.directions.moved(line.source_offset).boundaries]
    if not accents and not ends:
        return utterance
    return intone(utterance, Directions(accents=tuple(accents), boundaries=tuple(ends)))


def _script_of(utterance: Utterance, source: str) -> Script:
    line = SpokenLine(utterance.text, 0.0, Place(source))
    return script_of((line,), timed=False, source=source, language=utterance.language)
