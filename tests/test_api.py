"""What users import, and what two of them may do at once."""

from __future__ import annotations

import pydoc
import re
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import risorius

PAGE = Path(risorius.__file__).parent / "pipeline.py"


def test_the_pipeline_is_one_page() -> None:
    assert len(PAGE.read_text(encoding="utf-8").splitlines()) <= 80


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="has no attribute 'speek'"):
        _ = risorius.speek


def test_every_exported_name_is_there() -> None:
    for name in risorius.__all__:
        assert getattr(risorius, name) is not None, name


def test_to_stream_is_a_package_and_stays_one() -> None:
    assert isinstance(risorius.live.stream, ModuleType)
    assert callable(risorius.live.stream.send_take)
    assert isinstance(risorius.live.stream, ModuleType)


def _performed(script: Path) -> tuple[risorius.Take, list[str]]:
    warnings: list[str] = []
    with risorius.warnings_to(warnings.append):
        return risorius.speak(str(script)), warnings


def test_two_runs_in_two_threads_are_what_each_is_alone_with_its_own_warnings(tmp_path: Path) -> None:
    scripts = []
    for name, text in (("bark", "Hello, mum!"), ("purr", "I told you so.")):
        scripts.append(tmp_path / f"{name}.ssml")
        scripts[-1].write_text(f"<speak>{text} <{name}/></speak>")
    alone = [_performed(script) for script in scripts]
    with ThreadPoolExecutor(2) as threads:
        both = list(threads.map(_performed, scripts))
    for script, (one, said), (other, said_at_once) in zip(scripts, alone, both, strict=True):
        np.testing.assert_array_equal(other.performance.values, one.performance.values)
        assert said_at_once == said
        assert len(said) == 1
        assert f"<{script.stem}> is not understood" in said[0]


def test_what_can_be_used_is_listed_and_helped_with() -> None:
    assert set(risorius.__all__) <= set(dir(risorius))
    assert not {"Any", "annotations", "TYPE_CHECKING"} & set(dir(risorius))
    assert "speak(" in pydoc.plain(pydoc.render_doc(risorius))


def test_a_take_is_shown_in_one_line(clip: risorius.Take) -> None:
    assert repr(clip) == f"<Take of {clip.duration:.2f} s, {len(clip.times)} frames, 'Oh, my mother!'>"


def test_faults_of_a_caller_are_told_by_one_kind_of_error(clip: risorius.Take) -> None:
    with pytest.raises(risorius.RisoriusError, match="int cannot be performed; expected a text"):
        risorius.speak(5)
    with pytest.raises(risorius.RisoriusError, match="settings are dict; expected"):
        risorius.speak("Hi.", settings={"fps": 60})
    with pytest.raises(risorius.RisoriusError, match="unknown parameter 'lip_seel'; did you mean 'lip_seal'"):
        _ = clip.curves["lip_seel"]
    assert clip.curves.get("lip_seel") is None


def _no_file(call: Any) -> Any:
    return pytest.param(call, "int does not name a file; expected a text or a path")


@pytest.mark.parametrize(
    ("call", "message"),
    [
        _no_file(lambda take, r: take.write(5)),
        _no_file(lambda take, r: r.mix(5)),
        _no_file(lambda take, r: r.load(5)),
        _no_file(lambda take, r: r.play(5)),
        _no_file(lambda take, r: r.rig(5)),
        _no_file(lambda take, r: r.align(5)),
        _no_file(lambda take, r: r.speak(audio=5, transcript="Hi.")),
        _no_file(lambda take, r: r.load_settings(5)),
        (lambda take, r: r.speak(Path("no.xml")), "no.xml: there is no such file"),
        (lambda take, r: r.speak("Hi.", audio="x.wav", transcript=5), "int cannot be performed"),
        (lambda take, r: r.speak("Hi.", emotion=5), "int is not an emotion; expected {'happiness': 0.7}"),
        (lambda take, r: r.speak("Hi.", emotion=[5]), "int is not an emotion"),
        (lambda take, r: r.speak("Hi.", emotion="hapiness:1"), "did you mean 'happiness'"),
        (lambda take, r: r.speak("Hi.", emotion={"happiness": "x"}), "happiness = 'x' is not a number"),
        (lambda take, r: r.pose([1]), "list is not a pose; expected values by name"),
        (lambda take, r: r.pose({"AU12": "x"}), "AU12 = 'x' is not a number"),
        (lambda take, r: r.pipe(5), "texts are int; expected a sequence"),
        (lambda take, r: r.pipe([], settings=5), "settings are int"),
        (lambda take, r: r.batch(5, "{id}.wav"), "rows are int; expected a sequence"),
        (lambda take, r: r.batch([], 5), "outputs are int; expected a sequence"),
        (lambda take, r: r.Live(5), "settings are int"),
        (lambda take, r: r.Live().say(5), "int cannot be said; expected a text"),
        (lambda take, r: r.Live().feel(5, 1), "5 is not the name of an emotion"),
        (lambda take, r: r.Live().feel("joy", "x"), "joy = 'x' is not a number"),
        (lambda take, r: take.explain("x"), "time = 'x' is not a number"),
        (lambda take, r: take.explain(0.5, 5), "5 is not the name of a muscle or parameter"),
        (lambda take, r: next(take.pictures(indices=[999])), "frame 999 is not in the performance"),
        (lambda take, r: next(take.faces(["a"])), "frame 'a' is not in the performance"),
        (lambda take, r: next(take.pictures("big")), "size 'big' is not a size; expected e.g. 720x720"),
    ],
)
def test_a_wrong_argument_is_a_fault_of_the_same_kind(call: Any, message: str, clip: risorius.Take) -> None:
    with pytest.raises(risorius.RisoriusError) as caught:
        call(clip, risorius)
    assert message in str(caught.value)


