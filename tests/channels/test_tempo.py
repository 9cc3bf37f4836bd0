"""Slower speech opens the mouth wider, faster speech less."""

from dataclasses import replace

import pytest

from risorius.channels import ChannelInputs, compose
from risorius.channels.tempo import fullness_of_phones
from risorius.core.speech.audio import silence
from risorius.core.speech.utterance import Utterance
from risorius.rules.lips import lip_table

TEMPO = lip_table().tempo


def opening(utterance: Utterance) -> list[float]:
    """The gap that each /a/ but the last of a phrase asks for, beside the table's, without stress."""
    phones = tuple(replace(p, stress=min(p.stress, 0)) for p in utterance.phones)
    said = compose(ChannelInputs(utterance.duration, replace(utterance, phones=phones))).lips
    own = lip_table().shape("AA").targets["lip_aperture"] * (1.0 - 0.1 * 0.15)
    return [s.targets["lip_aperture"] / own for s in said if s.phone == "AA"][:-1]


@pytest.mark.parametrize(
    ("seconds", "factor"), [(0.4, 1.15), (0.13, 1.07), (0.098, 1.0), (0.07, 0.92), (0.03, 0.85)]
)
def test_the_opening_follows_the_rate_of_syllables(seconds: float, factor: float, utterance_of) -> None:
    found = opening(utterance_of("T AA T AA T AA T AA", seconds))
    assert found == pytest.approx([factor] * 3, abs=0.006)


def test_each_stretch_between_silences_has_its_own_rate(utterance_of) -> None:
    slow, fast = utterance_of("T AA T AA T AA", 0.2), utterance_of("T AA T AA T AA", 0.06)
    both = slow.phones + tuple(
        replace(p, start=p.start + slow.duration, end=p.end + slow.duration) for p in fast.phones
    )
    said = Utterance("", "en-us", silence(both[-1].end), tuple(replace(p, word=-1) for p in both), ())
    found = fullness_of_phones(said, lip_table())
    alone = [fullness_of_phones(each, lip_table()) for each in (slow, fast)]
    assert found == [*alone[0], *alone[1]]
    assert max(alone[0]) == 1.15
    assert min(alone[1]) == pytest.approx(0.88)


def test_a_closure_stays_shut_and_a_pause_at_rest(utterance_of) -> None:
    segments = compose(ChannelInputs(3.0, utterance_of("M AA M AA M AA M", 0.25))).lips
    shut = {s.targets["lip_aperture"] for s in segments if s.phone == "M"}
    assert shut == {lip_table().shape("M").targets["lip_aperture"]}
    breath = next(s for s in segments if s.cause.rule == "lips.breath")
    assert breath.targets == lip_table().pausing.breath_shape


def test_two_syllables_tell_no_rate(utterance_of) -> None:
    assert opening(utterance_of("T AA T AA", 0.3)) == pytest.approx([1.0])


def test_a_language_of_short_syllables_has_a_usual_rate_of_its_own() -> None:
    assert TEMPO.fullness(51, 10.0, "en-us") == 1.0
    assert TEMPO.fullness(51, 10.0, "es-419") == TEMPO.fullness(51, 12.6, "en-gb") > 1.0
