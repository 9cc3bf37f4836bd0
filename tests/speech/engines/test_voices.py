"""Voices by name and language."""

from __future__ import annotations

import pytest

from risorius.errors import SpeechError
from risorius.speech.engines.voices import find_voice, voices


@pytest.mark.parametrize(
    ("name", "language", "message"),
    [
        ("en-uss", None, "unknown voice 'en-uss'; did you mean 'en-us'"),
        ("", None, "unknown voice ''"),
        ("en-us+f33", None, r"unknown variant '\+f33'; did you mean '\+f3'"),
        ("+f3", None, "unknown voice ''"),
        (None, "klingonese", "unknown language 'klingonese'; expected a code such as en, de, fr, es, cmn"),
        (None, "xx", "unknown language 'xx'; expected a code such as"),
        (None, "german", "unknown language 'german'; did you mean 'de'"),
        (None, "fra", "unknown language 'fra'; did you mean 'fr'"),
        ("de", "fr", "voice 'de' speaks 'de', not 'fr'"),
    ],
)
def test_what_is_not_there(name, language, message, engine) -> None:
    with pytest.raises(SpeechError, match=message):
        find_voice(name, language, engine)


@pytest.mark.parametrize(
    ("name", "language", "expected"),
    [
        (None, None, "en-us"),
        ("en-us", None, "en-us"),
        ("EN_US", None, "en-us"),
        ("gmw/en-US", None, "en-us"),
        (None, "en", "en-us"),
        (None, "en-GB", "en-gb"),
        (None, "de-AT", "de"),
        (None, "zh", "cmn"),
        (None, "fr", "fr-fr"),
        ("fr", None, "fr-fr"),
        ("en", None, "en-us"),
        (None, "en-nz", "en-us"),
        (None, "pt-BR", "pt-br"),
        ("en-gb", "en", "en-gb"),
    ],
)
def test_what_is(name, language, expected, engine) -> None:
    assert find_voice(name, language, engine).name == expected


def test_variants_change_timbre_and_gender(engine) -> None:
    voice = find_voice("en-us+f3", engine=engine)
    assert (voice.name, voice.gender, voice.language, voice.key) == (
        "en-us+f3",
        "female",
        "en-us",
        "gmw/en-US+f3",
    )


def test_the_list_begins_with_what_speaks_and_is_complete_and_unique(engine) -> None:
    listed = voices(engine)
    names = [voice.name for voice in listed]
    speaking = [name for name in names if not name.startswith("+")]
    assert names[: len(speaking)] == speaking
    # The default, its language, languages of whose words we know most, then all by their own names.
    assert speaking[:2] == ["en-us", "en-us-nyc"]
    assert [speaking.index(name) for name in ("en-gb", "de", "it", "af", "cy")] == sorted(
        speaking.index(name) for name in ("en-gb", "de", "it", "af", "cy")
    )
    assert names[len(speaking) :][:3] == ["+f1", "+f2", "+f3"]
    assert len(set(names)) == len(names) > 150
    assert all(voice.language or voice.name.startswith("+") for voice in listed)
    assert all(voice.gender in ("male", "female", "") for voice in listed)


def test_every_listed_name_is_found(engine) -> None:
    for voice in voices(engine):
        name = f"en-us{voice.name}" if voice.name.startswith("+") else voice.name
        assert find_voice(name, engine=engine).key.endswith(voice.key)
