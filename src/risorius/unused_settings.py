"""Reject settings that nothing reads, by name; a setting counts as given unless it is the default."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from .errors import Place, UnusedSettingError
from .ports.formats import FileFormat, Need
from .settings import Settings
from .settings.declare import Row, Stage, rows

if TYPE_CHECKING:
    from .speech import SpeechSource

SHOWN = (Stage.HEAD, Stage.SHAPE, Stage.SKIN, Stage.APPEARANCE, Stage.PICTURE)


@dataclass(frozen=True, slots=True)
class InputKind:
    """Something that is performed: `what` it is, the `stages` that it goes through, and why no others.

    `also`: settings of other stages that it reads.
    """

    what: str
    stages: Collection[Stage]
    reason: str
    also: Collection[str] = ()


SCORE = InputKind(
    "a score",
    (Stage.COMBINE, Stage.FRAMES, *SHOWN, Stage.OUTPUT),
    "the movements of a score are planned already; expected only e.g. conflict, fps or head",
    ("rules",),
)
PERFORMANCE = InputKind(
    "a performance",
    (*SHOWN, Stage.OUTPUT),
    "the curves of a performance are final; expected only head, skin or pictures",
)
CAPTURE = InputKind(
    "a captured face",
    (Stage.FRAMES, *SHOWN, Stage.OUTPUT),
    "a captured face is not spoken, planned or combined; expected only fps, head, skin or pictures",
)
RECORDING = InputKind(
    "a recording",
    [stage for stage in Stage if stage is not Stage.VOICE],
    "the voice is recorded; expected no option of a synthesized voice",
    ("language", "format", "keep_tags"),
)
LABELS = InputKind(
    "a TextGrid",
    RECORDING.stages,
    "the words are timed by a TextGrid; expected no option of a synthesized voice",
)
SILENCE = InputKind(
    "a script that says nothing",
    RECORDING.stages,
    "the script has no words; expected no option of a voice",
)
POSE = InputKind(
    "a pose",
    SHOWN,
    "a pose is one face at rest; expected only head, skin or pictures",
    ("rules", "names"),
)
CHARACTER = InputKind(
    "a character",
    (Stage.HEAD, Stage.SHAPE),
    "a character is compared with a head; expected only head, age or shape",
)
INPUTS = (RECORDING, LABELS, SILENCE, SCORE, PERFORMANCE, CAPTURE, POSE, CHARACTER)
RECOGNIZED = "words are recognized as English only; expected a transcript as well"
SCHEDULED = "the times of this script are absolute; silence is added around plain text only"


_SAID = (Stage.VOICE,)
_MOVED = (*_SAID, Stage.PLAN, Stage.COMBINE)
_CURVED = (*_MOVED, Stage.FRAMES, Stage.HEAD)
_SOLVED = (*_CURVED, Stage.SHAPE, Stage.SKIN)
NEEDED: Mapping[Need, Collection[Stage]] = {
    Need.SPEECH: _SAID,
    Need.MOVEMENTS: _MOVED,
    Need.CURVES: _CURVED,
    Need.VERTICES: _SOLVED,
    Need.HEAD: _SOLVED,
    Need.PIXELS: (*_SOLVED, Stage.APPEARANCE, Stage.PICTURE),
}
"""The stages whose settings change a file that needs something."""
UNWRITTEN: Mapping[Stage, str] = {
    Stage.VOICE: "no output depends on the voice; expected e.g. -o x.wav",
    Stage.PLAN: "no output has movements; expected e.g. -o x.score.json",
    Stage.COMBINE: "no output has movements; expected e.g. -o x.muscles.csv",
    Stage.FRAMES: "no output has frames; expected e.g. -o x.muscles.csv",
    Stage.HEAD: "no output depends on the head; expected e.g. -o x.glb",
    Stage.SHAPE: "no output depends on the shape of the head; expected e.g. -o x.glb",
    Stage.SKIN: "no output shows the skin; expected e.g. -o x.glb",
    Stage.APPEARANCE: "no output shows hair or complexion; expected e.g. -o x.png",
    Stage.PICTURE: "no output is a picture or a video; expected e.g. -o x.mp4",
    Stage.OUTPUT: "no output is a single picture; expected -o x.png",
}
UNREAD: Mapping[str, str] = {"names": "no output has expressions of VRM; expected -o x.vrma"}
"""Reasons of single settings, in place of their stage's."""


def chosen(settings: Settings) -> Iterator[str]:
    """Yield the names of the settings that are not the default; those of `look` and `blend` by their own."""
    for name, row in rows(Settings).items():
        value = _value(settings, row)
        if value != row.default and not (_is_empty(value) and _is_empty(row.default)):
            yield name


def reject_unwritten(
    settings: Settings, formats: Iterable[FileFormat], read_by: Mapping[str, Stage] = MappingProxyType({})
) -> None:
    """Raise UnusedSettingError for settings that change none of the files that are written.

    `read_by`: the stage that reads a setting, if it is another one than for a script.
    """
    formats = tuple(formats)
    data = {Need(name) for written in formats for name in (*written.needs, *written.uses)}
    stages = {stage for need in data for stage in NEEDED[need]}
    names = {name for written in formats for name in written.reads}
    by_stage = {name: read_by.get(name, row.entry.stage) for name, row in rows(Settings).items()}
    unused = [n for n in chosen(settings) if n not in names and by_stage[n] not in stages]
    if unused:
        first = unused[0]
        raise UnusedSettingError(unused, UNREAD.get(first) or UNWRITTEN[by_stage[first]])


def values_read(settings: Settings, stage: Stage) -> tuple[object, ...]:
    """Return the values of the settings that a stage reads: as long as they are equal, so is its result."""
    table = rows(Settings).values()
    return tuple(_value(settings, row) for row in table if row.entry.stage is stage)


def reject(settings: Settings, kind: InputKind, place: Place | None = None, **arguments: object) -> None:
    """Raise UnusedSettingError for settings that no stage of an input reads, and for `arguments` except None
    and ().
    """
    unused = [name for name, value in arguments.items() if value is not None and value != ()]
    unused += [
        name
        for name in chosen(settings)
        if rows(Settings)[name].entry.stage not in kind.stages and name not in kind.also
    ]
    if unused:
        raise UnusedSettingError(unused, kind.reason, place)


def reject_unused(source: SpeechSource, settings: Settings) -> None:
    """Raise UnusedSettingError for settings of a synthesized voice that a source has no use for."""
    from .speech import LabelledRecording, Recording  # loaded already by what made the source

    if isinstance(source, Recording):
        reject(settings, RECORDING, Place(str(source.audio)))
        unread = [name for name in chosen(settings) if name in RECORDING.also]
        if unread and source.transcript is None and source.script is None:
            raise UnusedSettingError(unread, RECOGNIZED, Place(str(source.audio)))
    elif isinstance(source, LabelledRecording):
        kind = LABELS if source.audio is None else replace(RECORDING, also=())
        reject(settings, kind, Place(str(source.audio or source.labels)))
    elif not source.lines:
        reject(settings, SILENCE)
    elif source.timed:
        unused = [name for name in chosen(settings) if name in ("lead", "tail")]
        if unused:
            raise UnusedSettingError(unused, SCHEDULED)


def _value(settings: Settings, row: Row) -> Any:
    return getattr(settings if row.owner == row.name else getattr(settings, row.owner), row.name)


def _is_empty(value: object) -> bool:
    return isinstance(value, Collection) and not value
