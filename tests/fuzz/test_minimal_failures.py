"""The smallest inputs that once ended in a traceback, a hang, or gigabytes: now one line tells of each."""

from __future__ import annotations

import json
import wave
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from starlette.datastructures import Headers

from risorius.api import mix, play
from risorius.batches.journal import NAME as JOURNAL
from risorius.batches.journal import Journal
from risorius.core.performance import frame_count
from risorius.errors import InputError, RisoriusError, warnings_to
from risorius.face.head.head import load_head
from risorius.languages import language_of
from risorius.live.serve.guard import Guard
from risorius.live.services import AzureVoice, CartesiaVoice, ElevenLabsVoice
from risorius.live.session import Live
from risorius.live.stream.receiver_socket import parse_address
from risorius.ports.mesh.glb_file import read_glb
from risorius.reading.json_text import parse_json
from risorius.reading.toml import read_tables
from risorius.render.backdrop import backdrop
from risorius.rules.emotions import parse_display
from risorius.rules.profiles import profile_of
from risorius.rules.rule_set import rule_set_of
from risorius.script.kinds import misplaced
from risorius.script.read import parse_script
from risorius.script.textgrid import parse_textgrid
from risorius.settings import Settings
from risorius.speech.engines.program import ProgramEngine
from risorius.speech.engines.protocol import SpeechRequest, Voice
from risorius.speech.recordings.labelled import utterance_of_labels
from risorius.studio.decoding import decode
from risorius.studio.session.session_files import SessionFiles

from .guard import CPU_SECONDS, one_line_or_done

BIG = "9" * 5000
MOVEMENT = {"channel": "emotion", "start": 0.0, "end": 1.0, "onset": 0.2, "offset": 0.2, "targets": {}}
SCORE = {"risorius": 1, "duration": 3.9, "movements": [MOVEMENT]}


def grid(end: str, label: str = '"AA1"') -> str:
    return f'"ooTextFile" "TextGrid" 0 {end} <exists> 1 "IntervalTier" "phones" 0 {end} 1 0 {end} {label}'


def nested(name: str, count: int, root: str = "speak", inner: str = "a") -> str:
    return f"<{root}>{f'<{name}>' * count}{inner}{f'</{name}>' * count}</{root}>"


def chain(count: int) -> str:
    """Return a block of BML in which each nod waits for the next."""
    nods = "".join(f"<head id='h{k}' lexeme='NOD' start='h{k + 1}:end'/>" for k in range(count))
    return f"<bml id='b'>{nods}<head id='h{count}' lexeme='NOD' start='1'/></bml>"


REFUSED: dict[str, Callable[[], object]] = {
    "a movement of an hour and a million": lambda: parse_display("joy:1@0-1000000"),
    "a display beyond all numbers": lambda: parse_display("joy:1@0-99999999999999999999"),
    "an intensity of 60,000 digits": lambda: parse_display("joy:1" + "0" * 60_000),
    "a name of 60,000 characters": lambda: parse_display("x" * 60_000),
    "a file of emotions with a null": lambda: parse_display("a\0.toml:1"),
    "a TextGrid of 30,000 years": lambda: utterance_of_labels(parse_textgrid(grid("1e12"))),
    "a word of 20,000 digits in a TextGrid": lambda: parse_textgrid(grid("1", "9" * 20_000 + "x")),
    "a TextGrid of numbers": lambda: parse_textgrid(grid("1", "9" * 2_000_000)),
    "speech at the end of a day": lambda: parse_script("<PHONEME time='86399' text='a'/>", ".xml"),
    "a nod at 50,000 s": lambda: parse_script(
        "<bml id='b'><head id='h' lexeme='NOD' start='50000'/></bml>", ".bml"
    ),
    "a line of blanks": lambda: parse_script("text" + " " * 60_000 + "b", ".utt"),
    "an emotion of letters": lambda: parse_script("emotion: " + "a" * 60_000 + "\ntext: a", ".utt"),
    "a time of 60,000 digits": lambda: parse_script(
        "<PHONEME time='" + "0" * 60_000 + "x' text='a'/>", ".xml"
    ),
    "an attribute of blanks": lambda: parse_script("<BLINK" + " " * 60_000 + "time/>", ".xml"),
    "a reference of dots": lambda: parse_script(
        "<bml id='b'><head id='h' lexeme='NOD' start='" + "." * 60_000 + "'/></bml>", ".bml"
    ),
    "500 brackets in TOML": lambda: read_tables("x=" + "[" * 500 + "]" * 500, "x"),
    "50,000 brackets in TOML": lambda: read_tables("x=" + "[" * 50_000 + "]" * 50_000, "x"),
    "500 tables in TOML": lambda: read_tables("x=" + "{a=" * 500 + "1" + "}" * 500, "x"),
    "400 paragraphs in SSML": lambda: parse_script(nested("p", 400), ".ssml"),
    "4,000 requirements in BML": lambda: parse_script(nested("required", 4000, "bml", ""), ".bml"),
    "1,000 references in BML": lambda: parse_script(chain(1000), ".bml"),
    "400 objects in a message": lambda: decode('{"id":1,"do":"perform","x":' + "[" * 400 + "]" * 400 + "}"),
    "a whole number of 5,000 digits in TOML": lambda: read_tables(f"x={BIG}", "x"),
    "a phoneme of 5,000 digits": lambda: parse_script(f"text: (a)\nphonemes: (aa<{BIG}>)", ".utt"),
    "an action unit of 5,000 digits in BML": lambda: parse_script(
        f"<bml id='b'><faceFacs id='f' au='{BIG}' start='0' end='1'/></bml>", ".bml"
    ),
    "a port of 5,000 digits": lambda: parse_address(f"host:{BIG}", 1),
    "a head whose name is a sentence": lambda: load_head("h" * 5000),
    "a seed that is a word": lambda: Settings(seed="four"),  # type: ignore[arg-type]
    "a seed of 400 digits": lambda: Settings(seed=10**400),
    "a lead of 400 digits": lambda: Settings(lead=10**400),
    "six hours at 1,000 frames a second": lambda: frame_count(21_600.0, 1000),  # type: ignore[arg-type]
}


