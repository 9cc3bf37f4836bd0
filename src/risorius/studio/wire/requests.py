"""The messages of a page's requests; `request_table` has a row for each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any, Literal, cast

from ...core.edits import Add, ClearKeys, Delete, Edit, Keys, Move, Retarget, Stretch
from ...core.units import Seconds, Share
from ...errors import InputError, unknown
from ...reading.hints import Range, Then
from ...reading.schema import converter
from .choices import export_class
from .marks import LaneStates, Markers
from .shared import Choices, EmotionSpan, Source, Whole
from .views import PageView


@dataclass(frozen=True, slots=True)
class Open:
    """Ask for the session's state; answered by State."""


@dataclass(frozen=True, slots=True)
class Perform:
    """Perform a script; edits follow its words, and those that do not fit are `lost`. Answered by TakeView.

    The voice is synthesized only if something that it depends on has changed.
    """

    source: Source
    choices: Choices = field(default_factory=Choices)
    emotions: tuple[EmotionSpan, ...] = ()


@dataclass(frozen=True, slots=True)
class Prepare:
    """Prepare the answer to Perform with the same fields if the script is short. Always answered by Done."""

    source: Source
    choices: Choices = field(default_factory=Choices)
    emotions: tuple[EmotionSpan, ...] = ()


@dataclass(frozen=True, slots=True)
class SaveDraft:
    """Save a text that is written but not performed, with the fields of Perform; State has it until then."""

    source: Source
    choices: Choices = field(default_factory=Choices)
    emotions: tuple[EmotionSpan, ...] = ()


@dataclass(frozen=True, slots=True)
class Stop:
    """Stop a request of this page by its number: it is refused with `stopped`, and nothing changes.

    Performing can be stopped, as long as it is not done. Answered by Done, also if there is nothing to stop.
    """

    request: Annotated[int, Range(0, 2**53)]


@dataclass(frozen=True, slots=True)
class Choose:
    """Perform the same script with other choices or emotions; null keeps them. Answered by TakeView."""

    choices: Choices | None = None
    emotions: tuple[EmotionSpan, ...] | None = None


@dataclass(frozen=True, slots=True)
class Relabel:
    """Have a phone, by its index, begin at a time, or again where it was found if that is null.

    The sound stays; all that hangs on the phones follows. Answered by TakeView.
    """

    phone: Whole
    start: Seconds | None = None


EDITS: Mapping[str, type] = {
    "move": Move,
    "stretch": Stretch,
    "retarget": Retarget,
    "add": Add,
    "delete": Delete,
    "keys": Keys,
    "clear_keys": ClearKeys,
}
"""The kinds of `{"do": "edit", "kind": KIND, …}`, which are the library's own; answered by TakeChange."""


def edit_of(members: Mapping[str, object]) -> Edit:
    """Return the edit whose `kind` and fields these are."""
    kind = members.get("kind")
    if not isinstance(kind, str) or kind not in EDITS:
        raise InputError(unknown("kind of edit", str(kind)[:40], EDITS))
    fields = {name: value for name, value in members.items() if name != "kind" and value is not None}
    return cast(Edit, converter(EDITS[kind])(fields))


AnyEdit = Annotated[Edit, Then(edit_of, of=Mapping[str, object])]


@dataclass(frozen=True, slots=True)
class EditAll:
    """Make several edits as one change, or none if one does not fit; answered by TakeChange."""

    edits: tuple[AnyEdit, ...]


@dataclass(frozen=True, slots=True)
class Preview:
    """Ask for the effect of an edit without applying it: `{"do": "preview", "kind": KIND, …}`.

    Answered by Previewed. With `face`, a time, the face held at that time is sent before the answer.
    """

    edit: Edit
    face: Seconds | None = None


@dataclass(frozen=True, slots=True)
class PreviewAll:
    """Ask for the effect of several edits as one change, as Preview does for one; answered by Previewed."""

    edits: tuple[AnyEdit, ...]
    face: Seconds | None = None


