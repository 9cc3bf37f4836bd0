"""How well Italian recordings are aligned, against the times of another synthesizer than our own.

Run from the repository's root: `.venv/bin/python benchmarks/align_italian.py`. It needs Festival with its two
Italian voices (Debian: festival, festvox-italp16k, festvox-itapc16k), whose diphones were recorded by a woman
and a man and whose words' times are exact. Prints how far the starts of words are from them, how many right
transcripts were refused, and how many wrong ones (each sentence with the text of the next) were not.
"""

from __future__ import annotations

import subprocess
import tempfile
import warnings
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from risorius.core.speech.audio import Audio
from risorius.errors import InputError
from risorius.speech.alignment import align
from risorius.speech.recordings.recording import read_recording

VOICES = {"lp_diphone": "woman", "pc_diphone": "man"}
SENTENCES = (
    "Domani andiamo al mare con i bambini.",
    "La mia amica abita vicino alla stazione.",
    "Il treno per Milano parte alle nove.",
    "Ho comprato il pane e un litro di latte.",
    "Il gatto dorme sulla sedia davanti alla finestra.",
    "Vorrei un bicchiere di acqua fresca.",
    "Mio fratello lavora in una grande banca.",
    "La finestra della cucina era aperta.",
    "Nel bosco abbiamo trovato molti funghi.",
    "Il professore spiega la lezione agli studenti.",
    "Stasera mangiamo una zuppa di verdure.",
    "Le foglie cadono piano dagli alberi.",
    "Mia nonna racconta sempre belle storie.",
    "Il libro sul tavolo non era mio.",
    "Gli uccelli volano verso il sud.",
    "Abbiamo visto un film molto lungo.",
    "La bambina disegna una casa rossa.",
    "Il medico arriva fra pochi minuti.",
    "Prima di cena facciamo una passeggiata.",
    "La lettera era scritta a mano.",
)
PROGRAM = """(voice_{voice})
(set! said (Utterance Text "{text}"))
(utt.synth said)
(utt.save.wave said "{file}")
(mapcar (lambda (word) (format t "%f\\n" (item.feat word "word_start"))) (utt.relation.items said 'Word))
"""


def spoken(voice: str, text: str, folder: Path) -> tuple[Audio, list[float]]:
    """Return what Festival says, and where each word starts in it."""
    program, file = folder / "x.scm", folder / "x.wav"
    program.write_text(PROGRAM.format(voice=voice, text=text.rstrip("."), file=file))
    done = subprocess.run(["festival", "-b", str(program)], capture_output=True, text=True, check=True)
    return read_recording(file), [float(line) for line in done.stdout.split()]


def away(audio: Audio, text: str, starts: Sequence[float]) -> list[float] | None:
    """Return how far words start from where they should, in ms; None where the transcript was refused."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            words = align(audio, text, "it").words
        except InputError:
            return None
    return [1000.0 * abs(word.start - start) for word, start in zip(words, starts, strict=True)]


def main() -> None:
    for voice, who in VOICES.items():
        errors: list[float] = []
        refused = passed = 0
        with tempfile.TemporaryDirectory() as folder:
            for text, other in zip(SENTENCES, (*SENTENCES[1:], SENTENCES[0]), strict=True):
                audio, starts = spoken(voice, text, Path(folder))
                found = away(audio, text, starts)
                refused += found is None
                errors += found or []
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    try:
                        align(audio, other, "it")
                        passed += 1
                    except InputError:
                        pass
        apart = np.array(errors)
        within = ", ".join(f"{np.mean(apart <= ms):.0%} in {ms} ms" for ms in (20, 50, 100))
        print(
            f"{who}: {len(errors)} words, median {np.median(apart):.0f} ms, {within}, "
            f"worst {apart.max():.0f} ms"
        )
        print(f"    {refused} of {len(SENTENCES)} right transcripts refused, {passed} wrong ones not refused")


if __name__ == "__main__":
    main()
