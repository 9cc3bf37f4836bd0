from dataclasses import replace

import pytest

from risorius.core.movement import LipSegment, ManualCurve, Movement
from risorius.core.score import Score, check_score
from risorius.errors import InputError, RisoriusError

SMILE = Movement("emotion", 0.0, 2.0, 0.4, 0.6, {"zygomatic_major.left": 1.0}, id="smile")


@pytest.mark.parametrize(
    ("score", "message"),
    [
        (Score(0.0), "duration = 0.0"),
        (Score(float("nan")), "duration = nan"),
        (Score(3.0, (replace(SMILE, channel="emotions"),)), "did you mean 'emotion'"),
        (Score(3.0, (replace(SMILE, start=-1.0),)), "'smile': start = -1.0"),
        (Score(3.0, (replace(SMILE, end=0.0),)), "'smile': end = 0.0 must come after"),
        (Score(3.0, (replace(SMILE, onset=-0.1),)), "onset = -0.1"),
        (Score(3.0, (replace(SMILE, function="cubic"),)), "unknown onset function"),
        (Score(3.0, (replace(SMILE, targets={"zygomatic_major.left": 2.0}),)), "expected 0 to 1"),
        (Score(3.0, (replace(SMILE, targets={"zygomatic": 1.0}),)), "unknown parameter"),
        (Score(3.0, (SMILE, replace(SMILE, id="other"))), "'smile' and 'other' both start at 0 s"),
        (Score(3.0, lips=(LipSegment("M", 0.2, 0.1, {}),)), "phone M"),
        (Score(3.0, lips=(LipSegment("M", 0.1, 0.2, {}, {"masseter": (0.5, 0.1)}),)), "reversed"),
        (Score(3.0, manual=(ManualCurve({"masseter": ()}),)), "no keys"),
        (Score(3.0, manual=(ManualCurve({"masseter": ((0.0, 0.0), (0.0, 1.0))}),)), "increase"),
    ],
)
def test_bad_scores(score: Score, message: str) -> None:
    with pytest.raises(RisoriusError, match=message):
        check_score(score)


def test_same_start_is_allowed_in_another_layer() -> None:
    check_score(Score(3.0, (SMILE, replace(SMILE, layer="brows"))))


def test_errors_are_one_line() -> None:
    with pytest.raises(InputError) as caught:
        check_score(Score(-1.0))
    assert "\n" not in str(caught.value)
