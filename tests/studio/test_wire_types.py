"""The types of the page are those of the server."""

from risorius.studio import wire
from risorius.studio.wire_types import FILE, source


def test_the_file_is_up_to_date():
    assert FILE.read_text(encoding="utf-8") == source(), "run python -m risorius.studio.wire_types"


def test_every_message_is_in_it():
    text = source()
    for cls in (*wire.VERBS.values(), *wire.EDITS.values(), *wire.ANSWERS, *wire.EVENTS.values()):
        assert f"@typedef {{Object}} {cls.__name__}\n" in text
    assert '@property {"move"} kind' in text
    assert "@property {Array<EmotionSpan>} [emotions]" in text
    assert "@property {[number, number]" not in text or "Array<[number, number]>" in text
