import random
from dataclasses import replace
from xml.sax.saxutils import quoteattr

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.channels.from_script import inputs_of
from risorius.core.movement import Cause, Movement
from risorius.core.speech.utterance import Word
from risorius.errors import InputError, Place
from risorius.rules.emotions import emotion
from risorius.script.markup import parse_markup
from risorius.script.model import MarkKind, Script
from risorius.script.movements import movements_of

# As printed in the paper, section 2.
PAPER = """<PHONEME time="0" text="Oh really? I like it very much." />  
<EMOTIONDISPLAY time="0" duration="2.0" Surprise="0.7" />
"""  # noqa: W291
SAID = '<PHONEME text="hi"/>\n'
BAD = [
    ("nothing", "", "f:1: the script is empty; expected e.g. <PHONEME"),
    ("no contents", '<SCRIPT language="de"/>', "f:1: the script is empty"),
    (
        "no end",
        '<EMOTIONDISPLAY happiness="1"/>',
        "f:1:1: the script has no words and does not say how long it lasts; expected a duration in SCRIPT",
    ),
    ("no length", '<SCRIPT duration="0"/>', "f:1:9: duration = '0' is out of range; expected more than 0"),
    ("no text", '<PHONEME time="0"/>', 'f:1:1: PHONEME: text is missing; expected e.g. text="Hello."'),
    ("empty text", '<PHONEME text=" "/>', "f:1:10: the text is empty; expected words to speak"),
    ("no letter", '<PHONEME text="?!"/>', "f:1:10: nothing can be spoken in '?!'"),
    (
        "too long",
        f'<PHONEME text="{"a" * 100_001}"/>',
        "f:1:10: the text has 100,001 characters; expected at most 100,000",
    ),
    (
        "too long together",
        f'<PHONEME text="{"a" * 60_000}"/>\n' * 2,
        "f:2:1: the text has 120,000 characters",
    ),
    ("control character", '<PHONEME text="a&#x7f;"/>', "f:1:10: U+007F is not a character of a text"),
    (
        "negative speech",
        '<PHONEME time="-1" text="a"/>',
        "f:1:10: time = '-1' is out of range; expected 0 to 21600",
    ),
    ("speech at a word", '<PHONEME time="word:1" text="a"/>', "f:1:10: time = 'word:1' is not a number"),
    (
        "speech reversed",
        '<PHONEME time="2" text="a"/>\n<PHONEME time="1" text="b"/>',
        "f:2:1: PHONEME: time = 1 is not after 2, the time of the text before; expected a later time",
    ),
    (
        "speech together",
        '<PHONEME time="2" text="a"/><PHONEME text="c"/>\n<PHONEME time="2" text="b"/>',
        "f:2:1: PHONEME: time = 2 is not after 2",
    ),
    ("attribute of speech", '<PHONEME txt="a"/>', "f:1:10: unknown attribute 'txt'; did you mean 'text'?"),
    ("element", "<EMOTIONDISPLY/>", "f:1:1: unknown element 'EMOTIONDISPLY'; did you mean 'EMOTIONDISPLAY'?"),
    ("root", f"<scene>\n  {SAID}</scene>", "f:1:1: unknown element SCENE; a root is SCRIPT"),
    ("root around text", "<apml>Hello.</apml>", "f:1:1: unknown element APML; a root is SCRIPT"),
    (
        "element within",
        f"<SCRIPT><act>{SAID}</act></SCRIPT>",
        "f:1:9: unknown element 'ACT'; expected one of PHONEME",
    ),
    ("known element within", f'<BLINK time="1">{SAID}</BLINK>', "f:1:17: PHONEME stands inside BLINK"),
    (
        "languages",
        '<SCRIPT language="en"/>\n<SCRIPT language="de"/>',
        "f:2:1: SCRIPT: language = 'de' after 'en'; expected one language",
    ),
    (
        "attribute of container",
        '<SCRIPT lang="en"/>',
        "f:1:9: unknown attribute 'lang'; did you mean 'language'?",
    ),
    (
        "emotion",
        SAID + '<EMOTIONDISPLAY\n  Suprise="0.7"/>',
        "f:3:3: unknown attribute 'Suprise'; did you mean 'surprise'?",
    ),
    (
        "together",
        SAID + '<BLINK time="1"/>\n<BLINK time="1.0" duration="2"/>',
        "f:3:1: BLINK starts together with BLINK at f:2:1, both at 1 in channel manipulators; "
        "expected another time, or a layer of its own",
    ),
    (
        "together in a layer",
        SAID + '<SIGNAL time="word:1" layer="b"/>\n<SIGNAL layer="b" time="word:1" AU4="1"/>',
        'f:3:1: SIGNAL AU4="1" starts together with SIGNAL at f:2:1, both at word:1 in channel signals',
    ),
]


