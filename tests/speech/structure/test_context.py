"""Accents in context: what is given loses them, what is new, contrasted or asked for has them."""

from __future__ import annotations

from pathlib import Path

import pytest

import risorius
from risorius.core.directions import Directions
from risorius.errors import InputError, SpeechWarning
from risorius.languages import language_of
from risorius.script import parse_script
from risorius.speech import synthesize_script
from risorius.speech.synthesis import synthesize_line


def toned(text: str, question: str = "", language: str = "en-us") -> str:
    """Return the words of a text with their accents and boundaries, the nuclei in capitals."""
    said = synthesize_line(text, language=language, directions=Directions(answers=question))
    accents, ends = {a.word: a for a in said.accents}, {b.word: b.label for b in said.boundaries}
    words = []
    for index, word in enumerate(said.words):
        accent = accents.get(index)
        shown = word.text.lower() if accent is None else f"{word.text}:{accent.label}"
        words.append(f"{shown} {ends.get(index, '')}".strip())
    return " ".join(words)


def test_paper_b_s_answer_has_the_tones_that_it_prints() -> None:
    # Section 2.2.1: (JUlia prefers) (POPcorn), (L+H* LH%) (H* LL%).
    question = "Well, what about JUlia? What does SHE prefer?"
    assert toned("Julia prefers popcorn.", question) == "Julia:L+H* prefers L-H% popcorn:H* L-L%"


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("", "Julia:H* prefers:H* popcorn:H* L-L%"),
        ("What does Julia prefer?", "julia prefers popcorn:H* L-L%"),
        ("Who preferred popcorn?", "Julia:H* prefers popcorn L-L%"),
        ("Does Julia hate popcorn?", "julia prefers:H* popcorn L-L%"),
        ("Does she prefer popcorn or crisps?", "Julia:H* prefers popcorn:L+H* L-L%"),
    ],
)
def test_accents_answer_the_question(question: str, expected: str) -> None:
    assert toned("Julia prefers popcorn.", question) == expected


@pytest.mark.parametrize(
    ("text", "question", "expected"),
    [
        ("I did it.", "Who did it?", "I:L+H* did it L-L%"),
        ("It's me.", "Who is there?", "it's me:L+H* L-L%"),
        ("It was here.", "Where was it?", "it was here:H* L-L%"),
    ],
)
def test_a_function_word_answers_where_nothing_else_does(text: str, question: str, expected: str) -> None:
    assert toned(text, question) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("She has a red car and a blue car.", "she has a red:H* car:H* and a blue:H* car L-L%"),
        (
            "Marta wrote letters. She wrote books.",
            "Marta:H* wrote:H* letters:H* L-L% she wrote books:H* L-L%",
        ),
        # Figures of speech, and sentences of which nothing would be left, keep their accents.
        ("They go hand in hand.", "they go hand:H* in hand:H* L-L%"),
        ("We talked. We talked.", "we talked:H* L-L% we talked:H* L-L%"),
    ],
)
def test_words_given_before_lose_their_accent(text: str, expected: str) -> None:
    assert toned(text) == expected


def test_a_word_is_given_for_three_sentences() -> None:
    between = "We ate fish. " * 4
    assert (
        "harbour:H*" in toned(f"I saw the harbour. {between} Then I saw the harbour again.").split("fish")[-1]
    )
    assert (
        "harbour:H*"
        not in toned("I saw the harbour. We ate fish. Then I left the harbour.").split("fish")[-1]
    )


@pytest.mark.parametrize(
    ("text", "contrasted"),
    [
        ("I want tea, not coffee.", {"tea", "coffee"}),
        ("It is not red but blue.", {"red", "blue"}),
        ("I do not like it.", set()),
        ("It is not easy but we try.", set()),
    ],
)
def test_contrasts_in_so_many_words_are_accented_as_such(text: str, contrasted: set[str]) -> None:
    said = synthesize_line(text)
    assert {said.words[a.word].text for a in said.accents if a.label == "L+H*"} == contrasted


def test_german_compares_its_own_forms() -> None:
    shown = toned("Maria mag Popcorn.", "Was ist mit Maria? Was mag sie?", "de")
    assert shown == "Maria:L+H* L-H% mag Popcorn:H* L-L%"
    assert toned("Peter hat einen Hund. Der Hund ist alt.", language="de").endswith(
        "der hund ist alt:H* L-L%"
    )


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("prefers", "preferred"),
        ("carry", "carries"),
        ("make", "making"),
        ("glass", "glasses"),
        ("bus", "buses"),
    ],
)
def test_forms_of_a_word_have_one_stem(one: str, other: str) -> None:
    english = language_of("en")
    assert english.stem(one) == english.stem(other)


def test_the_voice_raises_what_is_new() -> None:
    def pitch(question: str) -> list[float]:
        said = synthesize_script(parse_script("Julia prefers popcorn.", ".txt"), answers=question)
        heights = [(s.word, s.pitch) for s in said.syllables]
        return [max(p for w, p in heights if w == word) for word in range(3)]

    julia, _, popcorn = pitch("Who prefers popcorn?")
    other_julia, _, other_popcorn = pitch("What does Julia prefer?")
    assert julia > other_julia
    assert popcorn < other_popcorn


def test_an_utterance_file_names_the_question() -> None:
    head = "answers: What does Julia prefer?\ntext: Julia prefers popcorn\n"
    script = parse_script(head, ".utt")
    assert script.lines[0].directions.answers == "What does Julia prefer?"
    said = synthesize_script(script)
    assert [said.words[a.word].text for a in said.accents] == ["popcorn"]


def test_with_a_recording_the_question_of_a_file_is_not_read(tmp_path: Path) -> None:
    file, sound = tmp_path / "julia.utt", tmp_path / "julia.wav"
    file.write_text("answers: Who prefers popcorn?\ntext: Julia prefers popcorn\n")
    risorius.speak(file).write(sound)
    with pytest.warns(SpeechWarning, match="answers is not read with a recording"):
        risorius.speak(file, audio=sound)


def test_what_is_no_question_is_refused() -> None:
    with pytest.raises(InputError, match="has no words"):
        synthesize_script(parse_script("Julia.", ".txt"), answers="?!")
    with pytest.raises(InputError, match="separates words by spaces; 'cmn' does not"):
        synthesize_line("我喜欢茶。", language="cmn", directions=Directions(answers="你喜欢什么?"))
