from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from risorius.blend.mouth.coarticulation import SegmentValues, without_gaps
from risorius.blend.mouth.effort import EffortModel
from risorius.channels import ChannelInputs, compose
from risorius.core.movement import LipSegment
from risorius.core.score import check_score
from risorius.core.speech.utterance import Accent, Syllable, Utterance
from risorius.errors import InputError, ParameterError
from risorius.rules.articulation import is_known, sounds
from risorius.rules.lips import lip_table
from risorius.speech.structure.phrases import with_phrases

ALL = "AA AE AH AO AW AY B CH D DH EH ER EY F G HH IH IY JH K L M N NG OW OY P R S SH T TH UH UW V W Y Z ZH"


def segments(utterance: Utterance, **options: float) -> tuple[LipSegment, ...]:
    return compose(ChannelInputs(utterance.duration, utterance, **options), without=["manipulators"]).lips


def test_an_unknown_phone_is_named() -> None:
    with pytest.raises(InputError, match="unknown phone 'QX'"):
        lip_table().shape("QX")


def test_sounds_of_other_languages_follow_their_features(utterance_of) -> None:
    found = {s.phone: s.targets for s in segments(utterance_of("m yː ts")) if s.phone}
    assert list(found) == ["m", "y", "ts"]
    assert found["m"]["lip_seal"] == 1.0
    assert found["y"]["lip_protrusion"] > 1.5


def test_a_sound_that_no_table_has_is_shown_by_its_class(utterance_of) -> None:
    assert [s.phone for s in segments(utterance_of("ʘ")) if s.phone] == ["T"]


def test_every_english_phone_has_a_shape(utterance_of) -> None:
    found = {s.phone for s in segments(utterance_of(ALL))}
    assert found == set(ALL.split()) | {""}


@pytest.mark.parametrize("phone", ["P", "B", "M"])
def test_labials_close_and_keep_the_others_from_opening(phone: str, utterance_of) -> None:
    (segment,) = (s for s in segments(utterance_of(f"AA {phone} AA")) if s.phone == phone)
    assert segment.targets["lip_seal"] == 1.0
    assert segment.end - segment.start >= 0.04
    for name in (
        "masseter",
        "depressor_labii.left",
        "levator_labii_nasi.right",
        "levator_labii_superioris.left",
    ):
        assert segment.limits[name][1] <= 0.2


@pytest.mark.parametrize("phone", ["F", "V"])
def test_labiodentals_bring_the_lip_to_the_teeth(phone: str, utterance_of) -> None:
    (segment,) = (s for s in segments(utterance_of(f"AA {phone} AA")) if s.phone == phone)
    assert segment.targets["lip_tuck"] >= 0.9
    assert segment.limits["masseter"][1] <= 0.15


@pytest.mark.parametrize("phone", ["IY", "IH", "EH", "AE", "AA", "AH", "S", "T", "K", "N", "TH"])
def test_unrounded_phones_ask_for_no_protrusion(phone: str) -> None:
    assert "lip_protrusion" not in lip_table().shape(phone).targets


def unstressed(utterance: Utterance) -> Utterance:
    return replace(utterance, phones=tuple(replace(p, stress=min(p.stress, 0)) for p in utterance.phones))


@pytest.mark.parametrize(("prominence", "factor"), [(0.0, 0.9), (1.0, 0.972), (-1.0, 0.828), (9.0, 1.044)])
def test_prominent_syllables_open_moderately_more(prominence: float, factor: float, utterance_of) -> None:
    plain = unstressed(utterance_of("M AA M AA M"))
    syllable = Syllable(2, 3, plain.phones[2].start, plain.phones[2].end, 2, 1, prominence=prominence)
    spoken = next(s for s in segments(replace(plain, syllables=(syllable,))) if s.phone == "AA")
    alone = lip_table().shape("AA").targets
    assert spoken.targets["jaw_drop"] == pytest.approx(alone["jaw_drop"] * (1 + 0.5 * (factor - 1)))
    assert spoken.targets["lip_aperture"] == pytest.approx(alone["lip_aperture"] * (1 + 0.15 * (factor - 1)))


def test_stress_hardly_opens_the_lips_and_rounds_what_is_round(utterance_of) -> None:
    for symbol in ("AE", "UW"):
        said = utterance_of(f"T {symbol} T")
        strong, weak = (
            next(s for s in segments(u) if s.phone == symbol).targets for u in (said, unstressed(said))
        )
        assert strong["jaw_drop"] > 1.05 * weak["jaw_drop"]
        if symbol == "AE":
            assert 1.0 < strong["lip_aperture"] / weak["lip_aperture"] < 1.07
        else:
            assert strong["lip_aperture"] == weak["lip_aperture"]
            assert strong["lip_protrusion"] > weak["lip_protrusion"]