def test_emotions_are_taken_as_on_the_command_line() -> None:
    by_name, by_text, by_texts, as_display = (
        risorius.speak("Hi.", emotion=emotion).performance.values
        for emotion in (
            {"happiness": 0.7}, "joy:0.7", ["happiness:0.7"], [risorius.Display("happiness", 0.7)]
        )
    )  # fmt: skip
    for values in (by_text, by_texts, as_display):
        np.testing.assert_array_equal(values, by_name)


def test_a_script_may_be_a_path(tmp_path: Path) -> None:
    script, words = tmp_path / "scene.xml", tmp_path / "words.txt"
    script.write_text('<PHONEME text="Hello." />')
    words.write_text("Hello.")
    take = risorius.speak(script)
    take.write(tmp_path / "x.wav")
    assert take.utterance is not None
    assert take.utterance.text == "Hello."
    heard = risorius.speak(audio=tmp_path / "x.wav", transcript=words)
    assert heard.utterance is not None
    assert [word.text for word in heard.utterance.words] == ["Hello"]


def test_what_a_take_holds_is_shown_in_one_line_each(clip: risorius.Take) -> None:
    held = [
        clip.utterance,
        clip.score,
        clip.performance,
        clip.audio,
        clip.head,
        clip.settings,
        next(clip.faces([0])),
    ]
    for part in held:
        assert len(repr(part)) < 160, repr(part)
        assert "\n" not in repr(part)
    assert repr(risorius.Settings(age=40, look=risorius.Look(style="clay"))) == (
        "Settings(age=40, look=Look(style='clay'))"
    )
    assert str(clip.explain(0.5, "masseter")[0]).startswith("masseter = ")


@pytest.mark.parametrize(
    ("chosen", "message"),
    [
        ({"head": "nobody"}, "unknown head 'nobody'"),
        ({"language": "xx"}, "unknown language 'xx'"),
        ({"voice": "en-uss"}, "unknown voice 'en-uss'"),
        ({"profile": "nobody"}, "unknown profile 'nobody'"),
    ],
)
def test_unknown_names_are_refused_before_anything_is_spoken(chosen: dict[str, str], message: str) -> None:
    said: list[str] = []
    with pytest.raises(risorius.RisoriusError, match=message):
        risorius.speak(
            "Hi.", settings=risorius.Settings(**chosen), progress=lambda what, *_: said.append(what)
        )
    assert said == []


@pytest.mark.parametrize(
    ("chosen", "content", "message"),
    [
        ({"rules": "given"}, "x = " + "[" * 500, "given: is nested too deeply"),
        ({"look": risorius.Look(background="given")}, "%!PS", "given: not a picture"),
    ],
)
def test_a_spoilt_file_is_refused_before_anything_is_spoken(
    chosen: dict[str, Any], content: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("given").write_text(content)
    said: list[str] = []
    with pytest.raises(risorius.RisoriusError, match=f"^{message}"):
        risorius.speak(
            "Hi.", settings=risorius.Settings(**chosen), progress=lambda what, *_: said.append(what)
        )
    assert said == []


@pytest.mark.parametrize(
    ("wrong", "expected"),
    [
        (lambda: risorius.Settings(seed=1.5), "seed = 1.5 is not a whole number"),
        (lambda: risorius.pose({5: 1.0}), "int is not the name of a muscle"),
        (lambda: risorius.batch([], "{id}.wav", jobs=-1), "jobs = -1; expected a whole number, 0 or more"),
        (lambda: risorius.batch([], "{id}.wav", timeout=0), "timeout = 0; expected seconds, more than 0"),
        (lambda: next(risorius.pipe(["Hi."], as_tuples=True)), "str is not a pair; expected a text"),
        (lambda: risorius.Live().say(audio=b"", rate=8000, words=5), "words are int"),
    ],
)
def test_wrong_types_are_errors_in_one_line(wrong: Callable[[], object], expected: str) -> None:
    with pytest.raises(risorius.InputError, match=re.escape(expected)):
        wrong()
