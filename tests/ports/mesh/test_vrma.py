import re
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from risorius.api import pose, speak
from risorius.core.arkit import SHAPES, column_of
from risorius.errors import InputError, UnusedSettingError
from risorius.face.contact.mouth import Mouth
from risorius.face.fit.expressions import VOWELS, emotion_presets, expressions
from risorius.ports.formats import format_for
from risorius.ports.mesh.gltf import quaternion
from risorius.settings import Settings
from risorius.take import Take
from risorius.unused_settings import reject_unwritten

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
    assert list(extension["expressions"]) == ["preset"]
    assert set(extension["expressions"]["preset"]) == set(expressions()) < PRESETS
    (animation,) = document.json["animations"]
    moved = {
        channel["target"]["node"]
        for channel in animation["channels"]
        if channel["target"]["path"] == "translation"
    }
    assert not moved & {bone["node"] for bone in bones.values()}


def test_a_weight_is_a_translation_along_x(document: Document, clip: Take) -> None:
    values = document.output("blinkLeft", "translation")[: len(clip.times)]
    assert np.abs(values[:, 0] - clip.arkit.weights[:, SHAPES.index("eyeBlinkLeft")]).max() < 1e-6
    assert values[:, 0].any()
    assert not values[:, 1:].any()


def test_the_emotion_alone_makes_an_avatar_happy(clip: Take, document: Document) -> None:
    happy = document.output("happy", "translation")[:, 0]
    assert happy[0] < 1e-4
    assert happy.max() == pytest.approx(0.5, abs=0.01)


def test_plain_speech_shows_no_emotion_and_shuts_the_mouth(tmp_path: Path) -> None:
    settings = Settings(fps=Fraction(25), dynamics="static")
    take = speak("My baby brother put the map by the beam.", settings=settings)
    take.write(tmp_path / "x.vrma")
    read = Document(tmp_path / "x.vrma")
    for name in emotion_presets():
        assert not read.output(name, "translation").any()
    vowels = np.stack([read.output(name, "translation")[: len(take.times), 0] for name in VOWELS])
    mouth = Mouth.of(take.head)
    rest = mouth.line @ (take.head.skin.matrix @ take.head.rest)[mouth.vertices, 1]
    gaps = np.array([(mouth.line @ frame.skin[mouth.vertices, 1] - rest).max() for frame in take.faces()])
    sealed = (gaps < 0.1) & (take.performance["lip_seal"] > 0.05)
    assert sealed.sum() > 15
    assert not vowels[:, sealed].any()
    assert vowels.max() > 0.2
    assert vowels.sum(axis=0).max() <= 1.0 + 1e-6


@pytest.mark.parametrize("names", ["arkit", "ARKit"])
def test_perfect_sync_has_the_shapes_and_no_preset(clip: Take, tmp_path: Path, names: str) -> None:
    """An avatar whose presets are made of the shapes would add both."""
    replace(clip, settings=replace(clip.settings, names=names)).write(tmp_path / "x.vrma")
    read = Document(tmp_path / "x.vrma")
    written = read.json["extensions"]["VRMC_vrm_animation"]["expressions"]
    spelled = [column_of(name) if names == "ARKit" else name for name in SHAPES]
    assert {kind: list(nodes) for kind, nodes in written.items()} == {"custom": spelled}
    for index, name in enumerate(spelled):
        curve = read.output(name, "translation")[: len(clip.times), 0]
        assert np.abs(curve - clip.arkit.weights[:, index]).max() < 1e-6


def test_an_avatar_of_vrm_0_has_surprised_as_its_own(tmp_path: Path) -> None:
    settings = Settings(fps=Fraction(10), dynamics="static", names="vrm0", lead=0.1, tail=0.1)
    speak("Oh!", emotion={"surprise": 0.8}, settings=settings).write(tmp_path / "x.vrma")
    read = Document(tmp_path / "x.vrma")
    written = read.json["extensions"]["VRMC_vrm_animation"]["expressions"]
    assert set(written["custom"]) == {"Surprised"}
    assert set(written["preset"]) == set(expressions()) - {"surprised"}
    assert read.output("Surprised", "translation").max() > 0.7


def test_a_pose_shows_its_emotions_and_no_others(tmp_path: Path) -> None:
    for emotion, happy in (({"happiness": 0.8}, 0.8), ({}, 0.0)):
        pose({"AU12": 0.5, "AU26": 0.5}, emotion=emotion).write(tmp_path / "x.vrma")
        read = Document(tmp_path / "x.vrma")
        assert read.output("happy", "translation")[:, 0] == pytest.approx(happy, abs=0.01)
    pose({"AU26": 0.5}, settings=Settings(names="arkit")).write(tmp_path / "x.vrma")
    assert Document(tmp_path / "x.vrma").output("jawOpen", "translation").max() > 0.05


def test_names_without_such_a_file_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"unknown set of names 'vrm2'"):
        Settings(names="vrm2")
    refused = "names has no effect: no output has expressions of VRM; expected -o x.vrma"
    with pytest.raises(UnusedSettingError, match=re.escape(refused)):
        reject_unwritten(Settings(names="arkit"), [format_for(tmp_path / "x.rig.glb")])


def test_the_head_turns(document: Document, clip: Take) -> None:
    for row, frame in zip(document.output("head", "rotation"), clip.faces(), strict=False):
        assert abs(row @ quaternion(frame.head_rotation)) == pytest.approx(1.0, abs=1e-6)
