"""The pipeline on one page: input → script → utterance → score → performance.

`perform` is all of it. A `Take` holds what comes out and makes the rest when asked: faces, pictures, files.
"""

from __future__ import annotations

from dataclasses import replace

from . import channels
from .blend import Plan, performance_after
from .core.performance import announced
from .core.progress import Progress, quiet
from .core.score import Score
from .core.utterance import Utterance
from .rules.emotions import Displays
from .rules.profiles import attitude, profile_of
from .rules.rule_set import emotions_of, rule_set_of
from .script import Script
from .settings import Settings
from .speech import VOICE_SETTINGS, Input, SpokenBefore, feelings, hear, read, say
from .take import Take, lip_rig, with_profile
from .unread import refuse_unread


def perform(given: Input, emotions: Displays, settings: Settings, progress: Progress = quiet) -> Take:
    """Perform a text, a script or a recording, showing `emotions` beside those that it marks."""
    with emotions_of(settings.rules, settings.expression):  # a fault in it is told before anything is spoken
        source = read(given)
        refuse_unread(source, settings)
        settings = with_profile(settings)
        if isinstance(source, Script):
            script, utterance = source, speak(source, emotions, settings, progress, given.before)
        else:
            script, utterance = hear(source, progress)
        score = compose(script, utterance, emotions, settings)
    return combine(announced(score, settings.fps, progress), settings, utterance)


def speak(
    script: Script, emotions: Displays, settings: Settings, progress: Progress, before: SpokenBefore | None
) -> Utterance | None:
    """Speak a script with a synthesized voice, coloured by emotions; None if it says nothing."""
    felt = feelings(script, emotions) if settings.voice_emotion else ()
    voice = {name: getattr(settings, name) for name in VOICE_SETTINGS}
    return say(script, felt=felt, progress=progress, before=before, **voice) if script.lines else None


def compose(script: Script, utterance: Utterance | None, emotions: Displays, settings: Settings) -> Score:
    """Derive the movements of all channels from the utterance, if any, and the marks."""
    with emotions_of(settings.rules, settings.expression):
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
    known = earlier.planned if earlier else None
    plan = Plan(score, lip_rig(score, settings.head), known)
    performance = performance_after(plan, settings.fps, known, earlier.performance if earlier else None)
    return Take(performance, settings, utterance, planned=plan)
