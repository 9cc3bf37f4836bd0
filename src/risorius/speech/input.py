"""Read the texts and files that a user names into a script or a recording."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from ..errors import InputError, Place
from ..script import Script, parse_script, read_script
from ..script.files import names_something, read_text
from ..script.plain import USUAL_FORM, TextForm
from .from_recording import LabelledRecording, Recording

LABELS_SUFFIX = ".textgrid"
TRANSCRIPT_SUFFIXES = (".txt", ".lab")

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
    script = None if source.script is None else _script(source, source.script)
    if source.audio is not None:
        return Recording(source.audio, read_transcript(source.transcript), script, source.language)
    if script is None:
        raise InputError("nothing to perform; expected a text, a file or --audio")
    return script


def _script(source: Input, script: str) -> Script:
    if source.content is not None:
        return parse_script(source.content, Path(script).suffix.lower(), script, source.form)
    return read_script(script, text=source.text, source=source.name, form=source.form)


def read_transcript(transcript: str | None) -> str | None:
    """Return a transcript, if there is one, read from its file if it names one."""
    if not transcript:
        return transcript
    named = transcript.lower().endswith(TRANSCRIPT_SUFFIXES) or names_something(transcript)
    return read_text(transcript) if named else transcript
