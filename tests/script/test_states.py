import pytest

from risorius.core.speech.utterance import Word
from risorius.rules.emotions import Display
from risorius.script import felt_in, listening_in, read_script

WORDS = (Word("one", 0.5, 0.9, 0, 1, 0, 3), Word("two", 1.0, 1.6, 1, 2, 4, 7))


def script_of(tmp_path, *elements: str):
    file = tmp_path / "x.xml"
    file.write_text('<PHONEME text="One two." />' + "".join(elements))
    return read_script(str(file))


def test_displays_are_felt_and_emblems_are_not(tmp_path) -> None:
    script = script_of(
        tmp_path,
        '<EMOTIONDISPLAY time="word:2" duration="0.5" joy="0.7" fear="0.2" />',
        '<EMOTIONEMBLEM time="0.1" sadness="0.9" />',
    )
    assert set(felt_in(script, WORDS, 3.0)) == {
        Display("happiness", 0.7, 1.0, 1.5),
        Display("fear", 0.2, 1.0, 1.5),
    }


@pytest.mark.parametrize(
    ("elements", "spans"),
    [
        ((), ()),
        (('<LISTEN time="2" duration="1" />',), ((2.0, 3.0),)),
        (
            ('<LISTEN time="2" />', '<LISTEN time="word:1" end="word:2" layer="x" />'),
            ((0.5, 1.0), (2.0, 4.0)),
        ),
    ],
)
def test_listening_in_order(elements: tuple[str, ...], spans: tuple, tmp_path) -> None:
    assert listening_in(script_of(tmp_path, *elements), WORDS, 4.0) == spans
