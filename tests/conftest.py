"""Shared builders: small utterances that need no speech engine."""

from __future__ import annotations

import gc
import os
import re
from collections.abc import Callable, Generator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import settings

from risorius.api import speak
from risorius.cli import STRICT
from risorius.core.speech.audio import silence
from risorius.core.speech.utterance import (
    Accent,
    Boundary,
    Pause,
    PauseKind,
    Phone,
    Syllable,
    Utterance,
    Word,
)
from risorius.settings import Settings
from risorius.speech.structure.phrases import with_phrases
from risorius.take import Take

from . import profiles  # noqa: F401  (registers them)
from .schedule import FilesInOrder, begun_elsewhere, in_order

VOWELS = frozenset({"AA", "AE", "AH", "AO", "AW", "AY", "EH", "ER", "EY", "IH", "IY", "OW", "OY", "UH", "UW"})
UtteranceMaker = Callable[..., Utterance]


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--full", action="store_true", help="run also what takes long, and more examples")


def pytest_configure(config: pytest.Config) -> None:
    # What the command line says in one line if nobody foresaw it is a failure of the program.
    os.environ[STRICT] = "1"
    settings.load_profile("full" if config.getoption("full") else "everyday")


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(collector: pytest.Collector) -> Generator[None, pytest.CollectReport, object]:
    report = yield
    if isinstance(collector, pytest.Directory):
        report.result = begun_elsewhere(report.result)
    return report


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out what is marked `full`, unless it is asked for, and put what takes longest first."""
    left_out = [] if config.getoption("full") else [i for i in items if i.get_closest_marker("full")]
    if left_out:
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if not item.get_closest_marker("full")]
    items[:] = in_order(items)


def pytest_collection_finish() -> None:
    """Leave the tests themselves, which live to the end, out of all later collections of garbage."""
    gc.freeze()


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: object) -> FilesInOrder:
    return FilesInOrder(config, log)


@pytest.fixture
def utterance_of() -> UtteranceMaker:
    """Return a function from ARPAbet symbols ("_" for a pause) to an utterance, a word per phone."""

    def make(symbols: str, seconds: float = 0.1, lead: float = 0.5, tail: float = 0.5) -> Utterance:
        rate = 22_050
        spans: list[tuple[str, float]] = [("", lead)]
        spans += [("" if s == "_" else s, 0.2 if s == "_" else seconds) for s in symbols.split()]
        spans.append(("", tail))
        phones: list[Phone] = []
        words: list[Word] = []
        pauses: list[Pause] = []
        edge = 0
        for number, (symbol, length) in enumerate(spans):
            start, edge = edge / rate, edge + round(length * rate)
            end = edge / rate
            if symbol:
                stress = 2 if symbol in VOWELS else -1
                phones.append(Phone(symbol, start, end, stress, len(words)))
                words.append(Word(symbol.lower(), start, end, number, number + 1, number, number + 1))
            else:
                kind = PauseKind.INITIAL if number == 0 else PauseKind.COMMA
                kind = PauseKind.FINAL if number == len(spans) - 1 else kind
                phones.append(Phone("", start, end))
                pauses.append(Pause(start, end, kind))
        text = " ".join(w.text for w in words)
        audio = silence(edge / rate, rate)
        said = Utterance(text, "en-us", audio, tuple(phones), tuple(words), pauses=tuple(pauses))
        return with_phrases(said)

    return make


@pytest.fixture(scope="session")
def clip() -> Take:
    """A short sentence, performed by the standard head without inertia at 10 frames per second."""
    settings = Settings(fps=Fraction(10), dynamics="static", lead=0.3, tail=0.3)
    return speak("Oh, my mother!", emotion={"happiness": 0.5}, settings=settings)


@pytest.fixture
def rules_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The rules that `tests.setting_cases` names, in the current folder."""
    monkeypatch.chdir(tmp_path)
    Path("mine.toml").write_text('delete = ["signals", "gaze"]\n')


