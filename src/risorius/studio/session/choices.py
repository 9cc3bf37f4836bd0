"""A page's choices as the library's settings; nothing that a page names is ever opened as a file."""

from __future__ import annotations

import json
from pathlib import Path

from ...core.score import BlendSettings
from ...errors import InputError, unknown
from ...face.head.head import shipped_heads
from ...rules.profiles import profile as named_profile
from ...rules.profiles import profile_from, profile_texts
from ...rules.rule_set import extended, shipped
from ...settings import BlendChoices, Settings
from ...settings import settings_of as settings_from
from ...settings.declare import rows
from ...speech.engines.registry import is_voice_file
from ..wire.choices import chosen_rows, on_wire
from ..wire.shared import Choices
from .session_files import kept_table

LARGEST_PROFILE = 100_000


def settings_of(choices: Choices, folder: Path) -> Settings:
    """Return the settings that `choices` mean; `folder` is the session's, for files made from them.

    Raises InputError or ParameterError for an invalid choice, the name of a file among them.
    """
    if choices.head not in shipped_heads():
        raise InputError(unknown("head", choices.head, shipped_heads()))
    if is_voice_file(choices.voice):
        raise InputError(f"voice '{choices.voice}' is a file; expected the name of a voice")
    values = {row.name: getattr(choices, row.name) for row in chosen_rows()}
    usual = {row.name: on_wire(row, row.usual) for row in chosen_rows()}
    chosen = {name: value for name, value in values.items() if value != usual[name]}
    profile, rules = _profile(choices, folder), _rules(choices.rules_off, folder)
    return settings_from({**chosen, "profile": profile, "rules": rules})


def blend_of(choices: Choices) -> BlendSettings:
    """Return how movements are combined, whatever a score says."""
    return BlendSettings(**{name: getattr(choices, name) for name in rows(BlendChoices)})


def _profile(choices: Choices, folder: Path) -> str:
    """Return a profile's name, or the file in our folder that holds the one that was edited."""
    if choices.profile_text is None:
        return named_profile(choices.profile).name
    if len(choices.profile_text) > LARGEST_PROFILE:
        raise InputError(f"the profile is longer than {LARGEST_PROFILE} characters")
    profile_from(choices.profile_text, "profile", profile_texts())
    return str(kept_table(choices.profile_text, "profile", folder))


def _rules(off: tuple[str, ...], folder: Path) -> Path | None:
    if not off:
        return None
    text = f"delete = {json.dumps(sorted(set(off)))}\n"
    # Read before it is a file: an error names the setting, not a path of this machine.
    extended(shipped(), text, "rules_off")
    return kept_table(text, "rules", folder)
