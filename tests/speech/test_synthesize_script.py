from dataclasses import replace

import numpy as np
import pytest

from risorius.core.speech.utterance import Utterance
from risorius.errors import InputError, SpeechError
from risorius.script import read_script
from risorius.script.anchor import Anchor, Base, parse_anchor
from risorius.script.markup import parse_markup
from risorius.speech import synthesize_script
from risorius.speech.affect import Feeling
from risorius.speech.engines.protocol import Rendition, SpeechEngine, SpeechRequest
from risorius.speech.engines.registry import load_engine


def test_a_line_may_not_start_before_the_one_before_it_ends() -> None:
    script = parse_markup(
        '<PHONEME time="0" text="Hello there." />\n<PHONEME time="0.3" text="You." />', "x.xml"
    )
    with pytest.raises(InputError, match=r"x\.xml:2:.*which ends at 0\.\d+ s"):
        synthesize_script(script)


def test_what_cannot_be_spoken_is_reported_with_its_place() -> None:
    with pytest.raises(InputError, match=r"x\.xml:2:"):
        synthesize_script(parse_markup('<PHONEME text="Hello." />\n<PHONEME text="…" />', "x.xml"))


def test_plain_text_has_lead_and_tail_and_markup_has_neither() -> None:
    plain = synthesize_script(read_script("Hello there.", text=True), lead=0.5, tail=0.7)
    timed = synthesize_script(
        parse_markup('<PHONEME time="0" text="Hello there." />', "x.xml"), lead=0.5, tail=0.7
    )
    assert plain.duration - timed.duration == pytest.approx(1.2, abs=1e-4)
    # In a lead the first consonant may close before its sound.
    assert plain.words[0].start - timed.words[0].start == pytest.approx(0.5, abs=0.05)


def test_lines_stand_at_their_times_in_one_utterance() -> None:
    script = parse_markup(
        '<PHONEME time="0.5" text="Hello there." />\n<PHONEME time="3" text="It is me." />', "x.xml"
    )
    said = synthesize_script(script)
    alone = synthesize_script(parse_markup('<PHONEME time="0" text="It is me." />', "x.xml"))
    assert [w.text for w in said.words] == ["Hello", "there", "It", "is", "me"]
    assert all(said.text[w.source_start : w.source_end] == w.text for w in said.words)
    assert said.words[2].start == pytest.approx(3.0 + alone.words[0].start, abs=1e-4)
    assert [(p.first_word, p.last_word, p.sentence) for p in said.phrases] == [(0, 2, 0), (2, 5, 1)]
    assert all(p.start == said.words[p.first_word].start for p in said.phrases)
    assert said.duration == pytest.approx(3.0 + alone.duration, abs=1e-4)
    for word in said.words:
        assert all(said.phones[i].word >= 0 for i in range(word.first_phone, word.last_phone))
    for syllable in said.syllables:
        assert said.phones[syllable.first_phone].start == pytest.approx(syllable.start, abs=1e-4)
    gaps = [p for p in said.phones if not p.symbol]
    assert gaps[0].start == 0.0
    assert gaps[0].end == pytest.approx(0.5, abs=1e-4)


def test_a_line_without_a_time_follows_the_one_before() -> None:
    said = synthesize_script(parse_markup('<PHONEME text="One." /><PHONEME text="Two." />', "x.xml"))
    assert [w.text for w in said.words] == ["One", "Two"]
    assert said.words[1].start > said.words[0].end + 0.2


def test_the_language_of_a_script_chooses_the_voice() -> None:
    script = parse_markup('<SCRIPT language="de"><PHONEME text="Guten Tag." /></SCRIPT>', "x.xml")
    assert synthesize_script(script).language.startswith("de")
    assert synthesize_script(script, voice="en-us").language.startswith("en")
    assert synthesize_script(script, language="nl").language == "nl"


def test_a_voice_and_another_language_do_not_go_together() -> None:
    with pytest.raises(SpeechError, match="voice 'en-gb' speaks 'en-gb', not 'de'"):
        synthesize_script(read_script("Hello.", text=True), voice="en-gb", language="de")


