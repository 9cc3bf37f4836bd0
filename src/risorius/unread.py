"""Settings that nothing reads are refused by name: a setting counts as given where it is not the default."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import fields, is_dataclass
from enum import StrEnum
from typing import Any

from .errors import Place, UnreadError
from .script import Script
from .settings import Settings
from .speech import LabelledRecording, Recording


class Stage(StrEnum):
    """The stages of a performance that read settings."""

    VOICE = "voice"
    PLAN = "plan"
    COMBINE = "combine"
    FRAMES = "frames"
    HEAD = "head"
    SKIN = "skin"
    LOOK = "look"
    OUTPUT = "output"


PLANNING = (Stage.VOICE, Stage.PLAN)
LATER = "expected only what acts after the plan, such as conflict, fps, head or size"
SCORE = f"the movements of a score are planned; {LATER}"
CAPTURED = "a captured face is not spoken, planned or combined; expected only fps, head, skin or pictures"
PERFORMED = "the curves of a performance stay as they are; expected only head, skin or pictures"
RECORDED = "the voice is recorded; expected no choice of a synthesized one"
TIMED = "the words are timed by a TextGrid; expected no choice of a synthesized voice"
SILENT = "the script says nothing; expected no choice of a voice"
SCHEDULED = "the times of this script are absolute; expected them where silence is added around plain text"
MEASURED = "a character is measured by a head; expected only head, age or shape"
HELD = "a pose is one face at rest; expected only head, skin or pictures"
"""Why nothing reads a setting, and what is expected instead."""

READERS: Mapping[str, Stage] = {
    **dict.fromkeys(("voice", "language", "rate", "voice_emotion", "lead", "tail"), Stage.VOICE),
    **dict.fromkeys(("articulation", "manner", "lively", "seed", "without"), Stage.PLAN),
    **dict.fromkeys(("profile", "attitudes", "rules"), Stage.PLAN),
    "blend": Stage.COMBINE,
    "fps": Stage.FRAMES,
    **dict.fromkeys(("head", "age", "shape"), Stage.HEAD),
    **dict.fromkeys(("wrinkles", "dynamics"), Stage.SKIN),
    **dict.fromkeys(("look", "size"), Stage.LOOK),
    **dict.fromkeys(("at", "every"), Stage.OUTPUT),
}
"""The stage that reads each field of `Settings`."""


def chosen(settings: Settings) -> Iterator[str]:
    """Yield the names of the settings that are not the default; those of `look` and `blend` by their own."""
    yield from (name for name, _ in _chosen(settings, Settings()))


def values_read(settings: Settings, stage: Stage) -> tuple[object, ...]:
    """Return the values of the settings that a stage reads: as long as they are equal, so is its result."""
    return tuple(getattr(settings, name) for name, reader in READERS.items() if reader is stage)


def refuse_all_but(
    settings: Settings, stages: Collection[Stage], reason: str, place: Place | None = None
) -> None:
    """Raise UnreadError for settings that none of `stages` reads."""
    refuse_stages(settings, [stage for stage in Stage if stage not in stages], reason, place)


def refuse_stages(
    settings: Settings,
    stages: Collection[Stage],
    reason: str,
    place: Place | None = None,
    **arguments: object,
) -> None:
    """Raise UnreadError for settings that `stages` alone would read, and for any of `arguments` that is
    neither None nor empty.
    """
    given = [name for name, value in arguments.items() if value is not None and value != ()]
    given += [name for name, owner in _chosen(settings, Settings()) if READERS[owner] in stages]
    if given:
        raise UnreadError(given, reason, place)


def refuse(settings: Settings, names: Collection[str], reason: str, place: Place | None = None) -> None:
    """Raise UnreadError for settings among `names` that are not the default."""
    given = [name for name in chosen(settings) if name in names]
    if given:
        raise UnreadError(given, reason, place)


def refuse_unread(source: Script | Recording | LabelledRecording, settings: Settings) -> None:
    """Raise UnreadError for settings of a synthesized voice that a source has no use for."""
    if isinstance(source, Recording):
        refuse_stages(settings, [Stage.VOICE], RECORDED, Place(str(source.audio)))
    elif isinstance(source, LabelledRecording):
        reason = TIMED if source.audio is None else RECORDED
        refuse_stages(settings, [Stage.VOICE], reason, Place(str(source.audio or source.labels)))
    elif not source.lines:
        refuse_stages(settings, [Stage.VOICE], SILENT)
    elif source.timed:
        refuse(settings, ("lead", "tail"), SCHEDULED)


def _chosen(settings: Any, default: Any) -> Iterator[tuple[str, str]]:
    """Yield each changed setting's own name and the field of `Settings` that it stands in."""
    for f in fields(default):
        value, usual = getattr(settings, f.name), getattr(default, f.name)
        if is_dataclass(usual):
            yield from ((name, f.name) for name, _ in _chosen(value, usual))
        elif value != usual and not (_is_empty(value) and _is_empty(usual)):
            yield f.name, f.name


def _is_empty(value: object) -> bool:
    return isinstance(value, Collection) and not value
