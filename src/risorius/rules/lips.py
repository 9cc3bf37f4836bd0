"""The lips' table: the targets of each phone for the articulators, and their strength (`data/lips.toml`)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Annotated, Any

from ..core.lips.articulators import APERTURE, ARTICULATORS, JAW, check_lip_target
from ..core.movement import Dominance
from ..core.parameters import INDEX, parameters_named
from ..core.units import Share
from ..errors import InputError, ParameterError, unknown
from ..languages.phones import check_phones
from ..reading.frozen import FrozenDict
from ..reading.hints import Range
from ..reading.schema import build
from ..reading.source_text import SourceText
from .load import DATA, load

Weights = Mapping[str, Annotated[float, Range(0.0, 100.0)]]
LipTargets = Mapping[str, float]
EVERYTHING = "*"
LIPS_FILE = "lips.toml"
NAMED_TABLES = ("class", "phone", "diphthong", "onset", "manner")
"""The tables of the file whose entries have names."""
OPENING = (JAW, APERTURE)
SEAL = "lip_seal"


@dataclass(frozen=True, slots=True)
class PhoneShape:
    """One phone: its class, its targets (articulators in mm, parameters 0..1), what share a contact holds."""

    lip_class: str = field(metadata={"key": "class"})
    targets: LipTargets
    closure: Share = 1.0


@dataclass(frozen=True, slots=True)
class LipClass:
    """A class of phones: dominance magnitude per articulator, flanks in seconds, limits per parameter.

    `yields`: for the look-ahead model, phones a second from which on it yields an articulator. `precision`:
    for the model of least effort, where it differs from the magnitude. `anticipates`: per articulator, the
    share of the precision of the coming vowel with which that vowel takes part in a consonant of this class.
    """

    magnitude: Weights
    before: Annotated[float, Range(0.001, 1.0)]
    after: Annotated[float, Range(0.001, 1.0)]
    limits: Mapping[str, tuple[float, float]]
    yields: Mapping[str, Annotated[float, Range(0.0, 100.0)]] = field(default_factory=FrozenDict)
    precision: Weights = field(default_factory=FrozenDict)
    anticipates: Mapping[str, Share] = field(default_factory=FrozenDict)


@dataclass(frozen=True, slots=True)
class Diphthong:
    """Two shapes in a row; `turn` is the share of the phone that the first one takes.

    `begun_by`: phones that are the first shape themselves; after them the phone has its second one alone.
    """

    parts: tuple[str, str]
    turn: Share
    begun_by: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Opening:
    """Changes of a vowel's shape by stress, accents, position and the voice.

    The factors multiply to at most `widest`. An articulator takes its share of what that is beyond 1: of
    `unrounded` or of `rounded`, else none.
    """

    stressed: float
    unstressed: float
    accented: float
    phrase_final: float
    widest: float
    prominence: Annotated[float, Range(0.0, 0.15)]
    most_prominent: Annotated[float, Range(0.0, 3.0)]
    unrounded: Mapping[str, Share]
    rounded: Mapping[str, Share]


@dataclass(frozen=True, slots=True)
class Pausing:
    """Movements of the lips in pauses; seconds. `shortest`: a shorter pause changes nothing.

    The in-breath: in a silence of `breath_from` or more before speech the mouth opens to `breath_shape`,
    from `breath_lead` before the speech (or from the start of the silence), and leaves it `breath_end`
    before. The silence that begins a clip is the end of a longer one: it may be as short as `breath_least`
    more than `breath_end`. A clip begins with lips at rest for `breath_clip`, or as much of that as leaves
    `breath_lips` from the breath's start to the speech.
    """

    shortest: Annotated[float, Range(0.0, 5.0)]
    breath_from: Annotated[float, Range(0.0, 5.0)]
    breath_lead: Annotated[float, Range(0.0, 5.0)]
    breath_end: Annotated[float, Range(0.0, 5.0)]
    breath_least: Annotated[float, Range(0.001, 5.0)]
    breath_clip: Annotated[float, Range(0.0, 5.0)]
    breath_lips: Annotated[float, Range(0.0, 5.0)]
    breath_shape: LipTargets

    def allows_breath(self, silence: float, begins_clip: bool) -> bool:
        """Return whether the mouth opens for a breath in `silence` seconds of silence before speech."""
        return silence >= (self.breath_end + self.breath_least if begins_clip else self.breath_from)


@dataclass(frozen=True, slots=True)
class Tempo:
    """Fuller articulation of slower speech: (usual/rate)**`share` times, between `least` and `most`.

    `usual`: syllables a second; `faster`: how many times as many other languages have, by their codes.
    `syllables`: a stretch of fewer has the usual rate, because its last syllable is long.
    """

    usual: Annotated[float, Range(1.0, 20.0)]
    faster: Mapping[str, Annotated[float, Range(0.2, 5.0)]]
    share: Share
    least: Share
    most: Annotated[float, Range(1.0, 2.0)]
    syllables: Annotated[int, Range(1, 100)]

    def fullness(self, syllables: int, seconds: float, language: str) -> float:
        """Return the factor on the opening for a number of `syllables` in `seconds`."""
        if syllables < self.syllables:
            return 1.0
        usual = self.usual * self.faster.get(language.partition("-")[0], 1.0)
        return min(max(math.pow(usual * seconds / syllables, self.share), self.least), self.most)


@dataclass(frozen=True, slots=True)
class LipManner:
    """A manner of speech: factors on targets by name."""

    factors: Mapping[str, Annotated[float, Range(0.0, 3.0)]]


@dataclass(frozen=True, slots=True)
class _File:
    classes: Mapping[str, LipClass] = field(metadata={"key": "class"})
    phones: Mapping[str, PhoneShape] = field(metadata={"key": "phone"})
    diphthongs: Mapping[str, Diphthong] = field(metadata={"key": "diphthong"})
    onsets: Mapping[str, PhoneShape] = field(metadata={"key": "onset"})
    opening: Opening
    pausing: Pausing
    articulation: Mapping[str, Share]
    tempo: Tempo
    manners: Mapping[str, LipManner] = field(metadata={"key": "manner"})


@dataclass(frozen=True, slots=True)
class Holding:
    """The data that all phones of a class share (`LipClass`); the limits have both sides spelled out."""

    dominance: Mapping[str, Dominance]
    limits: Mapping[str, tuple[float, float]]
    yields: Mapping[str, float]
    precision: Mapping[str, float]
    anticipates: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class LipTable:
    """The lips' rules, ready for use: phones by ARPAbet symbol, classes by name.

    `onsets`: the allophones at the start of a word or of a stressed syllable. `silent`: phones that move no
    lips.
    """

    holdings: Mapping[str, Holding]
    phones: Mapping[str, PhoneShape]
    diphthongs: Mapping[str, Diphthong]
    onsets: Mapping[str, PhoneShape]
    opening: Opening
    pausing: Pausing
    articulation: Mapping[str, float]
    tempo: Tempo
    manners: Mapping[str, LipManner]
    silent: frozenset[str] = frozenset()
    rest: PhoneShape = field(default_factory=lambda: PhoneShape("silence", FrozenDict()))

    def shape(self, symbol: str) -> PhoneShape:
        """Return a phone's shape; raise InputError for a diphthong, and for a phone that the table lacks."""
        if symbol in self.phones:
            return self.phones[symbol]
        if symbol in self.diphthongs:
            first, second = self.diphthongs[symbol].parts
            raise InputError(f"the diphthong {symbol!r} has two shapes; expected {first!r} or {second!r}")
        raise InputError(unknown("phone", symbol, (*self.phones, *self.diphthongs)))

    def at_onset(self, symbol: str, shape: PhoneShape) -> PhoneShape:
        """Return the shape of a phone at the start of a word or of a stressed syllable.

        A sound of another language with the lips of an English one has its allophone, too, but a stop:
        whether it is aspirated depends on the language.
        """
        if symbol in self.onsets or SEAL in shape.targets:
            return self.onsets.get(symbol, shape)
        return next((on for phone, on in self.onsets.items() if self.phones[phone] == shape), shape)

    def factors(self, manner: str, articulation: float) -> Mapping[str, float]:
        """Return the factors on targets for a manner of speech, hypo- or hyper-articulated (1 is neither).

        Raises ParameterError for an unknown manner.
        """
        if manner not in self.manners:
            raise ParameterError(unknown("manner of speech", manner, self.manners))
        shares = {**dict.fromkeys(OPENING, 1.0), **self.articulation}
        manner_factors = self.manners[manner].factors
        return {
            name: manner_factors.get(name, 1.0) * (1.0 + shares.get(name, 0.0) * (articulation - 1.0))
            for name in {*shares, *manner_factors}
        }

    def shapes(self, symbol: str, before: str = "") -> tuple[tuple[str, PhoneShape, float], ...]:
        """Return a phone's shapes in order, each with its symbol and share of the phone's time.

        `before`: the phone before it.
        """
        diphthong = self.diphthongs.get(symbol)
        if diphthong is None:
            return ((symbol, self.shape(symbol), 1.0),)
        first, second = (self.shape(part) for part in diphthong.parts)
        if before in diphthong.begun_by:
            return ((symbol, second, 1.0),)
        return (symbol, first, diphthong.turn), (symbol, second, 1.0 - diphthong.turn)


