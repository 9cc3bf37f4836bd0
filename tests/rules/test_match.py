from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.counter_rng import CounterRng
from risorius.core.speech.utterance import Question, Utterance
from risorius.rules.emotions import Display
from risorius.rules.match import Event, events_of
from risorius.rules.modulation import Modulation, rate_of, size_of
from risorius.rules.resolve import resolve
from risorius.rules.rule import Level, Rule
from risorius.rules.rule_set import extended, shipped
from risorius.rules.rule_span import RuleSpan
from risorius.rules.rule_spans import RuleSpans
from risorius.rules.situation import Situation
from risorius.rules.synchrony import MovementPhases, nearest, snapped, synchrony
from risorius.speech.synthesis import synthesize_line

Maker = Callable[..., Utterance]
NUMBERS = CounterRng(7)


def rule_of(text: str, name: str = "signals.brows.mine") -> Rule:
    given = f'[[rule]]\nid = "{name}"\nsource = "s"\ncomment = "c"\n' + text
    if "effect" not in text:
        given += "\neffect = { targets = { AU1 = 0.5 } }"
    return extended(shipped(), given, "my.toml").get(name).rule


def units_of(said: Utterance, **more: object) -> RuleSpans:
    return RuleSpans(Situation(said.duration, said, **more))  # type: ignore[arg-type]


def events(rules: Sequence[Rule], said: Utterance, **more: object) -> list[Event]:
    return events_of(rules, units_of(said, **more), NUMBERS)


def fired(text: str, said: Utterance, **more: object) -> list[str]:
    return [e.unit.text.strip('"') for e in events([rule_of(text)], said, **more)]


SAID = (
    "Well[L+H*], who are you[H*]? I am not Julia[H*]. You like it[L*]? "
    "Do you like popcorn[H*] or nuts[H*]? No[H*]!"
)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('level = "word"\nwhen = { accent = ["L+H*"] }', ["Well"]),
        ('level = "word"\nwhen = { accent = ["any"], nuclear = false }', ["popcorn"]),
        ('level = "syllable"\nwhen = { accent = ["L*"] }', ["it"]),
        ('level = "word"\nwhen = { words = ["am not"] }', ["am"]),
        ('level = "word"\nwhen = { pause = ["exclamation"] }', ["No"]),
        ('level = "word"\nwhen = { position = ["first"], question = ["alternative"] }', ["Do"]),
        ('level = "word"\nwhen = { stress = [2], question = ["wh"] }', ["Well", "you"]),
        ('level = "word"\nwhen = { boundary = ["any"], position = ["only"] }', ["Well", "No"]),
        ('level = "phrase"\nwhen = { position = ["first"] }', ["Well"]),
        ('level = "utterance"\nwhen = { question = ["unmarked"] }', ["You like it"]),
        ('level = "utterance"\nwhen = { position = ["last"] }', ["No"]),
        ('level = "pause"\nwhen = { pause = ["comma"] }', ["the comma pause"]),
        ('level = "phoneme"\nwhen = { phones = ["AA"], words = ["no"] }', ['/AA/ of "No']),
    ],
)
def test_rules_fire_where_their_conditions_hold(text: str, expected: list[str], sentence_of: Maker) -> None:
    assert fired(text, sentence_of(SAID)) == expected


def test_questions_are_told_apart(sentence_of: Maker) -> None:
    asked = [u.question for u in units_of(sentence_of(SAID)).of(Level.UTTERANCE)]
    assert asked == [Question.WH, Question.NONE, Question.UNMARKED, Question.ALTERNATIVE, Question.NONE]


def test_items_are_syllables_in_slow_speech_and_words_else(sentence_of: Maker) -> None:
    slow, fast = sentence_of(SAID, phone=0.2), sentence_of(SAID, phone=0.1)
    assert all(u.rate < synchrony().slow_rate for u in units_of(slow).of(Level.ITEM))
    slow_items, fast_items = (units_of(said).of(Level.ITEM) for said in (slow, fast))
    assert [u.position for u in slow_items] == [u.position for u in units_of(slow).of(Level.SYLLABLE)]
    assert [u.position for u in fast_items] == [u.position for u in units_of(fast).of(Level.WORD)]


def test_where_nothing_is_said_only_moments_pass() -> None:
    units = RuleSpans(Situation(3.0))
    assert [u.start for u in units.of(Level.MOMENT)] == [0.0, 1.0, 2.0]
    assert all(units.of(level) == () for level in Level if level is not Level.MOMENT)


