"""Documents in FML-APML: functions refer to marks of time in the speech."""

from __future__ import annotations

import warnings

import pytest

from risorius.core.directions import Emphasis
from risorius.errors import RisoriusError
from risorius.rules.rule import InformationPart
from risorius.script import MarkKind, Script
from risorius.script.apml import parse_apml
from risorius.script.tree import ScriptWarning
from risorius.speech import synthesize_script


def document(functions: str = "", tones: str = "", speech: str = 'id="s1" language="english"') -> str:
    return (
        f"<fml-apml><bml><speech {speech}><tm id='a'/>We<tm id='b'/> sailed north <tm id='c'/>in March"
        f"<tm id='d'/>{tones}</speech></bml><fml>{functions}</fml></fml-apml>"
    )


BAD = [
    ("<fml-apml/>", "x.apml:1: the script has no behaviour"),
    ("<fml-apml>a</fml-apml>", "x.apml:1:11: 'a' stands in <fml-apml>"),
    ("<fml-apml><bml><speech id='s'/></bml></fml-apml>", "x.apml:1:16: the text is empty"),
    (
        "<fml-apml><bml><speech id='s'><tm id='a'/>a<tm id='a'/></speech></bml></fml-apml>",
        "x.apml:1:44: sync point 'a' is set twice",
    ),
    ("<fml-apml><bml><speech id='s'><tm/>a</speech></bml></fml-apml>", "x.apml:1:31: <tm>: id is missing"),
    (
        document("<emotion id='e' type='joi' start='s1:a' end='s1:b'/>"),
        "unknown affect 'joi'; did you mean 'joy'?",
    ),
    (document("<emotion id='e' start='s1:a' end='s1:b'/>"), "<emotion>: type is missing"),
    (
        document("<emotion id='e' type='joy' regulation='hidden'/>"),
        "unknown regulation 'hidden'; expected one of",
    ),
    (
        document("<emotion id='e' type='joy' start='s1:x'/>"),
        "unknown sync point of 's1' 'x'; expected one of",
    ),
    (document("<emotion id='e' type='joy' start='s2:a'/>"), "unknown behaviour 's2'; expected one of e, s1"),
    (
        document("<emotion id='e' type='joy' start='e:end' end='e:start'/>"),
        "a cycle of sync references: e:start",
    ),
    (document("<emotion id='e' type='joy' start='s1:b' end='s1:b'/>"), "'e' ends at its start"),
    (document("<emotion id='e' type='joy' start='soon'/>"), "start = 'soon' is not a sync reference"),
    (document("<theme id='s1' start='s1:a' end='s1:b'/>"), "id 's1' is given twice"),
    (document(tones="<boundary id='q' type='LK' start='s1:d'/>"), "unknown boundary 'LK'; did you mean"),
    (document(tones="<pitchaccent id='q' start='s1:a' end='s1:b'/>"), "<pitchaccent>: type is missing"),
    (document("<turntaking id='q' type='loose' start='s1:a' end='s1:b'/>"), "unknown type 'loose'"),
]
REPORTED = [
    (
        document("<perfomative id='p' type='greet'/>"),
        "<perfomative> is not understood; did you mean <performative>?",
    ),
    (document("<world id='w' ref_type='x'/>"), "<world> is not understood; it is left out"),
    (
        document("<performative id='p' type='hum' start='s1:a'/>"),
        "unknown performative 'hum'; expected one of",
    ),
    (document("<boundary id='q' type='LL' start='s1:a+0.5'/>"), "<boundary> that is not at a mark of time"),
    (
        document("<pitchaccent id='q' type='Hstar' start='s1:d' end='s1:d+1'/>"),
        "<pitchaccent> that has no words",
    ),
    (
        document("<emotion id='e' type='joy' regulation='fake'/>"),
        "regulation 'fake' is not understood; the emotion",
    ),
    (document(speech="id='s1' pitch='3'"), "pitch of <speech> is not understood"),
]
WHOLE = document(
    "<performative id='p' type='greet' start='s1:a' end='s1:b' importance='1.0'/>"
    "<emotion id='e' type='sadness' intensity='0.5' start='s1:b' end='s1:c' regulation='felt'/>"
    "<emphasis id='f' level='high' start='s1:b' end='s1:c'/>"
    "<turntaking id='g' type='givethefloor' start='s1:c' end='s1:d'/>"
    "<theme id='t' start='s1:a' end='s1:c'/><rheme id='r' start='s1:c' end='s1:d'/>",
    "<pitchaccent id='x' type='LPlusHStar' start='s1:c' end='s1:d'/>"
    "<boundary id='y' type='LH' start='s1:c' end='s1:c+0.7'/><boundary id='z' type='LL' start='s1:d'/>",
)


