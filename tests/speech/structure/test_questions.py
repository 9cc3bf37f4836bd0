"""Questions: told apart by the words of a sentence."""

from __future__ import annotations

import pytest

from risorius.core.utterance import Question
from risorius.languages import language_of
from risorius.speech.structure.questions import question_of

WH, YES_NO, OR, UNMARKED = Question.WH, Question.YES_NO, Question.ALTERNATIVE, Question.UNMARKED


@pytest.mark.parametrize(
    ("language", "text", "expected"),
    [
        ("en-us", "What is it", WH),
        ("en-us", "Well what about Julia", WH),
        ("en-gb", "In which house", WH),
        ("en-us", "Is it when you can", YES_NO),
        ("en-us", "Do you like it", YES_NO),
        ("en-us", "And are you there", YES_NO),
        ("en-us", "Aren’t you", YES_NO),
        ("en-us", "Is it tea or coffee", OR),
        ("en-us", "Tea or coffee", OR),
        ("en-us", "You like it", UNMARKED),
        ("en-us", "You are there", UNMARKED),
        ("en-us", "I can", UNMARKED),
        ("en-us", "Peter is here", UNMARKED),
        ("en-us", "Peter is a doctor", UNMARKED),
        ("en-us", "Mr. Smith can swim", UNMARKED),
        ("en-us", "Peter are you here", YES_NO),
        ("en-us", "Tea or coffee or milk", OR),
        ("en-us", "And can he", YES_NO),
        ("en-us", "So are you there", YES_NO),
        ("en-us", "But in which house", WH),
        ("en-us", "Bob are you there", YES_NO),
        ("en-us", "Or", UNMARKED),
        ("en-us", "What's that", WH),
        ("en-us", "Is what he says true", YES_NO),
        ("de", "Was machst du", WH),
        ("de", "Und mit wem", WH),
        ("de", "Um wie viel Uhr kommst du", WH),
        ("de", "Kommst du", YES_NO),
        ("de", "Ist Peter da", YES_NO),
        ("de", "Weißt du was er will", YES_NO),
        ("de", "Trinkst du Tee oder Kaffee", OR),
        ("de", "Du kommst", UNMARKED),
        ("de", "Mit der Bahn", UNMARKED),
        ("es", "Cómo estás", WH),
        ("es", "De dónde eres", WH),
        ("es", "Por qué no vienes", WH),
        ("es", "Has visto a Juan", YES_NO),
        ("es", "Juan viene", YES_NO),
        ("es", "Sabes qué es", YES_NO),
        ("es", "Quieres té o café", OR),
        ("fr", "Où vas-tu", WH),
        ("fr", "Avec qui viens-tu", WH),
        ("fr", "Qu’est-ce que tu fais", WH),
        ("fr", "D’où viens-tu", WH),
        ("fr", "Tu vas où", WH),
        ("fr", "Est-ce que tu viens", YES_NO),
        ("fr", "Penses-tu qu’il vienne", YES_NO),
        ("fr", "Jean vient-il", YES_NO),
        ("fr", "Veux-tu du thé ou du café", OR),
        ("fr", "Tu viens", UNMARKED),
        ("it", "Come stai", WH),
        ("it", "Dov’è Maria", WH),
        ("it", "Di chi è", WH),
        ("it", "Hai visto Juan", YES_NO),
        ("it", "Sai che viene", YES_NO),
        ("it", "Vuoi tè o caffè", OR),
        ("nl", "Wat doe je", WH),
        ("nl", "Met wie ga je", WH),
        ("nl", "Kom je morgen", YES_NO),
        ("nl", "Werkt hij nog", YES_NO),
        ("nl", "Wil je thee of koffie", OR),
        ("nl", "Je komt", UNMARKED),
        ("pt", "Como estás", WH),
        ("pt-br", "Você mora onde", WH),
        ("pt", "O que fazes", WH),
        ("pt", "Viste o João", YES_NO),
        ("pt", "Acha que ele vem", YES_NO),
        ("pt", "Queres chá ou café", OR),
        ("pl", "Co robisz", YES_NO),
        ("pl", "", YES_NO),
    ],
)
def test_kinds(language: str, text: str, expected: Question) -> None:
    assert question_of(text.split(), language_of(language)) is expected
