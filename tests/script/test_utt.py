"""Utterance files."""

import pytest

from risorius.core.directions import Break
from risorius.errors import InputError
from risorius.script import read_script
from risorius.script.utt import parse_utterance
from risorius.speech import feelings, synthesize_script

BAD = [
    ("", "x.utt:1: the script has no words; expected at least one line 'text: …'"),
    ("txet: (A)", "x.utt:1:1: unknown key 'txet'; did you mean 'text'"),
    ("hello", "x.utt:1:1: 'hello' is not a line of an utterance"),
    ("emotion: hapiness 0.3\ntext: (A)", "x.utt:1:10: unknown emotion 'hapiness'; did you mean 'happiness'"),
    ("emotion: joy\ntext: (A)", "x.utt:1:10: 'joy' is not an emotion; expected e.g. happiness 0.7"),
    ("emotion: joy 0.5/\ntext: (A)", "x.utt:1:10: 'joy 0.5/' is not an emotion; expected e.g. happiness 0.7"),
    ("emotion: joy 0.5, fear 2\ntext: (A)", "x.utt:1:19: "),
    ("text: (A)\nemotion: joy 0.5", "x.utt:2:10: emotion comes after the text"),
    ("language: de\nlanguage: fr\ntext: (A)", "x.utt:2:11: language is given twice"),
    ("accents: (H*)\ntext: (A)", "x.utt:1:10: accents comes before the text"),
    ("text: (A)\naccents: (H*)\naccents: (H*)", "x.utt:3:10: accents is given twice"),
    ("text: (A)\naccents:", "x.utt:2:9: no accents"),
    ("text: ()", "x.utt:1:7: nothing can be spoken"),
    ("text: (A) (B)\nphonemes: (ey)", "x.utt:2:11: 1 brackets of phonemes for 2 of words"),
    ("text: (A B)\nphonemes: (ey)", "x.utt:2:11: phonemes of 1 words for 2 words"),
    ("text: (A)\nphonemes: (@)", "x.utt:2:12: unknown phoneme '@'"),
    ("text: (AN)\nphonemes: (ae<80>n)", "x.utt:2:11: 1 of 2 phonemes have a duration"),
]
JULIA = """
# a comment
emotion: happiness 0.4, surprise 0.2
text:     (JUlia prefers) (POPcorn)   # and another
accents:  (L+H* LH%) (H* LL%)
phonemes: (jh'uwliyax prixf'rrz _) (p'aapkaorn)
text: Really?
"""


@pytest.mark.parametrize(("text", "message"), BAD, ids=[row[0][:20] for row in BAD])
def test_faults_have_their_place(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        parse_utterance(text, "x.utt")
    assert str(caught.value).startswith(message)


def test_an_unknown_language_names_the_file() -> None:
    with pytest.raises(Exception, match=r"x\.utt:.*unknown language 'qq'"):
        synthesize_script(parse_utterance("language: qq\ntext: (A)", "x.utt"))


def test_all_of_it() -> None:
    script = parse_utterance(JULIA, "x.utt")
    (line,) = script.lines
    assert line.text == "Julia prefers, popcorn. Really?"
    assert not script.timed
    assert [(mark.emotions, mark.place.column) for mark in script.marks] == [
        ({"happiness": 0.4}, 10),
        ({"surprise": 0.2}, 25),
    ]
    dictated = {line.text[s.start : s.end]: " ".join(s.phones) for s in line.directions.spans if s.phones}
    assert dictated == {
        "Julia": "JH UW1 L IY0 AH0",
        "prefers": "P R IH0 F ER1 Z",
        "popcorn": "P AA1 P K AO0 R N",
    }
    (pause,) = line.directions.breaks
    assert (pause.at, pause.seconds) == (line.text.index("popcorn"), 0.2)
    assert isinstance(pause, Break)


def test_julia_is_spoken_as_written() -> None:
    said = synthesize_script(parse_utterance(JULIA, "x.utt"))
    phones = {
        w.text: " ".join(p.symbol for p in said.phones[w.first_phone : w.last_phone]) for w in said.words
    }
    assert phones["popcorn"] == "P AA P K AO R N"
    assert [(said.words[a.word].text, a.label) for a in said.accents[:2]] == [
        ("Julia", "L+H*"),
        ("popcorn", "H*"),
    ]
    assert [(said.words[b.word].text, b.label) for b in said.boundaries] == [
        ("prefers", "L-H%"),
        ("popcorn", "L-L%"),
        ("Really", "H-H%"),
    ]


def test_an_emotion_at_the_head_may_have_a_priority() -> None:
    marks = read_script_text("emotion: sadness 1/80, fear 0.2\n").marks
    assert [mark.priority for mark in marks] == [80.0, 10.0]


def test_the_emotion_at_the_head_changes_the_voice() -> None:
    plain, sad = (read_script_text(head) for head in ("", "emotion: sadness 1\n"))
    quick, slow = synthesize_script(plain).words, synthesize_script(sad, felt=feelings(sad, ())).words
    assert slow[-1].end - slow[0].start > 1.15 * (quick[-1].end - quick[0].start)


def read_script_text(head: str):
    return parse_utterance(head + "text: (JUlia prefers) (POPcorn)", "x.utt")


def test_words_between_asterisks_are_emphasised() -> None:
    (line,) = read_script("I like *this* one, not 2 * 3 * 4.", text=True).lines
    assert [line.text[s.start : s.end] for s in line.directions.spans] == ["this"]


def test_durations_need_an_english_voice() -> None:
    script = parse_utterance("language: de\ntext: (JA)\nphonemes: (y<90>aa<200>)", "x.utt")
    with pytest.raises(
        InputError, match=r"x\.utt:3:12: durations of phonemes in 'de'; expected an English voice"
    ):
        synthesize_script(script)
