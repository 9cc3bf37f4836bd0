"""Lips: one segment per phone (two per diphthong), with its targets, dominance and limits.

Paper A, section 5.1; DESIGN, section 3; the numbers are in `rules/data/lips.toml`.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from ..core.lips.articulators import PROTRUSION, SHORTEST_CLOSURE, within_range
from ..core.movement import Cause, LipSegment, silent_dominance
from ..core.speech.utterance import SILENCE, PauseKind, Phone, Utterance
from ..languages.phonesets import to_arpabet
from ..reading.frozen import FrozenDict
from ..rules.articulation import is_known, sounds
from ..rules.lips import OPENING, SEAL, LipTable, PhoneShape
from .anticipation import TargetsHeld, coarticulate_onset, coming_vowels
from .inputs import ChannelInputs, Context
from .registry import register
from .tempo import fullness_of_phones

# Seconds before the release of a closure is heard in which the lips begin to part: people's lips press
# hardest soon after they meet, and may part at full speed before the release (Löfqvist 1996).
PARTING = 0.01
BREATH = "breath"
CONTACTS = (SEAL, "lip_tuck")


def lips(inputs: ChannelInputs, context: Context) -> Iterator[LipSegment]:
    """Yield the segments of all phones and pauses in order, the in-breath before speech included."""
    if inputs.utterance is None:
        return
    table = inputs.rules.tables.lips()
    shaper = _Shaper(table, inputs.utterance, inputs.manner, inputs.articulation)
    released = inputs.utterance.duration
    for index, phone in enumerate(inputs.utterance.phones):
        if phone.symbol in table.silent:
            continue
        if phone.symbol != SILENCE:
            for segment in shaper.spoken(index, phone):
                yield _from_release(segment, released)
                released = segment.end
        elif phone.duration >= table.pausing.shortest:
            yield from shaper.silence(index, phone)
            released = phone.end


@dataclass
class _Shaper:
    """Turns phones into segments; equal shapes share their mappings, so that long clips stay small."""

    table: LipTable
    utterance: Utterance
    manner: str
    articulation: float

    def __post_init__(self) -> None:
        self._factors: dict[float, Mapping[str, float]] = {}
        self._targets: dict[tuple[int, float, float], Mapping[str, float]] = {}
        self._shared: dict[tuple[object, ...], TargetsHeld] = {}
        self._vowels: dict[int, LipSegment] = {}
        self._onsets = _onsets(self.utterance)
        self._coming = coming_vowels(self.utterance, self._anticipates)
        self._final = _phrase_final_phones(self.utterance)
        self._fullness = fullness_of_phones(self.utterance, self.table)
        accents = {accent.syllable for accent in self.utterance.accents}
        self._accented = {
            index
            for number, syllable in enumerate(self.utterance.syllables)
            if number in accents
            for index in range(syllable.first_phone, syllable.last_phone)
        }
        self._prominence = {
            index: syllable.prominence
            for syllable in self.utterance.syllables
            for index in range(syllable.first_phone, syllable.last_phone)
        }

    def spoken(self, index: int, phone: Phone) -> Iterator[LipSegment]:
        """Yield the phone's segments: one for each sound it holds, two for a diphthong."""
        coming = self._coming.get(index)
        if coming is None:
            yield from self._alone(index, phone)
            return
        vowel = self._vowels.get(coming.phone)
        if vowel is None:
            vowel = next(self._alone(coming.phone, self.utterance.phones[coming.phone]))
            self._vowels[coming.phone] = vowel
        for own in self._alone(index, phone):
            # Equal shapes share their mappings.
            owners = (own.targets, own.precision, vowel.targets, vowel.precision)
            key = (*map(id, owners), *coming.shares.items())
            if key not in self._shared:
                self._shared[key] = coarticulate_onset(own, vowel, coming.shares)
            shared = self._shared[key]
            yield own.with_targets(shared.targets, shared.precision)

    def _anticipates(self, phone: Phone) -> Mapping[str, float]:
        """Return the articulators that all sounds of a consonant leave to the coming vowel."""
        classes = [shape.lip_class for _, shape, _ in self._sounds(phone.symbol)]
        first, *others = (self.table.holdings[name].anticipates for name in classes)
        return {name: share for name, share in first.items() if all(name in other for other in others)}

    def _alone(self, index: int, phone: Phone) -> Iterator[LipSegment]:
        scale = self._opening(index, phone)
        before = self.utterance.phones[index - 1].symbol if index else SILENCE
        shapes = self._sounds(phone.symbol, before)
        if index in self._onsets:
            shapes = tuple(
                (symbol, self.table.at_onset(symbol, shape), part) for symbol, shape, part in shapes
            )
        share = phone.duration / sum(part for _, _, part in shapes)
        start = phone.start
        for symbol, shape, part in shapes:
            end = start + part * share
            cause = Cause(sys.intern(f"lips.{symbol}"), self._trigger(phone))
            times = _held(start, end, shape)
            yield self._segment(symbol, shape, *times, cause, scale, self._fullness[index])
            start = end

    def _sounds(self, symbol: str, before: str = SILENCE) -> tuple[tuple[str, PhoneShape, float], ...]:
        """Return a phone's sounds; of one that no table has, those of the class of sounds it looks like."""
        if symbol in self.table.phones or symbol in self.table.diphthongs:
            return self.table.shapes(symbol, before)
        if is_known(symbol):
            return sounds(symbol)
        return tuple(sound for part in to_arpabet(symbol) for sound in self.table.shapes(part))

    def silence(self, index: int, phone: Phone) -> Iterator[LipSegment]:
        """Yield the rest of a pause, with an in-breath at its end if it is long and speech follows."""
        rest, pausing = self.table.rest, self.table.pausing
        cause = Cause("lips.rest", "pause")
        last = index + 1 == len(self.utterance.phones)
        if last or not pausing.allows_breath(phone.duration, begins_clip=index == 0):
            yield self._segment(SILENCE, rest, phone.start, phone.end, cause)
            return
        breath = max(phone.end - pausing.breath_lead, phone.start)
        if index == 0:
            breath = max(breath, min(phone.start + pausing.breath_clip, phone.end - pausing.breath_lips))
        if breath > phone.start:
            yield self._segment(SILENCE, rest, phone.start, breath, cause)
        inhale = PhoneShape(BREATH, pausing.breath_shape)
        end = phone.end - pausing.breath_end
        yield self._segment(SILENCE, inhale, breath, end, Cause("lips.breath", "in-breath"))

    def _segment(
        self,
        symbol: str,
        shape: PhoneShape,
        start: float,
        end: float,
        cause: Cause,
        scale: float = 1.0,
        fullness: float = 1.0,
    ) -> LipSegment:
        holding = self.table.holdings[shape.lip_class]
        targets = self._scaled_targets(shape, scale, fullness)
        if symbol == SILENCE:
            silent = {name: silent_dominance(d, end - start) for name, d in holding.dominance.items()}
            holding = replace(holding, dominance=FrozenDict(silent))
        return LipSegment(
            symbol,
            start,
            end,
            targets,
            holding.limits,
            holding.dominance,
            cause,
            holding.yields,
            holding.precision,
        )

    def _scaled_targets(self, shape: PhoneShape, scale: float, fullness: float) -> Mapping[str, float]:
        key = (id(shape.targets), round(scale, 6), fullness)
        if key not in self._targets:
            opening = self.table.opening
            shares = opening.rounded if PROTRUSION in shape.targets else opening.unrounded
            spoken = self._factors_of(fullness)
            factors = {
                name: spoken.get(name, 1.0) * (1.0 + shares.get(name, 0.0) * (scale - 1.0))
                for name in shape.targets
            }
            self._targets[key] = FrozenDict(
                {name: _scaled(name, value, factors[name]) for name, value in shape.targets.items()}
            )
        return self._targets[key]

    def _factors_of(self, fullness: float) -> Mapping[str, float]:
        """Return the factors on targets in this manner of speech, by how fully it is articulated."""
        if fullness not in self._factors:
            self._factors[fullness] = self.table.factors(self.manner, self.articulation * fullness)
        return self._factors[fullness]

    def _opening(self, index: int, phone: Phone) -> float:
        opening = self.table.opening
        if phone.stress < 0:
            return 1.0
        scale = opening.stressed if phone.stress > 0 else opening.unstressed
        scale *= opening.accented if index in self._accented else 1.0
        scale *= opening.phrase_final if index in self._final else 1.0
        standing = max(min(self._prominence.get(index, 0.0), opening.most_prominent), -opening.most_prominent)
        return min(scale * (1.0 + opening.prominence * standing), opening.widest)

    def _trigger(self, phone: Phone) -> str:
        if phone.word < 0:
            return f"/{phone.symbol}/"
        return f'/{phone.symbol}/ of "{self.utterance.words[phone.word].text}"'


