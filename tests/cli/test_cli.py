"""The command line as a user meets it: help, lists, one-line errors, nothing left behind."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from risorius.cli import EXIT_FAULT, commands, run

MINIMAL_SCORE = {
    "risorius": 1,
    "duration": 1.0,
    "movements": [
        {
            "channel": "emotion",
            "start": 0.0,
            "end": 1.0,
            "onset": 0.2,
            "offset": 0.3,
            "targets": {"zygomatic_major.left": 1.0},
        }
    ],
}
BOMB = """<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>
<PHONEME text="&b;"/>"""
EXTERNAL = """<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]><PHONEME text="&a;"/>"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def fails(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """Run a command that must fail; return its one line."""
    before = {p: p.read_bytes() for p in Path().iterdir() if p.is_file()}
    assert run(arguments) == EXIT_FAULT
    lines = [line for line in capsys.readouterr().err.splitlines() if line.startswith("risorius: ")]
    assert len(lines) == 1
    after = {p: p.read_bytes() for p in Path().iterdir() if p.is_file()}
    assert after == before, "a failed command left or changed a file"
    return lines[0]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["speak", ""], "the text is empty"),
        (["speak", "… — !"], "nothing can be spoken"),
        (["speak", "a" * 100_001], "100,000"),
        (["speak", "missing.xml"], "missing.xml"),
        (["speak", "Hello.", "--age", "-1"], "age = -1.0 is out of range; expected 0 to 100"),
        (["pose", "AU1=1", "--age", "101", "-o", "x.png"], "age = 101.0 is out of range; expected 0 to 100"),
        (["pose", "AU1=1", "--age", "nan", "-o", "x.png"], "age = nan is out of range"),
        (["pose", "AU1=1", "--style", "clya", "-o", "x.png"], "unknown style 'clya'; did you mean 'clay'?"),
        (["pose", "AU1=1", "--camera", "close-up:wide", "-o", "x.png"], "expected e.g. close-up:85"),
        (["pose", "AU1=1", "--light", "sun", "-o", "x.png"], "expected one of studio, daylight, dark"),
        (["pose", "AU1=1", "--background", "blurple", "-o", "x.png"], "did you mean 'purple'"),
        (["pose", "AU1=1", "--quality", "hihg", "-o", "x.png"], "did you mean 'high'"),
        (["pose", "AU1=1", "--hair", "bold", "-o", "x.png"], "did you mean 'bald'"),
        (
            ["pose", "AU1=1", "--complexion", "2", "-o", "x.png"],
            "complexion = 2 is out of range; expected 0 to 1",
        ),
        (["pose", "AU1=1", "--overlay", "lane", "-o", "x.png"], "did you mean 'lanes'"),
        (
            ["speak", "Hi.", "--background", "transparent", "-o", "x.mp4"],
            ".mp4 cannot have a transparent background",
        ),
        (["speak", "Hello.", "-o", "nowhere/x.mp4"], "does not exist"),
        (["speak", "Hello.", "-o", "x.mp5"], "did you mean '.mp4'"),
        (["speak", "Hello.", "-o", "x"], "no suffix"),
        (["speak", "Hello.", "--emotion", "hapiness:1"], "did you mean 'happiness'"),
        (["speak", "Hello.", "--emotion", "happiness:2"], "expected 0 to 1"),
        (["speak", "Hello.", "--emotion", "happiness"], "has no intensity; expected e.g. happiness:0.7"),
        (["speak", "Hello.", "--emotion", "happiness:1@3-2"], "happiness"),
        (["speak", "Hello.", "--voice", "en-uss"], "did you mean"),
        (["speak", "Hello.", "--rate", "10"], "80"),
        (["speak", "Hello.", "--fps", "0"], "fps"),
        (["speak", "Hello.", "--size", "720"], "720x720"),
        (["speak", "Hello.", "--without", "blinks"], "unknown channel"),
        (["speak", "Hello.", "--conflict", "inhibitt"], "did you mean 'inhibit'"),
        (["speak", "Hello.", "--voice-emotion", "of"], "unknown voice emotion 'of'; did you mean 'off'?"),
        (["speak", "Hello.", "--lips", "dominanc"], "did you mean 'dominance'"),
        (["speak", "Hello.", "--head", "standart", "-o", "x.png"], "did you mean 'standard'"),
        (["speak", "Hello.", "--seed", "-1"], "seed"),
        (["speak", "Hello.", "--bogus"], "bogus"),
        (["mix", "missing.json"], "missing.json"),
        (["pose", "zygomatic=1", "-o", "x.png"], "did you mean"),
        (["pose", "zygomatic_major", "-o", "x.png"], "NAME=VALUE"),
        (["pose", "AU34=1", "-o", "x.png"], "cheek puff"),
        (["pose", "masseter=nan", "-o", "x.png"], "expected 0 to 1"),
        (["pose", "masseter=1"], "-o"),
        (["explain", "missing.performance.json"], "missing.performance.json"),
        (["explain", "x.performance.json", "--parameter", "masseter"], "--at"),
        (["explain", "x.performance.json", "--at", "1", "--parameter", "smyle"], "unknown muscle"),
        (["list", "muskles"], "muscles"),
        (["list", "lang"], "unknown list 'lang'; did you mean 'languages'"),
        (["speak", "Hello.", "--voice", "german"], "unknown voice 'german'; did you mean 'de'?"),
        (["speak", "Hello.", "--voice", "zzz"], "'risorius list voices' shows all"),
        (["speak", "Hello.", "--rate", "fast"], "rate 'fast' is not a whole number; expected 80 to 440"),
        (["speak", "Hello.", "--age", "old", "-o", "x.png"], "age 'old' is not a number; expected 0 to 100"),
        (["pose", "AU1=1", "--background", "trnsparent", "-o", "x.png"], "did you mean 'transparent'?"),
        (["pose", "AU1=1", "--size", "5x720", "-o", "x.png"], "the width of size = 5 is out of range"),
        (["pose", "happiness=0.8", "-o", "x.png"], "expected --emotion happiness:0.8"),
        (["pose", "zygomat=1", "-o", "x.png"], "did you mean 'zygomatic_m"),
        (["rules", "show", "contrast"], "did you mean 'signals.brows.contrast'"),
        (["stream", "Hello.", "--protocol", "vcm"], "unknown protocol 'vcm'; did you mean 'vmc'"),
        (["spaek", "Hello."], "spaek"),
        (["speak", "Hello", "there."], "'there.' is one argument too many; expected quotation marks"),
        (["studio", "here"], "'here' is one argument too many; expected options alone"),
        (["speak", "Hello.", "--emotoin", "joy:1"], "unknown option '--emotoin'; did you mean '--emotion'?"),
        (["speak", "Hello.", "--xyzzy"], "unknown option '--xyzzy'; 'risorius speak --help' shows all"),
        (["serve", "--port", "99999"], "--port 99999 is out of range; expected 0 to 65535"),
        (["batch", "x.csv", "--jobs", "two"], "--jobs 'two' is not a whole number; expected 0 or more"),
        (["pose", "AU12=.5", "AU12=.6", "-o", "x.png"], "'AU12' is given twice; expected one value"),
        (["pose", "=1", "-o", "x.png"], "'=1' is not NAME=VALUE"),
        (["pose", "--emotion", "joy:1@0-1", "-o", "x.png"], "--emotion has no effect: a pose has no times"),
        (["batch", ".", "-o", "{id}.wav", "--jobs", "0"], "holds no recording; expected e.g. a.wav"),
        (["explain", "x.score.json"], "is a score; expected a performance"),
    ],
)
def test_faults_are_one_line(
    arguments: list[str], expected: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if "-o" not in arguments and arguments[0] == "speak":
        arguments = [*arguments, "-o", "x.muscles.csv"]
    assert expected in fails(arguments, capsys)


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ('<PHONEME text="Hi." />\n<EMOTIONDISPLAY time="0" duration="1" Surprize="0.7" />', "x.xml:2:"),
        ('<PHONEME text="Hi." />\n<EMOTIONDISPLAY time="-1" duration="1" surprise="0.7" />', "x.xml:2:"),
        ('<PHONEME text="Hi." />\n<EMOTIONDISPLAY time="2" end="1" surprise="0.7" />', "x.xml:2:"),
        (
            '<PHONEME text="Hi." />\n<EMOTIONDISPLAY time="0" end="1" surprise="1" />\n'
            '<EMOTIONDISPLAY time="0" end="2" anger="1" />',
            "x.xml:3:",
        ),
        ('<MOVEMENT time="0" end="1" zygomatic="1" /><PHONEME text="Hi."/>', "x.xml:1:"),
        (BOMB, "x.xml:1:"),
        (EXTERNAL, "x.xml:1:"),
        ("<PHONEME", "x.xml:1:"),
        ("", "x.xml"),
    ],
)
def test_markup_faults_name_the_place(
    content: str, expected: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("x.xml").write_text(content)
    Path("x.mp4").write_bytes(b"mine")
    assert expected in fails(["speak", "x.xml", "-o", "x.mp4"], capsys)


def test_a_binary_file_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("x.txt").write_bytes(bytes(range(256)) * 10)
    assert "x.txt" in fails(["speak", "x.txt", "-o", "x.muscles.csv"], capsys)


def test_a_score_with_an_unknown_key_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("x.json").write_text(json.dumps({**MINIMAL_SCORE, "durration": 2}))
    assert "did you mean 'duration'" in fails(["mix", "x.json", "-o", "x.muscles.csv"], capsys)


@pytest.mark.skipif(os.geteuid() == 0, reason="an administrator may write anywhere")
def test_an_unwritable_folder_is_reported(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "locked").mkdir(mode=0o500)
    assert "not writable" in fails(["speak", "Hello.", "-o", "locked/x.wav"], capsys)


def test_mix_writes_the_curves_to_standard_output(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("x.json").write_text(json.dumps(MINIMAL_SCORE))
    assert run(["mix", "x.json", "--fps", "10"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("time_s,zygomatic_major.left,")
    assert len(lines) == 1 + 11


@pytest.mark.parametrize("what", ["muscles", "channels", "emotions", "voices", "languages", "outputs"])
def test_lists(what: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["list", what]) == 0
    assert len(capsys.readouterr().out.splitlines()) > 5


@pytest.mark.parametrize("command", [[], ["speak"], ["mix"], ["pose"], ["list"]])
def test_help_explains(command: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*command, "--help"]) == 0
    assert "Usage: risorius" in capsys.readouterr().out


BARE = [[], ["rules"], *([name] for name in commands.commands if name not in ("studio", "serve"))]


@pytest.mark.parametrize("command", [*BARE, ["rules", "show"]])
def test_a_bare_command_prints_its_help(command: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(command) == 0
    assert len(capsys.readouterr().out.splitlines()) > 5


def test_an_unknown_list_is_told_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["list", "emotion"]) == 2
    assert capsys.readouterr().err == "risorius: unknown list 'emotion'; did you mean 'emotions'?\n"


def test_help_loads_nothing_heavy() -> None:
    code = "import sys; from risorius.cli import run; run(['--help']); print(*sys.modules, file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not {"numpy", "numba", "scipy", "av", "rich", "PIL"} & set(done.stderr.split())


@pytest.mark.parametrize("number", [signal.SIGINT, pytest.param(signal.SIGTERM, marks=pytest.mark.full)])
def test_an_interrupt_leaves_nothing(number: signal.Signals, folder: Path) -> None:
    command = [
        sys.executable,
        "-m",
        "risorius",
        "speak",
        "Hello there. " * 40,
        "--size",
        "64x64",
        "-o",
        "x.mp4",
    ]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        while process.poll() is None and not list(folder.iterdir()):
            time.sleep(0.02)  # until the video is begun
        process.send_signal(number)
        _, lines = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "Traceback" not in lines
    assert list(folder.iterdir()) == []


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_while_modules_load_is_one_line(number: signal.Signals) -> None:
    code = f"""
