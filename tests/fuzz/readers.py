"""All that reads files of others, by the kind of file: a new reader is one line here."""

from __future__ import annotations

import io
import wave
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
from PIL import Image

from risorius.api import load, mix
from risorius.batches.manifest import Manifest
from risorius.errors import HeadError, RisoriusError
from risorius.face.head.coupled_muscles import LinkTable
from risorius.face.head.head_file import HeadFile
from risorius.face.head.identity import read_identity
from risorius.face.head.muscle_table import load_muscles
from risorius.live.stream.receiver_socket import parse_address
from risorius.machine.npz import read_arrays
from risorius.ports.curves.arkit_csv import COLUMNS as ARKIT_COLUMNS
from risorius.ports.curves.arkit_csv import read_arkit_csv
from risorius.ports.curves.au_csv import read_au_csv
from risorius.ports.curves.fap import FLAGS, read_fap
from risorius.ports.mesh.glb_file import GlbFile, save_glb
from risorius.ports.mesh.rig import read_rig
from risorius.reading.toml import load_file
from risorius.render.backdrop import backdrop
from risorius.rules.emotions import Emotion, parse_display
from risorius.rules.profiles import profile_of
from risorius.rules.rule_set import rule_set_of
from risorius.script.read import read_script
from risorius.script.textgrid import read_textgrid
from risorius.settings import Settings, settings_of
from risorius.speech.engines.program import ProgramEngine
from risorius.speech.engines.protocol import SpeechRequest, Voice
from risorius.speech.input import read_transcript
from risorius.speech.recordings.labelled import utterance_of_labels
from risorius.speech.recordings.recording import read_recording
from risorius.studio.decoding import decode

from .registry import register
from .scores import MINIMAL, SCORE, as_json

ROOT = Path(__file__).parents[2]
EXAMPLES, PACKAGE = ROOT / "examples", ROOT / "src" / "risorius"
COARSE = Settings(fps=Fraction(2))


def _script(path: Path) -> object:
    return read_script(str(path))


def _transcript(path: Path) -> object:
    return read_transcript(str(path))


def _labels(path: Path) -> object:
    grid = read_textgrid(str(path))
    return utterance_of_labels(grid) if grid.end < 60.0 else grid


def _text(read: Callable[[str], object]) -> Callable[[Path], object]:
    return lambda path: read(path.read_bytes().decode("utf-8", "replace"))


def _rows(path: Path) -> object:
    rows = list(Manifest(path).rows())
    fault = next((row for row in rows if isinstance(row, RisoriusError)), None)
    if fault is not None:
        raise fault
    return rows


def _setting(text: str) -> Settings:
    name, _, value = text.partition("=")
    return settings_of({name: value})


def _answer(path: Path) -> object:
    request = SpeechRequest("Hello.", Voice("en-us", ("en-us",), "", "", "en-us"))
    return ProgramEngine(["none"], "mine").rendition_of(path.read_bytes(), request)


def _muscles(path: Path) -> object:
    (path.parent / "muscles.toml").write_bytes(path.read_bytes())
    return load_muscles(path.parent)


def _head(path: Path) -> object:
    file = HeadFile.read(path)
    return [file.array("rest", ("n", 3)), file.indices("quads", ("n", 4), 10_000)]


def _arrays(path: Path) -> object:
    try:
        return read_arrays(path)
    except ValueError as error:
        raise HeadError(str(error)) from None


def _map(path: Path) -> object:
    (path.parent / "rig.glb").write_bytes(_glb())
    return read_rig(path.parent / "rig.glb", path)


def _saved(save: Callable[[io.BytesIO], object]) -> bytes:
    held = io.BytesIO()
    save(held)
    return held.getvalue()


def _wav(file: io.BytesIO) -> None:
    with wave.open(file, "wb") as sound:
        sound.setparams((1, 2, 8000, 0, "NONE", ""))
        sound.writeframes((8000 * np.sin(np.arange(2000.0))).astype("<i2").tobytes())


def _sound(kind: str) -> bytes:
    import soundfile

    sound = 0.3 * np.sin(np.arange(4000.0))
    return _saved(lambda file: soundfile.write(file, sound, 8000, format=kind))


@cache
def _glb() -> bytes:
    import tempfile

    mesh = {"primitives": [{"targets": [{}, {}]}], "extras": {"targetNames": ["jawOpen", "mouthClose"]}}
    document = {"asset": {"version": "2.0"}, "meshes": [mesh], "nodes": [{"mesh": 0}]}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.glb"
        save_glb(GlbFile(path, document, b"1234"), path)
        return path.read_bytes()


