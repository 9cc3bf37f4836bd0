import json
import struct
from pathlib import Path

import numpy as np
import pytest

from risorius.api import pose, rig
from risorius.cli import run
from risorius.core.arkit import INDEX, SHAPES
from risorius.errors import InputError, RisoriusError
from risorius.face.fit.arkit_fit import ArkitFit
from risorius.face.head.head import load_head
from risorius.ports.mesh.glb_file import read_glb
from risorius.ports.mesh.gltf import Gltf
from risorius.ports.mesh.rig import lips_apart, read_rig
from risorius.ports.mesh.shape_names import guess_map
from risorius.take import Take


def character(path: Path, names: list[str], *, named: bool = True) -> Path:
    """A triangle with morph targets."""
    gltf = Gltf(generator="test")
    points = np.eye(3, dtype=np.float32)
    target = {"POSITION": gltf.accessor(points)}
    primitive = {"attributes": {"POSITION": gltf.accessor(points)}, "targets": [target] * len(names)}
    mesh = {"primitives": [primitive], **({"extras": {"targetNames": names}} if named else {})}
    gltf.add("nodes", {"mesh": gltf.add("meshes", mesh)})
    gltf.add("scenes", {"nodes": [0]})
    gltf.save(path)
    return path


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "is not binary glTF"),
        (b"glTF" + struct.pack("<II", 1, 12), "is not binary glTF 2.0"),
        (b"glTF" + struct.pack("<II", 2, 99), "is cut off"),
        (b"glTF" + struct.pack("<II", 2, 12), "is not binary glTF"),
        (
            b"glTF" + struct.pack("<II", 2, 24) + struct.pack("<I4s", 4, b"JSON") + b"{no}",
            "is not JSON: expecting property name",
        ),
        (b"glTF" + struct.pack("<II", 2, 24) + struct.pack("<I4s", 4, b"JSON") + b"[]  ", "no glTF document"),
    ],
)
def test_what_is_no_glb_is_one_line(tmp_path: Path, data: bytes, message: str) -> None:
    (tmp_path / "x.glb").write_bytes(data)
    with pytest.raises(InputError, match=message):
        read_rig(tmp_path / "x.glb")


def test_a_mesh_without_targets_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="has no morph targets"):
        read_rig(character(tmp_path / "x.glb", []))


def glb(document: dict[str, object]) -> bytes:
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunk = struct.pack("<I4s", len(text), b"JSON") + text
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunk)) + chunk


@pytest.mark.parametrize(
    ("mesh", "message"),
    [
        ({"primitives": 3}, "'primitives' of mesh 0 is not a list"),
        ({"primitives": [3]}, "'targets' of mesh 0 is not a list"),
        ({"primitives": [{"targets": 3}]}, "'targets' of mesh 0 is not a list"),
        (
            {"primitives": [{"targets": [{}]}], "extras": {"targetNames": 3}},
            "'targetNames' of mesh 0 is not a list",
        ),
        (
            {"primitives": [{"targets": [{}] * 2}], "extras": {"targetNames": ["a"]}},
            "2 morph targets and 1 names",
        ),
        ({"primitives": [{"targets": [{}]}, {}]}, "has 1 morph targets and 0 names"),
        (3, "'meshes' is not a list of objects"),
    ],
)
def test_meshes_that_are_none_are_named(tmp_path: Path, mesh: object, message: str) -> None:
    (tmp_path / "x.glb").write_bytes(glb({"meshes": [mesh]}))
    with pytest.raises(InputError, match=message):
        read_rig(tmp_path / "x.glb")


