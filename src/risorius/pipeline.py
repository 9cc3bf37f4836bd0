"""The pipeline on one page: script → utterance → score → performance.

`perform` is all of it. A `Take` holds what comes out and makes the rest when asked: faces, pictures, files.
"""

from __future__ import annotations

from dataclasses import replace

from . import channels
from .blend import Plan, recombine
from .core.performance import announced
from .core.progress import Progress, quiet
from .core.score import Score
from .core.speech.utterance import Utterance
from .rules.emotions import Displays
from .rules.profiles import attitude, profile_of
from .rules.rule_set import emotions_of, rule_set_of
from .script import Script
from .settings import Settings
from .speech import VOICE_SETTINGS, SpeechSource, SynthesisCache, align_recording, feelings, synthesize_script
from .take import Take, lip_rig, with_profile


def perform(
    source: SpeechSource,
    emotions: Displays,
    settings: Settings,
    progress: Progress = quiet,
    before: SynthesisCache | None = None,
) -> Take:
    """Perform a script or a recording, showing `emotions` beside those that it marks.

    What was spoken `before` is not spoken again; what is spoken is added to it.
    """
    with emotions_of(settings.rules, settings.expression, settings.overwhelmed):
        settings = with_profile(settings)
        if isinstance(source, Script):
            script, utterance = source, speak(source, emotions, settings, progress, before)
        else:
            script, utterance = align_recording(source, progress)
        score = compose(script, utterance, emotions, settings)
    return combine(announced(score, settings.fps, progress), settings, utterance)


def speak(
    script: Script, emotions: Displays, settings: Settings, progress: Progress, before: SynthesisCache | None
) -> Utterance | None:
    """Speak a script with a synthesized voice, coloured by emotions; None if it says nothing."""
    felt = feelings(script, emotions) if settings.voice_emotion else ()
    voice = {name: getattr(settings, name) for name in VOICE_SETTINGS}
    if not script.lines:
        return None
    return synthesize_script(script, felt=felt, progress=progress, before=before, **voice)


def compose(script: Script, utterance: Utterance | None, emotions: Displays, settings: Settings) -> Score:
    """Derive the movements of all channels from the utterance, if any, and the marks."""
    with emotions_of(settings.rules, settings.expression, settings.overwhelmed):
        inputs = replace(
            channels.inputs_of(script, utterance, emotions),
            articulation=settings.articulation,
            manner=settings.manner,
            lively=settings.lively,
            profile=profile_of(settings.profile, settings.blinks),
            attitudes=tuple(attitude(name) for name in settings.attitudes),
            rules=rule_set_of(settings.rules),
        )
        blend = settings.blend.planned()
        return channels.compose(inputs, seed=settings.seed, without=settings.without, settings=blend)


def combine(
    score: Score, settings: Settings, utterance: Utterance | None = None, earlier: Take | None = None
) -> Take:
    """Combine movements into curves; parts that an `earlier` take has in common with this one are reused."""
    planned = earlier.planned if earlier else None
    plan = Plan(score, lip_rig(score, settings.head), planned)
    performance = recombine(plan, settings.fps, planned, earlier.performance if earlier else None)
    return Take(performance, settings, utterance, planned=plan)
