"""How well the accents of recordings are found: beside labels, and from their first phrase on.

Run from the repository's root: `.venv/bin/python benchmarks/accents.py FOLDER`, FOLDER in TIMIT's layout with
`.wrd`. The labels are `accents.toml`, which says how they were made; accents are compared word by word.
Each sentence is also measured as the first of all its speaker's: what follows may not change what was found.
"""

from __future__ import annotations

import collections
import sys
import tomllib
import warnings
from collections.abc import Sequence, Set
from dataclasses import replace
from pathlib import Path

from timit import RATE, sentences

from risorius.core.speech.audio import AudioWriter
from risorius.core.speech.utterance import Pause, PauseKind, Phone, Utterance
from risorius.speech.alignment import align
from risorius.speech.prosody import measured
from risorius.speech.recordings.recording import read_recording
from risorius.speech.structure.phrases import with_phrases

LABELS = Path(__file__).parent / "accents.toml"


class Score:
    """Words that are accented in the one, in the other and in both, of so many."""

    def __init__(self) -> None:
        self.both = self.found = self.expected = self.neither = 0

    def add(self, found: Set[int], expected: Set[int], words: int) -> None:
        self.both += len(found & expected)
        self.found += len(found)
        self.expected += len(expected)
        self.neither += words - len(found | expected)

    @property
    def f1(self) -> float:
        return 2 * self.both / (self.found + self.expected)

    @property
    def kappa(self) -> float:
        """Cohen's kappa."""
        words = self.found + self.expected - self.both + self.neither
        alike = (self.both + self.neither) / words
        one, other = self.found / words, self.expected / words
        chance = one * other + (1 - one) * (1 - other)
        return (alike - chance) / (1 - chance)

    def __str__(self) -> str:
        return (
            f"F1 {self.f1:.3f}, precision {self.both / self.found:.3f}, "
            f"recall {self.both / self.expected:.3f}, kappa {self.kappa:.3f}"
        )


def labelled_words(sound: Path) -> list[tuple[float, float]]:
    """Return start and end of each word, seconds."""
    path = next(p for p in sound.parent.glob(f"{sound.stem}.*") if p.suffix.lower() == ".wrd")
    return [(int(a) / RATE, int(b) / RATE) for a, b, _ in map(str.split, path.read_text().splitlines())]


def accented(said: Utterance, words: Sequence[tuple[float, float]]) -> set[int]:
    """Return the words in whose time the middle of an accented syllable lies, or which are nearest to it."""
    middles = [0.5 * (s.start + s.end) for s in (said.syllables[a.syllable] for a in said.accents)]
    return {min(range(len(words)), key=lambda i, at=at: _outside(words[i], at)) for at in middles}


def _outside(word: tuple[float, float], at: float) -> float:
    return max(word[0] - at, at - word[1], 0.0)


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


def agreement(labels: dict[str, dict[str, list[int]]], lengths: dict[str, int]) -> Score:
    """Return how far both passes of labelling agree."""
    score = Score()
    for name, words in labels["second"].items():
        score.add(set(words), set(labels["first"][name]), lengths[name])
    return score


def main(folder: Path) -> None:
    """Measure and print."""
    labels = tomllib.loads(LABELS.read_text())
    by_speaker = collections.defaultdict(list)
    for sentence in sentences(folder):
        name = f"{sentence.speaker}/{sentence.sound.stem}"
        if name in labels["first"]:
            said = align(read_recording(sentence.sound), sentence.text)
            by_speaker[sentence.speaker].append((name, labelled_words(sentence.sound), said))
    heard, first, read, changed = Score(), Score(), Score(), 0
    for spoken in by_speaker.values():
        for number, (name, words, said) in enumerate(spoken):
            others = [other for _, _, other in spoken[number + 1 :] + spoken[:number]]
            found, longer = measured(said), measured(followed(said, others))
            expected = set(labels["first"][name])
            for score, utterance in ((heard, found), (first, longer), (read, said)):
                score.add(accented(utterance, words), expected, len(words))
            changed += found.accents != longer.accents
    lengths = {name: len(words) for spoken in by_speaker.values() for name, words, _ in spoken}
    print(f"{len(lengths)} sentences, {sum(lengths.values())} words, {heard.expected} of them accented")
    print(f"two passes of labelling, {len(labels['second'])} sentences: {agreement(labels, lengths)}")
    print(f"found in the sound: {heard}")
    print(f"found in the sound, with the speaker's other sentences after it: {first}")
    print(f"by the rules of intonation, from the words alone: {read}")
    print(f"sentences with other accents when more follows: {changed}")


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    main(Path(sys.argv[1]))
