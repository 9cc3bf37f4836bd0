import json
import xml.etree.ElementTree as ET
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from risorius import speak
from risorius.core.parameters import INDEX
from risorius.core.speech.utterance import Utterance
from risorius.errors import OutputError, SpeechWarning
from risorius.face.contact.mouth import Mouth
from risorius.ports.export_source import WritableTake, WriteOptions
from risorius.ports.speech.azure_json import write_azure_json
from risorius.ports.speech.oculus_csv import write_oculus_csv
from risorius.ports.speech.rhubarb import (
    write_moho_dat,
    write_rhubarb_json,
    write_rhubarb_tsv,
    write_rhubarb_xml,
)
from risorius.ports.speech.visemes import OCULUS, viseme_of, viseme_table
from risorius.settings import Settings

WRITERS = (
    write_rhubarb_json,
    write_rhubarb_tsv,
    write_rhubarb_xml,
    write_moho_dat,
    write_azure_json,
    write_oculus_csv,
)


@pytest.mark.parametrize("write", WRITERS)
def test_nothing_said_is_an_error(tmp_path: Path, take_of: Callable[..., WritableTake], write) -> None:
    with pytest.raises(OutputError, match="there is no speech"):
        write(take_of(), tmp_path / "x", WriteOptions())


def test_an_unknown_phone_is_named_and_shown_as_a_neutral_vowel() -> None:
    with pytest.warns(SpeechWarning, match="phone '!' has no viseme; shown as AH"):
        assert viseme_of("!") == viseme_of("AH")


@pytest.mark.parametrize(
    ("symbol", "rhubarb", "azure", "oculus"),
    [
        ("M", ("A",), 21, ("PP",)),
        ("F", ("G",), 18, ("FF",)),
        ("TH", ("B",), 19, ("TH",)),
        ("DH", ("B",), 17, ("TH",)),
        ("L", ("H",), 14, ("nn",)),
        ("AA", ("D",), 2, ("aa",)),
        ("UW", ("F",), 7, ("ou",)),
        ("tʃ", ("B",), 16, ("CH",)),
        ("aː", ("D",), 2, ("aa",)),
        ("aʊ", ("D", "F"), 9, ("aa", "ou")),
        ("o", ("E",), 8, ("oh",)),
        ("õ", ("E",), 8, ("oh",)),
        ("oʊ", ("E", "F"), 8, ("oh", "ou")),
    ],
)
def test_phones(symbol: str, rhubarb: tuple[str, ...], azure: int, oculus: tuple[str, ...]) -> None:
    viseme = viseme_of(symbol)
    assert (viseme.rhubarb, viseme.azure, viseme.oculus) == (rhubarb, azure, oculus)


def test_the_table_is_whole() -> None:
    rows = viseme_table().values()
    assert {shape for row in rows for shape in row.rhubarb} == set("ABCDEFGH")
    assert {name for row in rows for name in row.oculus} == set(OCULUS) - {"sil"}
    assert {row.azure for row in rows} == set(range(1, 22))


@pytest.fixture
def take(take_of: Callable[..., WritableTake], utterance_of: Callable[..., Utterance]) -> WritableTake:
    utterance = utterance_of("M AA M P _ OW", lead=0.3, tail=0.4)
    return take_of(duration=utterance.duration, utterance=utterance, audio=utterance.audio)


