"""BML blocks."""

import pytest

from risorius.api import speak
from risorius.core.action_units import in_parameters
from risorius.core.movement import Movement
from risorius.errors import RisoriusError
from risorius.script.bml import parse_bml
from risorius.script.bml_behaviours import BEHAVIOURS
from risorius.script.bml_shapes import SHAPES
from risorius.script.tree import ScriptWarning
from risorius.settings import Settings
from risorius.speech import synthesize_script

SPEECH = '<speech id="s"><text>Hello <sync id="t"/>there.</text></speech>'
STILL = Settings(lively=False)


def in_block(inside: str) -> str:
    return f"<bml>{SPEECH}\n{inside}</bml>"


BAD = [
    ("<bml></bml>", "x.bml:1: the script has no behaviour"),
    ("<speak>a</speak>", "x.bml:1:1: <speak> stands outside; expected one <bml>"),
    ("<bml>hello</bml>", "x.bml:1:6: 'hello' stands in <bml>"),
    (f"<bml>{SPEECH}", "x.bml:1:1: bml is not closed"),
    (f"<bml>{SPEECH}{SPEECH}</bml>", "x.bml:1:77: id 's' is given twice"),
    ('<bml><speech id="s"/></bml>', "x.bml:1:6: <speech>: text is missing"),
    ('<bml><speech id="s"><text>…</text></speech></bml>', "x.bml:1:6: nothing can be spoken"),
    (in_block('<gaze id="a" target="left" start="x:end"/>'), "x.bml:2:28: unknown behaviour 'x'"),
    (in_block('<gaze id="a" target="left" start="s:tt"/>'), "x.bml:2:28: unknown sync point of 's' 'tt'"),
    (
        in_block('<gaze id="a" target="left" start="soon"/>'),
        "x.bml:2:28: start = 'soon' is not a sync reference",
    ),
    (in_block('<gaze id="a" target="left" start="-1"/>'), "x.bml:2:28: start = '-1' is before the start"),
    (in_block('<gaze id="a" target="left" start="2" end="1"/>'), "x.bml:2:1: 'a' ends at 1, not after"),
    (in_block('<gaze id="a"/>'), "x.bml:2:1: <gaze>: target is missing"),
    (
        in_block('<gaze id="a" target="up" start="b:end"/><gaze id="b" target="up" start="a:end"/>'),
        "x.bml:2:1: a cycle of sync references: a:start → b:end → b:start → a:end → a:start",
    ),
    ('<bml><speech id="s" start="s:end"><text>a</text></speech></bml>', "x.bml:1:21: a cycle of sync"),
    (in_block('<faceLexeme id="a" lexeme="RAISE_BROW"/>'), "x.bml:2:20: unknown lexeme 'RAISE_BROW'; did"),
    (in_block('<faceLexeme id="a"/>'), "x.bml:2:1: <faceLexeme>: lexeme is missing"),
    (in_block('<faceFacs id="a" au="99"/>'), "x.bml:2:18: unknown action unit 'AU99'"),
    (in_block('<faceFacs id="a" au="12" amount="2"/>'), "x.bml:2:26: amount = '2' is out of range"),
    (in_block('<head id="a" lexeme="WAG"/>'), "x.bml:2:14: unknown lexeme 'WAG'"),
    (
        in_block('<constraint><synchronize ref="s:t"><sync ref="z:start"/></synchronize></constraint>'),
        "x.bml:2:42: unknown behaviour 'z'",
    ),
    (
        '<bml><speech id="a"><text>a <sync id="t"/><sync id="t"/></text></speech></bml>',
        "x.bml:1:43: sync point 't' is set twice",
    ),
    (
        f'<bml>{SPEECH}<speech id="b" start="s:t"><text>b</text></speech></bml>',
        "x.bml:1:84: speech starts at a time or after the end",
    ),
]


@pytest.mark.parametrize(("text", "message"), BAD, ids=[row[0][-60:] for row in BAD])
def test_faults_have_their_place(text: str, message: str) -> None:
    with pytest.raises(RisoriusError) as caught:
        parse_bml(text, "x.bml")
    assert str(caught.value).startswith(message), str(caught.value)


@pytest.mark.parametrize(
    ("inside", "message"),
    [
        ('<gesture id="g" lexeme="BEAT"/>', "x.bml:2:1: <gesture> is not understood; it is left out"),
        ('<gaze id="g" target="ball"/>', "x.bml:2:14: target 'ball' is not understood; the listener"),
        ('<gaze id="g" target="up" influence="WAIST"/>', "influence 'WAIST' is not understood"),
    ],
)
def test_what_is_not_understood_is_reported_by_name(inside: str, message: str) -> None:
    with pytest.warns(ScriptWarning) as caught:
        parse_bml(in_block(inside), "x.bml")
    assert [message in str(w.message) for w in caught] == [True]


def test_every_behaviour_has_sync_points() -> None:
    assert set(BEHAVIOURS) == set(SHAPES)


def _is_mark(m: Movement) -> bool:
    """Tell whether a movement is a mark itself, not the head's share of a look."""
    return bool(m.id) and not m.id.endswith(".head")


