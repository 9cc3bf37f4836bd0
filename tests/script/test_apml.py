"""Documents in APML: what is refused, what is reported, and what the voice and the face do."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest

import risorius
from risorius.core.action_units import resolve_targets
from risorius.core.directions import Emphasis
from risorius.core.speech.utterance import Utterance
from risorius.errors import RisoriusError
from risorius.rules.apml import apml_table
from risorius.rules.emotions import emotion
from risorius.rules.rule import InformationPart
from risorius.script import Script, read_script
from risorius.script.apml import parse_apml
from risorius.script.tree import ScriptWarning
from risorius.speech import synthesize_script

BAD = [
    ("", "x.apml:1: there is no element; expected <apml>"),
    ("<apml/>", "x.apml:1:1: the text is empty"),
    ("<apml> … </apml>", "x.apml:1:1: nothing can be spoken"),
    ("<speak>a</speak>", "x.apml:1:1: <speak> stands outside; expected one <apml>"),
    ("<apml>a</apml><apml>b</apml>", "x.apml:1:15: <apml> stands outside"),
    ("<apml>\n <theme>Hello</apml>", "x.apml:2:2: theme is not closed"),
    ("<apml>a & b</apml>", "x.apml:1:10: a bare '&'; expected &amp;"),
    ('<!DOCTYPE apml [<!ENTITY a "b">]><apml>&a;</apml>', "x.apml:1:1: document types and entity"),
    ("<apml>a <boundary/></apml>", "x.apml:1:9: <boundary>: type is missing"),
    ('<apml>a <boundary type="LK"/></apml>', "x.apml:1:19: unknown boundary 'LK'; did you mean 'L"),
    ('<apml><boundary type="LL"/>a</apml>', "x.apml:1:7: <boundary> stands before all words"),
    (
        '<apml><emphasis x-pitchaccent="Hstarr">a</emphasis></apml>',
        "x.apml:1:17: unknown pitch accent 'Hstarr'; did you mean 'Hstar'?",
    ),
    ('<apml><emphasis level="very">a</emphasis></apml>', "x.apml:1:17: unknown level 'very'"),
    ('<apml>a <pause sec="long"/></apml>', "x.apml:1:16: sec = 'long' is not a number"),
    ('<apml>a <pause sec="61"/></apml>', "x.apml:1:16: sec = '61' is out of range"),
    ("<apml>a <pause/></apml>", "x.apml:1:9: <pause>: sec is missing"),
    ('<apml><theme affect="joi">a</theme></apml>', "x.apml:1:14: unknown affect 'joi'; did you mean 'joy'?"),
    ('<apml><theme affect="joi"/>a</apml>', "x.apml:1:14: unknown affect 'joi'"),
    (
        '<apml><theme affect="joy" intensity="2">a</theme></apml>',
        "x.apml:1:27: intensity = '2' is out of range",
    ),
    ('<apml><turn-allocation type="tak">a</turn-allocation></apml>', "x.apml:1:24: unknown type 'tak'"),
    ("<apml><turn-allocation>a</turn-allocation></apml>", "x.apml:1:7: <turn-allocation>: type is missing"),
]
REPORTED = [
    (
        "<emphasys>b</emphasys>",
        "x.apml:1:9: <emphasys> is not understood; did you mean <emphasis>? its words",
    ),
    ("<audio>b</audio>", "x.apml:1:9: <audio> is not understood; its words are spoken plainly"),
    ('<performative type="sugest">b</performative>', "x.apml:1:23: unknown performative 'sugest'; did you"),
    ("<performative>b</performative>", "<performative> without type is not understood; nothing is shown"),
    ('<certainty type="maybe">b</certainty>', "x.apml:1:20: unknown certainty 'maybe'; expected one of"),
    ('<rheme focus="x">b</rheme>', "x.apml:1:16: focus of <rheme> is not understood"),
]
DOCUMENT = """<?xml version="1.0"?>
<!DOCTYPE apml SYSTEM "apml.dtd" []>
<apml xml:lang="en">
<turn-allocation type="take">
<performative type="greet">Welcome, dear Nina.</performative>
<performative type="inform">
<theme>The ship to <emphasis x-pitchaccent="LplusHstar">Genoa</emphasis> <boundary type="LH"/></theme>
<rheme affect="sorry-for">left an <emphasis x-pitchaccent="Hstar">hour</emphasis> ago<boundary type="LL"/>
</rheme></performative></turn-allocation></apml>"""


@pytest.mark.parametrize(("text", "message"), BAD, ids=[row[0][:40] for row in BAD])
def test_faults_have_their_place(text: str, message: str) -> None:
    with pytest.raises(RisoriusError) as caught:
        parse_apml(text, "x.apml")
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize(("inside", "message"), REPORTED, ids=[row[0] for row in REPORTED])
def test_what_is_not_understood_is_reported_once_and_spoken(inside: str, message: str) -> None:
    with pytest.warns(ScriptWarning) as caught:
        script = parse_apml(f"<apml>a {inside} {inside.replace('b', 'c')}.</apml>", "x.apml")
    assert [message in str(w.message) for w in caught].count(True) == 1
    assert script.text.replace(".", "").split() == ["a", "b", "c"]
    assert not script.marks


@pytest.fixture(scope="module")
def script() -> Script:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return parse_apml(DOCUMENT, "x.apml")


@pytest.fixture(scope="module")
def said(script: Script) -> Utterance:
    return synthesize_script(script)


def test_the_words_are_those_of_the_document(script: Script) -> None:
    assert script.text == "Welcome, dear Nina. The ship to Genoa, left an hour ago."
    assert script.language == "en"


def test_tones_reach_the_utterance(said: Utterance) -> None:
    accents = [(said.words[a.word].text, a.label) for a in said.accents]
    assert accents[-2:] == [("Genoa", "L+H*"), ("hour", "H*")]
    boundaries = {said.words[b.word].text: b.label for b in said.boundaries}
    assert boundaries["Genoa"] == "L-H%"
    assert boundaries["ago"] == "L-L%"


@pytest.mark.parametrize(("written", "label"), apml_table().boundary.items())
def test_every_boundary_has_its_label(written: str, label: str) -> None:
    script = parse_apml(f'<apml>The red boat<boundary type="{written}"/> sank</apml>')
    said = synthesize_script(script)
    assert [b.label for b in said.boundaries if said.words[b.word].text == "boat"] == [label]


@pytest.mark.parametrize(("written", "label"), apml_table().accent.items())
def test_every_accent_has_its_label(written: str, label: str) -> None:
    script = parse_apml(f'<apml>The <emphasis x-pitchaccent="{written}">red</emphasis> boat sank.</apml>')
    said = synthesize_script(script)
    assert [(said.words[a.word].text, a.label) for a in said.accents] == [("red", label)]


def test_tones_may_be_written_as_tobi_has_them() -> None:
    script = parse_apml(
        '<apml>A <emphasis x-pitchaccent="l+h*">red</emphasis> hat<boundary type="LH%"/></apml>'
    )
    (line,) = script.lines
    assert [tone.label for tone in line.directions.accents] == ["L+H*"]
    assert [tone.label for tone in line.directions.boundaries] == ["L-H%"]


def test_each_content_word_of_an_emphasis_is_accented() -> None:
    script = parse_apml(
        '<apml><emphasis x-pitchaccent="Hstar">the salt and the pepper</emphasis> fell.</apml>'
    )
    (line,) = script.lines
    assert [line.text[tone.at :].split()[0] for tone in line.directions.accents] == ["salt", "pepper"]


def test_an_emphasis_without_a_tone_is_accented_beside_written_ones() -> None:
    text = (
        '<apml>A <emphasis x-pitchaccent="Hstar">red</emphasis> hat, a <emphasis>blue</emphasis> coat.</apml>'
    )
    (line,) = parse_apml(text).lines
    tones = {line.text[tone.at :].split()[0]: tone.label for tone in line.directions.accents}
    assert tones == {"red": "H*", "blue": "L+H*"}
    (alone,) = parse_apml("<apml>A <emphasis level='strong'>blue</emphasis> coat.</apml>").lines
    assert not alone.directions.accents
    assert [span.emphasis for span in alone.directions.spans] == [Emphasis.STRONG]


@pytest.mark.parametrize(
    ("inside", "text"),
    [
        ("A hat<boundary type='LH'/> a coat", "A hat, a coat"),
        ("A hat <boundary type='LL'/>! A coat", "A hat ! A coat"),
        ("A hat.<boundary type='LL'/>A coat", "A hat. A coat"),
        ("A hat<boundary type='L'/>a coat", "A hat a coat"),
        ("A hat<boundary type='HH'/>", "A hat?"),
        (
            "<performative type='inform'>A hat</performative> <certainty type='certain'>a coat</certainty>",
            "A hat. a coat",
        ),
        ("A <emphasis>h</emphasis>at", "A h at"),
    ],
)
def test_a_boundary_ends_as_it_sounds(inside: str, text: str) -> None:
    assert parse_apml(f"<apml>{inside}</apml>").text == text


def test_a_boundary_and_a_pause_are_heard() -> None:
    plain, bound, paused = (
        synthesize_script(parse_apml(f"<apml>The old boat{between} left the harbour.</apml>"))
        for between in ("", "<boundary type='LH'/>", "<boundary type='LH'/><pause sec='0.9'/>")
    )
    silences = [said.words[3].start - said.words[2].end for said in (plain, bound, paused)]
    assert silences[0] < 0.02
    assert silences[1] > 0.08
    assert silences[2] == pytest.approx(0.9, abs=0.05)


FPS = 50
BROWS = "frontalis_medialis.left"
FROWN, SMILE = "corrugator_supercilii.left", "zygomatic_major.left"
ACCENTED = (
    '<apml>We saw a <emphasis x-pitchaccent="LplusHstar">tall</emphasis> and narrow '
    '<emphasis x-pitchaccent="Hstar">tower</emphasis> there.</apml>'
)


def performed(text: str, tmp_path: Path, **settings: object) -> risorius.Take:
    path = tmp_path / "x.apml"
    path.write_text(text)
    return risorius.speak(path, settings=risorius.Settings(fps=FPS, **settings))  # type: ignore[arg-type]


def times_of(take: risorius.Take, word: str) -> tuple[int, int]:
    """Return the first and the last frame of a word."""
    assert take.utterance is not None
    found = next(w for w in take.utterance.words if w.text == word)
    return round(found.start * FPS), round(found.end * FPS)


def test_accents_get_brows_at_their_words_alone(tmp_path: Path) -> None:
    lifted = {"tall": 0, "tower": 0}
    for seed in range(6):
        take = performed(ACCENTED, tmp_path, seed=seed)
        raised = [m for m in take.score.movements if m.cause.rule.startswith("signals.brows")]
        assert {m.cause.trigger for m in raised} <= {'"tall"', '"tower"'}
        for word in lifted:
            first, last = times_of(take, word)
            lifted[word] += bool(take.curves[BROWS][first : last + 1].max() > 0.1)
    assert lifted["tall"] >= 3
    assert sum(lifted.values()) >= 6


def test_an_affect_moves_the_face_over_its_words(tmp_path: Path) -> None:
    take = performed(
        '<apml>We had fun in June and in July. <rheme affect="sadness">But now the house is empty and cold.'
        "</rheme> We will go back there when it is warm again.</apml>",
        tmp_path,
        lively=False,
    )
    curve = take.curves[FROWN]
    (first, _), (_, last) = times_of(take, "But"), times_of(take, "cold")
    inside = curve[first + FPS // 2 : last]
    assert inside.min() > 0.7 * emotion("sadness").targets(1.0)[FROWN]
    assert curve[: first - 1].max() < 0.02
    assert curve[last + FPS : last + 2 * FPS].max() < 0.02


@pytest.mark.parametrize(("level", "share"), [("0.3", 0.3), ("1", 1.0)])
def test_an_affect_has_its_intensity(level: str, share: float) -> None:
    script = parse_apml(f'<apml><theme affect="fear" intensity="{level}">The wolf is here.</theme></apml>')
    assert [dict(mark.emotions) for mark in script.marks] == [{"fear": share}]


def test_an_affect_of_another_name_is_shown_by_the_nearest_emotion() -> None:
    for name, affect in apml_table().affect.items():
        script = parse_apml(f'<apml><rheme affect="{name}" intensity="0.5">So it is.</rheme></apml>')
        assert [dict(m.emotions) for m in script.marks] == [{affect.emotion: 0.5 * affect.share}]


def test_affects_within_each_other_are_both_shown() -> None:
    text = '<performative type="inform" affect="joy"><theme affect="joy" intensity="0.2">So it is.</theme>'
    script = parse_apml(f"<apml>{text}</performative></apml>")
    assert sorted(m.emotions["happiness"] for m in script.marks) == [0.2, 1.0]


def test_neutral_and_none_are_shown_by_nothing() -> None:
    text = '<theme affect="neutral">So</theme> <rheme affect="joy" intensity="0">it is.</rheme>'
    assert not parse_apml(f"<apml>{text}</apml>").marks


def test_a_greeting_smiles_and_a_warning_frowns(tmp_path: Path) -> None:
    smiles, frowns = (
        performed(
            f'<apml><performative type="{kind}">Hello to all of you.</performative></apml>',
            tmp_path,
            lively=False,
        )
        for kind in ("greet", "warn")
    )
    first, last = times_of(smiles, "all")
    (cheek,) = set(resolve_targets({"AU6.left": 1.0}))
    assert smiles.curves[cheek][first:last].min() > 0.2
    assert smiles.curves[SMILE].max() > 0.2
    assert smiles.curves[FROWN].max() < 0.02
    assert frowns.curves[FROWN][first:last].min() > 0.1
    assert np.ptp(frowns.curves["head_pitch"]) > 3.0


def test_a_turn_is_taken_with_a_look_away_and_given_with_one_at_the_listener(tmp_path: Path) -> None:
    take, give = (
        performed(
            f'<apml><turn-allocation type="{kind}">The tea is hot now.</turn-allocation></apml>',
            tmp_path,
            lively=False,
        )
        for kind in ("take", "give")
    )
    first, _ = times_of(take, "tea")
    assert take.curves["gaze_yaw"][first] < -8.0
    _, last = times_of(give, "now")
    assert np.abs(give.curves["gaze_yaw"][last - 20 : last]).max() < 1.0
    assert give.curves["head_pitch"][last - 10] > 2.0


def test_theme_and_rheme_have_their_spans(script: Script) -> None:
    parts = [(p.part, script.text[p.start.character : p.end.character]) for p in script.information]
    assert parts == [
        (InformationPart.THEME, "The ship to Genoa"),
        (InformationPart.RHEME, "left an hour ago"),
    ]


def test_gaze_is_away_in_the_theme_and_toward_the_listener_in_the_rheme(tmp_path: Path) -> None:
    text = (
        '<apml>Listen to me now. <theme>The man who built this bridge<boundary type="LH"/></theme> '
        '<rheme>came from a village in the mountains<boundary type="LL"/></rheme></apml>'
    )
    away, toward = [], []
    for seed in range(12):
        take = performed(text, tmp_path, seed=seed)
        gaze = np.hypot(take.curves["gaze_yaw"], take.curves["gaze_pitch"])
        away.append(float(gaze[slice(times_of(take, "who")[0], times_of(take, "bridge")[0])].mean()))
        toward.append(float(gaze[slice(times_of(take, "from")[0], times_of(take, "mountains")[0])].mean()))
    assert np.mean([value > 5.0 for value in away]) >= 0.6
    assert np.mean([value < 5.0 for value in toward]) >= 0.6


def test_the_file_is_read_by_both_suffixes(tmp_path: Path, script: Script) -> None:
    for name in ("x.apml", "x.xml"):
        (tmp_path / name).write_text(DOCUMENT.replace("apml>", "APML>").replace("<apml ", "<APML "))
        read = read_script(str(tmp_path / name))
        assert (read.text, len(read.marks)) == (script.text, len(script.marks))


def test_the_place_is_right_below_a_document_type(tmp_path: Path) -> None:
    text = '<?xml version="1.0" encoding="ISO-8859-1"?>\n<!-- one -->\n<!DOCTYPE apml\n SYSTEM "apml.dtd">\n'
    with pytest.raises(RisoriusError, match=r"^x\.apml:5:14: unknown affect"):
        parse_apml(text + '<apml><theme affect="joi">a</theme></apml>', "x.apml")
    with pytest.raises(RisoriusError, match="encoding 'ISO-8859-1' cannot be read"):
        parse_apml(text + "<apml>é</apml>", "x.apml")