def one_word(utterance: Utterance) -> Utterance:
    first, last = utterance.words[0], utterance.words[-1]
    phones = tuple(replace(p, word=min(p.word, 0)) for p in utterance.phones)
    word = replace(first, end=last.end, last_phone=last.last_phone)
    return with_phrases(replace(utterance, phones=phones, words=(word,), phrases=()))


HEIGHTS = {
    "AE": (11, 14), "AA": (10, 12), "EH": (9, 11), "AH": (6, 8), "ER": (6, 8), "IY": (6, 7.5), "IH": (6, 7.5),
    "AO": (5, 7), "UH": (5, 7), "UW": (2, 3), "S": (3.5, 5), "Z": (3.5, 5), "SH": (3.5, 4.5),
    "ZH": (3.5, 4.5), "CH": (3.5, 4.5), "JH": (3.5, 4.5), "T": (3.5, 5), "D": (3.5, 5), "N": (3.5, 5),
    "L": (5, 6), "F": (1, 2), "V": (1, 2), "W": (0, 0.5), "R": (3.5, 5),
    "æ": (11, 14), "a": (11, 14), "ɑ": (10, 12), "ɛ": (9, 11), "ə": (6, 8), "ʌ": (6, 8), "i": (6, 7.5),
    "ɪ": (6, 7.5), "ɔ": (5, 7), "u": (2, 3), "ʂ": (3.5, 4.5), "ɕ": (3.5, 5),
}  # fmt: skip
"""How far people open the lips, in mm (facts: lips-motion, 3 to 5)."""
SPREAD = ("AE", "AA", "EH", "AH", "ER", "IY", "IH", "æ", "a", "ɑ", "ɛ", "ə", "ʌ", "i", "ɪ")
REACH = 0.9
"""The share of its target that a vowel of 100 ms reaches between weak consonants."""


@pytest.mark.parametrize("phone", HEIGHTS)
def test_lips_open_as_far_as_people_open_them(phone: str) -> None:
    """The target of a vowel that is wider than its neighbours lies as far beyond as it is missed."""
    least, most = HEIGHTS[phone]
    *_, (_, shape, _) = sounds(phone) if is_known(phone) else lip_table().shapes(phone)
    reached = REACH if phone in SPREAD else 1.0
    assert least <= reached * shape.targets["lip_aperture"] <= most


@pytest.mark.parametrize("phone", ["AE", "AA", "EH", "IH", "AH", "IY", "ER"])
def test_a_vowel_of_100_ms_reaches_nine_tenths_of_its_target(phone: str, utterance_of) -> None:
    targets = [shape.targets["lip_aperture"] for _, shape, _ in lip_table().shapes(phone)]
    _, gap = said(unstressed(utterance_of(f"T {phone} T")), "lip_aperture")
    assert REACH * min(targets) <= gap.max() <= 1.02 * max(targets)


def test_the_jaw_has_the_order_that_people_have() -> None:
    order = [("S", "Z"), ("SH", "CH"), ("T",), ("D",), ("UW", "IY"), ("N", "L", "R"), ("K", "G"), ("IH",),
             ("AO",), ("EH",), ("AA",), ("AE",)]  # fmt: skip
    drops = [[lip_table().shape(p).targets["jaw_drop"] for p in phones] for phones in order]
    assert all(max(a) < min(b) for a, b in pairwise(drops))


def said(utterance: Utterance, name: str, step: float = 0.002) -> tuple[np.ndarray, np.ndarray]:
    """Times from the first phone to the last, and an articulator in mm by the least effort, shape (n,)."""
    found = [s for s in segments(utterance) if s.phone]
    model = EffortModel(without_gaps(found))
    times = np.arange(found[0].start, found[-1].end, step)
    targets = SegmentValues(model.targets(name))
    return times, model.averages(model.group(name), [targets], times)[0]


@pytest.mark.parametrize("vowel", ["AA", "AE"])
@pytest.mark.parametrize(
    ("phone", "raise_"), [*((p, 2.0) for p in ("T", "D", "N", "L", "K", "P", "M")), ("S", 4.0), ("SH", 4.0)]
)
def test_a_consonant_between_open_vowels_raises_the_chin(
    vowel: str, phone: str, raise_: float, utterance_of
) -> None:
    times, chin = said(utterance_of(f"T {vowel} {phone} {vowel} T"), "jaw_drop")
    vowels, consonant = abs(times - 0.65) < 0.05, abs(times - 0.75) < 0.07
    assert chin[vowels].max() - chin[consonant].min() >= raise_