@pytest.mark.parametrize(("text", "message"), BAD, ids=[row[1][:40] for row in BAD])
def test_faults_have_their_place(text: str, message: str) -> None:
    with pytest.raises(RisoriusError) as caught:
        parse_apml(text, "x.apml")
    assert message in str(caught.value)
    assert str(caught.value).startswith("x.apml:1")


@pytest.mark.parametrize(("text", "message"), REPORTED, ids=[row[1][:40] for row in REPORTED])
def test_what_is_not_understood_is_reported_with_its_place(text: str, message: str) -> None:
    with pytest.warns(ScriptWarning) as caught:
        script = parse_apml(text, "x.apml")
    assert any(message in str(w.message) and str(w.message).startswith("x.apml:1:") for w in caught)
    assert script.text.startswith("We sailed north in March")


@pytest.fixture(scope="module")
def script() -> Script:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return parse_apml(WHOLE, "x.apml")


def test_words_tones_and_pauses(script: Script) -> None:
    assert (script.text, script.language) == ("We sailed north, in March.", "en")
    said = synthesize_script(script)
    accents = {said.words[a.word].text: a.label for a in said.accents}
    assert accents["March"] == "L+H*"
    boundaries = {said.words[b.word].text: b.label for b in said.boundaries}
    assert boundaries == {"north": "L-H%", "March": "L-L%"}
    assert said.words[3].start - said.words[2].end == pytest.approx(0.7, abs=0.05)


def test_functions_last_from_mark_to_mark(script: Script) -> None:
    words = synthesize_script(script).words
    spans = {
        mark.label: (mark.start.resolve(words, 9.0), mark.end.resolve(words, 9.0))
        for mark in script.marks
        if mark.kind is not MarkKind.HEAD
    }
    assert spans["performative greet"] == (words[0].start, words[1].start)
    assert spans["emotion: sadness 0.5"] == (words[1].start, words[3].start)
    assert spans["turn give"][1] == words[-1].end
    (line,) = script.lines
    emphasised = [line.text[s.start : s.end] for s in line.directions.spans if s.emphasis is Emphasis.STRONG]
    assert emphasised == ["sailed north"]
    assert [part.part for part in script.information] == [InformationPart.THEME, InformationPart.RHEME]


def test_two_speeches_and_behaviours_of_bml_are_performed() -> None:
    text = (
        "<fml-apml><bml><speech id='s1' start='0.5'><tm id='a'/>Hello.<tm id='b'/></speech>"
        "<speech id='s2' start='s1:end+0.4' language='french'>Salut.<tm id='c'/></speech>"
        "<head id='h' lexeme='NOD' start='s2:start'/></bml>"
        "<fml><emotion id='e' type='joy' start='s1:b' end='s2:c'/></fml></fml-apml>"
    )
    script = parse_apml(text)
    assert [line.text for line in script.lines] == ["Hello.", "Salut."]
    assert [s.language for s in script.lines[1].directions.spans] == ["fr"]
    said = synthesize_script(script)
    assert said.words[0].start == pytest.approx(0.5, abs=0.05)
    nod = next(mark for mark in script.marks if mark.kind is MarkKind.HEAD)
    assert nod.start.resolve(said.words, 9.0) == said.words[1].start


def test_a_speech_without_words_inside_has_those_of_its_text() -> None:
    script = parse_apml("<fml-apml><bml><speech id='s' text='Come in.'/></bml></fml-apml>")
    assert script.text == "Come in."