@lru_cache(maxsize=1)
def lip_table() -> LipTable:
    """Return the package's table; raise InputError if its names do not fit or it lacks a phone."""
    table = _compiled(load(_File, LIPS_FILE))
    check_phones(LIPS_FILE, (*table.phones, *table.diphthongs))
    return table


def lip_table_text() -> str:
    """Return the package's file."""
    return (DATA / LIPS_FILE).read_text(encoding="utf-8")


def lip_table_of(tables: Mapping[str, Any]) -> LipTable:
    """Return the table of a file as TOML has it, or the package's if it is empty; raise as `lip_table`."""
    return _compiled(build(_File, tables, SourceText(LIPS_FILE, ""))) if tables else lip_table()


def _compiled(raw: _File) -> LipTable:
    _check_names(raw)
    holdings = {name: _holding(lip_class) for name, lip_class in raw.classes.items()}
    return LipTable(
        FrozenDict(holdings),
        raw.phones,
        raw.diphthongs,
        raw.onsets,
        raw.opening,
        raw.pausing,
        raw.articulation,
        raw.tempo,
        raw.manners,
    )


def _holding(lip_class: LipClass) -> Holding:
    dominance = {
        name: Dominance(magnitude, lip_class.before, lip_class.after)
        for name, magnitude in lip_class.magnitude.items()
    }
    limits = {p.name: span for base, span in lip_class.limits.items() for p in parameters_named(base)}
    return Holding(
        FrozenDict(dominance),
        FrozenDict(limits),
        FrozenDict(lip_class.yields),
        FrozenDict({**lip_class.magnitude, **lip_class.precision}),
        FrozenDict(lip_class.anticipates),
    )


