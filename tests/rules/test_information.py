"""Rules on the themes and rhemes that a script marks."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from risorius.core.counter_rng import CounterRng
from risorius.core.speech.utterance import Utterance
from risorius.errors import InputError
from risorius.rules.match import events_of
from risorius.rules.rule import InformationPart, Level, Position
from risorius.rules.rule_set import extended, shipped
from risorius.rules.rule_spans import RuleSpans
from risorius.rules.situation import PartSpan, Situation

Maker = Callable[..., Utterance]
THEME, RHEME = InformationPart.THEME, InformationPart.RHEME
RULE = """
[[rule]]
id = "signals.brows.mine"
level = "{level}"
when = {{ information = ["{part}"] }}
effect = {{ targets = {{ AU1 = 0.5 }} }}
source = "s"
comment = "c"
"""


def spans_of(said: Utterance, *parts: tuple[InformationPart, int, int]) -> RuleSpans:
    """Return the units of an utterance whose words [first, last) are themes and rhemes."""
    words = said.words
    information = tuple(PartSpan(part, words[a].start, words[b - 1].end) for part, a, b in parts)
    return RuleSpans(Situation(said.duration, said, information=information))


@pytest.mark.parametrize(
    ("level", "part", "message"),
    [
        ("word", "theme", "no word has 'information'"),
        ("information", "topic", 'information.* = "topic" cannot be used'),
    ],
)
def test_rules_that_cannot_fire_are_refused(level: str, part: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        extended(shipped(), RULE.format(level=level, part=part), "my.toml")


def test_a_rule_fires_on_its_part_alone(sentence_of: Maker) -> None:
    said = sentence_of("The old man sold the boat. He left.")
    units = spans_of(said, (THEME, 0, 3), (RHEME, 3, 6), (RHEME, 6, 8))
    rule = extended(shipped(), RULE.format(level="information", part="rheme"), "my.toml").get(
        "signals.brows.mine"
    )
    events = events_of([rule.rule], units, CounterRng(1))
    assert [(e.unit.start, e.unit.end) for e in events] == [
        (said.words[3].start, said.words[5].end),
        (said.words[6].start, said.words[7].end),
    ]


def test_units_have_their_place_in_the_sentence(sentence_of: Maker) -> None:
    said = sentence_of("The old man sold the boat. He left.")
    units = spans_of(said, (THEME, 0, 3), (RHEME, 3, 6), (RHEME, 6, 8)).of(Level.INFORMATION)
    assert [u.position for u in units] == [Position.FIRST, Position.LAST, Position.ONLY]
    assert [u.text for u in units] == [
        'the theme "The old man"',
        'the rheme "sold the boat"',
        'the rheme "He left"',
    ]


def test_a_part_without_words_is_none(sentence_of: Maker) -> None:
    said = sentence_of("The old man sold the boat.")
    empty = PartSpan(THEME, said.words[0].start + 0.01, said.words[0].start + 0.02)
    assert not RuleSpans(Situation(said.duration, said, information=(empty,))).of(Level.INFORMATION)
    assert not RuleSpans(Situation(said.duration, said)).of(Level.INFORMATION)
