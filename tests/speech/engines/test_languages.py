"""Languages: every sound that espeak-ng can make in them has lips; real texts come out whole."""

import struct
import warnings
from typing import Any

import numpy as np
import pytest

from risorius.errors import SpeechWarning
from risorius.languages import language_of
from risorius.ports.speech.visemes import known_viseme
from risorius.rules.articulation import is_known
from risorius.speech.engines.espeak import EspeakEngine, data_folder
from risorius.speech.engines.espeak_events import render
from risorius.speech.engines.mnemonics import as_ipa
from risorius.speech.engines.voices import find_voice
from risorius.speech.synthesis import synthesize_line

# Pangrams and the like: sentences rich in sounds.
TEXTS = {
    "en-us": "The quick brown fox jumps over the lazy dog. Measure the vision of yachts, though both thin.",
    "en-gb": "The quick brown fox jumps over the lazy dog. Pure fire here; we tour the air.",
    "de": "Zwölf Boxkämpfer jagen Viktor quer über den großen Sylter Deich. Ich heiße Pfarrer Schütz, ja.",
    "fr": "Portez ce vieux whisky au juge blond qui fume. Un bon vin blanc, huit garçons, la montagne.",
    "es": "El veloz murciélago hindú comía feliz cardillo y kiwi. La cigüeña, perro, niño, llave, ahí.",
    "it": "Quel vituperabile xenofobo zelante assaggia il whisky. Gli gnomi, la pizza, zero, asso, figlia.",
    "pt": "À noite, vovô Kowalsky vê o ímã cair no pé do pinguim queixoso e põe açúcar no chá de tâmaras.",
    "nl": "Pa's wijze lynx bezag vroom het fikse aquaduct. Een huis met leuke muren, schuw nieuws.",
    "pl": "Zażółć gęślą jaźń. Chrząszcz brzmi w trzcinie w Szczebrzeszynie. Dźwięk, ćma, dżem.",
    "ru": "Съешь же ещё этих мягких французских булок, да выпей чаю. Щука, жизнь, объект, ты.",
    "cmn": "你好,我是中国人。绿色的女士去吃热饭,二十四只狮子。雨下得很大。",
    "ja": "こんにちは。わたしはにほんじんです。がっこう、きゃく、ふじさん、りょこう、びょういん。",
    "vi": "Xin chào, tôi là người Việt Nam. Đường phố đông nghịt, những quyển sách rất hay, khuya.",
    "hi": "नमस्ते, मैं भारत से हूँ। ऋषियों को सताने वाले दुष्ट राक्षसों के राजा रावण का सर्वनाश करने वाले।",
}
LANGUAGES = [language for language in TEXTS if not language.startswith("en")]
# Types of phonemes in espeak-ng's tables that sound: vowels, liquids, stops, fricatives, nasals.
SOUNDING = range(2, 9)


@pytest.mark.parametrize(
    ("name", "language", "ipa"),
    [("y", "ru", "ɨ"), ("y", "de", "y"), ("ts.h", "cmn", "tʂʰ"), ("ə-", "fr", "ə"), ("i̪", "cmn", "ɨ")],
)
def test_spellings_become_ipa(name: str, language: str, ipa: str) -> None:
    assert as_ipa(name, language_of(language)) == ipa


@pytest.mark.parametrize("language", TEXTS)
def test_real_texts_have_no_unknown_sound(language: str, engine: EspeakEngine) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error", SpeechWarning)
        said = synthesize_line(TEXTS[language], language=language, engine=engine)
    symbols = {phone.symbol for phone in said.phones} - {""}
    assert len(symbols) > 15
    assert [symbol for symbol in symbols if not is_known(symbol)] == []
    assert len(said.words) == pytest.approx(sum(1 for _ in TEXTS[language].split()), abs=60)


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_phoneme_of_the_language_has_lips(language: str, engine: EspeakEngine) -> None:
    names = sorted(_inventory(language))
    assert len(names) > 60
    text = " ".join(f"[[{name}]]" for name in names)
    request = {"op": "speak", "text": text, "voice": find_voice(None, language, engine).key, "ipa": True}
    answer, sound = engine.request(request | {"dictated": True}, len(text))
    rendition = render(answer, np.frombuffer(sound, "<i2"), language_of(language))
    assert len({phone.symbol for phone in rendition.phones}) > 30
    assert rendition.guessed == ()
    assert [
        phone.symbol for phone in rendition.phones if phone.symbol and not known_viseme(phone.symbol)
    ] == []


def test_an_unmapped_phone_is_warned_of(engine: EspeakEngine, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("risorius.speech.engines.espeak_events.is_known", lambda symbol: symbol != "ʃ")
    with pytest.warns(SpeechWarning, match="'ʃ'"):
        synthesize_line("Schön.", language="de", engine=engine)


def _inventory(language: str) -> set[str]:
    """Return the mnemonics of a language's phoneme table, with those of the tables that it extends."""
    tables = _tables((data_folder() / "phontab").read_bytes())
    index = {name: number for number, (name, _, _) in enumerate(tables)}
    codes: dict[int, str] = {}

    def collect(number: int) -> None:
        _, base, phonemes = tables[number]
        if base:
            collect(base - 1)
        codes.update({code: (name if kind in SOUNDING else "") for name, code, kind in phonemes})

    collect(index[language])
    return {name for name in codes.values() if name and not name.startswith("_")}


def _tables(data: bytes) -> list[tuple[str, int, list[tuple[str, int, int]]]]:
    tables: list[Any] = []
    at = 4
    for _ in range(data[0]):
        count, base = data[at], data[at + 1]
        name = data[at + 4 : at + 36].split(b"\0")[0].decode()
        at += 36
        entries = [struct.unpack_from("<4sIHBB", data, at + 16 * k) for k in range(count)]
        at += 16 * count
        tables.append((name, base, [(e[0].rstrip(b"\0").decode("latin1"), e[3], e[4]) for e in entries]))
    return tables
