import pytest

from risorius.core.movement import Cause, check_movement
from risorius.core.score import check_sequence
from risorius.core.speech.utterance import Word
from risorius.errors import InputError, RisoriusWarning
from risorius.rules.saccade import saccade_duration
from risorius.script.markup import parse_markup
from risorius.script.movements import movements_of
from risorius.script.plain import parse_plain

WORDS = (Word("oh", 0.1, 0.4, 0, 1, 0, 2), Word("really", 0.5, 1.0, 1, 5, 3, 9))
SAID = '<PHONEME text="Oh really"/>\n'
BAD = [
    ("no such word", '<BLINK time="word:3"/>', "f:2:8: 'word:3': there is no word 3; expected words 1 to 2"),
    (
        "no such word at the end",
        '<BLINK time="0" end="word:9.end"/>',
        "f:2:17: 'word:9.end': there is no word 9",
    ),
    ("before the start", '<BLINK time="end-5"/>', "f:2:8: 'end-5' is 3.000 s before the start"),
    (
        "reversed words",
        '<SIGNAL time="word:2" end="word:1.end"/>',
        "f:2:1: SIGNAL ends at 0.4 s (word:1.end), not after its start at 0.5 s (word:2)",
    ),
    (
        "starts at the end",
        '<EMOTIONDISPLAY time="2" joy="1"/>',
        'f:2:1: EMOTIONDISPLAY joy="1" ends at 2 s (end), not after its start at 2 s (2)',
    ),
    (
        "together",
        '<BLINK time="word:2"/>\n<BLINK time="0.5" duration="1"/>',
        "f:3:1: BLINK starts together with BLINK at f:2:1, both at 0.5 in channel manipulators",
    ),
    (
        "together with a nod's second part",
        '<HEAD time="1" nod="1"/>\n<HEAD time="1.17" yaw="5"/>',
        'f:3:1: HEAD yaw="5" starts together with HEAD nod="1" at f:2:1, both at 1.17 in channel head',
    ),
]


@pytest.mark.parametrize(("marks", "message"), [row[1:] for row in BAD], ids=[row[0] for row in BAD])
def test_marks_that_do_not_fit_the_speech_are_refused(marks: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        movements_of(parse_markup(SAID + marks, "f"), WORDS, 2.0)
    assert str(caught.value).startswith(message)
    assert str(caught.value).isprintable()


def test_plain_text_moves_nothing() -> None:
    assert movements_of(parse_plain("Oh really"), WORDS, 2.0) == ()


def test_marks_follow_the_words() -> None:
    (blink,) = movements_of(parse_markup(SAID + '<BLINK time="word:2" end="word:2.end+0.5"/>'), WORDS, 2.0)
    assert (blink.start, blink.end) == (0.5, 1.5)


def test_the_cause_leads_back_to_the_source() -> None:
    (blink,) = movements_of(parse_markup(SAID + ' <BLINK time="1" side="left"/>', "talk.xml"), WORDS, 2.0)
    assert blink.cause == Cause("script", 'BLINK side="left"', "talk.xml:2:2")
    assert blink.id == "manipulators@2.2"


def test_all_can_be_performed() -> None:
    marks = (
        '<EMOTIONDISPLAY joy="1" fear="1"/> <EMOTIONEMBLEM time="1" anger="1"/> <SIGNAL time="word:1"/>'
        '<GAZE target="away"/> <HEAD time="1" nod="3"/> <HEAD time="0" shake="2" layer="b" amplitude="45"/>'
        '<BLINK time="0"/> <MOVEMENT time="1" duration="0.1" AU6="1" head_yaw="80"/>'
        '<TURN time="1.5" type="keep"/>'
        '<LISTEN time="1.7" end="end+3"/>'
    )
    movements = movements_of(parse_markup(SAID + marks), WORDS, 2.0)
    for movement in movements:
        check_movement(movement)
    check_sequence(movements)
    assert len({m.id for m in movements}) == len(movements)
    assert [m.start for m in movements] == sorted(m.start for m in movements)


def test_the_eyes_turn_as_long_as_the_angle_asks_for() -> None:
    marks = (
        '<GAZE yaw="20" end="1"/><GAZE time="0.8" yaw="-20"/><GAZE time="1.5" target="listener" layer="b"/>'
    )
    first, second, other = movements_of(parse_markup(SAID + marks), WORDS, 2.0)
    assert first.onset == first.offset == saccade_duration(20.0)
    assert second.onset == saccade_duration(40.0)
    assert second.offset == saccade_duration(20.0)
    assert other.onset == saccade_duration(0.0)
    assert {m.function for m in (first, second, other)} == {"saccade"}


def test_eyes_that_have_come_back_start_from_rest() -> None:
    marks = '<GAZE yaw="20" end="0.5"/><GAZE time="0.8" yaw="-20"/>'
    _, second = movements_of(parse_markup(SAID + marks), WORDS, 2.0)
    assert second.onset == saccade_duration(20.0)


def test_eyes_that_move_in_other_channels_are_as_fast() -> None:
    marks = '<MOVEMENT time="0" duration="1" channel="regulators" gaze_yaw="10"/>'
    (movement,) = movements_of(parse_markup(SAID + marks), WORDS, 2.0)
    assert (movement.onset, movement.function) == (saccade_duration(10.0), "saccade")


def test_rivals_that_a_mark_asks_for_together_are_said() -> None:
    marked = parse_markup(
        SAID + '<MOVEMENT time="1" duration="0.5" zygomatic_major="0.9" triangularis="0.6"/>'
    )
    with pytest.warns(
        RisoriusWarning, match="triangularis conflicts with zygomatic_major; it is held to 0.1"
    ):
        movements_of(marked, WORDS, 2.0)
