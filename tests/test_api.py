"""What users import, and what two of them may do at once."""

from __future__ import annotations

import pydoc
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
    assert isinstance(risorius.stream, ModuleType)
    assert callable(risorius.stream.send_take)
    assert isinstance(risorius.stream, ModuleType)


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
        risorius.speak(5)  # type: ignore[arg-type]
    with pytest.raises(risorius.RisoriusError, match="settings are dict; expected"):
        risorius.speak("Hi.", settings={"fps": 60})  # type: ignore[arg-type]
    with pytest.raises(risorius.RisoriusError, match="unknown parameter 'lip_seel'; did you mean 'lip_seal'"):
        _ = clip.curves["lip_seel"]
    assert clip.curves.get("lip_seel") is None


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