@pytest.mark.parametrize("read", REFUSED.values(), ids=REFUSED)
def test_what_broke_a_reader_is_refused(read: Callable[[], object]) -> None:
    with one_line_or_done(), pytest.raises(RisoriusError) as caught:
        read()
    with one_line_or_done():
        raise caught.value


LEFT_OUT = {
    "a break of 60,000 digits": f"<break time='{'0' * 60_000}x'/>",
    "a break of 60,000 digits and a unit": f"<break time='{'9' * 60_000}s'/>",
    "a rate of 60,000 digits": f"<prosody rate='{'0' * 60_000}x'>a</prosody>",
    "a rate of 60,000 digits and a unit": f"<prosody rate='{'9' * 60_000}%'>a</prosody>",
    "a pitch of 60,000 digits": f"<prosody pitch='+{'9' * 60_000}st'>a</prosody>",
    "a volume of 60,000 digits": f"<prosody volume='1e{'9' * 60_000}x'>a</prosody>",
    "a year of 60,000 digits": f"<say-as interpret-as='date' format='ymd'>{'9' * 60_000}-1-2</say-as>",
}


@pytest.mark.parametrize("inside", LEFT_OUT.values(), ids=LEFT_OUT)
def test_what_broke_a_reader_of_ssml_is_left_out_with_a_warning(inside: str) -> None:
    lines: list[str] = []
    with one_line_or_done(), warnings_to(lines.append):
        parse_script(f"<speak>a {inside}</speak>", ".ssml")
    (line,) = lines
    assert line.isprintable()
    assert len(line) < 200


SCORES: dict[str, dict[str, Any]] = {
    "a movement until 1e308 s": SCORE | {"movements": [MOVEMENT | {"end": 1e308}]},
    "a movement until 1e6 s": SCORE | {"movements": [MOVEMENT | {"end": 1e6}]},
    "a key at 1e300 s": SCORE | {"movements": [{"channel": "manual", "keys": {"AU1": [[-1e300, 0]]}}]},
    "a day": SCORE | {"duration": 86_400},
    "a word that ends before it starts": SCORE
    | {
        "speech": {
            "language": "en",
            "phones": [{"symbol": "", "start": 0, "end": 3.9}],
            "words": [
                {"text": "a", "start": 3, "end": 2, "first_phone": 0, "last_phone": 1}
                | {"source_start": 0, "source_end": 1}
            ],
        }
    },
    "an action unit of 5,000 digits": SCORE | {"movements": [MOVEMENT | {"targets": {f"AU{BIG}": 1}}]},
}