def _check_names(raw: _File) -> None:
    for lip_class in raw.classes.values():
        _check_known((*lip_class.magnitude, *lip_class.yields, *lip_class.precision, *lip_class.anticipates))
    for factors in (raw.articulation, *(manner.factors for manner in raw.manners.values())):
        _check_known(factors)
    _check_known((*raw.opening.unrounded, *raw.opening.rounded))
    shapes = (*raw.phones.values(), *raw.onsets.values())
    for targets in (*(p.targets for p in shapes), raw.pausing.breath_shape):
        check_shape(targets)
    for name in raw.onsets:
        if name not in raw.phones:
            raise InputError(f"lips.toml: {unknown('phone', name, raw.phones)}")
    for phone in shapes:
        if phone.lip_class not in raw.classes:
            raise InputError(f"lips.toml: {unknown('class of phones', phone.lip_class, raw.classes)}")
    for part in (part for d in raw.diphthongs.values() for part in (*d.parts, *d.begun_by)):
        if part not in raw.phones:
            raise InputError(f"lips.toml: {unknown('phone', part, raw.phones)}")


def _check_known(names: Iterable[str]) -> None:
    known = (EVERYTHING, *ARTICULATORS, *INDEX)
    for name in names:
        if name not in known:
            raise InputError(f"lips.toml: {unknown('articulator', name, known)}")


def check_shape(targets: LipTargets) -> None:
    """Raise InputError unless all targets are articulators or parameters, within their ranges."""
    for name, value in targets.items():
        try:
            check_lip_target(name, value)
        except ParameterError as error:
            raise InputError(str(error)) from None