@pytest.mark.parametrize("voice", ["en-us", "en-us+f3", "en-us+Storm"])
def test_syllables_of_a_spoken_text_know_how_high_they_are_in_their_voice(voice: str) -> None:
    said = synthesize_script(read_script("I like it very much, but do you?", text=True), voice=voice)
    heights = np.array([s.pitch for s in said.syllables])
    assert abs(heights.mean()) < 0.6
    assert heights.std() == pytest.approx(1.0, abs=0.2)
    assert heights[:2].argmax() == heights.argmax() == 1


def same(one: Utterance, two: Utterance) -> bool:
    """Whether two utterances say the same with the same sound."""
    sounds = (np.concatenate(list(said.audio.blocks())) for said in (one, two))
    return replace(one, audio=two.audio) == two and np.array_equal(*sounds)


SENTENCES = ["The first is plain.", "The second is sad.", "The third is plain."]


@pytest.fixture
def requests(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What the engine is asked to speak from now on."""
    engine, asked = load_engine(), []
    speak = type(engine).synthesize

    def counted(self: SpeechEngine, request: SpeechRequest) -> Rendition:
        asked.append(request.text.strip())
        return speak(self, request)

    monkeypatch.setattr(type(engine), "synthesize", counted)
    return asked


def test_an_emotion_over_words_is_spoken_once_with_the_same_sound(requests: list[str]) -> None:
    script = read_script(" ".join(SENTENCES), text=True)
    sad = Feeling({"sadness": 0.9}, parse_anchor("start", "word:5"), parse_anchor("end", "word:6.end"))
    said = synthesize_script(script, felt=[sad])
    assert requests == SENTENCES
    plain = synthesize_script(script)
    first, last = plain.words[4].start, plain.words[5].end
    timed = replace(sad, start=Anchor(Base.START, first), end=Anchor(Base.START, last))
    assert same(synthesize_script(script, felt=[timed]), said)
    assert said.words[7].end != pytest.approx(plain.words[7].end, abs=1e-3)


def test_an_emotion_between_two_times_speaks_only_what_it_colours_twice(requests: list[str]) -> None:
    script = read_script(" ".join(SENTENCES), text=True)
    sad = Feeling({"sadness": 0.9}, parse_anchor("start", "2.2"), parse_anchor("end", "3"))
    synthesize_script(script, felt=[sad])
    assert requests == [*SENTENCES, SENTENCES[1]]


def test_words_without_a_sound_do_not_count_where_an_emotion_is_placed() -> None:
    script = read_script("One ៛ two three.", text=True)
    sad = Feeling({"sadness": 1.0}, parse_anchor("start", "word:3"))
    plain = synthesize_script(script)
    timed = replace(sad, start=Anchor(Base.START, plain.words[2].start))
    assert same(synthesize_script(script, felt=[sad]), synthesize_script(script, felt=[timed]))


REPEATED = ["I bought a house.", "The house is big", "Do you like it"]


def test_neither_sentences_nor_what_is_given_go_on_from_line_to_line() -> None:
    said = synthesize_script(
        parse_markup("".join(f'<PHONEME text="{line}" />' for line in REPEATED), "x.xml")
    )
    alone = [synthesize_script(parse_markup(f'<PHONEME text="{line}" />', "x.xml")) for line in REPEATED]
    assert [p.ending for p in said.phrases] == [p.ending for one in alone for p in one.phrases]
    assert [p.sentence for p in said.phrases] == [0, 1, 2]
    assert [(said.words[a.word].text, a.label) for a in said.accents] == [
        (one.words[a.word].text, a.label) for one in alone for a in one.accents
    ]


def test_a_line_more_changes_nothing_before_it() -> None:
    texts = [f'<PHONEME text="{line}" />' for line in (*REPEATED, "A house?")]
    more = synthesize_script(parse_markup("".join(texts), "x.xml"))
    said = synthesize_script(parse_markup("".join(texts[:-1]), "x.xml"))
    for name in ("phones", "words", "syllables", "pauses", "accents", "boundaries", "phrases"):
        own = getattr(said, name)
        assert getattr(more, name)[: len(own)] == own, name
