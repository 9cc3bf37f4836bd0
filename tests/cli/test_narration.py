from risorius.blend import Contribution, Explanation, Tally
from risorius.blend.narrate import narrate
from risorius.cli.narration import tell
from risorius.core.movement import Cause

SMILE = Contribution("emotion", "", "smile", Cause("script", "joy", "a.xml:1:1"), 0.9, 0.1, "limited by /M/")
LIPS = Contribution("lips", "", "/M/", Cause("lips.M", '/M/ of "me"'), 0.05, 0.05, "lower than joy (emotion)")


def explanation(name: str) -> Explanation:
    return Explanation(1.0, name, 0.1, SMILE, (LIPS,), ("held by the seal of the lips",))


def test_nothing_is_said_to_move_where_nothing_does() -> None:
    assert list(narrate([], 1.5)) == ["at 1.5 s nothing moves"]


def test_equal_sides_are_told_once_with_winner_losers_and_notes() -> None:
    both = [explanation("zygomatic_major.left"), explanation("zygomatic_major.right")]
    assert list(narrate(both, 1.0)) == [
        "zygomatic_major = 0.100",
        "    0.100 of 0.900 from emotion: joy (script, a.xml:1:1): limited by /M/",
        '    not 0.050 from lips: /M/ of "me" (lips.M): lower than joy (emotion)',
        "    held by the seal of the lips",
    ]
    assert next(narrate(both[:1], 1.0)) == "zygomatic_major.left = 0.100"


def test_angles_have_their_unit() -> None:
    assert next(narrate([explanation("head_yaw")], 1.0)) == "head_yaw = 0.100 deg"


def test_the_summary_gives_shares() -> None:
    lines = list(tell({"emotion": Tally(200, 150, 10, 40), "gaze": Tally()}))
    assert lines[1].split() == ["emotion", "200", "75.0", "%", "5.0", "%", "20.0", "%"]
    assert lines[2].split() == ["gaze", "0"]
