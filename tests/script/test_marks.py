from collections.abc import Callable
from dataclasses import replace

import pytest

from risorius.core.action_units import in_parameters, resolve_targets
from risorius.core.movement import Movement
from risorius.errors import InputError
from risorius.rules.emotions import emotion
from risorius.script.markup import parse_markup
from risorius.script.movements import movements_of

SAID = '<PHONEME text="hi"/>\n'
JOY = emotion("joy").targets(0.5)
# Each line of markup stands after SAID; below it, the start of the message it is refused with.
BAD_MARKS = r"""
<EMOTIONDISPLAY time="0"/>
2:1: EMOTIONDISPLAY: no emotion is given; expected e.g. surprise="0.7"
<EMOTIONEMBLEM time="0" AU1="1"/>
2:1: EMOTIONEMBLEM: no emotion is given
<EMOTIONDISPLAY joy="1" happiness="1"/>
2:25: EMOTIONDISPLAY: happiness is given twice; expected it once
<EMOTIONDISPLAY joy="1.01"/>
2:17: joy = '1.01' is out of range; expected 0 to 1
<EMOTIONDISPLAY joy="-0.1"/>
2:17: joy = '-0.1' is out of range; expected 0 to 1
<EMOTIONDISPLAY joy="much"/>
2:17: joy = 'much' is not a number; expected e.g. 0.5
<EMOTIONDISPLAY joy="0,5"/>
2:17: joy = '0,5' is not a number
<EMOTIONDISPLAY joy="nan"/>
2:17: joy = 'nan' is not a number
<BLINK time="1" Time="1"/>
2:17: 'Time' is given twice; expected it once
<BLINK/>
2:1: BLINK: time is missing; expected seconds, word:3
<BLINK time="-1"/>
2:8: time = '-1' is negative; expected 0 or more seconds
<BLINK time="nan"/>
2:8: time = 'nan' is not a time; expected seconds, word:3
<BLINK time="2" end="1"/>
2:17: BLINK: end = 1 is not after time = 2; expected a later end
<SIGNAL time="word:1" end="word:1"/>
2:23: SIGNAL: end = word:1 is not after time = word:1
<BLINK time="2" duration="0"/>
2:17: duration = '0' is out of range; expected more than 0, at most 21600 s
<BLINK time="2" duration="-1"/>
2:17: duration = '-1' is out of range
<BLINK time="2" duration="1" end="3"/>
2:1: BLINK: duration and end are both given; expected one of them
<BLINK time="2" onset="-0.1"/>
2:17: onset = '-0.1' is out of range; expected 0 to 21600
<BLINK time="2" offset="-0.1"/>
2:17: offset = '-0.1' is out of range
<BLINK time="2" onset="inf"/>
2:17: onset = 'inf' is not a number
<BLINK time="2" priority="high"/>
2:17: priority = 'high' is not a number
<BLINK time="2" function="linaer"/>
2:17: unknown function 'linaer'; did you mean 'linear'?
<BLINK time="2" durtion="1"/>
2:17: unknown attribute 'durtion'; did you mean 'duration'?
<BLINK time="2" side="up"/>
2:17: unknown side 'up'; expected one of both, left, right
<BLINK time="2" intensity="2"/>
2:17: intensity = '2' is out of range; expected 0 to 1
<MOVEMENT time="0" duration="1" zygomatic_majr="1"/>
2:33: unknown attribute 'zygomatic_majr'; did you mean 'zygomatic_major'?
<MOVEMENT time="0" duration="1" masseter="2"/>
2:33: masseter = 2.0 is out of range; expected 0 to 1
<MOVEMENT time="0" duration="1" masseter.left="1"/>
2:33: 'masseter' has no side '.left'; expected no side
<MOVEMENT time="0" duration="1" AU99="1"/>
2:33: unknown action unit 'AU99'
<SIGNAL time="0" AU34="1"/>
2:18: AU34 (cheek puff) cannot be shown by the 35 muscles
<MOVEMENT time="0" duration="1"/>
2:1: MOVEMENT: no muscle is given
<MOVEMENT time="0" AU1="1"/>
2:1: MOVEMENT: duration is missing; expected duration or end
<MOVEMENT time="0" duration="1" channel="signal" AU1="1"/>
2:33: unknown channel 'signal'; did you mean 'signals'?
<MOVEMENT time="0" duration="1" channel="lips" AU1="1"/>
2:33: unknown channel 'lips'; expected one of manipulators
<GAZE/>
2:1: GAZE: no direction is given; expected target="listener", pitch or yaw
<GAZE target="lisener"/>
2:7: unknown target 'lisener'; did you mean 'listener'?
<GAZE target="left" yaw="1"/>
2:1: GAZE: target and an angle are both given
<GAZE yaw="90"/>
2:7: yaw = '90' is out of range; expected -45 to 45
<GAZE target="left" distance="0"/>
2:21: distance = '0' is out of range; expected 0.1 to 100
<HEAD time="0"/>
2:1: HEAD: nothing is given; expected nod, shake, tilt, pitch, yaw or roll
<HEAD time="0" nod="2.5"/>
2:1: HEAD: nod = 2.5 is not a number of times
<HEAD time="0" nod="11"/>
2:16: nod = '11' is out of range; expected 0 to 10
<HEAD time="0" nod="1" shake="1"/>
2:1: HEAD: nod and shake are both given
<HEAD time="0" nod="1" yaw="1"/>
2:1: HEAD: nod and an angle are both given
<HEAD time="0" tilt="1" roll="1"/>
2:1: HEAD: tilt and roll are both given
<HEAD time="0" yaw="1" amplitude="1"/>
2:1: HEAD: amplitude is given without nod or shake
<HEAD time="0" roll="50"/>
2:16: roll = '50' is out of range; expected -45 to 45
<TURN time="0"/>
2:1: TURN: type is missing; expected take, keep, give
<TURN time="0" type="gives"/>
2:16: unknown type 'gives'; did you mean 'give'?
<LISTEN gaze="1"/>
2:9: unknown attribute 'gaze'
<BLINK time="1&#10;2"/>
2:8: time = '1 2' is not a time
"""


