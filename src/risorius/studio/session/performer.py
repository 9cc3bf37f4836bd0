"""From a request to a score by the stages of the pipeline; speech that has not changed is used again."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace

from ...core.edits import identified
from ...core.progress import Progress
from ...core.speech.utterance import Utterance
from ...errors import InputError, warnings_to
from ...pipeline import compose, speak
from ...ports.import_result import ScoreFile
from ...rules.emotions import Display, Displays
from ...rules.rule_set import emotions_of
from ...script import Script, parse_script
from ...script.plain import USUAL_FORM, TextForm
from ...script.read import TEXT_READERS
from ...settings import Settings
from ...settings.declare import Stage
from ...speech import LabelledRecording, Recording, align_recording
from ...speech.recordings.recording import read_recording
from ...speech.structure.edges_moved import EdgeShift, with_edges
from ...take import with_profile
from ...unused_settings import values_read
from .. import limits
from ..wire.shared import EmotionSpan, Source, TakeInputs
from .choices import blend_of, settings_of
from .revision import Revision
from .scores import adopted, parsed, read_score
from .session_files import SessionFiles
from .stage_cache import StageCache

_MOST_VOICES = 8


class Performer:
    """Plans performances for one session and caches its speech. For one thread at a time."""

    def __init__(self, files: SessionFiles) -> None:
        self._files = files
        self._spoken: StageCache[Utterance | None] = StageCache(_MOST_VOICES)
        self._heard: StageCache[tuple[Script, Utterance]] = StageCache(_MOST_VOICES)
        self._moved: StageCache[Utterance | None] = StageCache(_MOST_VOICES)
        self._scores: StageCache[ScoreFile] = StageCache(1)

    def perform(self, inputs: TakeInputs, progress: Progress) -> Revision:
        """Plan a performance. Raises RisoriusError with one line."""
        if len(inputs.source.script) > limits.SCRIPT and inputs.source.format != "score":
            raise InputError(f"the script is longer than {limits.SCRIPT} characters")
        spans = tuple(replace(span, emotion=self._files.emotion(span.emotion)) for span in inputs.emotions)
        settings = with_profile(settings_of(inputs.choices, self._files.folder))
        if inputs.source.format == "score":
            return self._scored(inputs, settings)
        begun = time.perf_counter()
        messages: list[str] = []
        with (
            warnings_to(messages.append),
            emotions_of(settings.rules, settings.expression, settings.overwhelmed),
        ):
            script, utterance, displays = self._said(inputs.source, spans, settings, progress)
            spoken_at = time.perf_counter()
            progress("Planning …")
            score = identified(compose(script, utterance, displays, settings))
        warnings = tuple(self._files.told(line) for line in messages)
        spent = {"voice": 1e3 * (spoken_at - begun), "plan": 1e3 * (time.perf_counter() - spoken_at)}
        return Revision(inputs, score, score, settings, utterance, warnings=warnings, milliseconds=spent)

    def adopted(self, inputs: TakeInputs) -> TakeInputs:
        """Return a request to perform a score with the score's own settings in its choices."""
        if inputs.source.format != "score":
            return inputs
        return replace(
            inputs, choices=adopted(inputs.choices, self._score_file(inputs.source).score.settings)
        )

    def _scored(self, inputs: TakeInputs, settings: Settings) -> Revision:
        score_file = self._score_file(inputs.source)
        score = identified(replace(score_file.score, settings=blend_of(inputs.choices)))
        return Revision(inputs, score, score, settings, score_file.utterance)

    def _score_file(self, source: Source) -> ScoreFile:
        return self._scores.get(source, lambda: self._read(source))

    def _read(self, source: Source) -> ScoreFile:
        name = source.recording
        if name is None:
            return read_score(parsed(source.script, "score"), None)
        sound = read_recording(self._files.recording(name))
        score_file = read_score(parsed(source.script, "score"), sound.path)
        if score_file.utterance is None:
            return score_file
        # The file exists as long as this Audio.
        return replace(score_file, utterance=replace(score_file.utterance, audio=sound))

    def _said(
        self, source: Source, spans: tuple[EmotionSpan, ...], settings: Settings, progress: Progress
    ) -> tuple[Script, Utterance | None, Displays]:
        """Return a source's script, its utterance, and the places of the spans in it."""
        source, edges = replace(source, edges=()), source.edges
        if source.recording is not None or source.format == "TextGrid":
            key = source, settings.language, settings.format, settings.keep_tags
            recording = self._recording(source, settings)
            script, found = self._heard.get(key, lambda: align_recording(recording, progress))
            if isinstance(recording, Recording) and recording.script is not None:
                script = recording.script  # its marks show emotions as they are in force now
            heard = self._with_edges(key, found, edges)
            return script, heard, _placed(spans, heard)
        script = _script(source, settings)

        def spoken(displays: Displays) -> Utterance | None:
            colours = displays if settings.voice_emotion else ()
            key = (source, colours, values_read(settings, Stage.VOICE))
            said = self._spoken.get(key, lambda: speak(script, displays, settings, progress, None))
            return self._with_edges(key, said, edges)

        displays = _placed([span for span in spans if span.first is None], None)
        if len(displays) < len(spans):
            displays = _placed(spans, spoken(()))
        utterance = spoken(displays)
        return script, utterance, _placed(spans, utterance)

    def _with_edges(
        self, key: tuple[object, ...], said: Utterance | None, edges: tuple[EdgeShift, ...]
    ) -> Utterance | None:
        """Return the utterance with phone boundaries moved by hand; the same object for the same moves."""
        if said is None or not edges:
            return said
        return self._moved.get((key, edges), lambda: with_edges(said, edges))

    def _recording(self, source: Source, settings: Settings) -> Recording | LabelledRecording:
        audio = None if source.recording is None else self._files.recording(source.recording)
        if audio is not None and source.format != "TextGrid":
            written = source.script.strip() != ""
            script = _script(source, settings) if written else None
            return Recording(audio, script=script, language=settings.language if script else None)
        labels = self._files.folder / "labels.TextGrid"
        labels.write_text(source.script, encoding="utf-8")
        return LabelledRecording(str(labels), audio)


_SUFFIX = {name: f".{name}" for name in ("xml", "utt", "ssml", "bml", "apml")} | {"text": ".txt"}


def _script(source: Source, settings: Settings) -> Script:
    """Return a source's script; the form of a text is not read for other formats."""
    suffix = _SUFFIX[source.format]
    form = (
        TextForm(settings.format, settings.keep_tags, heard=source.recording is not None)
        if suffix in TEXT_READERS
        else USUAL_FORM
    )
    return parse_script(source.script, suffix, "script", form)


def _placed(spans: Sequence[EmotionSpan], utterance: Utterance | None) -> Displays:
    """Return the displays of spans; those over characters last from word to word."""
    return tuple(_display(span, utterance) for span in spans)


def _display(span: EmotionSpan, utterance: Utterance | None) -> Display:
    display = Display(span.emotion, span.intensity, span.start, span.end)
    if span.first is None or utterance is None:
        return display
    last = 2**31 if span.last is None else span.last
    words = [w for w in utterance.words if w.source_start < last and w.source_end > span.first]
    if not words:
        raise InputError(f"emotion {span.emotion}: no word stands at characters {span.first} to {last}")
    return replace(display, start=words[0].start, end=words[-1].end)