def movements(tmp_path, inside: str):
    file = tmp_path / "x.bml"
    file.write_text(in_block(inside))
    take = speak(str(file), settings=STILL)
    assert take.utterance is not None
    return take.utterance.words, {m.cause.trigger.split()[1]: m for m in take.score.movements if _is_mark(m)}


def test_behaviours_follow_the_speech(tmp_path) -> None:
    words, found = movements(
        tmp_path,
        '<faceLexeme id="brows" lexeme="RAISE_BROWS" amount="1" start="s:t-0.1" attackPeak="s:t"/>'
        '<faceFacs id="smile" au="12" side="LEFT" start="s:start" end="s:end+0.5"/>'
        '<head id="nod" lexeme="NOD" stroke="s:t"/>',
    )
    brows, smile = found["brows"], found["smile"]
    assert brows.start == pytest.approx(words[1].start - 0.1, abs=1e-6)
    assert brows.onset == pytest.approx(0.1)
    assert in_parameters(brows.targets)["frontalis_medialis.left"] == 1.0
    assert (smile.start, smile.end) == pytest.approx((words[0].start, words[1].end + 0.5), abs=1e-6)
    assert set(in_parameters(smile.targets)) == {"zygomatic_major.left"}
    assert found["nod"].start < words[1].start < found["nod"].end


def test_a_chain_of_references_and_a_constraint(tmp_path) -> None:
    _, found = movements(
        tmp_path,
        '<gaze id="a" target="left" start="0.25" end="1.25"/>'
        '<gazeShift id="b" target="listener" start="a:end+0.5"/>'
        '<faceLexeme id="c" lexeme="OPEN_MOUTH"/>'
        '<constraint><synchronize ref="b:start"><sync ref="c:start"/></synchronize></constraint>'
        '<faceLexeme id="d" lexeme="WIDEN_EYES"/>'
        '<constraint><after ref="a:end"><sync ref="d:start"/></after></constraint>',
    )
    assert (found["a"].start, found["a"].end) == (0.25, 1.25)
    assert found["b"].start == found["c"].start == 1.75
    assert found["b"].end > found["c"].start
    assert found["d"].start == 1.25


def test_two_given_points_stretch_what_lies_between() -> None:
    script = parse_bml('<bml><faceLexeme id="f" lexeme="RAISE_BROWS" start="1" end="4"/></bml>')
    (mark,) = script.marks
    assert (mark.start.seconds, mark.end.seconds) == (1.0, 4.0)
    assert mark.onset == pytest.approx(0.1 * 3.0 / 1.5)


def test_influence_divides_the_turn_between_eyes_and_head() -> None:
    turned = parse_bml('<bml><gaze id="g" target="left" influence="HEAD" offsetAngle="5" /></bml>').marks
    eyes, head = (mark.targets for mark in turned)
    assert eyes["gaze_yaw"] + head["head_yaw"] == pytest.approx(20.0 - 5.0)


def test_a_container_gives_its_sync_points_to_what_it_holds() -> None:
    text = '<bml><face id="f" start="1" end="3" amount="1"><faceFacs id="u" au="4"/></face></bml>'
    (mark,) = parse_bml(text).marks
    assert (mark.start.seconds, mark.end.seconds) == (1.0, 3.0)
    assert set(mark.targets.values()) == {1.0}


def test_speech_in_turn() -> None:
    first = '<speech id="a"><text>One.</text></speech>'
    second = '<speech id="b" start="a:end+1"><text>Two.</text></speech>'
    said = synthesize_script(parse_bml(f"<bml>{first}{second}</bml>"))
    assert said.words[1].start - said.words[0].end == pytest.approx(1.0, abs=0.06)


def test_ssml_in_a_description() -> None:
    text = (
        '<bml><speech id="a"><description type="application/ssml+xml">'
        '<speak>One <mark name="m"/> two.</speak></description></speech>'
        '<head id="h" lexeme="NOD" start="a:m"/></bml>'
    )
    script = parse_bml(text)
    assert script.text == "One two."
    assert script.marks[0].start.character == 4


def test_a_face_may_move_without_a_word(tmp_path) -> None:
    file = tmp_path / "x.bml"
    file.write_text('<bml><faceShift id="f" lexeme="OBLIQUE_BROWS" amount="1" start="0.2"/></bml>')
    take = speak(str(file), settings=STILL)
    assert take.utterance is None
    assert take.curves["frontalis_medialis.left"].max() > 0.9


def test_an_unknown_attribute_is_reported() -> None:
    with pytest.warns(ScriptWarning, match=r"x\.bml:2:14: stroke of <gaze> is not understood"):
        parse_bml(in_block('<gaze id="a" stroke="1" target="up"/>'), "x.bml")


def test_a_constraint_may_come_first_and_may_not_move_what_has_a_time() -> None:
    first = '<constraint><synchronize ref="s:t"><sync ref="f:start"/></synchronize></constraint>'
    (mark,) = parse_bml(in_block(first + '<face id="f" lexeme="RAISE_BROWS"/>')).marks
    assert mark.start.character == len("Hello ")
    after = '<constraint><after ref="s:t"><sync ref="g:start"/></after></constraint>'
    late = f'<gaze id="g" target="up" start="1"/>{after}'
    with pytest.warns(ScriptWarning, match="<after> for a point with a time is not understood; the point"):
        (mark,) = parse_bml(in_block(late)).marks
    assert mark.start.seconds == 1.0