def pairs(lines: list[str]) -> list[tuple[str, str]]:
    return list(zip(lines[::2], lines[1::2], strict=True))


@pytest.mark.parametrize(("mark", "message"), pairs(BAD_MARKS.strip().split("\n")))
def test_bad_marks_are_refused_with_their_place(mark: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        parse_markup(SAID + mark, "f")
    assert str(caught.value).startswith(f"f:{message}")
    assert str(caught.value).isprintable()


def performed(text: str) -> list[Movement]:
    return list(movements_of(parse_markup(SAID + text, "f"), (), 3.0))


def only(text: str) -> Movement:
    (movement,) = performed(text)
    return movement


def timing(text: str) -> tuple[float, float, float, float]:
    m = only(text)
    return m.start, m.end, m.onset, m.offset


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('<EMOTIONDISPLAY joy="1"/>', (0.0, 3.0, 0.6, 0.75)),
        ('<EMOTIONDISPLAY time="1" joy="1" onset="0.1" offset="0"/>', (1.0, 3.0, 0.1, 0.0)),
        ('<EMOTIONDISPLAY time="1" AU12="1"/>', (1.0, 3.0, 0.45, 0.75)),
        ('<EMOTIONEMBLEM time="1" joy="1"/>', (1.0, 2.0, 0.25, 0.35)),
        ('<SIGNAL time="1"/>', (1.0, 1.5, 0.1, 0.2)),
        ('<HEAD time="1" yaw="5"/>', (1.0, 2.0, 0.2, 0.3)),
        ('<BLINK time="1"/>', (1.0, 1.25, 0.125, 0.0833)),
        ('<MOVEMENT time="end-1" end="end-0.5" AU12="1"/>', (2.0, 2.5, 0.1, 0.2)),
        ('<GAZE yaw="10"/>', (0.0, 3.0, 0.049, 0.049)),
        ('<GAZE distance="2"/>', (0.0, 3.0, 0.2, 0.2)),
    ],
)
def test_times_where_nothing_else_is_said(text: str, expected: tuple[float, ...]) -> None:
    assert timing(text) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("text", "channel"),
    [
        ('<EMOTIONEMBLEM time="1" joy="1"/>', "emotion"),
        ('<SIGNAL time="1" AU4="1"/>', "signals"),
        ('<GAZE target="up"/>', "gaze"),
        ('<HEAD time="1" tilt="5"/>', "head"),
        ('<BLINK time="1"/>', "manipulators"),
        ('<MOVEMENT time="1" duration="1" AU4="1"/>', "signals"),
        ('<MOVEMENT time="1" duration="1" head_yaw="5" AU53="1"/>', "head"),
        ('<MOVEMENT time="1" duration="1" gaze_yaw="5"/>', "gaze"),
        ('<MOVEMENT time="1" duration="1" gaze_yaw="5" AU1="1"/>', "signals"),
        ('<MOVEMENT time="1" duration="1" channel="Emotion" head_yaw="5"/>', "emotion"),
    ],
)
def test_channels(text: str, channel: str) -> None:
    assert only(text).channel == channel


