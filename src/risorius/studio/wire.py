"""Every message between the studio's page and its server, both ways: these dataclasses are the contract.

A request is JSON `{"id": 7, "do": VERB, …fields}`, answered by `{"re": 7, "ok": {…}}` or `{"re": 7, "error":
"one line"}`; what the server says of its own accord is `{"event": NAME, …fields}`. `web/wire.js` is generated
from here. Times are seconds, curves base64 of little-endian float32.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any, Literal

from ..core.edits import Add, ClearKeys, Delete, Keys, Move, Retarget, Stretch
from ..core.hints import Range
from ..core.units import Seconds, Share
from .wire_settings import choices_class, export_class

Whole = Annotated[int, Range(0, 2**31)]
Format = Literal["text", "xml", "utt", "ssml", "bml", "score", "TextGrid"]


# --- What both sides send -------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class EmotionSpan:
    """An emotion to show, over the whole clip, over seconds, or over characters [first, last) of the text."""

    emotion: str
    intensity: Share
    start: Seconds | None = None
    end: Seconds | None = None
    first: Whole | None = None
    last: Whole | None = None


if TYPE_CHECKING:
    Choices = Any
else:
    Choices = choices_class(__name__)


@dataclass(frozen=True, slots=True)
class Source:
    """What is performed: a script as text of a format, and a recording (by the name its upload was given).

    With a recording the text is its transcript; an empty one has the words recognized.
    """

    script: str = ""
    format: Format = "text"
    recording: str | None = None


# --- Requests -------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Open:
    """Ask for the session's state; answered by State."""


@dataclass(frozen=True, slots=True)
class Perform:
    """Perform a script anew; edits of blocks that are there again are kept. Answered by TakeView.

    The voice is synthesized only if something that it depends on has changed.
    """

    source: Source
    choices: Choices = field(default_factory=Choices)
    emotions: tuple[EmotionSpan, ...] = ()


@dataclass(frozen=True, slots=True)
class Prepare:
    """Have ready what Perform with the same fields will ask, where it is short. Answered by Done, always."""

    source: Source
    choices: Choices = field(default_factory=Choices)
    emotions: tuple[EmotionSpan, ...] = ()


@dataclass(frozen=True, slots=True)
class Choose:
    """Perform the same script with other choices or emotions (those left out stay). Answered by TakeView."""

    choices: Choices | None = None
    emotions: tuple[EmotionSpan, ...] | None = None


Edit = Move | Stretch | Retarget | Add | Delete | Keys | ClearKeys

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


@dataclass(frozen=True, slots=True)
class Preview:
    """What an edit would do, which is not made: `{"do": "preview", "kind": KIND, …}` with the edit's fields.

    Answered by Previewed; with `face`, a time, the face as it would be held there then comes before.
    """

    edit: Edit
    face: Seconds | None = None


@dataclass(frozen=True, slots=True)
class Undo:
    """Take the last change back; answered by TakeChange."""


@dataclass(frozen=True, slots=True)
class Redo:
    """Make the change that was taken back last again; answered by TakeChange."""


@dataclass(frozen=True, slots=True)
class Faces:
    """Send the faces of frames [first, last) of a take, in binary messages; answered when all are sent.

    A request takes the place of the one before for the same take: that is then answered with the frames sent.
    With `pace` no more than so many frames a second are sent after those of the first second.
    """

    take: Whole
    first: Whole
    last: Whole
    pace: Annotated[float, Range(1.0, 1e6)] | None = None


@dataclass(frozen=True, slots=True)
class FaceAt:
    """Send the one face at a time, that of the nearest frame.

    `still`: as if it were held there, the skin at rest, which is there much sooner: for who scrubs.
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
    """Hold a face: parameters, action units and emotions by name; answered by DialState, and faces follow.

    `live`: the skin moves there as springs do; the face at rest there at once otherwise.
    """

    values: Mapping[str, float] = field(default_factory=dict)
    emotions: Mapping[str, Share] = field(default_factory=dict)
    live: bool = True
    head: str = "standard"
    age: Annotated[float, Range(0.0, 100.0)] | None = None


@dataclass(frozen=True, slots=True)
class SavePose:
    """Keep the dialled face under a name, as a pose or as an emotion; answered by PoseFile."""

    name: str
    kind: Literal["pose", "emotion"]
    values: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Explain:
    """Say why a parameter (all that move if null) has its value; answered by Explained."""

    take: Whole
    time: Seconds
    parameter: str | None = None


@dataclass(frozen=True, slots=True)
class ChannelCurves:
    """Ask what each channel asks of a parameter and gets, over the take; answered by ParameterDetail."""

    take: Whole
    parameter: str


@dataclass(frozen=True, slots=True)
class Compare:
    """Perform the session's script with other choices as a second take beside it; answered by TakeView."""

    choices: Choices
    emotions: tuple[EmotionSpan, ...] | None = None


