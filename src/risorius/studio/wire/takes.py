"""Takes as a page draws them: speech, blocks, curves, and the changes of an edit in them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ...core.key_shapes import KeyShape
from .marks import LaneStates, Marker
from .shared import TakeInputs
from .views import PageView


@dataclass(frozen=True, slots=True)
class WordView:
    """A word; `first` and `last` are its characters in the script's text. Seconds."""

    text: str
    start: float
    end: float
    first: int
    last: int


@dataclass(frozen=True, slots=True)
class PhoneView:
    """A speech sound; "" is silence. `word` is -1 for none. Seconds."""

    symbol: str
    start: float
    end: float
    stress: int
    word: int


@dataclass(frozen=True, slots=True)
class Tone:
    """A pitch accent, or the tones that end a phrase, with its ToBI label."""

    time: float
    label: str
    word: int
    accent: bool
    nuclear: bool


@dataclass(frozen=True, slots=True)
class PauseView:
    """A silence and its kind. Seconds."""

    start: float
    end: float
    kind: str


@dataclass(frozen=True, slots=True)
class Block:
    """A movement on its lane. `apex_start`: end of its onset; `apex_end`: start of its offset. Seconds.

    `cause` is a sentence; `rule` is the id of the rule that made the movement. `editable` is false for phones
    of the lips. `edited`: whether a user has changed it.
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
class DrawnCurve:
    """A parameter's curve drawn by hand: keys [time, value]. `replaces`, `shapes`: as in Keys."""

    parameter: str
    keys: tuple[tuple[float, float], ...]
    cause: str
    replaces: bool
    shapes: tuple[KeyShape, ...] = ()


@dataclass(frozen=True, slots=True)
class Wave:
    """The sound's peaks at one zoom: base64 of int8 pairs (lowest, highest), one pair per bucket."""

    seconds_per_bucket: float
    peaks: str


@dataclass(frozen=True, slots=True)
class SpeechView:
    """The speech of a take. `sound`: the path of its sound file. `waves`: from coarse to fine."""

    text: str
    language: str
    sound: str
    words: tuple[WordView, ...]
    phones: tuple[PhoneView, ...]
    tones: tuple[Tone, ...]
    pauses: tuple[PauseView, ...]
    waves: tuple[Wave, ...]


@dataclass(frozen=True, slots=True)
class TakeView:
    """A whole take. `fps` is text such as "24000/1001". `speech` is null if nothing is said.

    `curves`: `frames` values for each parameter that moves; the others stay at their neutral value. `made`:
    what it was performed from. `undoes`, `redoes`: the changes that undo and redo would act on. `warnings`:
    where the take differs from what was requested. `lost`: changes by hand that did not fit when the line was
    planned anew, which `bring_back` makes again. `lanes`: what is muted, solo and
    locked. `milliseconds`: the duration of each step.
    """

    take: int
    duration: float
    fps: str
    frames: int
    speech: SpeechView | None
    blocks: tuple[Block, ...]
    drawn: tuple[DrawnCurve, ...]
    curves: Mapping[str, str]
    made: TakeInputs
    undoes: str = ""
    redoes: str = ""
    warnings: tuple[str, ...] = ()
    lost: tuple[str, ...] = ()
    markers: tuple[Marker, ...] = ()
    lanes: LaneStates = field(default_factory=LaneStates)
    milliseconds: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class TakeChange:
    """The difference from take `before`: new or changed blocks, ids of deleted ones (`gone`), changed curves.

    The curve of a parameter that no longer moves is "". If the speech has changed, `whole` is the new take
    and the rest is empty. `from_frame`, `to_frame`: the frames whose faces have changed, [from, to).
    """

    take: int
    before: int
    blocks: tuple[Block, ...]
    gone: tuple[str, ...]
    drawn: tuple[DrawnCurve, ...]
    curves: Mapping[str, str]
    from_frame: int
    to_frame: int
    made: TakeInputs
    undoes: str = ""
    redoes: str = ""
    whole: TakeView | None = None
    warnings: tuple[str, ...] = ()
    lost: tuple[str, ...] = ()
    markers: tuple[Marker, ...] = ()
    lanes: LaneStates = field(default_factory=LaneStates)


@dataclass(frozen=True, slots=True)
class State:
    """A session: its take (null before the first), and the recordings, emotions and poses saved in it.

    `view`: what the page saved of itself. `notes`: what could not be restored. `draft`: what was written last
    if it is not what was performed.
    """

    session: str
    take: TakeView | None
    recordings: tuple[str, ...]
    emotions: tuple[str, ...]
    poses: Mapping[str, Mapping[str, float]]
    view: PageView
    notes: tuple[str, ...] = ()
    draft: TakeInputs | None = None


@dataclass(frozen=True, slots=True)
class Previewed:
    """The curves that an edit would change, in base64 as in TakeView; "" if the parameter would not move."""

    take: int
    curves: Mapping[str, str]
