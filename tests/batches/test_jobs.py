from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import risorius
from risorius.batches.jobs import JobMaker, check_job
from risorius.batches.manifest import Manifest, ManifestRow
from risorius.batches.patterns import OutputPattern, checked_part
from risorius.errors import InputError, OutputError, ParameterError, Place, RisoriusError
from risorius.rules.emotions import Display
from risorius.settings import Settings
from risorius.settings.declare import rows

PLACE = Place("m.csv", 2)


def maker(tmp_path: Path, *patterns: str) -> JobMaker:
    return JobMaker([OutputPattern(text) for text in patterns or ("out/{id}.mp4",)], tmp_path)


@pytest.mark.parametrize(
    ("cells", "message"),
    [
        ({"text": "Hi"}, "has no id"),
        ({"id": "a"}, "has nothing to perform"),
        ({"id": "a", "text": "Hi", "script": "x.xml"}, "has both a text and a script"),
        ({"id": "a", "audio": "x.wav", "transcript": "Hi"}, "there is no such file"),
        ({"id": "a", "script": "x.xml"}, "there is no such file"),
        ({"id": "a", "text": "Hi", "emtion": "joy:1"}, "unknown column 'emtion'; did you mean 'emotion'?"),
        ({"id": "a", "text": "Hi", "emotion": "joy:2"}, "happiness = 2.0 is out of range"),
        ({"id": "a", "text": "Hi", "fps": "0"}, "fps = 0 is out of range"),
        ({"id": "a", "text": "Hi", "seed": "x"}, "seed 'x' is not a whole number"),
        ({"id": "a", "text": "Hi", "still": "yes"}, "unknown value 'yes'; expected one of on, off"),
        ({"id": "a", "text": "Hi", "still": "on", "lively": "on"}, "chooses lively in two columns"),
        ({"id": "a", "text": "Hi", "every": "3"}, "every has no effect"),
        ({"id": "a", "audio": "\udcff.wav", "transcript": "Hi"}, "is not UTF-8"),
    ],
)
def test_a_row_that_cannot_be_performed_says_why(cells: dict[str, str], message: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as error:
        maker(tmp_path).job(ManifestRow(PLACE, cells))
    assert error.value.place == PLACE
    assert message in error.value.message


@pytest.mark.parametrize(
    "name", ["../a", "a/../../b", "/a", "a//b", "a/", "./a", "C:a", "a\\b", "a\nb", "a\0", "..", "ä" * 101]
)
def test_an_id_stays_in_the_folder_of_the_outputs(name: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="id "):
        maker(tmp_path).job(ManifestRow(PLACE, {"id": name, "text": "Hi"}))


@given(st.text(max_size=30))
def test_a_part_of_a_name_stays_below_or_is_refused(value: str) -> None:
    try:
        part = checked_part("id", value)
    except InputError:
        return
    path = Path("/out") / f"{part}.mp4"
    assert path.resolve().is_relative_to("/out")
    assert path == path.resolve()


@pytest.mark.parametrize("text", ["out/x.mp4", "out/{}.mp4", "out/{id.mp4", "{id}.xyz", "{id}"])
def test_a_pattern_names_a_column_and_a_format(text: str) -> None:
    with pytest.raises(OutputError):
        OutputPattern(text)


@pytest.mark.parametrize(
    ("text", "folder"),
    [
        ("{id}.wav", "."),
        ("a/{id}.wav", "a"),
        ("a/b-{id}.wav", "a"),
        ("a/{lang}/{id}.wav", "a"),
        ("/{id}.wav", "/"),
    ],
)
def test_the_fixed_folder_is_the_longest_that_all_outputs_share(text: str, folder: str) -> None:
    assert OutputPattern(text).fixed_folder == folder


def test_a_row_chooses_settings_by_name_or_option_and_leaves_the_rest(tmp_path: Path) -> None:
    settings = Settings(seed=3, fps=Fraction(25))
    made = JobMaker([OutputPattern("out/{language}/{id}.mp4")], tmp_path, settings, (Display("fear", 1.0),))
    cells = {
        "id": "a/b", "text": "Hallo", "language": "de", "emotion": "joy:.5; anger:.2@0-1", "still": "on",
        "without-contact": "on", "fps": "24000/1001", "shape": "nose_width:0.5;jaw_width:-1",
    }  # fmt: skip
    job = made.job(ManifestRow(PLACE, cells))
    assert job.outputs == ("out/de/a/b.mp4",)
    assert [(d.emotion, d.intensity) for d in job.emotions] == [("happiness", 0.5), ("anger", 0.2)]
    assert (job.settings.seed, job.settings.fps) == (3, Fraction(24000, 1001))
    assert (job.settings.lively, job.settings.blend.contact) == (False, False)
    assert job.settings.shape == {"nose_width": 0.5, "jaw_width": -1.0}
    assert (
        made.job(ManifestRow(PLACE, {"id": "c", "text": "Hi", "language": "en-us"})).emotions == made.emotions
    )


def test_every_option_may_be_a_column_by_its_name_and_that_of_its_setting(tmp_path: Path) -> None:
    for name, row in rows(Settings).items():
        for column in (name, row.flag.lstrip("-")) if row.flag else ():
            with pytest.raises(RisoriusError) as error:
                maker(tmp_path).job(ManifestRow(PLACE, {"id": "a", column: "?"}))
            assert "unknown column" not in error.value.message


def test_a_column_for_others_is_ignored_by_name(tmp_path: Path) -> None:
    made = JobMaker([OutputPattern("{id}.wav")], tmp_path, ignore=("seed", "notes"))
    job = made.job(ManifestRow(PLACE, {"id": "a", "text": "Hi", "seed": "x", "notes": "loud"}))
    assert job.settings == Settings()


def test_scripts_are_checked_beforehand(tmp_path: Path) -> None:
    (tmp_path / "x.xml").write_text("<PHONEME time='0' text='Hi'/>\n<SIGNL/>")
    job = maker(tmp_path).job(ManifestRow(PLACE, {"id": "a", "script": "x.xml"}))
    with pytest.raises(InputError, match=r"m\.csv:2: .*x\.xml:2.*SIGNL"):
        check_job(job)


def test_names_that_are_not_utf_8_are_refused_before_anything_is_performed(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="is not UTF-8"):
        OutputPattern("out\udcff/{id}.wav")
    with pytest.raises(InputError, match="is not named in UTF-8"):
        Manifest(tmp_path / "\udcff.csv")


RULES = """
[[entry]]
id = "emotions.smirk"
values = { targets = { "AU12.left" = 0.7 } }
source = "This speaker"
"""
SMIRK = '<PHONEME time="0" text="Ha." /><EMOTIONDISPLAY time="0" duration="1" smirk="0.5" />'


def test_emotions_of_a_user_s_rules_may_be_in_any_column(tmp_path: Path) -> None:
    mine = tmp_path / "mine.toml"
    mine.write_text(RULES)
    (tmp_path / "x.xml").write_text(SMIRK)
    cells = {"id": "a", "text": "Ha.", "emotion": "smirk:0.9"}
    job = maker(tmp_path).job(ManifestRow(PLACE, {**cells, "rules": str(mine)}))
    assert job.emotions == (Display("smirk", 0.9),)
    check_job(job)
    check_job(maker(tmp_path).job(ManifestRow(PLACE, {"id": "b", "script": "x.xml", "rules": str(mine)})))
    with pytest.raises(ParameterError, match="unknown emotion 'smirk'"):
        maker(tmp_path).job(ManifestRow(PLACE, cells))


def test_all_lines_may_feel_an_emotion_of_a_user_s_rules(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("mine.toml").write_text(RULES)
    settings = Settings(rules=Path("mine.toml"), lively=False)
    rows = [{"id": "a", "text": "Ha."}]
    (made,) = risorius.batch(rows, "{id}.muscles.csv", emotion="smirk:1", settings=settings, jobs=0)
    assert made.error == ""
    speak = risorius.speak("Ha.", emotion="smirk:1", settings=settings)
    speak.write("b.muscles.csv")
    assert Path("a.muscles.csv").read_bytes() == Path("b.muscles.csv").read_bytes()