@pytest.mark.parametrize(("text", "message"), [row[1:] for row in BAD], ids=[row[0] for row in BAD])
def test_bad_markup_is_refused_with_its_place(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        parse_markup(text, "f")
    assert str(caught.value).startswith(message)
    assert str(caught.value).isprintable()


def performed(text: str) -> list[Movement]:
    """The movements of some markup, in three seconds, without what differs from place to place."""
    found = movements_of(parse_markup(text, "f"), (), 3.0)
    return [replace(m, id="", cause=Cause()) for m in found]


def test_the_papers_example_as_printed() -> None:
    script = parse_markup(PAPER, "paper.xml")
    assert script.text == "Oh really? I like it very much."
    assert [(line.text, line.start) for line in script.lines] == [(script.text, 0.0)]
    assert script.timed
    assert script.source == "paper.xml"
    (mark,) = script.marks
    assert (mark.kind, mark.channel, mark.layer) == (MarkKind.EMOTION, "emotion", "")
    assert (str(mark.start), str(mark.end), mark.onset, mark.offset) == ("0", "2", 0.2, 0.5)
    assert mark.targets == emotion("surprise").shown_units(0.7)
    assert mark.label == 'EMOTIONDISPLAY Surprise="0.7"'
    assert mark.place == Place("paper.xml", 2, 1)
    assert script.lasting((), 0.5) == 2.0


def test_the_papers_demonstration() -> None:
    """Section 6: full surprise from 0 to 2 s, then full happiness, which starts at 1 s and lasts 3 s."""
    first, second = performed(
        '<PHONEME time="0" text="Oh, really? I like it very much."/>'
        '<EMOTIONDISPLAY time="0" duration="2" surprise="1"/>'
        '<EMOTIONDISPLAY time="1" duration="3" happiness="1"/>'
    )
    assert (first.start, first.end, first.targets) == (0.0, 2.0, emotion("surprise").shown_units(1.0))
    assert (second.start, second.end, second.targets) == (1.0, 4.0, emotion("happiness").shown_units(1.0))
    assert first.layer == second.layer == ""


@given(st.randoms(use_true_random=False))
def test_case_does_not_matter(rng: random.Random) -> None:
    def any_case(text: str) -> str:
        return "".join(rng.choice((c.lower(), c.upper())) for c in text)

    names = [any_case(name) for name in ("emotiondisplay", "time", "duration", "surprise")]
    written = '<{} {}="0" {}="2.0" {}="0.7"/>'.format(*names)
    assert performed(SAID + written) == performed(PAPER)


MARKS = [
    '<EMOTIONDISPLAY joy="0.5" end="2"/>',
    '<EMOTIONDISPLAY time="1" sad="0.5" priority="70" release_priority="5"/>',
    '<EMOTIONEMBLEM time="2.5" duration="0.4" angry="1" layer="emblem"/>',
    '<SIGNAL time="0.5"/>',
    '<GAZE target="left" end="1"/>',
    '<GAZE time="1" yaw="-10"/>',
    '<HEAD time="0.2" nod="2"/>',
    '<HEAD time="2" shake="1" layer="other"/>',
    '<BLINK time="1"/>',
    '<MOVEMENT time="1" duration="1" AU12.left="0.5"/>',
    '<TURN time="0.7" type="give"/>',
    '<LISTEN time="2"/>',
]


@given(st.permutations(MARKS))
def test_the_order_of_marks_does_not_matter(marks: list[str]) -> None:
    assert performed(SAID + "\n".join(marks)) == performed(SAID + "\n".join(MARKS))


@given(
    st.text(st.characters(exclude_categories=("Cc", "Cs"), exclude_characters="\ufffe\uffff"), max_size=20)
)
def test_escaped_texts_are_spoken_as_meant(text: str) -> None:
    script = parse_markup(f"<PHONEME text={quoteattr('a' + text)}/>")
    assert script.text == "a" + text


def test_several_lines_and_where_they_stand() -> None:
    script = parse_markup(
        '<PHONEME time="0.5" text="One."/><PHONEME text="Two."/>\n<PHONEME time="3" text="Three."/>'
    )
    assert [(line.text, line.start) for line in script.lines] == [
        ("One.", 0.5),
        ("Two.", None),
        ("Three.", 3.0),
    ]
    assert [script.text[line.source_offset :].split("\n")[0] for line in script.lines] == [
        "One.",
        "Two.",
        "Three.",
    ]


def test_a_container_gives_the_language() -> None:
    script = parse_markup('<?xml version="1.0"?>\n<script language="de"><phoneme text="ja"/></script>')
    assert (script.language, script.text) == ("de", "ja")
    assert parse_markup(SAID).language is None


def test_a_performance_lasts_as_long_as_its_marks() -> None:
    word = Word("one", 0.2, 0.5, 0, 1, 0, 3)

    def lasting(marks: str) -> float:
        script: Script = parse_markup(SAID + marks)
        return round(script.lasting((word,), 1.0), 6)

    assert lasting("") == 1.0
    assert lasting('<BLINK time="2"/><SIGNAL time="1" end="5"/>') == 5.0
    assert lasting('<BLINK time="2" onset="0.1" end="end"/><SIGNAL time="end-1"/>') == 2.1
    assert lasting('<SIGNAL time="word:1+9"/>') == 9.7


@pytest.mark.parametrize(
    ("text", "lasts"),
    [
        ('<SCRIPT duration="6.5"><LISTEN time="0"/></SCRIPT>', 6.5),
        ('<SCRIPT duration="4"/><EMOTIONDISPLAY happiness="0.8"/>', 4.0),
        (
            '<SCRIPT duration="2"><SIGNAL time="end-0.5" end="end"/>'
            '<BLINK time="3" duration="0.5"/></SCRIPT>',
            3.5,
        ),
        ('<EMOTIONDISPLAY time="0.5" duration="3" sadness="0.8"/>', 3.5),
        ('<SCRIPT duration="0.4"/>', 0.4),
    ],
)
def test_a_script_without_words_lasts_as_long_as_it_says(text: str, lasts: float) -> None:
    script = parse_markup(text)
    assert script.text == ""
    assert inputs_of(script, None).duration == pytest.approx(lasts)


def test_a_script_with_words_lasts_at_least_as_long_as_it_says() -> None:
    script = parse_markup(f'<SCRIPT duration="4">{SAID}</SCRIPT>')
    assert (script.lasting((), 1.5), script.lasting((), 6.0)) == (4.0, 6.0)
