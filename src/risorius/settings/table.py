"""The table of settings: all that a user may choose, each with its type, default, range, help and reader.

The options of the command line, the studio's controls and messages, and docs/settings.md are derived from the
fields below: a new setting is a field here, and the line that reads it. `declare.py` says what can be
declared of one.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from fractions import Fraction
from functools import partial
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core import choices
from ..core import look as looks
from ..core.frame_rate import parse_fps
from ..core.units import MAX_SECONDS
from ..errors import InputError, UnusedSettingError, unknown
from .declare import Group, Row, Stage, ValueKind, check, rows, setting

if TYPE_CHECKING:
    from ..core.score import BlendSettings

    class FrameRate:
        """The type of a frame rate for type checkers: any number or text, and a fraction is kept."""

        def __get__(self, settings: object, owner: object = None) -> Fraction: ...
        def __set__(self, settings: object, rate: Fraction | float | str) -> None: ...

    class FileName:
        """The type of a file's name for type checkers: a text is accepted, and a path is kept."""

        def __get__(self, settings: object, owner: object = None) -> Path | None: ...
        def __set__(self, settings: object, name: str | PathLike[str] | None) -> None: ...

    class PictureSize:
        """The type of a picture's size for type checkers: "640x480" or (640, 480); a tuple is kept."""

        def __get__(self, settings: object, owner: object = None) -> tuple[int, int]: ...
        def __set__(self, settings: object, size: str | Sequence[int]) -> None: ...

    class NameList:
        """The type of several names for type checkers: one text or a sequence; a tuple is kept."""

        def __get__(self, settings: object, owner: object = None) -> tuple[str, ...]: ...
        def __set__(self, settings: object, names: str | Sequence[str]) -> None: ...

    class Complexion:
        """The type of a complexion for type checkers: "tan" or 0.5; a number is kept."""

        def __get__(self, settings: object, owner: object = None) -> float | None: ...
        def __set__(self, settings: object, complexion: str | float | None) -> None: ...

    Named = type
else:
    FrameRate, FileName, PictureSize = Fraction, Path | None, tuple[int, int]
    NameList, Complexion = tuple[str, ...], float | None

    class Named(type):
        """The type of settings: takes values, and refuses names, as the command line does."""

        def __call__(cls, *values: object, **named: object) -> object:
            """Make settings; raise InputError, with the nearest name, for an unknown one."""
            for name in named:
                if name not in cls.__dataclass_fields__:
                    raise InputError(_unknown_name(cls, name))
            return super().__call__(*values, **_values_read(cls, named))


LARGEST_SIDE = 4096
BY_VOICE = "settings.declare:later"  # to look a voice up starts the speech engine

_voice = partial(setting, Stage.VOICE, Group.VOICE)
_silence = partial(setting, Stage.VOICE, Group.TIME)
_manner = partial(setting, Stage.PLAN, Group.MANNER)
_model = partial(setting, Stage.COMBINE, Group.MODELS)
_head = partial(setting, Stage.HEAD, Group.HEAD)
_shape = partial(setting, Stage.SHAPE, Group.HEAD)
_skin = partial(setting, Stage.SKIN, Group.HEAD)
_appearance = partial(setting, Stage.APPEARANCE, Group.HEAD)
_picture = partial(setting, Stage.PICTURE, Group.PICTURE)
_output = partial(setting, Stage.OUTPUT, Group.PICTURE)


def parse_size(text: str) -> tuple[int, int]:
    """Return width and height of a text such as "720x720"; raise InputError for any other text."""
    match = re.fullmatch(r"(\d{1,5})[xX×](\d{1,5})", text.strip())
    if match is None:
        raise InputError(f"size '{text}' is not a size; expected e.g. 720x720")
    return int(match[1]), int(match[2])


def _shown(settings: Any) -> str:
    """Return settings as they are written, without those that are as usual."""
    usual = type(settings)()
    values = ((f.name, getattr(settings, f.name)) for f in fields(settings))
    changed = (f"{name}={value!r}" for name, value in values if value != getattr(usual, name))
    return f"{type(settings).__name__}({', '.join(changed)})"