@dataclass(frozen=True, slots=True)
class RulesFired:
    """Ask which rules fired where; answered by Fired."""

    take: Whole


@dataclass(frozen=True, slots=True)
class ProfileText:
    """Ask for a profile as TOML, with numbers changed by dotted key ("blinks.wait"); answered by ProfileFile.

    `base` is the profile's name; `name` what the new one is called.
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
class View:
    """Keep what the page shows (camera, tab, playhead …) with the project; the server does not look in."""

    view: Mapping[str, object]


VERBS: Mapping[str, type] = {
    "open": Open,
    "perform": Perform,
    "prepare": Prepare,
    "choose": Choose,
    "undo": Undo,
    "redo": Redo,
    "faces": Faces,
    "face_at": FaceAt,
    "cancel": Cancel,
    "dial": Dial,
    "name_pose": SavePose,
    "explain": Explain,
    "channel_curves": ChannelCurves,
    "compare": Compare,
    "rules_fired": RulesFired,
    "profile_save": ProfileText,
    "export": Export,
    "cancel_export": CancelExport,
    "project": Project,
    "view": View,
}
"""All requests but `edit` and `preview`, whose class is found in EDITS by their `kind`."""


# --- Answers --------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Word:
    """A word, its place in the script's text, seconds."""

    text: str
    start: float
    end: float
    first: int
    last: int


@dataclass(frozen=True, slots=True)
class Phone:
    """A speech sound; "" is silence. `word` -1 for none. Seconds."""

    symbol: str
    start: float
    end: float
    stress: int
    word: int


@dataclass(frozen=True, slots=True)
class Tone:
    """A pitch accent or the tones that end a phrase, as ToBI labels them."""

    time: float
    label: str
    word: int
    accent: bool
    nuclear: bool


@dataclass(frozen=True, slots=True)
class Pause:
    """A silence and what it stands for. Seconds."""

    start: float
    end: float
    kind: str


@dataclass(frozen=True, slots=True)
class Block:
    """A movement on its lane. `apex_start`: end of its onset; `apex_end`: start of its offset. Seconds.

    `cause` is a sentence; `rule` the id of what made it. `editable` is false for the lips' phones. `edited`:
    it is not as the rules made it.
    """

    id: str
    channel: str
    layer: str
    label: str
    start: float
    apex_start: float
    apex_end: float
    end: float
    targets: Mapping[str, float]
    priority: float
    function: str
    cause: str
    rule: str
    editable: bool = True
    edited: bool = False


@dataclass(frozen=True, slots=True)
class Drawn:
    """A parameter's curve drawn by hand: keys [time, value]. `replaces`: as in Keys."""

    parameter: str
    keys: tuple[tuple[float, float], ...]
    cause: str
    replaces: bool


@dataclass(frozen=True, slots=True)
class Wave:
    """The sound's peaks at one zoom: base64 of int8 pairs (least, greatest), one pair per bucket."""

    seconds_per_bucket: float
    peaks: str


@dataclass(frozen=True, slots=True)
class Spoken:
    """What is said in a take. `sound`: the path to fetch it from. `waves`: coarse to fine."""

    text: str
    language: str
    sound: str
    words: tuple[Word, ...]
    phones: tuple[Phone, ...]
    tones: tuple[Tone, ...]
    pauses: tuple[Pause, ...]
    waves: tuple[Wave, ...]


@dataclass(frozen=True, slots=True)
class Made:
    """How the session's take came about: what is asked again by `perform`."""

    source: Source
    choices: Choices
    emotions: tuple[EmotionSpan, ...]