@pytest.mark.parametrize(
    ("text", "targets"),
    [
        (
            '<EMOTIONDISPLAY joy="0.5" AU27="0.4"/>',
            {"masseter": 0.32 + JOY["masseter"], "zygomatic_major.left": JOY["zygomatic_major.left"]},
        ),
        # Units add and are clipped before they become muscles.
        (
            '<EMOTIONDISPLAY joy="0.5" AU26="1"/>',
            resolve_targets({**emotion("joy").shown_units(0.5), "AU26": 1.0}),
        ),
        ('<EMOTIONDISPLAY fear="1" surprise="1"/>', {"frontalis_medialis.left": 1.0}),
        ('<SIGNAL time="0"/>', {"frontalis_medialis.left": 0.6, "frontalis_lateralis.right": 0.6}),
        ('<SIGNAL time="0" AU1.right="0.3"/>', {"frontalis_medialis.right": 0.3}),
        ('<MOVEMENT time="0" duration="1" jaw_open="0.3"/>', {"masseter": 0.3}),
        ('<MOVEMENT time="0" duration="1" zygomatic-major.left="0.3"/>', {"zygomatic_major.left": 0.3}),
        ('<GAZE target="LEFT"/>', {"gaze_yaw": 20.0, "gaze_pitch": 0.0}),
        ('<GAZE pitch="-5" distance="2"/>', {"gaze_pitch": -5.0, "gaze_distance": 2.0}),
        ('<HEAD time="0" tilt="-5" pitch="2"/>', {"head_roll": -5.0, "head_pitch": 2.0}),
        ('<BLINK time="0" intensity="0.5" side="left"/>', {"orbicularis_oculi_palpebralis.left": 0.5}),
    ],
)
def test_output_files(text: str, targets: dict[str, float]) -> None:
    found = in_parameters(only(text).targets)
    assert {name: found.get(name) for name in targets} == pytest.approx(targets)


def test_one_side_leaves_the_other_alone() -> None:
    assert set(only('<BLINK time="0" side="left"/>').targets) == {"orbicularis_oculi_palpebralis.left"}
    brow = only('<SIGNAL time="0" AU2.right="1"/>')
    assert set(in_parameters(brow.targets)) == {"frontalis_lateralis.right"}


def test_what_a_mark_says_of_itself_is_kept() -> None:
    said = 'onset="0.3" offset="0.4" priority="70" release_priority="5" layer=" brow " function="LINEAR"'
    m = only(f'<SIGNAL time="0" {said}/>')
    assert (m.onset, m.offset, m.priority, m.release_priority) == (0.3, 0.4, 70.0, 5.0)
    assert (m.layer, m.function) == ("brow", "linear")


def test_the_strongest_emotion_sets_the_pace(monkeypatch: pytest.MonkeyPatch) -> None:
    quick = replace(emotion("surprise"), onset=0.1)
    find: Callable[[str], object] = lambda name: quick if name == "surprise" else emotion(name)  # noqa: E731
    monkeypatch.setattr("risorius.script.targets.emotion", find)
    assert only('<EMOTIONDISPLAY surprise="0.6" joy="0.5"/>').onset == 0.1
    assert only('<EMOTIONDISPLAY surprise="0.4" joy="0.5"/>').onset == emotion("happiness").onset


def test_giving_the_turn_looks_at_the_listener_and_raises_head_and_brows() -> None:
    eyes, face = performed('<TURN time="1" type="give"/>')
    assert (eyes.channel, eyes.targets) == ("gaze", {"gaze_pitch": 0.0, "gaze_yaw": 0.0})
    assert face.channel == "regulators"
    assert face.targets["head_pitch"] > 0.0
    assert in_parameters(face.targets)["frontalis_medialis.left"] > 0.0


def test_taking_the_turn_looks_away() -> None:
    eyes, _ = performed('<TURN time="1" type="Take"/>')
    assert abs(eyes.targets["gaze_yaw"]) > 5.0


def test_listening_lasts_to_the_end() -> None:
    assert {(m.channel, m.start, m.end) for m in performed("<LISTEN/>")} == {
        ("gaze", 0.0, 3.0), ("regulators", 0.0, 3.0)
    }  # fmt: skip
