"""From what a page asks to a score: only what has changed is done again, and never more synthesis than that."""

from __future__ import annotations

import time
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..channels import Display
from ..core.score import Score
from ..core.utterance import Utterance
from ..errors import InputError, RisoriusWarning
from ..pipeline import looking_like, plan, spoken
from ..rules.profiles import profile_of
from ..script import Script, parse_script
from ..settings import Settings
from ..speech.heard import listen
from ..take import Progress
from .choices import check_emotions, settings_of
from .wire import EmotionSpan, Made, Source

LONGEST_SCRIPT = 200_000
_MOST_KEPT = 8


@dataclass(slots=True)
class Performed:
    """What came of a request: the score as the rules made it, its settings, what is said, what was odd."""

    made: Made
    score: Score
    settings: Settings
    utterance: Utterance | None
    warnings: tuple[str, ...] = ()
    milliseconds: dict[str, float] = field(default_factory=dict)


class Performer:
    """Plans performances for one session; keeps the voices that it has heard. For one thread at a time."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._voices: dict[object, tuple[Script, Utterance | None]] = {}

    def perform(self, made: Made, progress: Progress) -> Performed:
        """Plan what a page asks. Raises RisoriusError with one line on what is wrong."""
        if len(made.source.script) > LONGEST_SCRIPT:
            raise InputError(f"the script is longer than {LONGEST_SCRIPT} characters")
        check_emotions(made.emotions)
        settings = settings_of(made.choices, self._folder)
        settings = looking_like(profile_of(settings.profile), settings)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", RisoriusWarning)
            begun = time.perf_counter()
            script, utterance, displays = self._heard(made, settings, progress)
            said = time.perf_counter()
            score = plan(script, utterance, displays, settings)
            planned = time.perf_counter()
        return Performed(
            made,
            score,
            settings,
            utterance,
            tuple(str(w.message) for w in caught if issubclass(w.category, RisoriusWarning)),
            {"voice": 1e3 * (said - begun), "plan": 1e3 * (planned - said)},
        )

    def _heard(
        self, made: Made, settings: Settings, progress: Progress
    ) -> tuple[Script, Utterance | None, tuple[Display, ...]]:
        source = made.source
        if source.recording is not None or source.format == "TextGrid":
            key: object = ("recording", source)
            script, utterance = self._kept(key, lambda: self._recorded(source, progress))
            return script, utterance, _placed(made.emotions, utterance)
        script = parse_script(source.script, _SUFFIX[source.format], "script")
        displays = _placed([span for span in made.emotions if span.first is None], None)
        if len(displays) < len(made.emotions):
            _, plain = self._voice(source, script, (), settings, progress)
            displays = _placed(made.emotions, plain)
        _, utterance = self._voice(source, script, displays, settings, progress)
        return script, utterance, _placed(made.emotions, utterance)

    def _voice(
        self,
        source: Source,
        script: Script,
        displays: tuple[Display, ...],
        settings: Settings,
        progress: Progress,
    ) -> tuple[Script, Utterance | None]:
        felt = displays if settings.voice_emotion else ()
        voice = (settings.voice, settings.language, settings.rate, settings.lead, settings.tail)

        def say() -> tuple[Script, Utterance | None]:
            progress("Speaking …")
            return script, spoken(script, felt, settings) if script.lines else None

        return self._kept((source, felt, settings.voice_emotion, *voice), say)

    def _kept(self, key, make):  # type: ignore[no-untyped-def]
        if key not in self._voices:
            made = make()
            while len(self._voices) >= _MOST_KEPT:
                del self._voices[next(iter(self._voices))]
            self._voices[key] = made
        return self._voices[key]

    def _recorded(self, source: Source, progress: Progress) -> tuple[Script, Utterance]:
        audio = None if source.recording is None else self._folder / "recordings" / source.recording
        if source.format == "TextGrid":
            labels = self._folder / "labels.TextGrid"
            labels.write_text(source.script, encoding="utf-8")
            return listen(str(labels), audio, None, progress)
        return listen(source.script or None, audio, None, progress, text=True)


_SUFFIX = {name: f".{name}" for name in ("xml", "utt", "ssml", "bml")} | {"text": ".txt"}


def _placed(spans: Sequence[EmotionSpan], utterance: Utterance | None) -> tuple[Display, ...]:
    """Return the displays of spans; those over characters last from word to word."""
    return tuple(_display(span, utterance) for span in spans)


def _display(span: EmotionSpan, utterance: Utterance | None) -> Display:
    display = Display(span.emotion, span.intensity, span.start, span.end)
    if span.first is None or utterance is None:
        return display
    last = 2**31 if span.last is None else span.last
    words = [w for w in utterance.words if w.source_start < last and w.source_end > span.first]
    if not words:
        raise InputError(f"emotion {span.emotion}: no word stands in characters {span.first} to {last}")
    return replace(display, start=words[0].start, end=words[-1].end)
