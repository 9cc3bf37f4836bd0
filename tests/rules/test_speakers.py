"""Individuality and attitude choose what is shown and when (paper B, section 3.2.1)."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from risorius import Settings, speak
from risorius.channels import ChannelInputs, compose
from risorius.core.movement import Movement
from risorius.core.speech.utterance import Utterance
from risorius.errors import InputError
from risorius.rules.doctor import examine
from risorius.rules.profiles import attitude, attitudes, profile, profile_of, profiles
from risorius.rules.rule_set import extended, rule_set_of, shipped
from risorius.rules.speakers import rules_of_speaker

Maker = Callable[..., Utterance]
NUCLEAR = "signals.brows.nuclear"
TEXT = "Three brothers[H*] carried the piano[H*] up the stairs[H*]. Their sister[H*] played a waltz[H*]."
RULE = """
[[rule]]
id = "{id}"
level = "item"
when = {{ accent = ["any"], nuclear = true{when} }}
effect = {{ targets = {{ {targets} }} }}
timing = {{ at = "accent", lead = {lead}, onset = 0.1, apex = {apex}, offset = 0.2, snap = false }}
source = "a test"
comment = "a test"
"""


def rule(
    id: str = NUCLEAR, when: str = "", targets: str = "AU4 = 0.5", lead: float = 0.0, apex: float = 0.1
) -> str:
    return RULE.format(id=id, when=when, targets=targets, lead=lead, apex=apex)


def nuclear(said: Utterance, **inputs: object) -> list[Movement]:
    """Return the movements on nuclear accents by several seeds."""
    scores = [compose(ChannelInputs(said.duration, said, **inputs), seed=s) for s in range(8)]  # type: ignore[arg-type]
    return [m for score in scores for m in score.movements if m.cause.rule == NUCLEAR]


@pytest.mark.parametrize("name", [*profiles(), *attitudes()])
def test_the_rules_of_our_speakers_are_sound(name: str) -> None:
    who, more = (profile(name), ()) if name in profiles() else (profile("neutral"), (attitude(name),))
    assert examine(rules_of_speaker(shipped(), who, more)) == ()


def test_speakers_differ_in_the_units_and_in_the_times_of_an_accent(sentence_of: Maker) -> None:
    said = sentence_of(TEXT)
    found = {
        "neutral": nuclear(said),
        "lively": nuclear(said, profile=profile("lively")),
        "authoritative": nuclear(said, profile=profile("authoritative")),
        "ironic": nuclear(said, attitudes=(attitude("ironic"),)),
        "submissive": nuclear(said, attitudes=(attitude("submissive"),)),
    }
    units = {name: frozenset(own[0].targets) for name, own in found.items()}
    assert len(set(units.values())) == len(units)
    length = {name: sum(m.end - m.start for m in own) / len(own) for name, own in found.items()}
    assert length["lively"] < length["neutral"] < length["authoritative"] < length["ironic"]


@pytest.mark.parametrize("text", [TEXT, "You could not have known[H*] that, of course[H*], could you?"])
def test_an_ironic_nucleus_raises_one_brow(text: str, sentence_of: Maker) -> None:
    found = nuclear(sentence_of(text), attitudes=(attitude("ironic"),))
    assert found
    assert all(
        m.parameters["frontalis_lateralis.left"] > 0.5 > m.parameters.get("frontalis_lateralis.right", 0.0)
        for m in found
    )


def test_a_profile_of_ones_own_has_rules_of_its_own(tmp_path: Path) -> None:
    file = tmp_path / "anna.toml"
    file.write_text(
        'name = "anna"\nbase = "lively"\ndescription = "a test"\nsource = "us"\ndelete = ["signals.nod"]\n'
        + rule(lead=-0.1, apex=0.4)
        + rule("signals.mouth.anna", targets="AU14 = 0.7")
    )
    said = speak(TEXT.replace("[H*]", ""), text=True, settings=Settings(profile=str(file), seed=3))
    rules = {m.cause.rule for m in said.score.movements}
    assert {NUCLEAR, "signals.mouth.anna"} <= rules
    assert not any(name.startswith("signals.nod") for name in rules)
    raised = [m for m in said.score.movements if m.cause.rule == NUCLEAR]
    assert all(set(m.targets) == {"AU4"} for m in raised)
    assert profile_of(str(file)).head == profile("lively").head


def test_rules_of_the_base_stay_unless_they_are_given_anew(tmp_path: Path) -> None:
    head = 'name = "b"\nbase = "lively"\ndescription = "a test"\nsource = "a test"\n'
    (tmp_path / "more.toml").write_text(head + rule("signals.mouth.more"))
    (tmp_path / "other.toml").write_text(head + rule())
    more, other = (profile_of(str(tmp_path / f"{name}.toml")) for name in ("more", "other"))
    assert [r.id for r in more.rule] == [NUCLEAR, "signals.mouth.more"]
    assert [set(r.effect.targets) for r in other.rule] == [{"AU4"}]


@pytest.mark.parametrize(
    ("when", "inputs", "holds"),
    [
        (', profile = ["neutral"]', {}, True),
        (', profile = ["lively"]', {}, False),
        (', profile = ["reserved", "lively"]', {"profile": profile("lively")}, True),
        (', attitude = ["ironic"]', {}, False),
        (', attitude = ["ironic", "polite"]', {"attitudes": (attitude("polite"),)}, True),
        (', attitude = ["ironic"], profile = ["lively"]', {"attitudes": (attitude("ironic"),)}, False),
    ],
)
def test_a_rule_may_be_for_some_speakers_only(
    when: str, inputs: dict[str, object], holds: bool, sentence_of: Maker
) -> None:
    said = sentence_of(TEXT)
    rules = extended(shipped(), rule("signals.mouth.some", when), "mine.toml")
    score = compose(ChannelInputs(said.duration, said, rules=rules, **inputs))  # type: ignore[arg-type]
    assert any(m.cause.rule == "signals.mouth.some" for m in score.movements) is holds


def test_a_user_s_file_has_the_last_word(tmp_path: Path, sentence_of: Maker) -> None:
    said = sentence_of(TEXT)
    ironic = {"attitudes": (attitude("ironic"),)}
    mine = tmp_path / "mine.toml"
    mine.write_text(rule(targets="AU4 = 0.4"))
    assert {tuple(m.targets) for m in nuclear(said, rules=rule_set_of(mine), **ironic)} == {("AU4",)}
    mine.write_text(f'delete = ["{NUCLEAR}"]')
    assert nuclear(said, rules=rule_set_of(mine), **ironic) == []
    mine.write_text(rule("signals.brows.mine").replace("source", f'replaces = ["{NUCLEAR}"]\nsource'))
    assert nuclear(said, rules=rule_set_of(mine), **ironic) == []


@pytest.mark.parametrize(
    ("when", "message"),
    [
        (', attitude = ["ironical"]', "unknown attitude 'ironical'.*did you mean 'ironic'"),
        (', profile = ["livly"]', "unknown profile 'livly'.*did you mean 'lively'"),
    ],
)
def test_unknown_speakers_are_errors_with_their_place(when: str, message: str) -> None:
    with pytest.raises(InputError, match=message) as caught:
        extended(shipped(), rule(when=when), "mine.toml")
    assert str(caught.value).startswith("mine.toml:5")


def test_faults_in_the_rules_of_a_profile_have_their_place(tmp_path: Path) -> None:
    head = 'name = "b"\nbase = "neutral"\ndescription = "a test"\nsource = "a test"\n'
    file = tmp_path / "b.toml"
    file.write_text(head + rule(targets="AU99 = 0.5"))
    with pytest.raises(InputError, match=r"b\.toml:10.*AU99"):
        profile_of(str(file))
    file.write_text(head + rule() + rule())
    with pytest.raises(InputError, match="given twice"):
        profile_of(str(file))
    file.write_text(head + 'delete = ["signals.browz"]\n')
    with pytest.raises(InputError, match=r"unknown rule 'signals\.browz'"):
        speak("Oh.", text=True, settings=Settings(profile=str(file)))
