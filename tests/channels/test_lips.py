from dataclasses import replace

import pytest

from risorius.channels import ChannelInputs, compose
from risorius.core.movement import LipSegment
from risorius.core.utterance import Accent, Syllable, Utterance
from risorius.errors import InputError, ParameterError
from risorius.rules.lips import lip_table

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


@pytest.mark.parametrize(("prominence", "factor"), [(0.0, 1.0), (1.0, 1.08), (-1.0, 0.92), (9.0, 1.16)])
def test_prominent_syllables_open_moderately_more(prominence: float, factor: float, utterance_of) -> None:
    plain = utterance_of("M AA M AA M")
    syllable = Syllable(2, 3, plain.phones[2].start, plain.phones[2].end, 2, 1, prominence=prominence)
    jaw, spoken = (
        next(s for s in segments(u) if s.phone == "AA").targets["jaw_drop"]
        for u in (plain, replace(plain, syllables=(syllable,)))
    )
    assert spoken == pytest.approx(factor * jaw)


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


def test_the_mouth_opens_before_speech_only_in_plain_text(utterance_of) -> None:
    utterance = utterance_of("AA")
    assert [s.cause.rule for s in segments(utterance)][:2] == ["lips.rest", "lips.breath"]
    assert "lips.breath" not in [s.cause.rule for s in segments(utterance, opens=False)]


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
    assert after[0] == pytest.approx(1.16 * before[0])
    assert after[1] == before[1]


def test_the_last_vowel_of_a_phrase_opens_more(utterance_of) -> None:
    opening = [s.targets["jaw_drop"] for s in segments(utterance_of("AA T AA _ AA T AA")) if s.phone == "AA"]
    assert opening[1] > opening[0]
    assert opening[3] > opening[2]
    assert opening[0] == opening[2]


def test_segments_name_the_phone_and_word_that_caused_them(utterance_of) -> None:
    assert [s.cause.trigger for s in segments(utterance_of("M")) if s.phone] == ['/M/ of "m"']