@pytest.mark.parametrize("vowel", ["AA", "AE", "IY", "UW"])
@pytest.mark.parametrize("phone", ["L", "D", "N", "K"])
def test_lips_are_free_in_a_consonant_of_the_tongue(phone: str, vowel: str, utterance_of) -> None:
    times, gap = said(utterance_of(f"P {vowel} {phone} {vowel} P"), "lip_aperture")
    assert abs(gap[abs(times - 0.75) < 0.05] - gap[abs(times - 0.85) < 0.01].mean()).max() < 3.0


def test_a_vowel_begins_with_the_consonants_before_it(utterance_of) -> None:
    """In "planks" the lips are as far open at the end of /l/ as they get: /l/ has no lips of its own."""
    times, gap = said(utterance_of("P L AE NG K S", seconds=0.06), "lip_aperture")
    assert 0.57 < times[gap.argmax()] < 0.66


@pytest.mark.parametrize("phone", ["T", "S", "K", "L", "P", "HH"])
def test_a_consonant_is_as_round_as_the_vowel_after_it(phone: str, utterance_of) -> None:
    """In "two" and "Sue" the lips are as round as the vowel begins before it sounds, in /a/ they are not."""
    utterance = utterance_of(f"AA {phone} UW")
    vowel = next(s for s in segments(utterance) if s.phone == "UW").targets
    for name in ("lip_width", "lip_protrusion"):
        times, ours = said(utterance, name)
        before, middle = (np.interp(at, times, ours) for at in (0.55, 0.65))
        assert middle / vowel[name] > 0.8 > 0.2 > before / vowel[name]


def test_a_consonant_at_the_end_of_a_syllable_does_not_wait_for_the_next_vowel(utterance_of) -> None:
    phones = "AA N DH AE"
    bare = utterance_of(phones)
    syllables = tuple(
        Syllable(first, last, bare.phones[first].start, bare.phones[last - 1].end, 1, 0)
        for first, last in ((1, 3), (3, 5))
    )
    ends, begins = (
        next(s for s in segments(utterance) if s.phone == "N").targets["lip_aperture"]
        for utterance in (replace(bare, syllables=syllables), utterance_of("AA N AE"))
    )
    assert ends == lip_table().shape("N").targets["lip_aperture"] < begins
    onset = next(s for s in segments(replace(bare, syllables=syllables)) if s.phone == "DH")
    assert onset.targets["lip_aperture"] > lip_table().shape("DH").targets["lip_aperture"] + 1.0


def test_consonants_that_hold_the_lips_do_not_give_way_to_the_vowel(utterance_of) -> None:
    for phone in ("S", "W", "F", "P"):
        before, after = (
            next(s for s in segments(utterance_of(p)) if s.phone == phone).targets["lip_aperture"]
            for p in (f"{phone} AE", f"AE {phone}")
        )
        assert before == after
    blocked = next(s for s in segments(utterance_of("N S AE")) if s.phone == "N")
    own = lip_table().shape("N").targets
    assert all(blocked.targets[name] == own[name] for name in ("lip_aperture", "jaw_drop"))


def test_a_closure_parts_before_its_release_is_heard_unless_it_is_short(utterance_of) -> None:
    """People's lips part at full speed a little before the release is heard."""
    short, long = (
        next(s for s in segments(utterance_of("AA M AA", seconds=x)) if s.phone == "M") for x in (0.045, 0.1)
    )
    assert long.end - long.start == pytest.approx(0.095 - 0.01)
    assert short.end - short.start == pytest.approx(0.04)
    assert short.start == pytest.approx(0.545, abs=1e-4)


@pytest.mark.parametrize(("phone", "share"), [("P", 0.5), ("B", 0.75), ("M", 0.95)])
def test_a_closure_that_is_too_short_begins_earlier_and_ends_at_its_release(
    phone: str, share: float, utterance_of
) -> None:
    """The release is heard when it is; the lips' meeting may hide in the phone before."""
    segment = next(s for s in segments(utterance_of(f"AA {phone} AA", seconds=0.033)) if s.phone == phone)
    assert segment.end == pytest.approx(0.533 + share * 0.033, abs=1e-4)
    assert segment.start == pytest.approx(segment.end - 0.04)


@pytest.mark.parametrize("lead", [0.0005, 0.003])
@pytest.mark.parametrize("phone", ["P", "B", "M"])
def test_no_closure_begins_before_the_clip(phone: str, lead: float, utterance_of) -> None:
    said = utterance_of(f"{phone} AA", seconds=0.033, lead=lead)
    segment = next(s for s in segments(said) if s.phone == phone)
    assert 0.0 <= segment.start <= lead
    check_score(compose(ChannelInputs(said.duration, said)))


