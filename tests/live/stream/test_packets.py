"""Each protocol's bytes, read by readers written here from the protocols' descriptions."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction

import numpy as np
import pytest

from risorius.core.arkit import INDEX, SHAPES
from risorius.errors import InputError
from risorius.face.fit.arkit_track import ArkitTrack
from risorius.face.fit.expressions import emotion_presets, expressions, preset_weights
from risorius.live.stream import PROTOCOLS, ArkitMoment, Options
from risorius.live.stream.osc import bundles, message

FPS = Fraction(30000, 1001)


@pytest.fixture
def track() -> ArkitTrack:
    rng = np.random.default_rng(3)
    weights = rng.random((4, 52))
    head, eyes = rng.uniform(-20, 20, (4, 3)), rng.uniform(-20, 20, (4, 2, 3))
    eyes[:, :, 2] = 0.0
    return ArkitTrack(weights, head, eyes, np.zeros(4), np.zeros(4))


def written(name: str, track: ArkitTrack, options: Options) -> Callable[[int], Sequence[bytes]]:
    packets = PROTOCOLS.get(name).make(FPS, options)
    return lambda k: packets(ArkitMoment(k, track.weights[k], track.head[k], track.eyes[k]))


@pytest.mark.parametrize("wrong", [{"names": "vrm2"}, {"subject": ""}, {"subject": "x" * 101}])
def test_wrong_options(wrong: dict[str, str]) -> None:
    with pytest.raises(InputError):
        Options(**wrong)


def test_live_link_face(track: ArkitTrack) -> None:
    packets = written("livelink", track, Options(subject="Ännchen"))
    (data,) = packets(3)
    name = "Ännchen".encode()
    assert len(data) == 306 + len(name)
    assert struct.unpack_from(">Bi", data) == (6, 36)
    assert data[5:41].decode("ascii").count("-") == 4
    assert struct.unpack_from(">i", data, 41) == (len(name),)
    assert data[45 : 45 + len(name)] == name
    frame, sub, numerator, denominator, count = struct.unpack_from(">ifiiB", data, 45 + len(name))
    assert (frame, sub, numerator, denominator, count) == (3, 0.0, 30000, 1001, 61)
    values = np.frombuffer(data, ">f4", 61, 62 + len(name))
    # Left before right, unlike the CSV.
    assert values[15] == pytest.approx(track.weights[3, INDEX["jawLeft"]], abs=1e-6)
    assert values[16] == pytest.approx(track.weights[3, INDEX["jawRight"]], abs=1e-6)
    assert values[51] == pytest.approx(track.weights[3, INDEX["tongueOut"]], abs=1e-6)
    assert values[52:55] == pytest.approx(np.radians(track.head[3]), abs=1e-6)
    assert values[58:61] == pytest.approx(np.radians(track.eyes[3, 1]), abs=1e-6)


def test_the_same_subject_is_the_same_device(track: ArkitTrack) -> None:
    one, same, other = (written("livelink", track, Options(subject=name))(0)[0][5:41] for name in "aab")
    assert one == same != other


def osc_messages(bundle: bytes) -> Iterator[tuple[str, list[object]]]:
    assert bundle[:16] == b"#bundle\0" + bytes(7) + b"\1"
    at = 16
    while at < len(bundle):
        (size,) = struct.unpack_from(">i", bundle, at)
        yield osc_message(bundle[at + 4 : at + 4 + size])
        at += 4 + size


def osc_message(data: bytes) -> tuple[str, list[object]]:
    def text(at: int) -> tuple[str, int]:
        end = data.index(b"\0", at)
        return data[at:end].decode(), (end // 4 + 1) * 4

    address, at = text(0)
    tags, at = text(at)
    arguments: list[object] = []
    for tag in tags[1:]:
        if tag == "s":
            word, at = text(at)
            arguments.append(word)
        else:
            arguments.append(struct.unpack_from(">" + tag, data, at)[0])
            at += 4
    assert at == len(data)
    return address, arguments


def test_osc_texts_end_on_four_bytes() -> None:
    assert message("/abc", "wxyz", 1, 0.5) == b"/abc\0\0\0\0,sif\0\0\0\0wxyz\0\0\0\0\0\0\0\1\x3f\0\0\0"


def test_bundles_stay_small_and_in_order() -> None:
    parts = [message("/x", k) for k in range(200)]
    found = bundles(parts, 400)
    assert max(map(len, found)) <= 400
    assert [a[0] for b in found for _, a in osc_messages(b)] == list(range(200))
    assert bundles([]) == []


@pytest.mark.parametrize("names", ["vrm0", "vrm1", "arkit", "ARKit"])
def test_vmc(track: ArkitTrack, names: str) -> None:
    packets = written("vmc", track, Options(names=names))(2)
    assert all(len(packet) <= 1500 for packet in packets)
    found = [m for packet in packets for m in osc_messages(packet)]
    assert found[0] == ("/VMC/Ext/OK", [1])
    assert found[1][1][0] == pytest.approx(float(2 / FPS), abs=1e-6)
    assert found[-1] == ("/VMC/Ext/Blend/Apply", [])
    values = {a[0]: a[1] for address, a in found if address == "/VMC/Ext/Blend/Val"}
    known = {
        "vrm0": {"Joy", "Angry", "Sorrow", "A", "I", "U", "E", "O", "Blink_L", "Blink_R"},
        "vrm1": {"happy", "angry", "sad", "aa", "ih", "ou", "ee", "oh", "blinkLeft", "blinkRight"},
        "arkit": set(SHAPES),
        "ARKit": {name[0].upper() + name[1:] for name in SHAPES},
    }[names]
    assert known <= set(values)
    if names == "ARKit":
        assert values["JawOpen"] == pytest.approx(track.weights[2, INDEX["jawOpen"]], abs=1e-6)


@pytest.mark.parametrize("names", ["vrm0", "vrm1"])
def test_python_osc_reads_the_same(track: ArkitTrack, names: str) -> None:
    osc_packet = pytest.importorskip("pythonosc.osc_packet")
    for packet in written("vmc", track, Options(names=names))(2):
        read = [(m.message.address, m.message.params) for m in osc_packet.OscPacket(packet).messages]
        assert read == list(osc_messages(packet))


def test_vmc_turns_to_unity_s_axes(track: ArkitTrack) -> None:
    """A head turned to the subject's left turns about Unity's y axis the other way, because x is mirrored."""
    left = np.array([[90.0, 0.0, 0.0]])
    turned = ArkitTrack(track.weights[:1], left, np.zeros((1, 2, 3)), np.zeros(1), np.zeros(1))
    bones = [
        a
        for packet in written("vmc", turned, Options())(0)
        for address, a in osc_messages(packet)
        if address == "/VMC/Ext/Bone/Pos"
    ]
    assert [bone[0] for bone in bones] == ["Head", "LeftEye", "RightEye"]
    half = np.sqrt(0.5)
    assert bones[0][4:] == pytest.approx([0.0, -half, 0.0, half], abs=1e-6)
    assert bones[1][4:] == pytest.approx([0.0, 0.0, 0.0, 1.0], abs=1e-6)


def test_ifacialmocap(track: ArkitTrack) -> None:
    (data,) = written("ifacialmocap", track, Options())(1)
    shapes, rest = data.decode().split("=")
    pairs = dict(pair.split("-") for pair in shapes.rstrip("|").split("|"))
    assert len(pairs) == 52
    assert {"mouthSmile_R", "eyeBlink_L", "jawLeft", "mouthLeft", "browInnerUp"} <= set(pairs)
    assert int(pairs["jawOpen"]) == round(100 * track.weights[1, INDEX["jawOpen"]])
    parts = dict(part.split("#") for part in rest.rstrip("|").split("|"))
    assert list(parts) == ["head", "rightEye", "leftEye"]
    x, y, z, *place = (float(number) for number in parts["head"].split(","))
    yaw, pitch, roll = track.head[1]
    assert (x, y, z) == pytest.approx((-pitch, yaw, -roll), abs=1e-3)
    assert place == [0.0, 0.0, 0.0]


def test_presets_follow_their_shapes() -> None:
    weights = np.zeros((1, 52))
    weights[0, [INDEX["jawOpen"], INDEX["eyeBlinkLeft"]]] = 0.5, 1.0
    found = dict(zip(expressions(), preset_weights(weights)[0], strict=True))
    assert found["aa"] == pytest.approx(0.9)
    assert found["blinkLeft"] == 1.0
    assert found["happy"] == found["blinkRight"] == 0.0


@pytest.mark.parametrize("names", ["vrm0", "vrm1"])
def test_vmc_s_presets_have_the_emotion_alone(track: ArkitTrack, names: str) -> None:
    """Weights of a smile come from speech, too: an avatar's `happy` may shut its mouth."""
    packets = PROTOCOLS.get("vmc").make(FPS, Options(names=names))
    happy = "Joy" if names == "vrm0" else "happy"
    emotion = np.eye(len(emotion_presets()))[emotion_presets().index("happy")]
    for felt, expected in ((None, 0.0), (0.7 * emotion, 0.7)):
        moment = ArkitMoment(0, np.ones(52), track.head[0], track.eyes[0], 0.0, felt)
        values = {
            str(a[0]): a[1]
            for packet in packets(moment)
            for address, a in osc_messages(packet)
            if address == "/VMC/Ext/Blend/Val"
        }
        assert values[happy] == pytest.approx(expected)
        assert len(values) == len(expressions())
