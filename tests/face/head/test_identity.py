from __future__ import annotations

import pytest

from risorius.errors import HeadError
from risorius.face.head.head import load_head, shipped_heads
from risorius.face.head.identity import OLD, YOUNG, Identity, Looks, grey_share, read_identity

GOOD = """
title = "someone"
age = 40
[sex]
female = 1.0
[origin]
asian = 0.5
african = 0.5
"""


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("title", "titel", "unknown key 'titel'; did you mean 'title'"),
        ('"someone"', "3", "title = 3 cannot be used; expected a text"),
        ("age = 40", "age = 12", "age = 12 is out of range; expected a number from 25 to 90"),
        ("age = 40", "age = true", "age = true cannot be used; expected a number"),
        ("female", "femal", "unknown key 'sex.femal'; did you mean 'female'"),
        ("female = 1.0", "female = 0.7", "sex adds up to 0.7"),
        ("asian = 0.5", "asian = 0.25", r":6:1: origin adds up to 0.75; expected shares"),
        ("asian = 0.5", "asian = -0.5", "origin.asian = -0.5 is out of range; expected a number from 0 to 1"),
        ("[sex]", "[[sex]]", r":4:1: sex = \[a table\] cannot be used; expected a table"),
        ("[origin]", "[looks]\nhare = 3\n[origin]", "unknown key 'looks.hare'; did you mean 'hair'"),
        (
            "[origin]",
            "[looks]\nhair = [1, 2]\n[origin]",
            r"looks.hair = \[1, 2\] cannot be used; expected a list of 3",
        ),
        (
            "[origin]",
            "[looks]\nskin = [1, 2, 300]\n[origin]",
            r":7:15: looks.skin\[2\] = 300 is out of range",
        ),
        (
            "[origin]",
            "[looks]\niris = [[1, 2, 3]]\n[origin]",
            "expected a list of 2, each a list of 3, each a whole number from 0 to 255",
        ),
        (
            "[origin]",
            "[looks]\nhairs = 0\n[origin]",
            "looks.hairs = 0 is out of range; expected a whole number from 100",
        ),
        (
            "[origin]",
            '[sliders]\n"nose/x" = 2.0\n[origin]',
            "sliders.nose/x = 2.0 is out of range; expected a number from -1 to 1",
        ),
        (
            "[origin]",
            "[build]\nheight = 0.1\n[origin]",
            "unknown key 'build.height'; did you mean 'weight'",
        ),
        ("[sex]", "[sex", ":4:5: is not a TOML file"),
    ],
)
def test_a_wrong_identity(tmp_path, old, new, message):
    file = tmp_path / "identity.toml"
    file.write_text(GOOD.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(HeadError, match=message) as caught:
        read_identity(file)
    assert "identity.toml" in str(caught.value)


def test_a_right_one(tmp_path):
    file = tmp_path / "identity.toml"
    file.write_text(GOOD, encoding="utf-8")
    who = read_identity(file)
    assert (who.title, who.age, dict(who.sex)) == ("someone", 40.0, {"female": 1.0})
    assert who.looks == Looks()
    assert who.at(60.0).age == 60.0


@pytest.mark.parametrize("name", shipped_heads())
def test_the_shipped_ones_say_who_they_are(name):
    who = load_head(name).identity
    assert who.title
    assert YOUNG <= who.age <= OLD


def test_the_shipped_ones_differ_in_sex_origin_and_age():
    known = [load_head(name).identity for name in shipped_heads()]
    assert len(known) >= 7
    assert {max(who.sex, key=who.sex.get) for who in known} == {"female", "male"}
    assert {max(who.origin, key=who.origin.get) for who in known} == {"african", "asian", "caucasian"}
    assert min(who.age for who in known) < 30 < 65 < max(who.age for who in known)
    assert len({who.looks.skin for who in known}) == len(known)


def test_hair_goes_grey_with_age_from_the_head_s_own():
    person = Identity("someone", age=40.0)
    assert person.at(40.0).looks.grey == 0.0
    assert person.at(30.0).looks.grey == 0.0
    shares = [person.at(age).looks.grey for age in (45.0, 55.0, 65.0, 75.0, 90.0)]
    assert shares == sorted(shares)
    assert shares[0] < 0.05 < 0.4 < shares[2] < 0.6 < 0.9 < shares[4]
    # By another age on the way it is the same.
    assert person.at(60.0).at(80.0).looks.grey == pytest.approx(person.at(80.0).looks.grey)


def test_the_share_of_grey_hairs_has_the_mean_of_its_source():
    ages = [45.0 + year for year in range(21)]
    assert sum(map(grey_share, ages)) / len(ages) == pytest.approx(0.74 * 0.27, abs=0.04)