def test_p_is_aspirated_where_a_word_begins_and_in_english_alone(utterance_of) -> None:
    """Closed for a half there, else for seven tenths; the lips part 10 ms before the release is heard."""

    def closed(utterance: Utterance, phone: str) -> float:
        shut = next(s for s in segments(utterance) if s.phone == phone)
        return shut.end - shut.start + 0.01

    assert closed(utterance_of("AA P AA", seconds=0.12), "P") == pytest.approx(0.06, abs=1e-3)
    assert closed(one_word(utterance_of("AA P AA", seconds=0.12)), "P") == pytest.approx(0.084, abs=1e-3)
    assert closed(utterance_of("a p a", seconds=0.12), "p") == pytest.approx(0.084, abs=1e-3)


def test_the_burst_of_a_stop_belongs_to_the_phone_after_it(utterance_of) -> None:
    closure, vowel = (s for s in segments(utterance_of("P AE")) if s.phone)
    assert vowel.start == closure.end < 0.6
    first, second = (s for s in segments(utterance_of("P M")) if s.phone)
    assert first.end < second.start


@pytest.mark.parametrize(("phones", "closed"), [("R AA", True), ("AA R", False), ("W AA", True)])
def test_r_and_w_nearly_close_where_a_word_begins(phones: str, closed: bool, utterance_of) -> None:
    r = next(s for s in segments(one_word(utterance_of(phones))) if s.phone in ("R", "W"))
    assert (r.targets["lip_aperture"] <= 1.5) == closed
    assert (r.precision["lip_aperture"] >= 3.0) == closed


def test_the_r_of_other_languages_has_the_same_allophones(utterance_of) -> None:
    first, last = (
        next(s for s in segments(one_word(utterance_of(p))) if s.phone == "ɹ").targets for p in ("ɹ a", "a ɹ")
    )
    assert first["lip_aperture"] < 2.0 < last["lip_aperture"]


@pytest.mark.parametrize("phone", ["W", "UW", "UH", "AO", "SH", "R"])
def test_rounded_phones_round(phone: str) -> None:
    targets = lip_table().shape(phone).targets
    assert targets["lip_width"] < -5.0
    assert targets["lip_protrusion"] > 0.0


def test_vowels_keep_the_presser_from_pressing() -> None:
    table = lip_table()
    for phone in ("AA", "IY", "UW", "ER"):
        assert table.holdings[table.shape(phone).lip_class].limits["orbicularis_oris_presser"][1] < 0.1


def test_diphthongs_have_two_shapes(utterance_of) -> None:
    first, second = (s for s in segments(utterance_of("T AY T")) if s.phone == "AY")
    assert first.end == second.start
    assert first.targets["jaw_drop"] > second.targets["jaw_drop"]


def test_a_long_close_vowel_comes_to_its_end(utterance_of) -> None:
    """ "Canoe" is narrowest, and roundest, at its end; the teeth of "knee" are nearest there."""
    times, gap = said(utterance_of("N UW"), "lip_aperture")
    _, protrusion = said(utterance_of("N UW"), "lip_protrusion")
    _, jaw = said(utterance_of("N IY"), "jaw_drop")
    begins, ends = (np.searchsorted(times, at) for at in (0.62, 0.68))
    assert gap[begins] > gap[ends] + 1.0
    assert protrusion[begins] < protrusion[ends] - 1.0
    assert jaw[begins] > jaw[ends] + 0.5


def breaths(utterance: Utterance) -> list[tuple[float, float]]:
    """The in-breaths: from how long before the end of their silence to how long before it."""
    ends = [p.end for p in utterance.phones if not p.symbol]
    found = [s for s in segments(utterance) if s.cause.rule == "lips.breath"]
    after = [min(end for end in ends if end > s.start) for s in found]
    return [(end - s.start, end - s.end) for s, end in zip(found, after, strict=True)]


@pytest.mark.parametrize(
    ("silence", "from_"),
    [(0.15, None), (0.2, 0.2), (0.3, 0.3), (0.45, 0.35), (0.5, 0.35), (0.6, 0.45), (2.0, 0.5)],
)
def test_the_mouth_opens_wherever_there_is_silence_before_speech(
    silence: float, from_: float | None, utterance_of
) -> None:
    found = breaths(utterance_of("AA _ AA", lead=silence))
    assert found == ([] if from_ is None else [pytest.approx((from_, 0.135), abs=1e-3)])


