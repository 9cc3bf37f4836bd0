"""Messages: whatever comes in is answered in one line; what goes out can come in again."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.edits import Move
from risorius.studio.decoding import BadRequestError, decode
from risorius.studio.request_table import VERBS
from risorius.studio.wire import answers, events, requests, shared
from risorius.studio.wire.messages import answer, encoded, event, refusal

BAD = [
    ("", None, "is not JSON"),
    ("[1]", None, "is not an object"),
    ("[" * 100_000, None, "is not JSON"),
    ('{"do": "undo"}', None, "has no number"),
    ('{"id": true, "do": "undo"}', None, "has no number"),
    ('{"id": -1, "do": "undo"}', None, "has no number"),
    ('{"id": 1e400, "do": "undo"}', None, "has no number"),
    ('{"id": 7, "do": "save_view", "view": ' + "[" * 900 + "]" * 900 + "}", 7, "is nested too deeply"),
    ('{"id": 7, "do": "save_view", "view": ' + "[" * 100_000, 7, "is not JSON"),
    ('{"id": 7, "do": "save_view", "view": {"time": "abc"}}', 7, "view.time"),
    ('{"id": 99999999999999999, "do": ', None, "is not JSON"),
    ('{"id": 7}', 7, "unknown request 'None'"),
    ('{"id": 7, "do": "undi"}', 7, "did you mean 'undo'"),
    ('{"id": 7, "do": ["undo"]}', 7, "unknown request"),
    ('{"id": 7, "do": "undo", "twice": 1}', 7, "unknown key 'twice'"),
    ('{"id": 7, "do": "edit"}', 7, "unknown edit 'None'"),
    ('{"id": 7, "do": "edit", "kind": "moves"}', 7, "did you mean 'move'"),
    ('{"id": 7, "do": "preview"}', 7, "unknown edit 'None'"),
    ('{"id": 7, "do": "preview", "kind": "move", "movement": "a"}', 7, "key 'start' is missing"),
    ('{"id": 7, "do": "preview", "kind": "move", "face": -1}', 7, "face = -1 is out of range"),
    ('{"id": 7, "do": "move", "movement": "a", "start": 1}', 7, "unknown request 'move'"),
    ('{"id": 7, "do": "edit", "kind": "move", "movement": "a"}', 7, "key 'start' is missing"),
    ('{"id": 7, "do": "edit", "kind": "move", "movement": 3, "start": 1}', 7, "movement = 3 cannot be used"),
    ('{"id": 7, "do": "edit", "kind": "move", "movement": "a", "start": -1}', 7, "out of range"),
    ('{"id": 7, "do": "edit", "kind": "move", "movement": "a", "start": NaN}', 7, "cannot be used"),
    ('{"id": 7, "do": "perform", "source": {"script": "a", "format": "exe"}}', 7, "source.format"),
    (
        '{"id": 7, "do": "perform", "source": {"script": "a"}, "choices": {"fsp": "30"}}',
        7,
        "unknown key 'choices.fsp'; did you mean 'fps'",
    ),
    ('{"id": 7, "do": "faces", "take": 1, "first": 0, "last": 1.5}', 7, "expected a whole number"),
]


@pytest.mark.parametrize(("text", "number", "message"), BAD)
def test_a_bad_message_is_refused_in_one_line(text, number, message):
    with pytest.raises(BadRequestError) as caught:
        decode(text)
    assert caught.value.id == number
    assert message in caught.value.message
    assert "\n" not in caught.value.message


words = st.text("ab7. é", max_size=6)
anything = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), words),
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(words, inner, max_size=3)),
    max_leaves=8,
)
fields = st.dictionaries(st.sampled_from(["take", "source", "movement", "values", "kind", "x"]), anything)


@given(st.sampled_from([*VERBS, "edit"]), fields)
def test_any_message_is_understood_or_refused(verb, given_):
    try:
        number = decode(json.dumps({**given_, "id": 3, "do": verb})).id
    except BadRequestError as error:
        number = error.id
    assert number == 3


def test_null_is_what_is_left_out():
    text = '{"id": 1, "do": "edit", "kind": "stretch", "movement": "a", "end": 2, "start": null}'
    assert decode(text).body.start is None
    spans = '{"id": 1, "do": "choose", "emotions": [{"emotion": "joy", "intensity": 1, "start": null}]}'
    assert decode(spans).body.emotions == (shared.EmotionSpan("joy", 1.0),)


def test_what_is_sent_can_be_asked_again():
    asked = requests.Perform(
        shared.Source("Oh."),
        shared.Choices(age=40.0, rules_off=("head",)),
        (shared.EmotionSpan("joy", 0.5, first=0, last=2),),
    )
    text = json.dumps({"id": 1, "do": "perform", **encoded(asked)})
    assert decode(text).body == asked
    move = decode('{"id": 2, "do": "edit", "kind": "move", "movement": "a", "start": 1}')
    assert move.body == Move("a", 1.0)


def test_answers_and_events_are_one_line_of_json():
    assert json.loads(answer(3, answers.FacesSent(4))) == {"re": 3, "ok": {"sent": 4}}
    assert json.loads(refusal(None, "no")) == {"re": None, "error": "no"}
    assert json.loads(event(events.Saved())) == {"event": "saved", "error": ""}


def test_a_preview_holds_the_edit():
    asked = decode('{"id": 7, "do": "preview", "kind": "move", "movement": "a", "start": 1}').body
    assert asked == requests.Preview(Move("a", 1.0))
    asked = decode('{"id": 7, "do": "preview", "kind": "move", "movement": "a", "start": 1, "face": 2}').body
    assert asked == requests.Preview(Move("a", 1.0), 2.0)
    edits = '[{"kind": "move", "movement": "a", "start": 1}]'
    asked = decode(f'{{"id": 7, "do": "preview_all", "edits": {edits}, "face": 2}}').body
    assert asked == requests.PreviewAll((Move("a", 1.0),), 2.0)