import os, sys
class Interrupting:
    def find_spec(self, name, *_):
        if name == "risorius.cli.align":
            os.kill(os.getpid(), {number.value})
sys.meta_path.insert(0, Interrupting())
from risorius.__main__ import main
main()
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (130, "risorius: interrupted; nothing was written\n")


def test_an_interrupt_within_exec_has_our_exit_code(folder: Path) -> None:
    Path("program.py").write_text("""
import os, signal, sys
from risorius import cli
cli.commands.command("wait")(lambda: exec("os.kill(os.getpid(), signal.SIGTERM)"))
sys.argv = ["risorius", "wait"]
cli.main()
""")
    done = subprocess.run([sys.executable, "-m", "program"], capture_output=True, text=True)
    assert done.returncode == 130, done.stderr
    assert "risorius: interrupted; nothing was written" in done.stderr


def test_explain_answers_why(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("x.json").write_text(json.dumps(MINIMAL_SCORE))
    assert run(["mix", "x.json", "-o", "x.performance.json"]) == 0
    assert run(["explain", "x.performance.json", "--at", "0.5", "--parameter", "zygomatic_major.left"]) == 0
    assert capsys.readouterr().out.startswith("zygomatic_major.left = 1.000\n    1.000 from emotion")
    assert run(["explain", "x.performance.json"]) == 0
    assert "100.0 %" in capsys.readouterr().out


def test_what_is_not_understood_is_said_on_standard_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source = tmp_path / "x.ssml"
    source.write_text('<speak>Hello <audio src="y"/> there.</speak>')
    assert run(["speak", str(source), "-o", str(tmp_path / "x.muscles.csv")]) == 0
    assert f"risorius: warning: {source}:1:14: <audio> is not understood" in capsys.readouterr().err


def test_a_language_and_a_voice_of_another(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = ["-o", str(tmp_path / "x.TextGrid")]
    assert run(["speak", "Guten Tag.", "--language", "de", *out]) == 0
    assert "ɡ" in (tmp_path / "x.TextGrid").read_text()
    assert run(["speak", "Hello.", "--language", "qq", *out]) == 2
    assert "unknown language 'qq'" in capsys.readouterr().err


def test_a_warning_is_printed_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "x.ssml").write_text('<speak>One. <voice name="nobody">Two. Three.</voice></speak>')
    assert run(["speak", str(tmp_path / "x.ssml"), "-o", str(tmp_path / "x.srt")]) == 0
    assert capsys.readouterr().err.count("unknown voice 'nobody'; the usual voice speaks") == 1
