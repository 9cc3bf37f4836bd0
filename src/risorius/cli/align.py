"""`risorius align`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ..errors import OutputError
from .console import Console
from .options import Command, check_outputs, output_option, setting_options
from .outputs import written


@click.command(cls=Command, short_help="Find the times of the words and phones of a recording.")
@click.argument("audio")
@click.argument("transcript", required=False)
@output_option
@setting_options(names=("language", "format", "keep_tags"))
def align(audio: str, transcript: str | None, outputs: tuple[Path, ...], **chosen: Any) -> None:
    """Find when each word and phone of TRANSCRIPT (a text, or a file) is spoken in AUDIO.

    Correct the TextGrid in Praat, then perform it: risorius speak x.TextGrid --audio x.wav. Without a
    TRANSCRIPT the words are recognized, as English.
    """
    if not outputs:
        raise OutputError("no output named; expected -o x.TextGrid")
    with Console() as console, written(console, outputs) as files:
        from ..api import align as find
        from ..speech.prosody import speech_rate

        check_outputs(files, available=("speech",))
        take = find(audio, transcript, **chosen, progress=console.progress)
        take.write(*files)
        if utterance := take.utterance:
            console.say(
                f"{len(utterance.words)} words, {speech_rate(utterance):.1f} syllables per second of speech"
            )
