"""A file of rules changes, adds and deletes entries of the tables of lips, emotions and links."""

from __future__ import annotations

from pathlib import Path

import pytest

import risorius
from risorius.core.muscle_coupling import Link
from risorius.errors import InputError, RisoriusError
from risorius.face.head.coupled_muscles import link_rows
from risorius.rules.doctor import examine
from risorius.rules.emotions import emotion, emotion_names, emotions
from risorius.rules.lips import lip_table
from risorius.rules.rule_set import RuleSet, emotions_of, extended, shipped


def rule_set(text: str) -> RuleSet:
    return extended(shipped(), text, "mine.toml")


def entry(name: str, values: str, source: str = "me") -> str:
    return f'[[entry]]\nid = "{name}"\nvalues = {{ {values} }}\nsource = "{source}"\n'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (entry("lips.phone.AA", "targets = { jaw_drop = 500.0 }"), "mine.toml:3:.*jaw_drop = 500"),
        (entry("lips.phone.AA", "targets = { jaw = 5.0 }"), "mine.toml:3:.*unknown articulator"),
        (entry("lips.phone.ZZ", 'class = "vowel"'), "mine.toml:3:.*targets"),
        (entry("lips.phon.AA", ""), "mine.toml:1:.*unknown table of lips 'phon'; did you mean 'phone'"),
        (entry("lips.phone", ""), "there is no entry 'lips.phone'"),
        (entry("faces.AA", ""), "there is no entry with the id 'faces.AA'; expected e.g. lips.phone.AA"),
        (entry("emotions.happiness", "targets = { AU99 = 1.0 }"), "mine.toml:3:.*unknown action unit 'AU99'"),
        (entry("emotions.happiness", "onsett = 1.0"), "mine.toml:3:.*onsett"),
        (
            entry("emotions.happy", 'targets = { AU12 = 1.0 }, aliases = ["fear"]'),
            "mine.toml:3:.*two emotions",
        ),
        (
            entry("links.zygomatic_major.frontalis", "weight = 0.5"),
            "mine.toml:3:.*unknown muscle 'frontalis'",
        ),
        (entry("links.zygomatic_major.triangularis", "weight = 0.5"), "mine.toml:3:.*conflict"),
        (entry("links.mentalis.masseter", "weigth = 0.5"), "mine.toml:3:.*values weigth; expected weight"),
        ('delete = ["links.frontalis"]', "mine.toml:1:.*unknown rule 'links.frontalis'"),
        ('delete = ["lips.phone.QQ"]', "mine.toml:1:.*unknown rule 'lips.phone.QQ'"),
    ],
)
def test_entries_that_do_not_fit_are_refused_with_their_place(text: str, message: str) -> None:
    with pytest.raises(RisoriusError, match=message):
        rule_set(text)


def test_a_phone_changes_and_the_others_stay() -> None:
    table = rule_set(entry("lips.phone.AA", "targets = { jaw_drop = 14.0 }")).tables.lips()
    assert table.shape("AA").targets["jaw_drop"] == 14.0
    assert {n: v for n, v in table.shape("AA").targets.items() if n != "jaw_drop"} == {
        n: v for n, v in lip_table().shape("AA").targets.items() if n != "jaw_drop"
    }
    assert table.shape("AE") == lip_table().shape("AE")
    assert shipped().tables.lips() is lip_table()


def test_a_phone_is_added() -> None:
    click = entry("lips.phone.TSK", 'class = "vowel", targets = { lip_width = 2.0 }')
    assert rule_set(click).tables.lips().shape("TSK").targets == {"lip_width": 2.0}