_PAUSES = {
    ",": PauseKind.COMMA,
    ".": PauseKind.FULL_STOP,
    "?": PauseKind.QUESTION,
    "!": PauseKind.EXCLAMATION,
    "…": PauseKind.HESITATION,
}
_TOKEN = re.compile(r"(?P<text>[\w']+)(?:\[(?P<tone>[^\]]*)\])?(?P<mark>[,.?!…]?)(?P<gap>\s*)")


@pytest.fixture(scope="session")
def sentence_of() -> UtteranceMaker:
    """Return a function from marked text to an utterance: a syllable /D AA/ per word.

    `[H*]` after a word accents it, the last one before a pause being nuclear; punctuation makes a pause of
    0.3 s, or of `pause`, after the last word of that and `tail`; the boundary tone after it is L-L%.
    """

    def make(
        marked: str, *, phone: float = 0.12, lead: float = 0.5, tail: float = 0.7, pause: float = 0.3
    ) -> Utterance:
        said = _Said(phone, pause)
        said.silence(lead, PauseKind.INITIAL)
        for token in _TOKEN.finditer(marked):
            said.word(token["text"], token["tone"], token["mark"], token["gap"])
        said.end(tail)
        return said.utterance()

    return make


class _Said:
    """Collects an utterance word by word."""

    def __init__(self, phone: float, pause: float) -> None:
        self.phone, self.pause, self.text = phone, pause, ""
        self.phones: list[Phone] = []
        self.words: list[Word] = []
        self.syllables: list[Syllable] = []
        self.pauses: list[Pause] = []
        self.accents: list[Accent] = []
        self.boundaries: list[Boundary] = []

    def _add(self, symbol: str, seconds: float, stress: int = -1, word: int = -1) -> Phone:
        start = self.phones[-1].end if self.phones else 0.0
        self.phones.append(Phone(symbol, start, round(start + seconds, 9), stress, word))
        return self.phones[-1]

    def silence(self, seconds: float, kind: PauseKind) -> None:
        found = self._add("", seconds)
        self.pauses.append(Pause(found.start, found.end, kind))

    def end(self, seconds: float) -> None:
        """Make the last silence so much longer."""
        if self.phones[-1].symbol:
            self.silence(seconds, PauseKind.FINAL)
            return
        end = round(self.phones[-1].end + seconds, 9)
        self.phones[-1] = replace(self.phones[-1], end=end)
        self.pauses[-1] = replace(self.pauses[-1], end=end)

    def word(self, text: str, tone: str | None, mark: str, gap: str) -> None:
        number, first = len(self.words), len(self.phones)
        stress = 2 if tone else 1
        start = self._add("D", self.phone, word=number).start
        end = self._add("AA", self.phone, stress, number).end
        self.syllables.append(Syllable(first, first + 2, start, end, stress, number))
        at = len(self.text)
        self.words.append(Word(text, start, end, first, first + 2, at, at + len(text)))
        self.text += text + mark + gap
        if tone:
            self.accents.append(Accent(start + 1.5 * self.phone, number, number, tone))
        if mark:
            self._end_phrase(number, end)
            self.silence(self.pause, _PAUSES[mark])

    def _end_phrase(self, word: int, end: float) -> None:
        self.boundaries.append(Boundary(end, word, "L-L%"))
        if self.accents and not self.accents[-1].nuclear:
            self.accents[-1] = replace(self.accents[-1], nuclear=True)

    def utterance(self) -> Utterance:
        audio = silence(self.phones[-1].end, 1000)
        last = replace(self.phones[-1], end=audio.duration)
        said = Utterance(
            self.text.rstrip(" "), "en-us", audio, (*self.phones[:-1], last), tuple(self.words),
            tuple(self.syllables), tuple(self.pauses), tuple(self.accents), tuple(self.boundaries),
        )  # fmt: skip
        return with_phrases(said)