def _scaled(name: str, value: float, factor: float) -> float:
    """Return a target times a factor; a closed articulator stays closed."""
    closed = name in OPENING and value <= 0.0
    return value if closed or factor == 1.0 else within_range(name, value * factor)


def _onsets(utterance: Utterance) -> frozenset[int]:
    """Return the first phones of words and of stressed syllables."""
    stressed = {s.first_phone for s in utterance.syllables if s.stress > 0}
    return frozenset(stressed | {word.first_phone for word in utterance.words})


def _from_release(segment: LipSegment, released: float) -> LipSegment:
    """Return a segment that begins where the stop before it is released, unless it is a contact itself."""
    if released >= segment.start or any(contact in segment.targets for contact in CONTACTS):
        return segment
    return segment.from_start(released)


def _held(start: float, end: float, shape: PhoneShape) -> tuple[float, float]:
    """Return when a phone's shape holds: a stop's until it is released, its burst is the next phone's.

    A closure that is too short first gives up the parting before its release, then begins earlier: the
    release is heard, the lips' meeting may hide in the phone before. None begins before the clip.
    """
    seconds = shape.closure * (end - start)
    if SEAL not in shape.targets:
        return start, min(start + max(seconds, SHORTEST_CLOSURE), end)
    released = start + seconds
    parted = max(released - PARTING, min(released, start + SHORTEST_CLOSURE))
    return max(min(start, parted - SHORTEST_CLOSURE), 0.0), parted


def _phrase_final_phones(utterance: Utterance) -> frozenset[int]:
    """Return the vowels of the last syllable before each pause that ends a phrase."""
    ends = {p.start for p in utterance.pauses if p.kind is not PauseKind.HESITATION}
    finals: set[int] = set()
    vowel = -1
    for index, phone in enumerate(utterance.phones):
        if phone.stress >= 0:
            vowel = index
        if vowel >= 0 and phone.end in ends:
            finals.add(vowel)
    return frozenset(finals)


register("lips", 60.0, lips)