@pytest.mark.parametrize("score", SCORES.values(), ids=SCORES)
def test_what_broke_a_score_is_refused(score: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "a.score.json"
    path.write_text(json.dumps(score))
    with one_line_or_done(), pytest.raises(InputError):
        mix(path)


CAPTURES = {
    "a.au.csv": f"timestamp, AU{BIG}_r\n0, 0\n",
    "b.fap": f"2.1 x 25 {BIG}\n",
    "c.fap": f"2.1 x 25 {'9' * 400}\n",
}


@pytest.mark.parametrize("name", CAPTURES)
def test_what_broke_a_capture_is_refused(name: str, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_text(CAPTURES[name])
    with one_line_or_done(), pytest.raises(InputError):
        play(path)


def test_a_sound_without_a_rate_is_refused(tmp_path: Path) -> None:
    with wave.open(str(tmp_path / "a.wav"), "wb") as file:
        file.setparams((1, 2, 8000, 0, "NONE", ""))
        file.writeframes(bytes(20))
    data = bytearray((tmp_path / "a.wav").read_bytes())
    data[24:28] = bytes(4)
    (tmp_path / "a.wav").write_bytes(data)
    for audio in ("a.wav", "a\0b"):
        speech = {"language": "en", "phones": [{"symbol": "", "start": 0, "end": 3.9}], "audio": audio}
        (tmp_path / "a.score.json").write_text(json.dumps(SCORE | {"speech": speech}))
        with one_line_or_done(), pytest.raises(InputError, match="16-bit mono"):
            mix(tmp_path / "a.score.json")


@pytest.mark.parametrize("text", ["base = []", "base = {}", f"age = {'9' * 400}"])
def test_a_profile_on_nothing_is_refused(text: str, tmp_path: Path) -> None:
    (tmp_path / "p.toml").write_text(text)
    with one_line_or_done(), pytest.raises(InputError):
        profile_of(str(tmp_path / "p.toml"))


def test_blank_lines_within_a_rule_take_no_time(tmp_path: Path) -> None:
    blank = "\n" * 200 + "# end"
    rule = f'[[rule]]\nid = "a.b.c"\n{blank}\ncomment = 1\n'
    (tmp_path / "r.toml").write_text(rule)
    with one_line_or_done(), pytest.raises(InputError):
        rule_set_of(tmp_path / "r.toml")


@pytest.mark.parametrize("data", [b"\x89PNG\r\n\x1a\n" + bytes(40), b"P6 9 9 255", b"DDS " + bytes(150)])
def test_a_damaged_background_is_refused(data: bytes, tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(data)
    with one_line_or_done(), pytest.raises(InputError, match="not a picture"):
        backdrop(16, 16, str(tmp_path / "a.png"), (0, 0, 0), (0, 0, 0))


def test_a_background_of_too_many_pixels_is_refused_before_it_is_decoded(tmp_path: Path) -> None:
    Image.new("1", (10_000, 6_000)).save(tmp_path / "a.png")
    with one_line_or_done(), pytest.raises(InputError, match="has 10000 x 6000 pixels"):
        backdrop(16, 16, str(tmp_path / "a.png"), (0, 0, 0), (0, 0, 0))


def test_a_background_is_not_handed_to_another_program(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_text("%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n")
    with one_line_or_done(), pytest.raises(InputError, match="not a picture"):
        backdrop(16, 16, str(tmp_path / "a.png"), (0, 0, 0), (0, 0, 0))


def test_deep_json_in_a_glb_is_refused(tmp_path: Path) -> None:
    text = ('{"extras":' + "[" * 200 + "]" * 200 + "}").encode()
    text += b" " * (-len(text) % 4)
    length = (20 + len(text)).to_bytes(4, "little")
    head = b"glTF" + (2).to_bytes(4, "little") + length + len(text).to_bytes(4, "little") + b"JSON"
    (tmp_path / "a.glb").write_bytes(head + text)
    with one_line_or_done(), pytest.raises(InputError, match="nested too deeply"):
        read_glb(tmp_path / "a.glb")


@pytest.mark.parametrize(
    "answer",
    [
        '{"sample_rate": 8000, "audio": "\u00e9"}',
        '{"sample_rate": 8000, "audio": "AAAA", "phones": [["AA", Infinity]]}',
        '{"sample_rate": 8000, "audio": "AAAA", "phones": [["AA", 0, Infinity]]}',
        '{"sample_rate": 8000, "audio": "AAAA", "phones": [["AA", NaN]]}',
        '{"sample_rate": true, "audio": "AAAA"}',
        "[" * 400 + "]" * 400,
        "[" * 100_000,
        "9" * 5000,
    ],
)
def test_what_a_voice_program_answers_wrongly_is_said(answer: str) -> None:
    engine = ProgramEngine(["none"], "mine")
    request = SpeechRequest("Hello.", Voice("en-us", ("en-us",), "", "", "en-us"))
    with one_line_or_done(), pytest.raises(RisoriusError, match="the voice 'mine'"):
        engine.rendition_of(answer.encode(), request)


def test_an_amount_of_thousands_of_digits_is_not_read_as_money() -> None:
    language = language_of("en-us")
    with one_line_or_done():
        assert [m.lastgroup for m in language.abbreviations.pattern.finditer(f"${BIG} and $5.50")] == [
            "money"
        ]


TEXTS = "\n".join(f"<PHONEME time='{k}' text='a'/>" for k in range(12_000))
MARKS = "".join(f"a <mark name='m{k}'/>" for k in range(12_000))
BOUNDARIES = "a <boundary type='LH'/><pause sec='0.1'/>" * 6000
QUADRATIC = {
    "12,000 texts": (".xml", TEXTS),
    "12,000 marks": (".ssml", f"<speak>{MARKS}</speak>"),
    "6,000 boundaries": (".apml", f"<apml>{BOUNDARIES}</apml>"),
    "12,000 comments": (".apml", f"{'<!-- a -->' * 12_000}<apml>a</apml>"),
}


@pytest.mark.parametrize("comment", ["<!---->", "<!-- a -->", "<!--"])
def test_many_comments_before_plain_words_do_not_take_for_ever(comment: str) -> None:
    with one_line_or_done(seconds=3.0):
        misplaced(comment * 200 + "Hello.")


@pytest.mark.parametrize("name", QUADRATIC)
def test_many_elements_take_a_time_that_grows_with_their_number(name: str) -> None:
    suffix, text = QUADRATIC[name]
    with one_line_or_done(seconds=3.0):
        parse_script(text, suffix)


DOTTED = {
    "40,000 names in a key": "a." * 40_000 + "b = 1",
    "40,000 names in a header": "[" + "a." * 40_000 + "b]",
    "40,000 names in an inline table": "x = {" + "'a' . " * 40_000 + "b = 1}",
    "33 names in a key": "a." * 32 + "b = 1",
    "strings that do not end": "." * 40 + '"\\' * 40_000,
}


@pytest.mark.parametrize("text", DOTTED.values(), ids=DOTTED)
def test_long_dotted_keys_take_no_time(text: str) -> None:
    with one_line_or_done(), pytest.raises(InputError):
        read_tables(text, "x.toml")


@pytest.mark.parametrize("text", ["x = '" + "a." * 99 + "'", "# " + "a." * 99, '"' + "a." * 99 + '" = 1'])
def test_dots_that_are_no_keys_are_read(text: str) -> None:
    read_tables(text, "x.toml")


def test_half_a_character_is_refused_with_its_place() -> None:
    text = r'{"a": "\\ud800",' + "\n" + r' "b": "\ud83d\ude00\udc00"}'
    with pytest.raises(InputError, match=r"^x:2:20: holds an escape of half a character"):
        parse_json(text, "x")
    with pytest.raises(RisoriusError, match="half a character"):
        decode(r'{"id": 1, "do": "perform", "source": {"script": "\ud800"}}')
    assert parse_json(r'["\ud83d\ude00", "\\ud800"]', "x").data == ["\U0001f600", r"\ud800"]


@pytest.mark.parametrize("origin", ["http://[", "http://[::1", "//[/", "http://[x]]"])
def test_an_origin_with_a_broken_bracket_is_refused(origin: str) -> None:
    headers = Headers({"host": "127.0.0.1:8000", "origin": origin})
    assert not Guard(None).allows(headers)  # type: ignore[arg-type]


SERVICES: dict[str, Callable[[Live], object]] = {
    "a message that is a list": lambda face: ElevenLabsVoice(face, "pcm_16000").say([]),  # type: ignore[arg-type]
    "characters that are numbers": lambda face: ElevenLabsVoice(face, "pcm_16000").say(
        {"alignment": {"chars": [1], "charStartTimesMs": [0], "charDurationsMs": [0]}}
    ),
    "an alignment that is a text": lambda face: ElevenLabsVoice(face, "pcm_16000").say({"alignment": "x"}),
    "a rate in superscript": lambda face: ElevenLabsVoice(face, "pcm_\u00b2"),
    "a rate of 5,000 digits": lambda face: ElevenLabsVoice(face, "pcm_" + BIG),
    "a word's time of 400 digits": lambda face: CartesiaVoice(face, "pcm_s16le", 16_000).say(
        {"type": "timestamps", "word_timestamps": {"words": ["a"], "start": [10**400], "end": [1]}}
    ),
    "a message that is a text": lambda face: CartesiaVoice(face, "pcm_s16le", 16_000).say("x"),  # type: ignore[arg-type]
    "an offset that is a text": lambda face: AzureVoice(face).word("a", "x", 0),  # type: ignore[arg-type]
    "a word without an end": lambda face: face.say(audio=b"", rate=16_000, words=[("a", 0)]),  # type: ignore[list-item]
    "a time beyond floats": lambda face: face.say(audio=b"", rate=16_000, words=[("a", 10**400, 1)]),
    "a time beyond digits": lambda face: face.say(audio=b"", rate=16_000, words=[("a", 10**5000, 1)]),
    "a word that is a number": lambda face: face.say(audio=b"", rate=16_000, words=[(5, 0.0, 1.0)]),  # type: ignore[list-item]
}


@pytest.mark.parametrize("say", SERVICES.values(), ids=SERVICES)
def test_what_no_service_sends_is_refused(say: Callable[[Live], object]) -> None:
    with one_line_or_done(), pytest.raises(InputError):
        say(Live())


@pytest.mark.parametrize("text", ["[]", '{"a": 5}', '{"a": "../../x"}', "[" * 9999, '{"a": {"b": "c"}}'])
def test_a_damaged_table_of_a_session_is_empty_or_stays_in_its_folder(text: str, tmp_path: Path) -> None:
    for name in ("emotions.json", "poses.json"):
        (tmp_path / name).write_text(text)
    files = SessionFiles(tmp_path)
    assert files.poses() == {}
    assert all(Path(files.emotion(name)).parent == tmp_path for name in files.emotions())


@pytest.mark.parametrize(
    "line",
    [
        '{"id": "\\ud800", "digest": "1"}',
        '{"id": "a", "digest": "1", "files": {"x": 5}}',
        '{"id": "a", "x": 1}',
    ],
)
def test_a_damaged_line_of_a_journal_is_passed_over(line: str, tmp_path: Path) -> None:
    (tmp_path / f"{JOURNAL}.jsonl").write_text(line + "\n")
    with Journal(tmp_path) as journal:
        assert journal.entry("a") is None


@pytest.mark.parametrize("content", [b"", b"glTF" + bytes(8), bytes(4_000)])
def test_a_glb_is_read_no_further_than_its_header(content: bytes, tmp_path: Path) -> None:
    (tmp_path / "a.glb").write_bytes(content)
    for path in (tmp_path / "a.glb", Path("/dev/zero")):
        with one_line_or_done(), pytest.raises(InputError, match="is not binary glTF"):
            read_glb(path)


def test_half_a_character_in_a_glb_is_refused(tmp_path: Path) -> None:
    text = rb'{"asset": {"version": "2.0"}, "x": "\ud800"} '
    text += b" " * (-len(text) % 4)
    head = b"glTF" + (2).to_bytes(4, "little") + (20 + len(text)).to_bytes(4, "little")
    (tmp_path / "a.glb").write_bytes(head + len(text).to_bytes(4, "little") + b"JSON" + text)
    with pytest.raises(InputError, match="half a character"):
        read_glb(tmp_path / "a.glb")


@pytest.mark.parametrize("model", ["effort", "dominance", "lookahead"])
def test_a_phone_that_goes_on_for_hours_costs_no_more_than_the_clip(model: str, tmp_path: Path) -> None:
    score = tmp_path / "x.score.json"
    jaw = {**MOVEMENT, "targets": {"masseter": 0.5}}
    phone = {"channel": "lips", "phone": "M", "start": 0.4, "end": 19_898.0, "targets": {"lip_seal": 1.0}}
    limited = {**phone, "limits": {"masseter": [0.0, 0.2]}}
    document = {"risorius": 1, "duration": 2.0, "settings": {"lips": model}, "movements": [jaw, limited]}
    score.write_text(json.dumps(document))
    with one_line_or_done(3 * CPU_SECONDS):
        take = mix(score)
    assert take.curves["lip_seal"].max() == 1.0
    assert take.curves["masseter"][take.times > 0.5].max() <= 0.2
