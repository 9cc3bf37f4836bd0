"""A page's choices as the library's settings; nothing that a page names is ever opened as a file."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

from ..core.look import Look
from ..core.performance import parse_fps
from ..core.score import BlendSettings
from ..errors import InputError, unknown
from ..face.head import shipped_heads
from ..rules.profiles import profile, profile_from, profile_texts
from ..settings import PLANNED, BlendChoices, Settings
from ..speech.engines.registry import is_voice_file
from .session_files import kept_table
from .wire import Choices

LARGEST_PROFILE = 100_000


def settings_of(choices: Choices, folder: Path) -> Settings:
    """Return the settings that `choices` mean; `folder` is the session's, for files made from them.

    Raises InputError or ParameterError for a choice that is none, the name of a file among them.
    """
    if choices.head not in shipped_heads():
        raise InputError(unknown("head", choices.head, shipped_heads()))
    if is_voice_file(choices.voice):
        raise InputError(f"voice '{choices.voice}' is a file; expected the name of a voice")
    return Settings(
        fps=parse_fps(choices.fps),
        head=choices.head,
        age=choices.age,
        voice=choices.voice,
        language=choices.language,
        rate=choices.rate,
        voice_emotion=choices.voice_emotion,
        lead=choices.lead,
        tail=choices.tail,
        articulation=choices.articulation,
        manner=choices.manner,
        lively=choices.lively,
        dynamics=choices.dynamics,
        without=choices.without,
        profile=_profile(choices, folder),
        attitudes=choices.attitudes,
        seed=choices.seed,
        rules=_rules(choices.rules_off, folder),
        look=Look(hair=choices.hair, complexion=choices.complexion),
        blend=_chosen_blend(choices),
    )


def _chosen_blend(choices: Choices) -> BlendChoices:
    """Return what is other than in a planned score."""
    blend, usual = asdict(blend_of(choices)), asdict(PLANNED)
    return BlendChoices(**{name: value for name, value in blend.items() if value != usual[name]})


def blend_of(choices: Choices) -> BlendSettings:
    """Return how movements are combined."""
    return BlendSettings(
        conflict=choices.conflict,
        activation_threshold=choices.activation_threshold,
        min_onset=choices.min_onset,
        min_offset=choices.min_offset,
        onset_function=choices.onset_function,
        contact=choices.contact,
        lips=choices.lips,
    )


def _profile(choices: Choices, folder: Path) -> str:
    """Return a profile's name, or the file in our folder that holds the one that was edited."""
    if choices.profile_text is None:
        return profile(choices.profile).name
    if len(choices.profile_text) > LARGEST_PROFILE:
        raise InputError(f"the profile is longer than {LARGEST_PROFILE} characters")
    profile_from(choices.profile_text, "profile", profile_texts())
    return str(kept_table(choices.profile_text, "profile", folder))


def _rules(off: tuple[str, ...], folder: Path) -> Path | None:
    if not off:
        return None
    return kept_table(f"delete = {json.dumps(sorted(set(off)))}\n", "rules", folder)