def test_turns_end_where_listening_begins(sentence_of: Maker) -> None:
    said = sentence_of("One two. Three four.")
    between = (said.words[1].end + 0.05, said.words[2].start - 0.05)
    assert len(units_of(said).of(Level.TURN)) == 1
    assert len(units_of(said, listening=(between,)).of(Level.TURN)) == 2
    assert fired('level = "moment"\nwhen = { turn = ["listening"] }', said, listening=((0.0, 1.1),)) == [
        "0 s"
    ]


@pytest.mark.parametrize(
    ("felt", "count"),
    [
        ((), 0),
        ((Display("joy", 0.5),), 1),
        ((Display("joy", 0.1),), 0),
        ((Display("joy", 0.5), Display("anger", 0.9)), 0),
    ],
)
def test_the_strongest_emotion_counts(felt: tuple[Display, ...], count: int, sentence_of: Maker) -> None:
    text = 'level = "pause"\nwhen = { pause = ["final"], emotion = ["happy"], intensity = 0.3 }'
    assert len(fired(text, sentence_of("One two"), felt=felt)) == count


LONG = " ".join(["One[H*] two three[H*], four five[H*] six."] * 30)


def test_a_probability_is_the_share_of_units(sentence_of: Maker) -> None:
    said = sentence_of(LONG)
    found = events([rule_of('level = "word"\nprobability = 0.3')], said)
    assert len(found) / len(said.words) == pytest.approx(0.3, abs=0.1)


def test_modulation_thins_or_adds_and_leaves_the_rest(sentence_of: Maker) -> None:
    units = units_of(sentence_of(LONG))
    rules = [rule_of('level = "item"\nwhen = { accent = ["any"] }\nprobability = 0.5')]
    spans = {
        factor: {
            e.span for e in events_of(rules, units, NUMBERS, modulations=[Modulation({"signals": factor})])
        }
        for factor in (0.5, 1.0, 1.5)
    }
    assert spans[0.5] < spans[1.0] < spans[1.5]


def test_factors_of_all_beginnings_multiply() -> None:
    modulations = [
        Modulation({"signals": 2.0, "signals.brows": 0.5}, {"signals.brows.a": 3.0}),
        Modulation({"signals": 4.0}),
    ]
    assert rate_of("signals.brows.a", modulations) == 4.0
    assert rate_of("signals.nod.a", modulations) == 8.0
    assert rate_of("signalsbrows", modulations) == 1.0
    assert size_of("signals.brows.a", modulations) == 3.0
    assert modulations[0].at(0.5).rates == {"signals": 1.5, "signals.brows": 0.75}


def test_another_rule_changes_no_event_of_the_first(sentence_of: Maker) -> None:
    said = sentence_of(LONG)
    one = rule_of('level = "word"\nprobability = 0.4')
    two = rule_of('level = "word"\nprobability = 0.7', "signals.nod.other")
    assert [e for e in events([one, two], said) if e.rule is one] == events([one], said)


def test_grouped_effects_are_alike_within_a_group(sentence_of: Maker) -> None:
    said = sentence_of("One two. Three four. Five six.\n\nSeven eight. Nine ten.")
    effect = "effect = { targets = { head_yaw = 5.0 }, grouped = true, vary = 0.5, mirror = true }"
    text = f'level = "utterance"\n{effect}'
    yaws = [e.targets["head_yaw"] for e in events([rule_of(text, "regulators.head.mine")], said)]
    assert len(set(yaws[:3])) == 1
    assert len(set(yaws[3:])) == 1
    assert yaws[0] != yaws[3]


@pytest.mark.parametrize("phone", [0.08, 0.12, 0.2])
def test_times_lie_on_phonemes_or_far_from_any(phone: float, sentence_of: Maker) -> None:
    said = sentence_of(SAID, phone=phone)
    units = units_of(said)
    bounds = np.array(units.boundaries)
    ruled = [r for r in shipped() if r.timing.snap and r.timing.onset > 0.0]
    found = events_of(ruled, units, NUMBERS)
    assert len(found) > 10
    for event in found:
        times = (event.span.start, event.span.apex, event.span.release, event.span.end)
        assert all(a <= b for a, b in pairwise(times))
        for time in (event.span.start, event.span.release):
            distance = np.abs(bounds - time).min()
            assert distance < 1e-9 or distance > synchrony().reach - 1e-9 or time == event.span.apex


