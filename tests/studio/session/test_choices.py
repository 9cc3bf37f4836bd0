"""Choices of a page: named things are looked up, and nothing that a page names is opened."""

from __future__ import annotations

import pytest

from risorius.errors import RisoriusError
from risorius.rules.profiles import profile_of
from risorius.rules.rule_set import rule_set_of
from risorius.rules.tuned import tuned_text
from risorius.settings import Settings
from risorius.studio.session.choices import settings_of
from risorius.studio.wire.shared import Choices

WRONG = [
    ({"head": "/etc/passwd"}, "unknown head '/etc/passwd'"),
    ({"voice": "/tmp/a.onnx"}, "is a file"),
    ({"profile": "/tmp/mine.toml"}, "unknown profile '/tmp/mine.toml'"),
    ({"profile_text": "name = 3"}, "profile"),
    ({"profile_text": "x" * 200_000}, "longer than"),
    ({"fps": "fast"}, "fps 'fast' is not a number"),
    ({"fps": "1e9"}, "out of range"),
    ({"dynamics": "jelly"}, "unknown skin 'jelly'"),
    ({"hair": "/etc"}, "unknown hair style"),
    ({"rules_off": ("nothing.such",)}, "unknown rule 'nothing.such'"),
]


@pytest.mark.parametrize(("chosen", "message"), WRONG)
def test_a_wrong_choice_is_named(tmp_path, chosen, message):
    with pytest.raises(RisoriusError) as caught:
        rule_set_of(settings_of(Choices(**chosen), tmp_path).rules)
    assert message in str(caught.value)


def test_the_defaults_are_the_library_s(tmp_path):
    assert settings_of(Choices(), tmp_path) == Settings()
    assert not list(tmp_path.iterdir())


def test_rules_are_switched_off_by_a_file_of_the_session(tmp_path):
    settings = settings_of(Choices(rules_off=("gaze", "head")), tmp_path)
    assert settings.rules.parent == tmp_path
    assert not any(name.startswith(("gaze.", "head.")) for name in rule_set_of(settings.rules).entries)
    assert settings == settings_of(Choices(rules_off=("head", "gaze", "head")), tmp_path)


def test_an_edited_profile_is_performed_from_a_file_of_the_session(tmp_path):
    text = tuned_text("lively", "mine", {"blinks.wait": 2.5})
    settings = settings_of(Choices(profile_text=text), tmp_path)
    assert profile_of(settings.profile).blinks.wait == 2.5
    assert [path.suffix for path in tmp_path.iterdir()] == [".toml"]


def test_a_rule_that_is_none_is_named_without_a_path_of_this_machine(tmp_path):
    with pytest.raises(RisoriusError) as caught:
        settings_of(Choices(rules_off=("../../x",)), tmp_path)
    assert str(caught.value).startswith("rules_off:1:11: unknown rule")
    assert str(tmp_path) not in str(caught.value)
    assert not list(tmp_path.iterdir())
