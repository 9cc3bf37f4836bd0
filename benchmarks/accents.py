"""How well the accents of recordings are found, from their first phrase on.

Run from the repository's root: `.venv/bin/python benchmarks/accents.py FOLDER`, FOLDER in TIMIT's layout. No
accents are labelled there: those that the rules of intonation give the text stand in for them, so that only
differences between two figures mean something. Each sentence is measured alone, and as the first of all its
speaker's sentences: what follows may not change what was found.
"""

from __future__ import annotations

import collections
import sys
import warnings
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from timit import sentences

from risorius.core.audio import AudioWriter
from risorius.core.utterance import Pause, PauseKind, Phone, Utterance
from risorius.speech.alignment import align
from risorius.speech.prosody import measured
from risorius.speech.recordings.recording import read_recording
from risorius.speech.structure.phrases import with_phrases


def followed(first: Utterance, others: Sequence[Utterance]) -> Utterance:
    """Return an utterance whose sound goes on with that of others, of which no word is known."""
    with AudioWriter(first.audio.sample_rate) as writer:
        for said in (first, *others):
            writer.append(said.audio.read())
        audio = writer.finish()
    *phones, last = first.phones
    end = first.pauses[-1]
    longer = replace(last, end=audio.duration) if not last.symbol else last
    silence = () if not last.symbol else (Phone("", last.end, audio.duration),)
    pauses = (*first.pauses[:-1], Pause(end.start, audio.duration, PauseKind.FINAL))
    said = replace(first, audio=audio, phones=(*phones, longer, *silence), pauses=pauses, phrases=())
    return with_phrases(said)


class Score:
    """Accents found, expected, and both, by syllable."""

    def __init__(self) -> None:
        self.both = self.found = self.expected = 0

    def add(self, found: Utterance, expected: Utterance) -> None:
        ours, theirs = ({a.syllable for a in said.accents} for said in (found, expected))
        self.both += len(ours & theirs)
        self.found += len(ours)
        self.expected += len(theirs)

    def __str__(self) -> str:
        return (
            f"F1 {2 * self.both / (self.found + self.expected):.3f}, "
            f"precision {self.both / self.found:.3f}, recall {self.both / self.expected:.3f}"
        )


def main(folder: Path) -> None:
    """Measure and print."""
    by_speaker = collections.defaultdict(list)
    for sentence in sentences(folder):
        by_speaker[sentence.speaker].append(align(read_recording(sentence.sound), sentence.text))
    alone, first, changed = Score(), Score(), 0
    for spoken in by_speaker.values():
        for number, said in enumerate(spoken):
            found = measured(said)
            longer = measured(followed(said, spoken[number + 1 :] + spoken[:number]))
            alone.add(found, said)
            first.add(longer, said)
            changed += found.accents != longer.accents
    print(f"alone: {alone}\nfirst: {first}\nsentences with other accents when more follows: {changed}")


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    main(Path(sys.argv[1]))