@pytest.mark.parametrize(
    ("name", "other", "message"),
    [
        (
            "viseme_PP",
            {"nodes": [{"mesh": 0}]},
            "no morph target has the name of an ARKit shape; expected --map",
        ),
        ("jawOpen", {}, "no node shows a mesh with morph targets"),
        ("jawOpen", {"nodes": 7}, "'nodes' is not a list of objects"),
        ("jawOpen", {"nodes": [{"mesh": 0}], "animations": "x"}, "'animations' is not a list of objects"),
        (
            "jawOpen",
            {"nodes": [{"mesh": 0}], "buffers": [{"uri": "x.bin"}]},
            "keeps its data in another file",
        ),
    ],
)
def test_what_cannot_perform_is_told_before_anything_is_said(
    tmp_path: Path, name: str, other: dict[str, object], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    mesh = {"primitives": [{"targets": [{}]}], "extras": {"targetNames": [name]}}
    (tmp_path / "x.glb").write_bytes(glb({"meshes": [mesh], **other}))
    assert run(["rig", str(tmp_path / "x.glb"), "--perform", "Hi.", "-o", str(tmp_path / "y.glb")]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert not (tmp_path / "y.glb").exists()


@pytest.mark.parametrize(
    ("output", "message"),
    [
        ("y.txt", "unknown suffix '.txt'"),
        ("y.mp4", "is not a .glb file"),
        ("none/y.glb", "folder .*none' does not exist"),
    ],
)
def test_the_output_is_told_before_anything_is_said(tmp_path: Path, output: str, message: str) -> None:
    path = character(tmp_path / "x.glb", ["Jaw_Open"])
    with pytest.raises(RisoriusError, match=message):
        rig(path, take=lambda: pytest.fail("spoken"), output=tmp_path / output)
    assert [file.name for file in tmp_path.iterdir()] == ["x.glb"]


def test_a_character_that_shows_only_the_tongue(tmp_path: Path) -> None:
    """None of what it has is fitted, and what is fitted it does not have."""
    _, rows = rig(character(tmp_path / "x.glb", ["tongueOut"]))
    assert {row.verdict for row in rows} == {"not"}


def test_wrong_maps_are_named(tmp_path: Path) -> None:
    path = character(tmp_path / "x.glb", ["Jaw"])
    for text, message in (
        ('[shapes]\njawOpne = "Jaw"', ":2:1: unknown ARKit shape 'jawOpne'; did you mean 'jawOpen'"),
        ("", r"\[shapes\] is empty"),
        (
            '[shapes]\njawOpen = "Jaw"\nmouthClose = "Jaw"',
            ":3:1: morph target 'Jaw' is given for jawOpen and for",
        ),
        ('[shapes]\njawOpen = "Jwa"', ":2:1: unknown morph target 'Jwa'; did you mean 'Jaw'"),
        ('[shape]\njawOpen = "Jaw"', "shape"),
    ):
        (tmp_path / "map.toml").write_text(text)
        with pytest.raises(InputError, match=message):
            read_rig(path, tmp_path / "map.toml")


@pytest.mark.parametrize(
    ("target", "shape"),
    [
        ("jawOpen", "jawOpen"),
        ("JawOpen", "jawOpen"),
        ("head_geo.Jaw_Open", "jawOpen"),
        ("Eye_Blink_L", "eyeBlinkLeft"),
        ("eyeBlink_R", "eyeBlinkRight"),
        ("blendShape1.mouthSmile_L", "mouthSmileLeft"),
        ("mouthSmileLft", "mouthSmileLeft"),
        ("eyeBlink.L", "eyeBlinkLeft"),
        ("mouthSmile.R", "mouthSmileRight"),
        ("Mouth_Smile.right", "mouthSmileRight"),
        ("blendShape1.eyeBlink.L", "eyeBlinkLeft"),
        ("jawOpen.001", "jawOpen"),
        ("Head_jawOpen", "jawOpen"),
    ],
)
def test_names_are_guessed(target: str, shape: str) -> None:
    assert guess_map([target]) == {shape: (target,)}


def test_sides_are_never_mixed_up() -> None:
    assert guess_map(["mouthSmileRight"]) == {"mouthSmileRight": ("mouthSmileRight",)}
    assert guess_map(["viseme_PP", "noseHair"]) == {}


def test_each_mesh_may_spell_names_its_own_way() -> None:
    """Maya writes the node's name before the target's."""
    teeth, skin = (
        ["blendShape1.jawOpen", "blendShape1.dirt"],
        ["blendShape5.eyeBlink_L", "blendShape5.jawOpen"],
    )
    assert guess_map(teeth, skin, ["jawOpen"]) == {
        "eyeBlinkLeft": ("blendShape5.eyeBlink_L",),
        "jawOpen": ("blendShape1.jawOpen", "blendShape5.jawOpen", "jawOpen"),
    }


@pytest.mark.parametrize("spelled", ["{} ", "face:{}", "blendShape2.{}", "CC_Base_{}", "Head_{}"])
@pytest.mark.parametrize(
    "sides", [("Left", "Right"), (".L", ".R"), ("_l", "_r"), (".Left", ".Right"), ("_LFT", "_RGT")]
)
def test_all_shapes_are_found_however_they_are_spelled(spelled: str, sides: tuple[str, str]) -> None:
    def own(shape: str) -> str:
        for side, other in zip(("Left", "Right"), sides, strict=True):
            if shape.endswith(side) and shape not in ("jawLeft", "jawRight", "mouthLeft", "mouthRight"):
                return shape.removesuffix(side) + other
        return shape

    names = [spelled.format(own(shape)) for shape in SHAPES]
    assert guess_map(names) == {shape: (name,) for shape, name in zip(SHAPES, names, strict=True)}


def test_a_prefix_counts_only_if_several_shapes_have_it() -> None:
    assert guess_map(["fix_jawOpen", "age", "jawOpen"]) == {"jawOpen": ("jawOpen",)}
    assert guess_map(["fix_jawOpen", "fix_mouthClose", "jawOpen", "mouthClose"]) == {
        "jawOpen": ("jawOpen",),
        "mouthClose": ("mouthClose",),
    }


def test_the_report_says_what_is_shown_and_what_not(tmp_path: Path) -> None:
    names = [name for name in SHAPES if not name.startswith(("brow", "eyeBlink"))]
    found, rows = rig(character(tmp_path / "x.glb", names))
    assert set(found.missing) == {name for name in SHAPES if name not in names}
    verdicts = {row.parameter: row for row in rows}
    assert verdicts["frontalis_lateralis.left"].verdict == "not"
    assert verdicts["orbicularis_oculi_palpebralis.right"].verdict == "not"
    assert verdicts["masseter"].verdict == "well"
    assert verdicts["zygomatic_major.left"].left_over < 0.4
    assert all(row.best <= row.left_over + 0.03 for row in rows)


def test_the_lips_of_a_character_close_whatever_it_lacks(tmp_path: Path) -> None:
    """Without a shape that closes the mouth, the jaw does not open under a seal."""
    for name, missing in (("whole", ()), ("no_close", ("mouthClose",)), ("no_mouth", ("mouth", "jawF"))):
        names = [shape for shape in SHAPES if not missing or not shape.startswith(missing)]
        assert lips_apart(read_rig(character(tmp_path / f"{name}.glb", names)), load_head()) < 0.2


def test_lips_that_cannot_close_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["rig", str(character(tmp_path / "x.glb", list(SHAPES)))]) == 0
    assert "# a sealed mouth stays open by 0." in capsys.readouterr().out


def test_the_character_performs(tmp_path: Path, clip: Take) -> None:
    path = character(tmp_path / "x.glb", ["MouthSmile_L", "Extra", "Jaw_Open"])
    rig(path, take=clip, output=tmp_path / "y.glb")
    file = read_glb(tmp_path / "y.glb")
    (animation,) = file.document["animations"]
    accessor = file.document["accessors"][animation["samplers"][0]["output"]]
    view = file.document["bufferViews"][accessor["bufferView"]]
    weights = np.frombuffer(file.binary, "<f4", accessor["count"], view["byteOffset"]).reshape(-1, 3)
    assert len(weights) == len(clip.times)
    assert not weights[:, 1].any()
    # The other shapes' work falls to these two.
    fitted = ArkitFit(clip.head, ["mouthSmileLeft", "jawOpen"]).track(clip.faces()).weights
    np.testing.assert_allclose(weights[:, 0], fitted[:, INDEX["mouthSmileLeft"]], atol=1e-6)
    np.testing.assert_allclose(weights[:, 2], fitted[:, INDEX["jawOpen"]], atol=1e-6)
    assert np.ptp(weights[:, 2]) > 0.1
    assert json.loads(json.dumps(file.document)) == file.document


def test_every_target_of_a_shape_is_driven_and_others_rest(tmp_path: Path, clip: Take) -> None:
    gltf = Gltf(generator="test")
    points = np.eye(3, dtype=np.float32)
    for names, weights in (
        (["teeth.jawOpen", "teeth.long"], [0.0, 0.25]),
        (["skin.identity", "skin.jawOpen"], [0.6, 0.0]),
    ):
        target = {"POSITION": gltf.accessor(points)}
        primitive = {
            "attributes": {"POSITION": gltf.accessor(points)},
            "targets": [target] * 2,
            "extras": {"targetNames": names},  # as UniVRM writes them
        }
        gltf.add("meshes", {"primitives": [primitive], "weights": weights})
    for node in ({"mesh": 0}, {"mesh": 1}, {"mesh": 1, "weights": [0.9, 0.0]}):
        gltf.add("nodes", node)
    gltf.save(tmp_path / "x.glb")
    rig(tmp_path / "x.glb", take=clip, output=tmp_path / "y.glb")
    file = read_glb(tmp_path / "y.glb")
    (animation,) = file.document["animations"]
    curves = []
    for channel in animation["channels"]:
        accessor = file.document["accessors"][animation["samplers"][channel["sampler"]]["output"]]
        view = file.document["bufferViews"][accessor["bufferView"]]
        curves.append(np.frombuffer(file.binary, "<f4", accessor["count"], view["byteOffset"]).reshape(-1, 2))
    teeth, skin, other = curves
    fitted = ArkitFit(clip.head, ["jawOpen"]).track(clip.faces()).weights[:, INDEX["jawOpen"]]
    assert np.ptp(fitted) > 0.1
    for driven in (teeth[:, 0], skin[:, 1], other[:, 1]):
        np.testing.assert_allclose(driven, fitted, atol=1e-6)
    for still, weight in ((teeth[:, 1], 0.25), (skin[:, 0], 0.6), (other[:, 0], 0.9)):
        np.testing.assert_allclose(still, weight, atol=1e-6)


@pytest.mark.parametrize(
    ("weights", "message"),
    [
        ([0.5], "2 morph targets and 1 weights"),
        ("x", "not a list of numbers"),
        (["x", 1], "not a list of numbers"),
    ],
)
def test_resting_weights_that_are_wrong_are_named(
    tmp_path: Path, clip: Take, weights: object, message: str
) -> None:
    mesh = {
        "primitives": [{"targets": [{}] * 2}],
        "extras": {"targetNames": ["jawOpen", "x"]},
        "weights": weights,
    }
    (tmp_path / "x.glb").write_bytes(glb({"meshes": [mesh], "nodes": [{"mesh": 0}]}))
    with pytest.raises(InputError, match=message):
        rig(tmp_path / "x.glb", take=clip, output=tmp_path / "y.glb")
    assert not (tmp_path / "y.glb").exists()


def test_a_map_may_name_several_targets(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = character(tmp_path / "x.glb", ["Auf", "Zu", "Oben"])
    (tmp_path / "map.toml").write_text('[shapes]\njawOpen = ["Auf", "Oben"]\nmouthClose = "Zu"\n')
    found = read_rig(path, tmp_path / "map.toml")
    assert found.shapes == {"jawOpen": ("Auf", "Oben"), "mouthClose": ("Zu",)}
    assert run(["rig", str(path), "--map", str(tmp_path / "map.toml")]) == 0
    (tmp_path / "again.toml").write_text(capsys.readouterr().out)
    assert read_rig(path, tmp_path / "again.toml").shapes == found.shapes
    for wrong, message in (('["Auf", "Unten"]', "unknown morph target 'Unten'"), ("[]", "the list is empty")):
        (tmp_path / "map.toml").write_text(f"[shapes]\njawOpen = {wrong}\n")
        with pytest.raises(InputError, match=message):
            read_rig(path, tmp_path / "map.toml")


def test_a_rig_is_shown_in_one_line(tmp_path: Path, clip: Take) -> None:
    clip.write(tmp_path / "x.rig.glb")
    result = rig(tmp_path / "x.rig.glb")
    assert repr(result[0]) == f"<Rig x.rig.glb: 52 of 52 ARKit shapes on {len(result[0].targets)} meshes>"
    assert len(repr(result[0].file)) < 100
    assert len(repr(result)) < 10_000


def test_our_own_rig_is_whole(tmp_path: Path, clip: Take) -> None:
    clip.write(tmp_path / "x.rig.glb")
    assert read_rig(tmp_path / "x.rig.glb").missing == ()


def test_the_map_that_is_shown_can_be_given_back(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = character(tmp_path / "x.glb", ["Jaw_Open", 'Sm"ile'])
    assert run(["rig", str(path)]) == 0
    shown = capsys.readouterr().out
    assert 'jawOpen = "Jaw_Open"' in shown
    (tmp_path / "map.toml").write_text(shown)
    assert read_rig(path, tmp_path / "map.toml").shapes == read_rig(path).shapes


def test_a_pose_is_no_rig(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pose({"AU12": 0.5}).write(tmp_path / "p.glb")
    assert run(["rig", str(tmp_path / "p.glb")]) == 2
    assert "has no morph targets" in capsys.readouterr().err