def test_a_deleted_phone_moves_no_lips(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text('delete = ["lips.phone.M"]')
    phones = [
        {s.phone for s in risorius.speak("Mama.", settings=risorius.Settings(rules=rules)).score.lips}
        for rules in (None, file)
    ]
    assert phones[0] - phones[1] == {"M"}


def test_links_change_are_added_and_deleted() -> None:
    before = link_rows()
    first = before[0]
    text = f'delete = ["links.{first.muscle}"]\n' + entry("links.mentalis.masseter", "weight = 0.25")
    after = rule_set(text).tables.links(before)
    assert after == (
        *(row for row in before if row.muscle != first.muscle), Link("mentalis", "masseter", 0.25, "me"),
    )  # fmt: skip
    other = ".other" if first.sides == "other" else ""
    changed = rule_set(entry(f"links.{first.muscle}.{first.linked}{other}", "weight = 0.0")).tables.links(
        before
    )
    assert changed[0].weight == 0.0
    assert changed[1:] == before[1:]


def test_emotions_change_are_added_and_deleted_while_the_file_is_in_force(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(
        'delete = ["emotions.boredom"]\n'
        + entry("emotions.happiness", "onset = 1.25, targets = { AU6 = 0.25 }")
        + entry("emotions.smirk", 'targets = { "AU12.left" = 0.5 }, aliases = ["sneaky"]')
    )
    usual = emotion("happiness")
    with emotions_of(file):
        assert emotion("joy").onset == 1.25
        assert emotion("joy").units == {**usual.units, "AU6": 0.25}
        assert emotion("sneaky").targets(1.0) == {"zygomatic_major.left": 0.5}
        assert "boredom" not in emotions()
    assert emotion("happiness") is usual
    assert "smirk" not in emotion_names()
    assert "boredom" in emotions()


def test_what_a_file_adds_can_be_performed_and_its_rules_know_it(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(
        entry("emotions.smirk", 'targets = { "AU12.left" = 0.5 }')
        + '[[rule]]\nid = "signals.lids.smirk"\nlevel = "word"\nwhen = { emotion = ["smirk"] }\n'
        'effect = { targets = { AU7 = 0.6 } }\ntiming = { at = "whole" }\n'
        'source = "me"\ncomment = "Squints."\n'
    )
    take = risorius.speak("He did it.", emotion="smirk:1", settings=risorius.Settings(rules=file))
    rules = {m.cause.rule for m in take.score.movements}
    assert {"emotion.display", "signals.lids.smirk"} <= rules
    with pytest.raises(RisoriusError, match="unknown emotion 'smirk'"):
        risorius.speak("He did it.", emotion="smirk:1")


def test_the_own_rules_change_no_links() -> None:
    assert not shipped().tables.touches("links")  # so that a head needs none of them


def test_a_changed_link_moves_the_skin(tmp_path: Path) -> None:
    from risorius.solvers import make_solver
    from risorius.take import with_profile

    file = tmp_path / "mine.toml"
    file.write_text(entry("links.frontalis_medialis.frontalis_lateralis", "weight = 1.0"))
    brow = risorius.pose({"AU1": 1.0}).performance.values[0]
    skins = [
        make_solver(with_profile(risorius.Settings(rules=rules, dynamics="static"))).solve(brow).skin.copy()
        for rules in (None, file)
    ]
    assert abs(skins[1] - skins[0]).max() > 0.5


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (entry("emotions.pride", ""), "changes nothing"),
        (entry("emotions.pride", "onset = 0.5", ""), "lacks a source"),
        (
            entry("emotions.pride", "onset = 0.5") + entry("emotions.pride", "onset = 0.6"),
            "gives 'onset' twice",
        ),
        ('delete = ["emotions.pride"]\n' + entry("emotions.pride", "onset = 0.5"), "changed and deleted"),
    ],
)
def test_the_doctor_examines_entries(text: str, message: str) -> None:
    (finding,) = examine(rule_set(text))
    assert message in str(finding)
    assert str(finding).startswith("mine.toml:")


def test_the_shape_of_a_diphthong_is_asked_for_by_its_parts():
    with pytest.raises(InputError, match="the diphthong 'OW' has two shapes; expected 'AO' or 'UW'"):
        lip_table().shape("OW")
    with pytest.raises(InputError, match="unknown phone 'OWW'; did you mean 'OW'"):
        lip_table().shape("OWW")
