from pathlib import Path

import numpy as np
import pytest

from risorius.core.arkit import SHAPES
from risorius.errors import OutputError
from risorius.face.fit.arkit_fit import ArkitFit
from risorius.take import Take


def test_without_usd_it_is_one_line(clip: Take, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "pxr", None)
    with pytest.raises(OutputError, match=r"x\.usda: needs usd-core; run pip install usd-core"):
        clip.write(tmp_path / "x.usda")
    assert list(tmp_path.iterdir()) == []


def test_pixar_s_reader_finds_the_same_face(clip: Take, tmp_path: Path) -> None:
    pxr = pytest.importorskip("pxr", reason="usd-core is not installed")
    from pxr import Usd, UsdGeom, UsdSkel

    assert pxr
    clip.write(tmp_path / "x.usda")
    stage = Usd.Stage.Open(str(tmp_path / "x.usda"))
    assert stage.GetTimeCodesPerSecond() == 10.0
    assert stage.GetFramesPerSecond() == 10.0
    assert stage.GetEndTimeCode() == len(clip.times) - 1
    animation = UsdSkel.Animation(stage.GetPrimAtPath("/head/animation"))
    assert tuple(animation.GetBlendShapesAttr().Get()) == SHAPES
    weights = np.array(animation.GetBlendShapeWeightsAttr().Get(8))
    assert np.abs(weights - clip.arkit.weights[8]).max() < 1e-6
    # Baked by the reader's own blend shapes and skinning, the skin is what the weights and the head make.
    UsdSkel.BakeSkinning(UsdSkel.Root(stage.GetPrimAtPath("/head")))
    baked = 1000.0 * np.array(UsdGeom.Mesh(stage.GetPrimAtPath("/head/skin")).GetPointsAttr().Get(8))
    made = ArkitFit.of(clip.head).skin(clip.arkit.weights[8])
    frame = next(clip.faces([8]))
    pivot, share = clip.head.head_pivot, np.asarray(clip.head.skin.matrix @ clip.head.neck_weight)[:, None]
    turned = made + share * ((made - pivot) @ frame.head_rotation.T + pivot - made)
    assert np.abs(baked - turned).max() < 0.02


def test_pixar_s_reader_turns_the_eyes_with_the_gaze(clip: Take, tmp_path: Path) -> None:
    """Before, eyeballs were bound to the head alone while the lids' shapes followed the gaze."""
    pytest.importorskip("pxr", reason="usd-core is not installed")
    from pxr import Usd, UsdGeom, UsdSkel

    clip.write(tmp_path / "x.usda")
    stage = Usd.Stage.Open(str(tmp_path / "x.usda"))
    eyes = [UsdGeom.Mesh(stage.GetPrimAtPath(f"/head/eye_{side}")) for side in ("left", "right")]
    rests = [1000.0 * np.array(eye.GetPointsAttr().Get()) for eye in eyes]
    UsdSkel.BakeSkinning(UsdSkel.Root(stage.GetPrimAtPath("/head")))
    head, looked = clip.head, 0.0
    for number, frame in enumerate(clip.faces()):
        for eye, rest, centre, turn in zip(eyes, rests, head.eye_centre, frame.eye_rotation, strict=True):
            baked = 1000.0 * np.array(eye.GetPointsAttr().Get(number))
            in_head = (rest - centre) @ turn.T + centre
            wanted = (in_head - head.head_pivot) @ frame.head_rotation.T + head.head_pivot
            assert np.abs(baked - wanted).max() < 0.01, number
            looked = max(looked, np.abs(in_head - rest).max())
    assert looked > 0.5  # mm: they do move