# fmt: off
@dataclass(frozen=True, slots=True)
class Look(metaclass=Named):
    """The look of a drawn head; frozen, checked on creation (InputError names the choice at fault)."""

    style: str = _picture(
        "Style", "realistic", "Style of the picture: {names}.",
        names=looks.STYLES)
    camera: str = _picture(
        "Camera", "portrait",
        "{names}; after a colon, the focal length in mm.",
        metavar="NAME[:MM]", names=looks.FRAMINGS, read=looks.parse_camera, fills=("camera", "lens"))
    lens: float = _picture(
        "Lens, mm", looks.USUAL_LENS, "Focal length in mm on 24 × 36 mm film.",
        flag=None, metavar="MM", low=20.0, high=400.0, step=1.0)
    light: str = _picture("Light", "studio", "{names}.", names=looks.LIGHTS)
    background: str | None = _picture(
        "Background", None, "A CSS colour, a picture file, or 'transparent' (.png, .webm, .mov).",
        metavar="WHAT", unset="the light's own")
    quality: str = _picture("Quality", "normal", "{names}.", names=tuple(looks.QUALITIES))
    hair: str | None = _appearance(
        "Hair", None, "{names}.",
        names=looks.HAIR_STYLES, what="hair style", unset="the head's own")
    complexion: Complexion = _appearance(
        "Complexion", None, "{names}, or {low} (the fairest) to {high} (the darkest).",
        low=0.0, high=1.0, names=tuple(looks.COMPLEXIONS), registry="core.look:COMPLEXIONS",
        read=looks.parse_complexion, unset="the head's own")
    overlay: NameList = _picture(
        "Overlay", (), "Explanations in the picture: {names}; separated by commas.",
        metavar="NAME,…", names=looks.OVERLAYS, read=looks.parse_overlay)

    def __post_init__(self) -> None:
        check(self, "g")

    __repr__ = _shown

    @property
    def transparent(self) -> bool:
        """Whether pictures have an alpha channel."""
        return self.background == looks.TRANSPARENT


@dataclass(frozen=True, slots=True)
class BlendChoices(metaclass=Named):
    """A user's choices for combining movements: None leaves a choice to the score that is performed, or, for
    a script, to the values of `planned`. The fields are those of `BlendSettings`.
    """

    conflict: str | None = _model(
        "Conflicts", None, "How conflicts between muscles are resolved: {names}.",
        metavar="POLICY", usual=choices.CONFLICT.planned, names=choices.CONFLICT_POLICIES,
        registry="blend.conflict:POLICIES", what="conflict policy")
    activation_threshold: float | None = _model(
        "Threshold", None, "Activity of a rival above which a muscle gives way.",
        flag=None, low=0.0, high=1.0, step=0.01, unset="by muscle")
    min_onset: float | None = _model(
        "Minimum onset, s", None, "Shortest time (s) in which a muscle returns after a rival.",
        flag=None, low=0.0, high=10.0, step=0.01, unset="by muscle")
    min_offset: float | None = _model(
        "Minimum offset, s", None, "Shortest time (s) in which a muscle gives way to a rival.",
        flag=None, low=0.0, high=10.0, step=0.01, unset="by muscle")
    onset_function: str | None = _model(
        "Onsets", None,
        "The function by which all movements rise and fall: {names}.",
        names=choices.ONSET_FUNCTIONS, registry="core.functions:ONSET_FUNCTIONS", what="onset function",
        unset="by channel")
    contact: bool | None = _model(
        "Lips always close", None, "Switch off the lips' contact goals, to see their effect.",
        flag="--without-contact", usual=choices.CONTACT.planned)
    lips: str | None = _model(
        "Lips", None, "Model of coarticulation: {names}.",
        metavar="MODEL", usual=choices.LIPS.planned, names=choices.LIP_MODELS,
        registry="blend.mouth.coarticulation:LIP_MODELS",
        what="lip model")
    rounding: float | None = _model(
        "Rounding, s", None, "Time (s) over which corners of curves are rounded off.",
        flag=None, low=0.0, high=0.1, step=0.005, usual=choices.ROUNDING.planned)

    def __post_init__(self) -> None:
        check(self)

    __repr__ = _shown

    def over(self, settings: BlendSettings) -> BlendSettings:
        """Return `settings` with the choices in place of theirs."""
        chosen = {name: getattr(self, name) for name in rows(BlendChoices)}
        return replace(settings, **{name: value for name, value in chosen.items() if value is not None})

    def planned(self) -> BlendSettings:
        """Return how the movements of a planned score are combined."""
        from ..core.functions import CORNERED
        from ..core.score import BlendSettings

        usual: dict[str, Any] = {name: row.usual for name, row in rows(BlendChoices).items()}
        if self.onset_function in CORNERED:
            usual["rounding"] = 0.0
        return self.over(BlendSettings(**usual))


