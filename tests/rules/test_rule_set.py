from pathlib import Path

import pytest

from risorius.errors import InputError
from risorius.rules.doctor import examine
from risorius.rules.rule_set import RuleSet, extended, rule_set_of, shipped

RULE = """
[[rule]]
id = "signals.brows.mine"
level = "word"
effect = { targets = { AU1 = 0.5 } }
source = "somebody"
comment = "why not"
"""


def mine(*lines: str) -> str:
    """Return the rule with some of its lines replaced by key, added, or left out where they are but a key."""
    found = {line.partition(" ")[0]: line for line in (*RULE.strip().splitlines(), *lines)}
    return "\n".join(line for line in found.values() if "=" in line or "[" in line)


@pytest.mark.parametrize(
    ("lines", "line", "message"),
    [
        (["wen = {}"], 7, "unknown key 'rule[0].wen'; did you mean 'when'?"),
        (["comment"], 1, "key 'rule[0].comment' is missing"),
        (['level = "sentence"'], 3, 'rule[0].level = "sentence" cannot be used; expected one of phoneme'),
        (["effect = { targets = { AU99 = 0.5 } }"], 4, "unknown action unit 'AU99'"),
        (["effect = { targets = { AU8 = 0.5 } }"], 4, "AU8 (lips toward each other) cannot be shown"),
        (["effect = { targets = { AU1 = 1.5 } }"], 4, "AU1 = 1.5 is out of range"),
        (["effect = { gesture = 'bow' }"], 4, "unknown gesture 'bow'; expected one of nod, beat, shake"),
        (["effect = { look = 'awya' }"], 4, "unknown direction 'awya'; did you mean 'away'?"),
        (["effect = { emblem = 'hapiness' }"], 4, "unknown emotion 'hapiness'"),
        (["effect = { blink = 1.2 }"], 4, "rule[0].effect.blink = 1.2 is out of range"),
        (["effect = { vary = 0.2 }"], 4, "the effect does nothing"),
        (
            ["probability = 1.5"],
            7,
            "rule[0].probability = 1.5 is out of range; expected a number from 0 to 1",
        ),
        (["probability = -0.1"], 7, "rule[0].probability = -0.1 is out of range"),
        (['when = { phones = ["QX"] }', 'level = "phoneme"'], 7, "unknown phone 'QX'"),
        (['when = { emotion = ["joyful", "gloom"] }'], 7, "unknown emotion 'gloom'"),
        (['when = { accent = ["H+"] }'], 7, "unknown pitch accent 'H+'"),
        (['when = { boundary = ["LL"] }'], 7, "unknown boundary tone 'LL'"),
        (['when = { pause = ["semicolon"] }'], 7, "rule[0].when.pause"),
        (["when = { rate = [5.0, 2.0] }"], 7, "rate = [5.0, 2.0] can never be met"),
        (['when = { phones = ["M"] }'], 1, "rule 'signals.brows.mine' can never fire: no word has 'phones'"),
        (['timing = { function = "cubic" }'], 7, "unknown onset function 'cubic'"),
        (['id = "signal.brows.mine"'], 1, "unknown channel of rule 'signal.brows.mine' 'signal'"),
        (['id = "signals.brows"'], 1, "expected channel.part.name"),
        (['replaces = ["signals.brows.nuclaer"]'], 7, "did you mean 'signals.brows.nuclear'?"),
    ],
)
def test_bad_rules_are_refused_with_their_place(lines: list[str], line: int, message: str) -> None:
    with pytest.raises(InputError) as caught:
        extended(shipped(), mine(*lines), "my.toml")
    assert message in str(caught.value)
    assert str(caught.value).startswith(f"my.toml:{line}")


def test_a_rule_given_twice_is_refused() -> None:
    with pytest.raises(InputError, match=r"my.toml:\d+:1: rule 'signals.brows.mine' is given twice"):
        extended(shipped(), mine() + "\n" + mine(), "my.toml")


def test_replacements_in_a_circle_are_refused() -> None:
    first, second, third = (f'id = "signals.brows.{n}"' for n in "abc")
    text = "\n".join(
        mine(own, f"replaces = [{other.partition('= ')[2]}]")
        for own, other in ((first, second), (second, third), (third, first))
    )
    with pytest.raises(InputError, match=r"go round in a circle: signals\.brows\.a → .*b → .*c → .*a"):
        extended(shipped(), text, "my.toml")


def test_an_unknown_rule_to_delete_is_refused() -> None:
    with pytest.raises(InputError, match=r"my.toml:1:11: unknown rule 'signals.brwos'"):
        extended(shipped(), 'delete = ["signals.brwos"]', "my.toml")


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be read"):
        rule_set_of(tmp_path / "none.toml")


def ids(rule_set: RuleSet) -> set[str]:
    return {rule.id for rule in rule_set}


def test_a_file_adds_replaces_and_deletes_without_touching_ours() -> None:
    before = ids(shipped())
    text = (
        'delete = ["punctuators.brows", "signals.lids.blink"]\n'
        + mine()
        + "\n"
        + mine('id = "signals.nod.accent"', "probability = 0.01")
        + "\n"
        + mine('id = "signals.swing.mine"', 'replaces = ["signals.swing.accent"]')
    )
    rule_set = extended(shipped(), text, "my.toml")
    assert ids(rule_set) - before == {"signals.brows.mine", "signals.swing.mine"}
    gone = before - ids(rule_set)
    assert {"signals.lids.blink", "signals.swing.accent", "punctuators.brows.comma"} <= gone
    assert all(
        name.startswith("punctuators.brows.") or name in ("signals.lids.blink", "signals.swing.accent")
        for name in gone
    )
    assert rule_set.get("signals.nod.accent").rule.probability == 0.01
    assert ids(shipped()) == before


def test_every_rule_has_source_and_comment_and_stands_in_its_file() -> None:
    for entry in shipped().entries.values():
        assert entry.rule.source
        assert entry.rule.comment
        assert f'id = "{entry.rule.id}"' in entry.text
        assert str(entry.place).startswith("rules/")


def test_our_rules_are_well() -> None:
    assert examine(shipped()) == ()


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (["probability = 0"], "can never fire: its probability is 0"),
        (["when = { nuclear = true }"], "nuclear accent without naming accents"),
        (['when = { emotion = ["none"], intensity = 0.3 }'], "when nothing is felt there is no intensity"),
        (['when = { words = ["Yes"] }'], "words are compared in lower case"),
        (['when = { pause = ["initial"] }'], "nothing is said before the initial pause"),
        (["when = { stress = [-1] }"], "only consonants have a stress of -1"),
        (
            ['level = "pause"', 'when = { pause = ["comma"], question = ["wh"] }'],
            "a question is followed by a pause of the kind question",
        ),
        (['pauses = ["signals.nods"]'], "pauses 'signals.nods', which is not a rule"),
        (['pauses = ["signals.brows"]'], "pauses itself"),
        (['effect = { targets = { AU1 = 0.5 }, look = "up" }'], "has a look and targets"),
        (['source = " "'], "lacks a source or a comment"),
    ],
)
def test_the_doctor_names_problems(lines: list[str], message: str) -> None:
    (finding,) = examine(extended(shipped(), mine(*lines), "my.toml"))
    assert str(finding).startswith("my.toml:1:1: rule 'signals.brows.mine' ")
    assert message in str(finding)


def test_the_doctor_names_twins() -> None:
    twin = mine() + "\n" + mine('id = "signals.brows.other"')
    (finding,) = examine(extended(shipped(), twin, "my.toml"))
    assert "does what 'signals.brows.mine' does" in finding.message
