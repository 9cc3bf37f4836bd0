from pathlib import Path

import pytest

from risorius.errors import InputError, ParameterError
from risorius.rules.emotions import emotion, emotion_key, emotions, parse_display
from risorius.rules.load import DATA
from risorius.rules.modulation import is_under
from risorius.rules.profiles import attitude, attitudes, profile, profile_from, profile_of, profiles
from risorius.rules.rule_set import shipped

SMALL = 'name = "mine"\nbase = "neutral"\ndescription = "d"\nsource = "s"\n'
BASES = {"neutral": (DATA / "profiles" / "neutral.toml").read_text()}
# What the channels themselves make, beside rules.
HABITS = ("gaze.aversion", "head", "head.noise.idle", "head.melody.pitch")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            'name = "mine"\nbase = "neutrl"\n',
            "mine.toml:2:1: unknown profile 'neutrl'; did you mean 'neutral'?",
        ),
        (SMALL + "[blink]\nwait = 2.0\n", "mine.toml:5:1: unknown key 'blink'; did you mean 'blinks'?"),
        (SMALL + "[blinks]\nwiat = 2.0\n", "mine.toml:6:1: unknown key 'blinks.wiat'"),
        (SMALL + "side = 2.0\n", "mine.toml:5:1: side = 2.0 is out of range"),
        (SMALL + "[rates]\nsignals = -1.0\n", "mine.toml:6:1: rates.signals = -1.0 is out of range"),
        (SMALL + "[posture]\nAU99 = 0.1\n", "unknown action unit 'AU99'"),
        (SMALL + "[posture]\ngaze_yaw = 5.0\n", "gaze_yaw cannot be held as a posture"),
        (SMALL + '[blinks]\nmodel = "often"\n', "expected one of natural, itti, pelachaud, none"),
        (SMALL + "[gaze.directions]\nfront = 0.5\n", "unknown direction 'front'"),
        ('name = "mine"\ndescription = "d"\nsource = "s"\n', "key 'blinks' is missing"),
        (SMALL + "[gaze.directions]\nup = 0\ndown = 0\nside = 0\n", "all directions of gaze have weight 0"),
        ("name = ", "not a TOML file"),
    ],
)
def test_bad_profiles_are_refused_with_their_place(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        profile_from(text, "mine.toml", BASES)
    assert message in str(caught.value)


def test_a_profile_that_rests_on_itself_is_refused() -> None:
    with pytest.raises(InputError, match="is based on itself"):
        profile_from(SMALL, "mine.toml", {"neutral": 'name = "neutral"\nbase = "mine"', "mine": SMALL})


def test_unknown_names_are_refused() -> None:
    with pytest.raises(ParameterError, match="did you mean 'lively'"):
        profile("livly")
    with pytest.raises(ParameterError, match="did you mean 'polite'"):
        attitude("polit")


def test_four_profiles_and_four_attitudes_ship() -> None:
    assert {"neutral", "lively", "reserved", "authoritative"} <= set(profiles())
    assert {"polite", "ironic", "persuasive", "submissive"} <= set(attitudes())


def test_what_a_profile_leaves_out_stands_in_its_base() -> None:
    mine = profile_from(SMALL + "[gaze.speaking]\nlength = [9.0, 1.0]\n", "mine.toml", BASES)
    neutral = profile("neutral")
    assert mine.gaze.speaking.length == (9.0, 1.0)
    assert mine.gaze.speaking.gap == neutral.gaze.speaking.gap
    assert mine.blinks == neutral.blinks


def test_a_profile_may_be_a_file(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(SMALL + "side = 0.5\n")
    assert profile_of(str(file)).side == 0.5


def test_factors_name_rules_that_exist() -> None:
    ids = [*(rule.id for rule in shipped()), *HABITS]
    for who in (*profiles().values(), *attitudes().values(), *emotions().values()):
        for prefix in who.modulation.prefixes():
            assert any(is_under(name, prefix) for name in ids), f"{who.name}: {prefix}"


def test_an_emotion_may_be_a_file(tmp_path: Path) -> None:
    text = (
        (DATA / "emotions" / "pride.toml")
        .read_text()
        .replace('"pride"', '"glee"')
        .replace("AU12 = 0.55", "AU12 = 0.6")
    )
    file = tmp_path / "glee.toml"
    file.write_text(text)
    display = parse_display(f"{file}:0.5@1-2")
    assert (display.intensity, display.start) == (0.5, 1.0)
    assert emotion(display.emotion).name == "glee"
    assert emotion(emotion_key(str(file))).targets(1.0)["zygomatic_major.left"] == 0.6
