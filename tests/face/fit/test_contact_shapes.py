import numpy as np
import pytest

from risorius.core.arkit import INDEX
from risorius.core.parameters import INDEX as PARAMETER
from risorius.core.parameters import NEUTRAL
from risorius.face.fit.arkit_fit import ArkitFit
from risorius.face.fit.contact_shapes import CORNERS, PRESSED
from risorius.face.fit.mouth_gap import MouthGap
from risorius.face.head.head import load_head, shipped_heads
from risorius.face.solve import FaceSolver
from tests.profiles import everyday


def gap_of(name: str, **weights: float) -> np.ndarray:
    """Return the gap (19,) in mm beyond that at rest of a head whose shapes have some weights."""
    head = load_head(name)
    values = np.zeros(52)
    values[[INDEX[shape] for shape in weights]] = list(weights.values())
    return MouthGap.of(head)(ArkitFit.of(head).skin(values))


@pytest.mark.parametrize("name", everyday(shipped_heads(), ["amara", "standard"]))
@pytest.mark.parametrize("weight", [0.1, 1.0])
def test_the_mouth_is_closed_exactly_as_far_as_the_jaw_opens(name: str, weight: float) -> None:
    assert gap_of(name, jawOpen=weight).min() > 4.0 * weight
    assert np.abs(gap_of(name, jawOpen=weight, mouthClose=weight)).max() < 0.01


def test_closing_moves_both_lips_and_little_else(head) -> None:
    fit = ArkitFit.of(head)
    moved = fit.shapes.skin_at(INDEX["mouthClose"])
    lips = head.skin.matrix @ head.masks["lips"]
    squares = (moved[fit.counted] ** 2).sum(axis=1)
    assert squares[lips[fit.counted] < 0.3].sum() < 0.08 * squares.sum()
    corners = MouthGap.of(head).corners(moved)[9]
    upper = MouthGap.of(head).share[9] > 0.0
    assert corners[upper, 1].max() < -10.0
    assert corners[~upper & (MouthGap.of(head).share[9] < 0.0), 1].min() > 10.0


def test_a_side_presses_its_own_lips_most_near_the_corner() -> None:
    left, right = (gap_of("standard", **{f"mouthPress{side}": 1.0}) for side in ("Left", "Right"))
    assert left[:6] == pytest.approx(0.0, abs=0.15)
    assert -PRESSED - 0.3 < left.min() < -0.9 * PRESSED
    assert np.argmin(left) in (15, 16, 17)
    assert left == pytest.approx(right[::-1], abs=0.35)


@pytest.mark.parametrize("name", everyday(shipped_heads(), ["kenji", "standard"]))
def test_puckered_lips_nearly_stay_in_contact(name: str) -> None:
    """The sculpts leave the middle a millimetre open, and the corners overlap by one."""
    assert np.abs(gap_of(name, mouthPucker=1.0)).max() < 0.7


def test_a_shrug_of_the_upper_lip_leaves_the_corners_shut() -> None:
    shrugged = gap_of("standard", mouthShrugUpper=1.0)
    assert shrugged[[0, -1]].max() < 0.5 - 0.4 * CORNERS
    assert shrugged[3:-3].min() > 1.5


@pytest.mark.parametrize("name", everyday(shipped_heads(), ["amara", "standard"]))
def test_a_rolled_lower_lip_goes_under_the_teeth(name: str) -> None:
    """With the jaw a little open, as at /f/ and /v/, it comes near our own lip, and farther back."""
    head = load_head(name)
    gap, fit, solver = MouthGap.of(head), ArkitFit.of(head), FaceSolver(head)
    row = NEUTRAL.copy()
    row[PARAMETER["masseter"]], row[PARAMETER["lip_tuck"]] = 0.1, 1.0
    own = solver.solve(row).skin

    def from_own(roll: float) -> tuple[float, float]:
        weights = np.zeros(52)
        weights[[INDEX["jawOpen"], INDEX["mouthRollLower"]]] = 0.1, roll
        way = np.minimum(gap.share, 0.0)[..., None] * (gap.corners(own) - gap.corners(fit.skin(weights)))
        way = way.sum(axis=1)[5:14, 1:]
        return float(np.linalg.norm(way, axis=1).mean()), float(-way[:, 1].mean())

    (far, behind), (near, _) = from_own(0.0), from_own(0.5)
    assert behind < -1.0
    assert near < 0.5 * far
