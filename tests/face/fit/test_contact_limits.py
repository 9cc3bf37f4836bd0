"""Where lips and lids of a face touch, so do those that its weights move."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import risorius
from risorius.core.arkit import EXCLUSIVE, INDEX, SHAPES
from risorius.core.parameters import INDEX as PARAMETER
from risorius.core.parameters import NEUTRAL
from risorius.face.fit import lip_limits
from risorius.face.fit.arkit_fit import NO_WAY, ArkitFit
from risorius.face.fit.lid_limits import lid_vertices
from risorius.face.fit.mouth_gap import MouthGap
from risorius.face.head.head import load_head, shipped_heads
from risorius.face.solve import FaceSolver
from risorius.rules.poses import posed
from risorius.take import Take
from tests.profiles import everyday, examples

LINE = "My baby brother put the map by the beam."
FELT = "anger", "disgust", "fear", "happiness", "sadness", "surprise"
SEALED = 0.05  # mm beyond rest, at most, anywhere between the lips: the mouth is sealed
PERFORMED = [
    ("standard", None),
    ("standard", "happiness"),
    ("amara", "fear"),
    *((name, emotion) for name in ("ines", "kenji", "kwame", "mei", "olaf") for emotion in (None, "disgust")),
]


def perform(name: str, emotion: str | None) -> Take:
    settings = risorius.Settings(dynamics="static", fps=Fraction(30), head=name)
    return risorius.speak(LINE, settings=settings, emotion={emotion: 0.8} if emotion else ())


def gaps(take: Take) -> tuple[np.ndarray, np.ndarray]:
    """Return the gaps (frames, 19) in mm beyond rest of a performance's face, and of its weights'."""
    gap, fit = MouthGap.of(take.head), ArkitFit.of(take.head)
    own = np.array([gap(frame.skin) for frame in take.faces(reuse=True)])
    return own, np.array([gap(fit.skin(weights)) for weights in take.arkit.weights])


@pytest.fixture(
    scope="module", params=everyday(PERFORMED, PERFORMED[:3]), ids=lambda pair: f"{pair[0]} {pair[1]}"
)
def take(request: pytest.FixtureRequest) -> Take:
    return perform(*request.param)


def test_sealed_lips_are_sealed_by_weights(take: Take) -> None:
    own, found = gaps(take)
    sealed = own.max(axis=1) < SEALED
    assert sealed.sum() > 10
    assert (found[sealed].max(axis=1) < 0.25).all()
    assert np.mean(found[sealed].max(axis=1) <= 0.2) > 0.9
    assert found.min() > -0.43
    assert found[sealed].min() > -0.3


def test_the_opening_follows_the_face(take: Take) -> None:
    own, found = (np.maximum(g[:, 9], 0.0) for g in gaps(take))
    assert np.corrcoef(own, found)[0, 1] > 0.98
    assert own @ found / (own @ own) == pytest.approx(1.0, abs=0.05)


def test_only_shapes_that_form_the_mouth_change(take: Take, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lip_limits.LipLimits, "keep", lambda *_: None)
    without = ArkitFit(take.head).track(take.faces()).weights
    changed = np.abs(take.arkit.weights - without).max(axis=0)
    others = [INDEX[name] for name in SHAPES if name not in lip_limits.SHAPES]
    assert changed[others].max() < 1e-6
    assert changed[INDEX["mouthPressLeft"]] > 0.02


def test_weights_stay_weights(take: Take) -> None:
    weights = take.arkit.weights
    assert weights.min() >= 0.0
    assert weights.max() <= 1.0
    assert (weights[:, INDEX["mouthClose"]] <= weights[:, INDEX["jawOpen"]]).all()
    for one, other in EXCLUSIVE:
        assert not (weights[:, INDEX[one]] * weights[:, INDEX[other]]).any(), (one, other)


def test_live_frames_have_the_same_weights(take: Take) -> None:
    fit, way, found = ArkitFit.of(take.head), NO_WAY, []
    for frame in take.faces(reuse=True):
        weights, way = fit.following(frame, way)
        found.append(weights)
    assert np.array(found) == pytest.approx(take.arkit.weights, abs=1e-6)


def test_a_second_run_has_the_same_bytes(take: Take) -> None:
    again = ArkitFit(take.head).track(take.faces())
    assert again.weights.tobytes() == take.arkit.weights.tobytes()


@pytest.mark.parametrize("name", everyday(shipped_heads(), ["standard"]))
def test_any_sealed_mouth_is_closed(name: str) -> None:
    head = load_head(name)
    fit, solver, gap = ArkitFit.of(head), FaceSolver(head), MouthGap.of(head)

    @examples(25)
    @given(st.sampled_from(FELT), st.floats(0.0, 0.8), st.floats(0.0, 0.2))
    def check(emotion: str, strength: float, jaw: float) -> None:
        values = NEUTRAL.copy()
        for muscle, amount in posed({}, {emotion: strength}).items():
            values[PARAMETER[muscle]] = amount
        values[PARAMETER["masseter"]], values[PARAMETER["lip_seal"]] = jaw, 1.0
        found = gap(fit.skin(fit.weights(solver.solve(values))))
        assert found.max() < 0.25
        assert found.min() > -0.3

    check()


def test_nothing_switches_as_a_seal_begins(head) -> None:
    """Weights move evenly while lips that stand 3 mm apart come together."""
    fit, solver = ArkitFit.of(head), FaceSolver(head)
    values = NEUTRAL.copy()
    values[PARAMETER["masseter"]] = 0.1
    found = []
    for seal in np.linspace(0.0, 1.0, 101):
        values[PARAMETER["lip_seal"]] = seal
        found.append(fit.weights(solver.solve(values)))
    assert np.abs(np.diff(found, axis=0)).max() < 0.06


def test_shut_lids_are_shut_by_weights(take: Take) -> None:
    """Squints and raised cheeks in an emotion leave less of the blink to be made, and no slit."""
    fit, pairs = ArkitFit.of(take.head), lid_vertices(take.head, ArkitFit.of(take.head).rest).reshape(-1, 2)

    def widest(skin: np.ndarray) -> float:
        return float((skin[pairs[:, 0], 1] - skin[pairs[:, 1], 1]).max())

    own = np.array([widest(frame.skin) for frame in take.faces(reuse=True)])
    found = np.array([widest(fit.skin(weights)) for weights in take.arkit.weights])
    shut = own < 0.1
    assert shut.any()
    assert found[shut].max() < 0.25


@pytest.mark.parametrize("missing", [["mouthClose"], ["jawOpen"], ["mouthPressLeft", "mouthPressRight"]])
def test_a_rig_without_a_shape_closes_as_far_as_it_can(head, face, missing: list[str]) -> None:
    some = ArkitFit(head, [name for name in SHAPES if name not in missing])
    frame = face(masseter=0.1, lip_seal=1.0)
    weights = some.weights(frame)
    assert not weights[[INDEX[name] for name in missing]].any()
    assert MouthGap.of(head)(some.skin(weights)).max() < 0.25