@dataclass(frozen=True, slots=True)
class TakeView:
    """A take whole. `fps` as "24000/1001". `speech` is null where nothing is said.

    `curves`: of the parameters that move, `frames` values each; the others stay at their neutral. `warnings`:
    what was done otherwise than asked. `milliseconds`: what each step took.
    """

    take: int
    duration: float
    fps: str
    frames: int
    speech: Spoken | None
    blocks: tuple[Block, ...]
    drawn: tuple[Drawn, ...]
    curves: Mapping[str, str]
    made: Made
    undoes: str = ""
    redoes: str = ""
    warnings: tuple[str, ...] = ()
    milliseconds: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class TakeChange:
    """What a change made of take `before`: blocks that are new or other, ids of those gone, changed curves.

    A parameter that has come to rest has the curve "". Where speech itself is another, `whole` has the take
    and the rest is empty. `from_frame`, `to_frame`: the frames whose faces are other, [from, to).
    """

    take: int
    before: int
    blocks: tuple[Block, ...]
    gone: tuple[str, ...]
    drawn: tuple[Drawn, ...]
    curves: Mapping[str, str]
    from_frame: int
    to_frame: int
    made: Made
    undoes: str = ""
    redoes: str = ""
    whole: TakeView | None = None
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class State:
    """A session as it stands: its take (null before the first), what was uploaded and saved under a name.

    `view`: what the page kept of itself. `notes`: what could not be taken up from what was saved.
    """

    session: str
    take: TakeView | None
    recordings: tuple[str, ...]
    emotions: tuple[str, ...]
    poses: Mapping[str, Mapping[str, float]]
    view: Mapping[str, object]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Sent:
    """How many faces were sent."""

    sent: int


@dataclass(frozen=True, slots=True)
class Done:
    """It is done."""


@dataclass(frozen=True, slots=True)
class DialState:
    """All parameters that the dialled face holds, by name; `notes` name what could not be shown."""

    values: Mapping[str, float]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Download:
    """A file to be fetched from `path`."""

    path: str
    name: str


@dataclass(frozen=True, slots=True)
class Part:
    """What one movement asks of a parameter and gets (deviations from neutral), and why not more."""

    channel: str
    what: str
    rule: str
    place: str
    asked: float
    given: float
    reason: str
    movement: str = ""


@dataclass(frozen=True, slots=True)
class Reason:
    """Why a parameter has its value: what wins (null at rest), what does not and why, the last steps."""

    parameter: str
    value: float
    unit: str
    winner: Part | None
    losers: tuple[Part, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Explained:
    """Explanations, as data and in sentences (as `risorius explain` prints them)."""

    time: float
    reasons: tuple[Reason, ...]
    sentences: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class ChannelCurve:
    """What a channel asks of a parameter and what it gets, `frames` values each.

    `inhibited`: spans [start, end] in seconds in which nothing is left of it; `limited`: less than asked.
    """

    channel: str
    asked: str
    given: str
    inhibited: tuple[tuple[float, float], ...]
    limited: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Previewed:
    """The curves that would be other in a take, in base64 as in TakeView; "" where one would come to rest."""

    take: int
    curves: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class ParameterDetail:
    """All channels in one parameter."""

    parameter: str
    channels: tuple[ChannelCurve, ...]


@dataclass(frozen=True, slots=True)
class FiredRule:
    """A rule, its comment, the ids of its blocks and when each starts."""

    rule: str
    comment: str
    blocks: tuple[str, ...]
    times: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Fired:
    """The rules that fired in a take, in order of their ids."""

    rules: tuple[FiredRule, ...]


@dataclass(frozen=True, slots=True)
class ProfileFile:
    """A profile as TOML, to be kept as a file or performed by `choices.profile_text`."""

    name: str
    text: str


@dataclass(frozen=True, slots=True)
class PoseFile:
    """What was saved under a name, as a file: an emotion (TOML), or the command that makes the pose."""

    name: str
    file: str
    text: str


@dataclass(frozen=True, slots=True)
class Job:
    """An export that has begun."""

    job: int


# --- Events ---------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a request (`re`) or an export (`job`) is; `total` 0 where that is not known."""

    stage: str
    done: int
    total: int
    re: int | None = None
    job: int | None = None


@dataclass(frozen=True, slots=True)
class Exported:
    """An export has ended: its files, or why there are none."""

    job: int
    files: tuple[Download, ...]
    error: str = ""


@dataclass(frozen=True, slots=True)
class Changed:
    """Another page of the same session has changed it: its take is another now."""

    take: int


@dataclass(frozen=True, slots=True)
class Saved:
    """The project was saved by itself; `error` says why it could not be."""

    error: str = ""


@dataclass(frozen=True, slots=True)
class Ready:
    """Whether the server is still "warming" (kernels are compiled; the first face waits), or is "warm"."""

    what: Literal["warming", "warm"]


EVENTS: Mapping[str, type] = {
    "progress": Progress,
    "exported": Exported,
    "changed": Changed,
    "saved": Saved,
    "ready": Ready,
}

ANSWERS: tuple[type, ...] = (
    TakeView, TakeChange, State, Sent, Done, DialState, Download, Explained, ParameterDetail, Fired,
    ProfileFile, PoseFile, Job, Previewed,
)  # fmt: skip