def _performance() -> bytes:
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "a.score.json").write_bytes(as_json(MINIMAL))
        mix(Path(folder) / "a.score.json", settings=COARSE).write(Path(folder) / "a.performance.json")
        return (Path(folder) / "a.performance.json").read_bytes()


GRID = b"""File type = "ooTextFile"
Object class = "TextGrid"
xmin = 0
xmax = 1
tiers? <exists>
size = 2
item [1]:
 class = "IntervalTier"
 name = "words"
 xmin = 0
 xmax = 1
 intervals: size = 2
 intervals [1]:
 xmin = 0
 xmax = 0.4
 text = ""
 intervals [2]:
 xmin = 0.4
 xmax = 1
 text = "ma"
item [2]:
 class = "IntervalTier"
 name = "phones"
 xmin = 0
 xmax = 1
 intervals: size = 3
 xmin = 0 xmax = 0.4 text = ""
 xmin = 0.4 xmax = 0.6 text = "M"
 xmin = 0.6 xmax = 1 text = "AA1"
"""
ARKIT = ",".join(ARKIT_COLUMNS) + "".join(f"\n00:00:0{k}:00.000,61" + ",0.1" * 61 for k in range(2))
AU = "frame, timestamp, success, AU01_r, AU12_r\n1, 0.0, 1, 0.5, 2\n2, 0.1, 0, 5, 1\n3, 0.2, 1, 0, 0\n"
FAP = f"2.1 a 25 2\n{FLAGS}\n0 {'7 ' * FLAGS.count('1')}\n{FLAGS}\n1 {'-9 ' * FLAGS.count('1')}\n"
PROFILE = PACKAGE / "rules/data/profiles/lively.toml"
BML = (
    b'<bml id="b"><speech id="s"><text>Hi <sync id="t"/> there.</text></speech>'
    b'<head id="h" lexeme="NOD" start="s:t" repetition="2"/>'
    b'<gaze id="g" target="listener" start="h:end+0.5"/>'
    b'<faceFacs id="f" au="12" side="LEFT" amount="0.5" start="0" end="2"/>'
    b'<constraint><synchronize ref="s:end"><sync ref="f:end"/></synchronize></constraint></bml>'
)
FML = (
    b'<fml-apml><bml><speech id="s" start="0.2" language="english">'
    b'<tm id="a"/>Hi, <tm id="b"/>there<tm id="c"/>'
    b'<pitchaccent id="p" type="Hstar" level="medium" start="s:a" end="s:b"/>'
    b'<boundary id="q" type="LL" start="s:c" end="s:c+0.5"/></speech></bml>'
    b'<fml><performative id="r" type="greet" start="s:a" end="s:b" importance="1.0"/>'
    b'<emotion id="e" type="joy" intensity="0.5" start="r:end" end="s:c"/>'
    b'<theme id="t" start="s:a" end="s:b"/>'
    b'<turntaking id="g" type="givethefloor" start="s:b" end="s:c+1"/></fml></fml-apml>'
)

MARKDOWN = """---
title: Order
---
# Your *order*

Thanks! **What happens** next, and ***all*** of __it__ ~~now~~ &amp; `soon`[^1]:

- [x] We _pack_ it, see [our page](https://x.org/a?b=(c) "Page") and ![a chart](c.png) at <https://x.org>.
2. <b>Two</b> \\* three.

> said
> so

Title
=====
| item | price |
|:-----|------:|
| lamp | $20   |

***
```py
x = 1
```
[1]: https://x.org
[cut off](https://ex"""
TRANSCRIPT = """Speakers: Anna, Dr. Lee
0:05 Anna: The old man [laughs] walked *coughs* his dog (sighs).
0:09 >> Dr. Lee: \u266a la \u266a {breath} <noise> \u3010\u7b11\u3011 *really*
"""
SRT = """1
00:00:01,000 --> 00:00:03,500
<i>The old man</i> walked
{\\an8}his dog &amp; cat.

2
00:00:04,000 --> 00:00:05,000
- ANNA: Yes. [door slams]
3
00:00:06,000 --> 00:00:07,250
ANNA: No.
"""
VTT = """WEBVTT - a film

STYLE
::cue { color: red }

first
00:01.000 --> 00:02.500 align:start
<v Anna>Hello <00:01.500>there.</v>

01:00:02.000 --> 01:00:03.000
Late.
"""

