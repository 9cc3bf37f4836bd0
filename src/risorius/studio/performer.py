"""From what a page asks to a score: the voice is synthesized again only where it has to be another."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace

from ..channels import Display
from ..core.edits import identified
from ..core.progress import Progress
from ..core.utterance import Utterance
from ..errors import InputError, warnings_to
from ..pipeline import looking_like, plan, spoken
from ..ports.readable import ScoreFile
from ..rules.profiles import profile_of
from ..script import Script, parse_script
from ..settings import Settings
from ..speech.from_recording import listen
from ..speech.recordings.recording import read_recording
from . import limits
from .choices import blend_of, settings_of
from .scores import adopted, parsed, score_file
from .session_files import SessionFiles
from .version import Version
from .wire import EmotionSpan, Made, Source

_MOST_KEPT = 8
Heard = tuple[Script, Utterance | None]


class Performer:
    """Plans performances for one session; keeps the voices that it has heard. For one thread at a time."""

    def __init__(self, files: SessionFiles) -> None:
        self._files = files
        self._voices: dict[object, Heard] = {}
        self._scores: dict[Source, ScoreFile] = {}

    def perform(self, made: Made, progress: Progress) -> Version:
        """Plan what a page asks. Raises RisoriusError with one line on what is wrong."""
        if len(made.source.script) > limits.SCRIPT and made.source.format != "score":
            raise InputError(f"the script is longer than {limits.SCRIPT} characters")
        spans = tuple(replace(span, emotion=self._files.emotion(span.emotion)) for span in made.emotions)
        settings = settings_of(made.choices, self._files.folder)
        settings = looking_like(profile_of(settings.profile), settings)
        if made.source.format == "score":
            return self._scored(made, settings)
        begun = time.perf_counter()
        odd: list[str] = []
        with warnings_to(odd.append):
            script, utterance, displays = self._heard(made.source, spans, settings, progress)
            said = time.perf_counter()
            score = identified(plan(script, utterance, displays, settings))
        spent = {"voice": 1e3 * (said - begun), "plan": 1e3 * (time.perf_counter() - said)}
        return Version(made, score, score, settings, utterance, warnings=tuple(odd), milliseconds=spent)

    def adopted(self, made: Made) -> Made:
        """Return a request to perform a score with the score's own settings in its choices."""
        if made.source.format != "score":
            return made
        return replace(made, choices=adopted(made.choices, self._held(made.source).score.settings))

    def _scored(self, made: Made, settings: Settings) -> Version:
        held = self._held(made.source)
        score = identified(replace(held.score, settings=blend_of(made.choices)))
        return Version(made, score, score, settings, held.utterance)

    def _held(self, source: Source) -> ScoreFile:
        if source not in self._scores:
            self._scores = {source: self._read(source)}
        return self._scores[source]

    def _read(self, source: Source) -> ScoreFile:
        name = source.recording
        if name is None:
            return score_file(parsed(source.script), None)
        sound = read_recording(self._files.recording(name))
        held = score_file(parsed(source.script), sound.path)
        if held.utterance is None:
            return held
        # The file is there as long as this Audio of it.
        return replace(held, utterance=replace(held.utterance, audio=sound))

    def _heard(
        self, source: Source, spans: tuple[EmotionSpan, ...], settings: Settings, progress: Progress
    ) -> tuple[Script, Utterance | None, tuple[Display, ...]]:
        if source.recording is not None or source.format == "TextGrid":
            script, utterance = self._kept(source, lambda: self._recorded(source, progress))
            return script, utterance, _placed(spans, utterance)
        script = parse_script(source.script, _SUFFIX[source.format], "script")
        displays = _placed([span for span in spans if span.first is None], None)
        if len(displays) < len(spans):
            _, plain = self._voice(source, script, (), settings, progress)
            displays = _placed(spans, plain)
        _, utterance = self._voice(source, script, displays, settings, progress)
        return script, utterance, _placed(spans, utterance)

    def _voice(
        self,
        source: Source,
        script: Script,
        displays: tuple[Display, ...],
        settings: Settings,
        progress: Progress,
    ) -> Heard:
        felt = displays if settings.voice_emotion else ()
        voice = (settings.voice, settings.language, settings.rate, settings.lead, settings.tail)

        def say() -> Heard:
            progress("Speaking …")
            return script, spoken(script, felt, settings) if script.lines else None

        return self._kept((source, felt, settings.voice_emotion, *voice), say)

    def _kept(self, key: object, make: Callable[[], Heard]) -> Heard:
        if key not in self._voices:
            made = make()
            while len(self._voices) >= _MOST_KEPT:
                del self._voices[next(iter(self._voices))]
            self._voices[key] = made
        return self._voices[key]

    def _recorded(self, source: Source, progress: Progress) -> Heard:
        audio = None if source.recording is None else self._files.recording(source.recording)
        if source.format == "TextGrid":
            labels = self._files.folder / "labels.TextGrid"
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
