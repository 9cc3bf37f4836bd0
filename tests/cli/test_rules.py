"""`risorius rules`, and the options that choose who speaks by which rules."""

from __future__ import annotations

from pathlib import Path

import pytest

from risorius import speak
from risorius.cli import run
from risorius.errors import InputError, ParameterError
from risorius.rules.rule_set import shipped
from risorius.settings import Settings

ILL = """
[[rule]]
id = "signals.brows.ill"
level = "word"
effect = { targets = { AU1 = 0.5 } }
probability = 0
source = "s"
comment = "c"
"""


@pytest.fixture
def ill(tmp_path: Path) -> Path:
    file = tmp_path / "ill.toml"
    file.write_text(ILL)
    return file


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["rules", "show", "signals.brows.nuclaer"], "did you mean 'signals.brows.nuclear'?"),
        (["rules", "list", "signal"], "unknown rule 'signal'"),
        (["rules", "list", "--rules", "none.toml"], "none.toml: cannot be read"),
        (["speak", "Hello.", "--profile", "livly", "-o", "x.muscles.csv"], "did you mean 'lively'?"),
        (["speak", "Hello.", "--attitude", "polit", "-o", "x.muscles.csv"], "did you mean 'polite'?"),
        (["speak", "Hello.", "--rules", "none.toml", "-o", "x.muscles.csv"], "none.toml: cannot be read"),
        (["speak", "Hello.", "--profile", "no.toml", "-o", "x.muscles.csv"], "no.toml: cannot be read"),
    ],
)
def test_faults(
    arguments: list[str], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(arguments) == 2
    assert message in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_the_doctor_names_what_is_ill_and_fails(ill: Path, capsys) -> None:
    assert run(["rules", "doctor"]) == 0
    assert run(["rules", "doctor", "--rules", str(ill)]) == 2
    shown = capsys.readouterr()
    assert f"{ill}:2:1: rule 'signals.brows.ill' can never fire: its probability is 0" in shown.out
    assert f"1 problem in {len(shipped().entries) + 1} rules" in shown.err


def test_all_rules_are_listed_and_each_shown_as_it_stands(ill: Path, capsys) -> None:
    assert run(["rules", "list", "--rules", str(ill)]) == 0
    listed = capsys.readouterr().out
    assert all(rule.id in listed for rule in shipped())
    assert run(["rules", "show", "signals.brows.ill", "--rules", str(ill)]) == 0
    assert capsys.readouterr().out == f"# {ill}:2:1\n{ILL.lstrip()}"
    assert run(["rules", "list", "regulators.eyes"]) == 0
    assert "signals" not in capsys.readouterr().out


def test_rules_profile_and_attitudes_reach_the_performance(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(ILL.replace("probability = 0", "").replace("brows.ill", "brows.mine"))
    settings = Settings(profile="lively", attitudes=("ironic",), rules=file)
    take = speak("She likes it.", settings=settings)
    causes = {m.cause.rule for m in take.score.movements}
    assert {"signals.brows.mine", "emotion.posture.speaker", "head.posture.speaker"} <= causes
    assert take.settings.age == 28.0
    assert speak("Hello.", settings=Settings(profile="lively", age=40.0)).settings.age == 40.0


def test_unknown_names_raise() -> None:
    with pytest.raises(ParameterError, match="unknown profile"):
        speak("Hello.", settings=Settings(profile="nobody"))
    with pytest.raises(ParameterError, match="unknown attitude"):
        speak("Hello.", settings=Settings(attitudes=("smug",)))
    with pytest.raises(InputError, match="cannot be read"):
        speak("Hello.", settings=Settings(rules=Path("none.toml")))


def test_still_no_rule_acts() -> None:
    score = speak("She likes it!", settings=Settings(lively=False)).score
    assert score.movements == ()