register(".txt", _script, "Hello there! *How* are you, Dr. Smith? $5.50, e.g.\n\nTwo…".encode())
register(".md", _script, MARKDOWN.encode())
register(".markdown", _script, MARKDOWN.encode())
register(".lab", _transcript, TRANSCRIPT.encode(), MARKDOWN.encode())
register(".srt", _transcript, SRT.encode())
register(".vtt", _transcript, VTT.encode())
register(".xml", _script, EXAMPLES / "demo.xml", EXAMPLES / "04-intonation.xml")
register(".utt", _script, EXAMPLES / "01-julia.utt", EXAMPLES / "05-timed.utt")
register(".ssml", _script, EXAMPLES / "02-news.ssml")
register(".bml", _script, EXAMPLES / "03-agent.bml", BML)
register(".apml", _script, EXAMPLES / "08-advice.apml", FML)
register(".TextGrid", _labels, GRID)
register(
    ".score.json", lambda path: mix(path, settings=COARSE), lambda: as_json(SCORE), lambda: as_json(MINIMAL)
)
register(".json", lambda path: mix(path, settings=COARSE), lambda: as_json(SCORE))
register(".performance.json", load, _performance)
register(".arkit.csv", read_arkit_csv, ARKIT.encode())
register(".csv", read_arkit_csv, ARKIT.encode())
register(".au.csv", read_au_csv, AU.encode())
register(".fap", read_fap, FAP.encode())
register(".rules.toml", rule_set_of, EXAMPLES / "06-my-rules.toml", tables="RuleFile")
register(".profile.toml", lambda p: profile_of(str(p)), PROFILE, tables="Profile")
register(
    ".emotion.toml",
    lambda path: load_file(Emotion, path).targets(0.5),
    PACKAGE / "rules/data/emotions/anger.toml",
    tables="Emotion",
)
register(".identity.toml", read_identity, PACKAGE / "heads/standard/identity.toml", tables="Identity")
register(
    ".links.toml",
    lambda path: load_file(LinkTable, path),
    PACKAGE / "heads/standard/links.toml",
    tables="LinkTable",
)
register(".muscles.toml", _muscles, PACKAGE / "heads/standard/muscles.toml", tables="Muscle")
register(".map.toml", _map, b'[shapes]\njawOpen = "jawOpen"\nmouthClose = "mouthClose"\n', tables="ShapeMap")
register(".head.npz", _head, PACKAGE / "heads/standard/head.npz")
register(".npz", _arrays, lambda: _saved(lambda file: np.savez(file, a=np.arange(9.0), b=np.eye(3))))
register(".glb", read_rig, _glb)
register(".wav", read_recording, lambda: _saved(_wav))
register(".flac", read_recording, lambda: _sound("FLAC"), lambda: 2 * _sound("FLAC"))
register(".ogg", read_recording, lambda: _sound("OGG"))
register(".mp3", read_recording, lambda: _sound("MP3"))
register(
    ".png",
    lambda path: backdrop(16, 16, str(path), (0, 0, 0), (0, 0, 0)),
    lambda: _saved(lambda file: Image.new("RGB", (20, 30), (9, 99, 199)).save(file, "PNG")),
    lambda: _saved(lambda file: Image.new("RGB", (20, 30), (9, 99, 199)).save(file, "JPEG")),
    lambda: _saved(lambda file: Image.new("P", (20, 30)).save(file, "GIF")),
    lambda: _saved(lambda file: Image.new("RGB", (20, 30)).save(file, "WEBP")),
    lambda: _saved(lambda file: Image.new("RGB", (20, 30)).save(file, "TIFF")),
    lambda: _saved(lambda file: Image.new("RGB", (20, 30)).save(file, "BMP")),
)
register(
    ".message",
    _text(decode),
    b'{"id": 7, "do": "perform", "source": {"script": "Hi."}, "choices": {"fps": "30", "seed": 3}}',
    b'{"id": 8, "do": "edit", "kind": "stretch", "movement": "a", "start": 0.5, "end": 1.5}',
    b'{"id": 9, "do": "relabel", "phone": 1, "start": 0.45}',
    b'{"id": 10, "do": "bring_back", "number": 0}',
)
register(
    ".answer",
    _answer,
    b'{"sample_rate": 8000, "audio": "AAAAAAAA", "phones": [["HH", 0.0, 0], ["AY1", 1e-4]]}',
)
register(".display", _text(parse_display), b"joy:0.7@1-2.5", b"fear:1")
register(".manifest.csv", _rows, b'id,text,emotion\na,"Hello, you",joy:0.7;anger:0.2\nb,Two.,\n')
register(
    ".jsonl",
    _rows,
    b'{"id": "a", "text": "Hi.", "fps": 5}\n{"id": "b", "text": "Two.", "shape": {"a": 0.1}}\n',
)
register(".address", _text(lambda text: parse_address(text, 9000)), b"127.0.0.1:8000", b"[::1]:80")
register(
    ".setting",
    _text(_setting),
    b"fps=24000/1001",
    b"size=720x720",
    b"shape=nose_width:0.5",
    b"camera=close-up:85",
)