def test_fast_speech_makes_signals_short_and_small(sentence_of: Maker) -> None:
    rule = rule_of('level = "word"\ntiming = { snap = false, apex = 0.1 }')
    (slow, fast) = (events([rule], sentence_of("One two three.", phone=p))[0] for p in (0.2, 0.06))
    assert fast.span.end - fast.span.start < slow.span.end - slow.span.start
    assert fast.targets["AU1"] < slow.targets["AU1"]


TIMES = st.floats(0.0, 10.0)


@given(
    st.lists(TIMES, max_size=60).map(sorted),
    TIMES,
    st.floats(0.01, 1.0),
    st.floats(0.0, 1.0),
    st.floats(0.01, 1.0),
)
def test_snapped_spans_stay_in_order(
    boundaries: list[float], start: float, onset: float, apex: float, offset: float
) -> None:
    span = MovementPhases(start, start + onset, start + onset + apex, start + onset + apex + offset)
    found = snapped(span, boundaries)
    assert found.start < found.apex <= found.release < found.end
    assert abs(found.start - start) <= synchrony().reach


@given(st.lists(TIMES, min_size=1, max_size=60).map(sorted), TIMES)
def test_the_nearest_boundary_is_the_nearest(boundaries: list[float], time: float) -> None:
    best = min(abs(b - time) for b in boundaries)
    expected = best if best <= synchrony().reach else 0.0
    assert abs(nearest(time, boundaries) - time) == expected


def test_what_pauses_others_keeps_them_away(sentence_of: Maker) -> None:
    said = sentence_of("No[H*], I do[H*] not.")
    shake = rule_of(
        'level = "word"\nwhen = { words = ["no"] }\neffect = { gesture = "shake" }\n'
        'pauses = ["signals.nod"]\ntiming = { onset = 0.2, apex = 0.2, offset = 0.2 }',
        "head.verbal.mine",
    )
    nod = rule_of(
        'level = "word"\nwhen = { accent = ["any"] }\neffect = { targets = { head_pitch = -4.0 } }',
        "signals.nod.mine",
    )
    kept = resolve(events([shake, nod], said))
    assert [(e.rule.id, e.unit.text) for e in kept] == [
        ("head.verbal.mine", '"No"'),
        ("signals.nod.mine", '"do"'),
    ]


def test_events_give_way_to_what_the_script_moves(sentence_of: Maker) -> None:
    found = events([rule_of('level = "word"')], sentence_of("One two three four."))
    brow = frozenset({"frontalis_medialis.left"})
    assert resolve(found, [(0.0, 99.0, brow)]) == []
    assert resolve(found, [(0.0, 99.0, frozenset({"head_yaw"}))]) == found


def test_of_two_that_start_together_the_larger_stays(sentence_of: Maker) -> None:
    small = rule_of('level = "word"', "signals.brows.a")
    large = rule_of('level = "word"\neffect = { targets = { AU1 = 0.9 } }', "signals.brows.b")
    assert {e.rule.id for e in resolve(events([small, large], sentence_of("One two.")))} == {
        "signals.brows.b"
    }


def test_units_know_where_they_stand(sentence_of: Maker) -> None:
    words: tuple[RuleSpan, ...] = units_of(sentence_of("One two[H*] three. Four.")).of(Level.WORD)
    assert [str(u.position) for u in words] == ["first", "inner", "last", "only"]
    assert words[1].accented == words[1].start
    assert [u.pause is None for u in words] == [True, True, False, False]


@pytest.mark.parametrize(
    ("language", "text", "question", "tones"),
    [
        ("en-us", "What are you doing?", "wh", "L-L%"),
        ("de", "Was machst du?", "wh", "L-L%"),
        ("de", "Kommst du?", "yes_no", "H-H%"),
        ("es", "¿Cómo estás?", "wh", "L-L%"),
        ("es", "¿Has visto a Juan?", "yes_no", "H-H%"),
        ("fr", "Où vas-tu ?", "wh", "L-L%"),
        ("it", "Hai visto Juan?", "yes_no", "H-H%"),
        ("nl", "Wat doe je?", "wh", "L-L%"),
        ("pt", "Viste o João?", "yes_no", "H-H%"),
    ],
)
def test_voice_and_face_ask_alike(language: str, text: str, question: str, tones: str) -> None:
    said = synthesize_line(text, language=language, tail=0.5)
    assert [b.label for b in said.boundaries] == [tones]
    for level in (Level.UTTERANCE, Level.PAUSE, Level.WORD):
        rule = rule_of(f'level = "{level}"\nwhen = {{ question = ["{question}"] }}')
        assert events([rule], said), level
