"""The types of the page are those of the server."""

from pathlib import Path

from risorius.studio.request_table import EDITING, ROWS, VERBS
from risorius.studio.wire import events, requests
from risorius.studio.wire_javascript import FILE, source

ANSWERS = {row.answer for row in ROWS.values()}


def test_the_file_is_up_to_date():
    assert FILE.read_text(encoding="utf-8") == source(), "run python -m risorius.studio.wire_javascript"


def test_every_message_is_in_it():
    text = source()
    for cls in (
        *VERBS.values(),
        *requests.EDITS.values(),
        *ANSWERS,
        *events.EVENTS.values(),
    ):
        assert f"@typedef {{Object}} {cls.__name__}\n" in text
    assert '@property {"move"} kind' in text
    assert "@property {Array<EmotionSpan>} [emotions]" in text
    assert "@property {[number, number]" not in text or "Array<[number, number]>" in text


def test_every_verb_edit_and_event_is_in_the_manual():
    manual = (Path(__file__).parents[2] / "docs" / "studio-server.md").read_text(encoding="utf-8")
    for name in (*VERBS, *requests.EDITS, *events.EVENTS, *EDITING):
        assert f"`{name}`" in manual, name
    for answer in ANSWERS:
        assert f"`{answer.__name__}`" in manual, answer.__name__