@dataclass(frozen=True, slots=True)
class Settings(metaclass=Named):
    """All settings of a performance; frozen, checked on creation (InputError names the one at fault)."""

    language: str | None = _voice(
        "Language", None, "Language of the text or of the recording: de, fr, cmn …",
        metavar="CODE", names="speech.engines.voices:languages", find=BY_VOICE, unset="the voice's")
    voice: str | None = _voice(
        "Voice", None, "A voice ('risorius list voices'), a Piper model (.onnx) or your own program; "
        "en-us if no language is chosen either.",
        names="speech.engines.voices:speaking", find=BY_VOICE, unset="the language's first")
    rate: int | None = _voice(
        "Words per minute", None, "Words per minute, {low} to {high}.",
        metavar="WPM", low=choices.RATES.low, high=choices.RATES.high, step=5, unset="the voice's own")
    voice_emotion: bool = _voice(
        "Emotional voice", True, "Whether emotions change the voice.", metavar="on|off")
    answers: str | None = _voice(
        "Answers", None,
        "The question that the line answers: new words get accents, words of the question get none.",
        metavar="QUESTION", unset="no question")
    lead: float = _silence(
        "Silence before, s", choices.LEAD, "Silence before plain text.",
        metavar="S", low=choices.SILENCES.low, high=choices.SILENCES.high, step=0.1)
    tail: float = _silence(
        "Silence after, s", choices.TAIL, "Silence after plain text.",
        metavar="S", low=choices.SILENCES.low, high=choices.SILENCES.high, step=0.1)
    profile: str = _manner(
        "Profile", "neutral", "Who speaks: a profile, or a .toml file.", names="rules.profiles:profiles",
        find="rules.profiles:profile_of")
    attitudes: NameList = _manner(
        "Attitudes", (), "Attitude of the speaker, added to the profile. May be given several times.",
        flag="--attitude", names="rules.profiles:attitudes",
        find="rules.profiles:attitude")
    expression: str = _manner(
        "Emotions are", "felt",
        "Whether emotions are {names}. Posed ones are faster and less smooth, and do not affect "
        "other channels.",
        names=choices.EXPRESSIONS, registry="rules.expressions:expressions")
    blinks: str | None = _manner(
        "Blinks", None, "How blinks are timed: {names}.",
        names=choices.BLINK_MODELS, what="model of blinks", unset="the profile's own")
    lively: bool = _manner(
        "Rules, blinks, gaze", True, "Perform only words and marks: no rules, nothing random.",
        flag="--still")
    manner: str = _manner(
        "Speaks", "plain", "Manner of speech: {names}.", names=choices.MANNERS,
        what="manner of speech")
    articulation: float = _manner(
        "Articulation", 1.0, "How far the lips move, {low} to {high}.",
        metavar="X", low=0.0, high=2.0, step=0.05)
    without: NameList = _manner(
        "Leave out", (), "Leave a channel out ('risorius list channels').",
        metavar="CHANNEL", names="core.channels:CHANNELS", what="channel")
    rules: FileName = _manner(
        "Rules", None,
        "A file of rules that are added to the built-in ones, or replace or delete some of them.",
        metavar="FILE", on_page=False)
    head: str = _head(
        "Head", "standard", "The head that performs: its name, or its folder.",
        names="face.head.head:head_titles",
        find="face.head.head_folder:head_file")
    age: float | None = _shape(
        "Age", None, "How old the head is, {low} to {high}.",
        metavar="YEARS", low=0.0, high=100.0, step=1.0, unset="its own")
    shape: Mapping[str, float] = _shape(
        "Shape", {}, "A slider of the head's shape, {low} to {high}, e.g. nose_width:0.5; may be repeated. "
        "`list sliders` names them.",
        metavar="NAME:VALUE", low=-1.0, high=1.0, names="face.head.sliders:slider_names", what="slider",
        read="face.head.sliders:parse_slider", on_page=False)
    muscles: str = _shape(
        "Muscles", "fields",
        "How muscles act: {names}.", names=choices.MUSCLE_MODES, what="manner of muscles", on_page=False)
    wrinkles: Mapping[str, float] = _skin(
        "Wrinkles", {},
        "Factors {low} to {high} by region: less or more wrinkled than other faces of that age.",
        flag=None, low=0.0, high=2.0, on_page=False)
    dynamics: str = _skin(
        "Skin", "springs",
        "How the skin moves: {names}.", flag="--skin", names=choices.DYNAMICS, what="skin")
    seed: int = setting(
        Stage.PLAN, Group.TIME, "Seed", 0, "Seed of everything random.",
        metavar="N", low=0, high=2**63 - 1, step=1)
    fps: FrameRate = setting(
        Stage.FRAMES, Group.TIME, "Frames per second", Fraction(30),
        "Frames per second; fractions such as 24000/1001 work.",
        metavar="RATE", names=("24", "25", "24000/1001", "30", "30000/1001", "50", "60"), read=parse_fps)
    size: PictureSize = _picture(
        "Size", (720, 720), "Size of the picture in pixels.",
        metavar="WxH", low=16, high=LARGEST_SIDE, read=parse_size)
    at: float | None = _output(
        "At, s", None, "Time of the frame that a .png shows, in seconds.",
        metavar="S", low=0.0, high=MAX_SECONDS, unset="the middle")
    every: int | None = _output(
        "Every", None, "Make each .png a sheet of every N-th frame.", metavar="N", low=1, high=1_000_000)
    names: str = setting(
        Stage.OUTPUT, Group.AVATAR, "Expressions of a .vrma", "vrm1",
        "Expressions in a .vrma: {names}.",
        metavar="SET", names=choices.EXPRESSION_NAMES, what="set of names")
    look: Look = field(default_factory=Look)
    blend: BlendChoices = field(default_factory=BlendChoices)

    def __post_init__(self) -> None:
        object.__setattr__(self, "fps", parse_fps(self.fps))
        if self.rules is not None:
            if not isinstance(self.rules, str | PathLike):
                raise InputError(f"rules is {type(self.rules).__name__}; expected the name of a file")
            object.__setattr__(self, "rules", Path(self.rules))
        check(self)
        for name, group in (("look", Look), ("blend", BlendChoices)):
            if not isinstance(getattr(self, name), group):
                kind = type(getattr(self, name)).__name__
                raise InputError(f"{name} is {kind}; expected risorius.{group.__name__}(…)")
        if self.at is not None and self.every is not None:
            raise UnusedSettingError(["at"], "every makes a sheet of the whole clip; expected at or every")

    __repr__ = _shown
