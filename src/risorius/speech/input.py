"""Read the texts and files that a user names into a script or a recording."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from ..errors import InputError, Place
from ..script import Script, parse_script, read_script
from ..script.files import names_something, read_text
from ..script.kinds import misplaced
from ..script.plain import USUAL_FORM, TextForm, only_words
from ..script.subtitles import SUBTITLE_SUFFIXES, TimedText, looks_like_subtitles, read_subtitles
from ..script.suffixes import RECORDING_SUFFIXES

LABELS_SUFFIX = ".textgrid"
TRANSCRIPT_SUFFIXES = (".txt", ".lab", ".md", *SUBTITLE_SUFFIXES)
_MARKED = (".ssml", ".bml", ".xml", ".utt")
HEARD = TextForm(heard=True)


@dataclass(frozen=True, slots=True)
class Recording:
    """A recorded voice: the file `audio`, and what is known of its words.

    `transcript`: the words, or `cues`: those of subtitles, with their times; `script`: the marks, and the
    words if there is no transcript. Without either, the words are recognized. `language` is that of the
    words, by default the script's, or English.
    """

    audio: str | PathLike[str]
    transcript: str | None = None
    cues: tuple[TimedText, ...] = ()
    script: Script | None = None
    language: str | None = None


@dataclass(frozen=True, slots=True)
class LabelledRecording:
    """A recorded voice, the file `audio` (None for silence), and the TextGrid of its timed words."""

    labels: str
    audio: str | PathLike[str] | None = None


SpeechSource = Script | Recording | LabelledRecording
"""A script that is to be spoken, or a recording with its known words."""


@dataclass(frozen=True, slots=True)
class Input:
    """An input to be performed, as a user names it.

    `script`: a text or the name of a file, a TextGrid among them; `text` takes it as a text whatever it looks
    like, `name` stands for it in messages. `audio`: the file of a recording; `transcript`: its words, or the
    name of a file with them; `language`: that of a recording's words. `content`: what the file `script`
    holds, if it is not to be read from there. `form`: that of a text.
    """

    script: str | None = None
    audio: str | PathLike[str] | None = None
    transcript: str | None = None
    text: bool = False
    name: str = "text"
    content: str | None = None
    language: str | None = None
    form: TextForm = USUAL_FORM

    @property
    def labels(self) -> str | None:
        """The file of labels, if the script is one."""
        named = self.script is not None and not self.text and self.script.lower().endswith(LABELS_SUFFIX)
        return self.script if named else None


def read(source: Input) -> SpeechSource:
    """Return a script that is to be spoken, or a recording with its known words.

    Raises InputError, with its place, for what is missing, does not fit together or cannot be read; whether
    recording and labels can be used is seen when they are heard.
    """
    if source.audio is None and source.transcript is not None:
        raise InputError("a transcript needs its recording; expected --audio as well")
    if source.labels is not None:
        if source.transcript is not None:
            raise InputError("a TextGrid has words of its own; expected no transcript", Place(source.labels))
        return LabelledRecording(source.labels, source.audio)
    if source.audio is not None:
        return _recording(source, source.audio)
    script = None if source.script is None else _script(source, source.script, source.form)
    if script is None:
        raise InputError("nothing to perform; expected a text, a file or --audio")
    return script


def _recording(source: Input, audio: str | PathLike[str]) -> Recording:
    form = source.form._replace(heard=True)
    if source.transcript is None and source.script is not None and _is_subtitles(source.script, source.text):
        return Recording(audio, *read_transcript(source.script, form), language=source.language)
    script = None if source.script is None else _script(source, source.script, form)
    return Recording(audio, *read_transcript(source.transcript, form), script, source.language)


def _script(source: Input, script: str, form: TextForm) -> Script:
    if source.content is not None:
        return parse_script(source.content, Path(script).suffix.lower(), script, form)
    return read_script(script, text=source.text, source=source.name, form=form)


def read_transcript(
    transcript: str | None, form: TextForm = HEARD
) -> tuple[str | None, tuple[TimedText, ...]]:
    """Return the words of a transcript, if there is one, read from its file if it names one.

    Subtitles are cues with their times, and no words. Tags and speakers' names are hidden as the `form` says.
    """
    if not transcript:
        return transcript, ()
    if not transcript.lower().endswith(TRANSCRIPT_SUFFIXES) and not names_something(transcript):
        return only_words(transcript, "transcript", form), ()
    if Path(transcript).suffix.lower() in RECORDING_SUFFIXES:
        raise InputError("is a recording; expected its words: a text, or a file with them", Place(transcript))
    text = read_text(transcript)
    if _is_subtitles(transcript) or looks_like_subtitles(text):
        return None, read_subtitles(text, transcript, keep_tags=form.keep_tags)
    _check_words_alone(text, transcript)
    return only_words(text, transcript, form), ()


def _check_words_alone(text: str, transcript: str) -> None:
    """Raise InputError if the file of a transcript holds more than words."""
    suffix, place = Path(transcript).suffix.lower(), Place(transcript)
    if suffix in (LABELS_SUFFIX, *_MARKED):
        kind = "labels" if suffix == LABELS_SUFFIX else "marks"
        other = f"risorius speak {transcript} --audio with the recording"
        raise InputError(f"holds {kind}; expected its words alone, or {other}", place)
    found = misplaced(text)
    if found is not None:
        raise InputError(found, place)


def _is_subtitles(name: str, text: bool = False) -> bool:
    return not text and name.lower().endswith(SUBTITLE_SUFFIXES)
