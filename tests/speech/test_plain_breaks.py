"""Emotion changes neither the place nor the type of accents and boundaries (paper B, section 4.1)."""

from __future__ import annotations

from itertools import product

import pytest

from risorius.core.speech.utterance import Utterance
from risorius.script import Anchor, Script, read_script
from risorius.script.anchor import parse_anchor
from risorius.script.markup import parse_markup
from risorius.speech import synthesize_script
from risorius.speech.affect import Feeling

EMOTIONS = ("anger", "disgust", "fear", "happiness", "sadness", "surprise", "boredom", "contempt", "worry")
SENTENCES = (
    "My brother keeps four goats behind the school and sells their milk.",
    "I thought that you knew where the keys were.",
    "We could have told her about the letter, but nobody dared.",
    "If the ferry leaves without them, who will carry the tents?",
    "Um, well, the gardener painted his fence green before the rain came.",
    "Nobody in the whole village had ever seen a river as wide as this one!",
    "After the concert they walked along the harbour until the lamps went out.",
)


def intonation(said: Utterance) -> tuple[object, ...]:
    """Return phrases, accents and boundaries without their times."""
    phrases = [(p.first_word, p.last_word, p.sentence, p.ending, p.question) for p in said.phrases]
    accents = [(a.word, a.syllable, a.label, a.nuclear, a.confidence) for a in said.accents]
    return phrases, accents, [(b.word, b.label, b.confidence) for b in said.boundaries]


def spoken(script: Script, felt: tuple[Feeling, ...] = (), rate: int | None = None) -> Utterance:
    return synthesize_script(script, felt=felt, rate=rate)


@pytest.mark.parametrize("sentence", SENTENCES)
def test_no_emotion_moves_an_accent_or_a_boundary(sentence: str) -> None:
    script = read_script(sentence, text=True)
    plain = intonation(spoken(script))
    differ = [e for e in EMOTIONS if intonation(spoken(script, (Feeling({e: 1.0}),))) != plain]
    assert differ == []


@pytest.mark.parametrize("rate", [95, 120, 260])
def test_nor_does_it_at_another_rate(rate: int) -> None:
    for sentence, emotion in product(SENTENCES[:2], ("sadness", "fear")):
        script = read_script(sentence, text=True)
        assert intonation(spoken(script, (Feeling({emotion: 1.0}),), rate)) == intonation(
            spoken(script, (), rate)
        )


@pytest.mark.parametrize("end", [None, parse_anchor("end", "word:9.end"), parse_anchor("end", "3.1")])
def test_nor_does_one_that_is_felt_for_a_while(end: Anchor | None) -> None:
    script = read_script(" ".join(SENTENCES[:3]), text=True)
    sad = Feeling({"sadness": 1.0}, parse_anchor("start", "word:3"), end)
    assert intonation(spoken(script, (sad,))) == intonation(spoken(script))


def test_lines_with_times_are_compared_without_them() -> None:
    lines = [f'<PHONEME time="{3.2 * n}" text="{s}"/>' for n, s in enumerate(SENTENCES[:2])]
    script = parse_markup(f"<SCRIPT>{''.join(lines)}</SCRIPT>")
    fast = spoken(script, (Feeling({"fear": 1.0}),), 200)
    assert intonation(fast) == intonation(spoken(parse_markup(f"<SCRIPT>{''.join(lines)}</SCRIPT>"), (), 200))


def test_the_slow_voice_still_pauses_where_the_plain_one_hardly_does() -> None:
    script = read_script(SENTENCES[1], text=True)
    sad, plain = spoken(script, (Feeling({"sadness": 1.0}),)), spoken(script)
    assert len(sad.pauses) == len(plain.pauses) + 1
    inside = next(p for p in sad.pauses if any(q.start < p.start < q.end for q in sad.phrases))
    assert inside.end - inside.start > 0.15


def test_a_rate_of_the_users_own_does_make_phrases() -> None:
    script = read_script(SENTENCES[1], text=True)
    assert len(spoken(script, rate=100).phrases) > len(spoken(script).phrases)