# fmt: on


def _values_read(kind: type, named: Mapping[str, Any]) -> dict[str, Any]:
    """Return values by name, texts read as on the command line and lists as tuples.

    "close-up:50" for a camera is its lens, too; without the colon the lens stays as it is named.
    """
    table, values = rows(kind), {**named}
    for name, value in named.items():
        if isinstance(value, list):
            values[name] = tuple(value)
        elif isinstance(value, str) and name in table:
            parts = [(row.name, part) for row, part in _parts(table, table[name], value)]
            values.update(parts[:1] if parts[0][1] == value else parts)
    return values


def _unknown_name(kind: Any, name: str) -> str:
    row = rows(Settings).get(name)
    if kind is not Settings or row is None or row.owner not in ("look", "blend"):
        return unknown("setting", name, kind.__dataclass_fields__)
    owner = row.owner.capitalize() if row.owner == "look" else "BlendChoices"
    return (
        f"{name} is a setting of {row.owner}; expected Settings({row.owner}={owner}({name}=…)), or "
        f"load_settings({name}=…), which takes all"
    )


def settings_of(values: Mapping[str, object], base: Settings | None = None) -> Settings:
    """Return `base`, by default the default settings, with values by name, those of `look` and `blend` among
    them; None leaves a setting as it is.

    A text for a setting of another type is read as on the command line: fps "24000/1001", camera
    "close-up:135", and several with semicolons. Raises InputError for an unknown name, or a value that the
    setting cannot have.
    """
    base, table = base or Settings(), rows(Settings)
    chosen: dict[str, dict[str, Any]] = {"look": {}, "blend": {}, "": {}}
    for name, value in values.items():
        if name not in table:
            raise InputError(unknown("setting", name, table))
        if value is not None:
            for row, part in _parts(table, table[name], value):
                chosen.get(row.owner, chosen[""])[row.name] = part
    look, blend = replace(base.look, **chosen["look"]), replace(base.blend, **chosen["blend"])
    return replace(base, look=look, blend=blend, **chosen[""])


def _parts(table: Mapping[str, Row], row: Row, value: Any) -> list[tuple[Row, Any]]:
    """Return the settings that a value fills, each with its own value."""
    if not isinstance(value, str):
        return [(row, value)]
    if row.several:
        values = [row.read(text.strip()) for text in value.split(";") if text.strip()]
        if row.kind is ValueKind.AMOUNTS and row.entry.read is None:
            raise InputError(f"{row.name} '{value}' is a text; expected numbers by name")
        return [(row, dict(values) if row.kind is ValueKind.AMOUNTS else tuple(values))]
    names = row.entry.fills
    if not names:
        return [(row, row.read(value))]
    return [(table[name], part) for name, part in zip(names, row.read(value), strict=True)]