def test_the_four_forms_say_the_same(tmp_path: Path, take: WritableTake) -> None:
    path, options = tmp_path / "x", WriteOptions(voice=Path("a/v.wav"))
    write_rhubarb_json(take, path, options)
    document = json.loads(path.read_text())
    cues = [(cue["start"], cue["end"], cue["value"]) for cue in document["mouthCues"]]
    assert document["metadata"] == {"soundFile": "v.wav", "duration": 1.4}
    assert cues[0] == (0.0, 0.3, "X")
    assert [shape for *_, shape in cues] == ["X", "A", "D", "A", "E", "F", "X"]  # closed through the pause
    assert all(a[1] == b[0] for a, b in pairwise(cues))
    write_rhubarb_tsv(take, path, options)
    lines = [line.split("\t") for line in path.read_text().splitlines()]
    assert [(float(time), shape) for time, shape in lines[:-1]] == [
        (start, shape) for start, _, shape in cues
    ]
    assert lines[-1] == ["1.40", "X"]
    write_rhubarb_xml(take, path, options)
    root = ET.fromstring(path.read_bytes())
    assert root.tag == "rhubarbResult"
    assert root.findtext("metadata/soundFile") == "v.wav"
    found = [(float(c.get("start")), float(c.get("end")), c.text) for c in root.iter("mouthCue")]
    assert found == cues
    write_moho_dat(take, path, options)
    head, *rows = path.read_text().splitlines()
    assert head == "MohoSwitch1"
    frames = [int(row.split()[0]) for row in rows]
    assert frames[0] == 1
    assert frames == sorted(set(frames))
    assert rows[1] == "10 A"


def test_azure_counts_in_100_ns(tmp_path: Path, take: WritableTake) -> None:
    write_azure_json(take, tmp_path / "x", WriteOptions())
    events = json.loads((tmp_path / "x").read_text())["visemes"]
    assert events[0] == {"AudioOffset": 0, "VisemeId": 0}
    assert events[1] == {"AudioOffset": pytest.approx(3_000_000, abs=500), "VisemeId": 21}


def test_oculus_weights_add_up_and_follow_the_phones(tmp_path: Path, take: WritableTake) -> None:
    write_oculus_csv(take, tmp_path / "x", WriteOptions())
    header, *lines = (tmp_path / "x").read_text().splitlines()
    assert header.split(",") == ["time_s", *OCULUS]
    rows = np.array([[float(cell) for cell in line.split(",")] for line in lines])
    assert rows[:, 1:].sum(axis=1) == pytest.approx(1.0, abs=1e-3)
    assert rows[0, 1] == 1.0
    middle_of_m = np.abs(rows[:, 0] - 0.35).argmin()
    assert OCULUS[int(rows[middle_of_m, 1:].argmax())] == "PP"


def test_a_closure_is_shown_as_long_as_our_lips_are_sealed(tmp_path: Path) -> None:
    """By phones alone, two neighbours that fade into a short /m/ leave it .5 of PP and .5 of a vowel."""
    take = speak("My baby brother put the map by the beam.", settings=Settings(dynamics="static"))
    take.write(*(tmp_path / f"x.{suffix}" for suffix in ("oculus.csv", "visemes.json", "azure.json")))
    mouths = json.loads((tmp_path / "x.visemes.json").read_text())["mouthCues"]
    events = json.loads((tmp_path / "x.azure.json").read_text())["visemes"]
    rows = np.genfromtxt(tmp_path / "x.oculus.csv", delimiter=",", names=True)
    mouth = Mouth.of(take.head)
    heights = mouth.line @ (take.head.skin.matrix @ take.head.rest)[mouth.vertices, 1]
    sealed = 0
    for row, frame in zip(rows, take.faces(), strict=True):
        gap = (mouth.line @ frame.skin[mouth.vertices, 1] - heights).max()
        if gap < 0.1 and frame.parameters[INDEX["lip_seal"]] > 0.05:
            sealed += 1
            assert row["PP"] >= 0.9, row
            assert max(row[name] for name in ("aa", "E", "ih", "oh", "ou")) == 0.0, row
            time = row["time_s"]
            assert [cue["value"] for cue in mouths if cue["start"] <= time < cue["end"]] == ["A"], time
            assert [e["VisemeId"] for e in events if e["AudioOffset"] <= 1e7 * time][-1] == 21, time
        if gap > 3.0:
            assert row["PP"] < 0.7, row
    assert sealed > 15
    assert all(a["end"] == b["start"] for a, b in pairwise(mouths))
    assert [cue["value"] for cue in mouths].count("A") == 9  # My ba-by bro-ther put the ma-p by the bea-m
    assert np.array([list(row)[1:] for row in rows]).sum(axis=1) == pytest.approx(1.0, abs=1e-3)