@dataclass(frozen=True, slots=True)
class SetMarkers:
    """Set all markers of the line; they follow its words when the text changes. Answered by TakeChange."""

    markers: Markers


@dataclass(frozen=True, slots=True)
class SetLanes:
    """Say which lanes are muted, solo and locked; answered by TakeChange."""

    lanes: LaneStates


@dataclass(frozen=True, slots=True)
class BringBack:
    """Make a change again that did not fit a new plan, by its number in `lost`; answered by TakeChange."""

    number: Whole


@dataclass(frozen=True, slots=True)
class LetGo:
    """Forget the changes that did not fit; answered by TakeChange."""


@dataclass(frozen=True, slots=True)
class Undo:
    """Undo the last change; answered by TakeChange.

    `opened`: go back to what was here before a project was opened, with all that was changed since.
    """

    opened: bool = False


@dataclass(frozen=True, slots=True)
class Redo:
    """Redo the change that was undone last; answered by TakeChange."""


@dataclass(frozen=True, slots=True)
class Faces:
    """Send the faces of frames [first, last) of a take in binary messages; answered when all are sent.

    A new request for the same take replaces the previous one, which is then answered with the count of faces
    sent so far. With `pace`, at most that many frames a second are sent after those of the first second.
    """

    take: Whole
    first: Whole
    last: Whole
    pace: Annotated[float, Range(1.0, 1e6)] | None = None


@dataclass(frozen=True, slots=True)
class FaceAt:
    """Send the face of the frame nearest to a time.

    `still`: as if the face were held there, with the skin at rest. This is much faster: it is for scrubbing.
    """

    take: Whole
    time: Seconds
    still: bool = False


@dataclass(frozen=True, slots=True)
class Cancel:
    """Stop sending a take's faces."""

    take: Whole


@dataclass(frozen=True, slots=True)
class Dial:
    """Show a pose: parameters, action units and emotions by name. Answered by DialState; faces follow.

    `live`: the skin moves there as its springs do; otherwise the face is at rest there at once.
    """

    values: Mapping[str, float] = field(default_factory=dict)
    emotions: Mapping[str, Share] = field(default_factory=dict)
    live: bool = True
    head: str = "standard"
    age: Annotated[float, Range(0.0, 100.0)] | None = None


@dataclass(frozen=True, slots=True)
class SavePose:
    """Save the dialled face under a name, as a pose or as an emotion; answered by PoseFile."""

    name: str
    kind: Literal["pose", "emotion"]
    values: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Explain:
    """Explain the value of a parameter, or of all that move if it is null; answered by Explanations."""

    take: Whole
    time: Seconds
    parameter: str | None = None


@dataclass(frozen=True, slots=True)
class ChannelCurves:
    """Request each channel's curve of a parameter, asked and applied; answered by ParameterDetail."""

    take: Whole
    parameter: str


@dataclass(frozen=True, slots=True)
class Compare:
    """Perform the session's script with other choices, as a second take; answered by TakeView."""

    choices: Choices
    emotions: tuple[EmotionSpan, ...] | None = None


@dataclass(frozen=True, slots=True)
class ProfileText:
    """Ask for a profile as TOML, with numbers changed by dotted key ("blinks.wait"); answered by ProfileFile.

    `base`: the name of the profile to start from. `name`: the name of the new one.
    """

    base: str
    name: str
    numbers: Mapping[str, float] = field(default_factory=dict)


if TYPE_CHECKING:
    Export = Any
else:
    Export = export_class(
        __name__,
        [("take", Whole), ("suffixes", tuple[str, ...]), ("name", str, field(default="performance"))],
    )


@dataclass(frozen=True, slots=True)
class CancelExport:
    """Stop an export."""

    job: Whole


@dataclass(frozen=True, slots=True)
class Project:
    """Ask for the project file; answered by Download."""


@dataclass(frozen=True, slots=True)
class SaveView:
    """Save the page's view (camera, tab, playhead …) with the project."""

    view: PageView
