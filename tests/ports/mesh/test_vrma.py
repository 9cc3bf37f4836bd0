from pathlib import Path

import numpy as np
import pytest

from risorius.core.arkit import SHAPES
from risorius.ports.mesh.gltf import quaternion
from risorius.take import Take

from ..gltf_reader import Document

PRESETS = {
    *("happy", "angry", "sad", "relaxed", "surprised", "aa", "ih", "ou", "ee", "oh"),
    *("blink", "blinkLeft", "blinkRight", "neutral"),
}


@pytest.fixture(scope="module")
def document(clip: Take, tmp_path_factory: pytest.TempPathFactory) -> Document:
    path: Path = tmp_path_factory.mktemp("vrma") / "x.vrma"
    clip.write(path)
    return Document(path)


def test_the_rules_of_the_specification(document: Document) -> None:
    extension = document.json["extensions"]["VRMC_vrm_animation"]
    assert document.json["extensionsUsed"] == ["VRMC_vrm_animation"]
    assert extension["specVersion"] == "1.0"
    bones = extension["humanoid"]["humanBones"]
    assert {"hips", "spine", "head"} <= set(bones)
    assert not {"leftEye", "rightEye"} & set(bones)
    assert set(extension["expressions"]["preset"]) <= PRESETS
    assert set(extension["expressions"]["custom"]) == set(SHAPES)
    (animation,) = document.json["animations"]
    moved = {
        channel["target"]["node"]
        for channel in animation["channels"]
        if channel["target"]["path"] == "translation"
    }
    assert not moved & {bone["node"] for bone in bones.values()}


def test_a_weight_is_a_translation_along_x(document: Document, clip: Take) -> None:
    values = document.output("jawOpen", "translation")
    assert np.abs(values[:, 0] - clip.arkit.weights[:, SHAPES.index("jawOpen")]).max() < 1e-6
    assert not values[:, 1:].any()
    happy = document.output("happy", "translation")[:, 0]
    assert happy.min() >= 0.0
    assert 0.1 < happy.max() <= 1.0


def test_the_head_turns(document: Document, clip: Take) -> None:
    for row, frame in zip(document.output("head", "rotation"), clip.faces(), strict=True):
        assert abs(row @ quaternion(frame.head_rotation)) == pytest.approx(1.0, abs=1e-6)