@pytest.mark.parametrize("lead", [0.5, 0.6, 1.0])
def test_a_clip_begins_with_lips_at_rest_and_breathes_then(lead: float, utterance_of) -> None:
    model = EffortModel(segments(utterance_of("AA", lead=lead)))
    times = np.array([0.0, lead - 0.2])
    targets = [SegmentValues(model.targets("lip_aperture"))]
    gap = model.averages(model.group("lip_aperture"), targets, times)[0]
    assert -1.0 < gap[0] < 0.1  # shut, or pressed a little
    assert gap[1] > 4.0


def test_the_breath_opens_lips_and_jaw_and_is_over_before_the_first_phone() -> None:
    pausing = lip_table().pausing
    assert 6.0 <= pausing.breath_shape["lip_aperture"] <= 8.0
    assert 3.5 <= pausing.breath_shape["jaw_drop"] <= 5.0
    assert 0.4 <= pausing.breath_lead <= 0.55
    assert 0.12 <= pausing.breath_end <= 0.15


def test_the_lips_stay_round_through_a_breath_between_rounded_words(utterance_of) -> None:
    breath, vowel = segments(utterance_of("UW", lead=0.3))[:2]
    model = EffortModel([replace(vowel, start=-0.1, end=0.0), breath, vowel])
    inhaling = np.linspace(breath.start, breath.end, 20)
    for name in ("lip_width", "lip_protrusion"):
        ours = model.averages(model.group(name), [SegmentValues(model.targets(name))], inhaling)[0]
        assert (ours / vowel.targets[name]).min() > 0.6


def test_articulation_moves_the_opening_most(utterance_of) -> None:
    utterance = utterance_of("AO")
    wide, plain = (next(s for s in segments(utterance, articulation=a) if s.phone) for a in (1.3, 1.0))
    for name in ("jaw_drop", "lip_aperture"):
        assert wide.targets[name] == pytest.approx(1.3 * plain.targets[name])
    assert wide.targets["lip_protrusion"] == pytest.approx(1.15 * plain.targets["lip_protrusion"])


@pytest.mark.parametrize("articulation", [0.5, 1.5])
def test_labials_close_however_far_the_lips_move(articulation: float, utterance_of) -> None:
    utterance = utterance_of("AA M AA")
    (m,) = (s for s in segments(utterance, articulation=articulation) if s.phone == "M")
    assert m.targets["lip_aperture"] < 0.0
    assert m.targets["lip_seal"] == 1.0


def test_manners_change_how_far_the_mouth_opens(utterance_of) -> None:
    utterance = utterance_of("AA")

    def drop(manner: str) -> float:
        inputs = ChannelInputs(utterance.duration, utterance, manner=manner)
        return max(s.targets.get("jaw_drop", 0.0) for s in compose(inputs, without=["manipulators"]).lips)

    assert drop("murmur") < drop("whisper") < drop("plain") < drop("shout")


def test_an_unknown_manner_is_named(utterance_of) -> None:
    utterance = utterance_of("AA")
    with pytest.raises(ParameterError, match="unknown manner of speech 'shuot'; did you mean 'shout'"):
        compose(ChannelInputs(utterance.duration, utterance, manner="shuot"))


def test_accents_open_the_mouth(utterance_of) -> None:
    plain = utterance_of("AA T AA")
    syllables = tuple(Syllable(i, i + 1, plain.phones[i].start, plain.phones[i].end, 0, 0) for i in (1, 3))
    unstressed = replace(
        plain, syllables=syllables, phones=tuple(replace(p, stress=min(p.stress, 0)) for p in plain.phones)
    )
    accent = Accent(plain.phones[1].start, 0, 0)
    before, after = (
        [s.targets["jaw_drop"] for s in segments(u) if s.phone == "AA"]
        for u in (unstressed, replace(unstressed, accents=(accent,)))
    )
    assert after[0] / before[0] == pytest.approx((1 + 0.5 * (1.16 * 0.9 - 1)) / (1 + 0.5 * (0.9 - 1)))
    assert after[1] == before[1]


def test_the_last_vowel_of_a_phrase_opens_more(utterance_of) -> None:
    opening = [s.targets["jaw_drop"] for s in segments(utterance_of("AA T AA _ AA T AA")) if s.phone == "AA"]
    assert opening[1] > opening[0]
    assert opening[3] > opening[2]
    assert opening[0] == opening[2]


def test_segments_name_the_phone_and_word_that_caused_them(utterance_of) -> None:
    assert [s.cause.trigger for s in segments(utterance_of("M")) if s.phone] == ['/M/ of "m"']
