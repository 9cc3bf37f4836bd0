"""Spoilt files of every kind: read, or refused in one line, within bounds of time and memory.

Every day 300 of each, fewer of those that are slow, a few of them hypothesis's; under `--full` 20,000 of
each. RISORIUS_FUZZ sets another number of hypothesis's. `python -m tests.fuzz` reads many more in a time.
"""

from __future__ import annotations

import dataclasses
import importlib
import os
import pkgutil
import re
import sys
import typing
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest
from hypothesis import HealthCheck, given, settings

import risorius
from risorius.errors import RisoriusError
from risorius.live.serve.messages import KINDS
from risorius.ports.formats import FORMATS
from risorius.reading.schema import MisfitError, converter
from risorius.script.read import READERS as SCRIPTS
from risorius.script.suffixes import RECORDING_SUFFIXES
from risorius.settings import Settings, settings_of
from risorius.settings.declare import rows
from risorius.speech.input import TRANSCRIPT_SUFFIXES
from risorius.studio.request_table import VERBS
from risorius.studio.wire.requests import EDITS

from ..collected import all_cases
from ..profiles import samples
from .cases import spoilt
from .guard import bounded, one_line_or_done
from .kinds import READERS
from .mutation import mutated
from .readers import PACKAGE
from .registry import FuzzedReader

CASES = int(os.environ.get("RISORIUS_FUZZ", samples(2000, 12)))
COUNTED = samples(18_000, 144)
PACKAGE_TABLES = {
    "ApmlTable", "Articulation", "Attitude", "BmlTable", "Bulge", "Expression", "FuzzyTable", "LabelTable",
    "MarkupTable", "PhoneInventory", "Priors", "ProsodyRules", "RegionRow", "Saccade", "SsmlTable",
    "Synchrony", "TagTable", "Tradeoffs", "Viseme", "VoiceEmotions",
}  # fmt: skip
"""Tables that only the package's own files hold."""
PARSERS = {
    "batches/manifest": ".manifest.csv .jsonl",
    "reading/json_text": ".json .journal.jsonl .performance.json .glb",
    "machine/npz": ".npz .head.npz",
    "reading/toml": ".rules.toml .config.toml",
    "live/services": ".elevenlabs .cartesia .azure",
    "ports/curves/capture": ".au.csv .arkit.csv",
    "ports/curves/fap": ".fap",
    "ports/score/speech_json": ".score.json",
    "render/backdrop": ".png",
    "script/elements": ".xml .ssml .bml .apml",
    "live/serve/messages": ".client",
    "speech/engines/program": ".answer",
    "speech/recordings/film_worker": ".m4a .mp4 .mov .webm .mkv .aac",
    "speech/recordings/joined_files": ".flac .ogg .mp3",
    "speech/recordings/recording": ".wav .flac .ogg .mp3",
    "studio/project/project": ".project.json",
    "studio/project/session_list": ".saved.json",
    "reading/json_object": ".message .page",
}
"""Modules that parse what others wrote, and the kinds with which they are fuzzed."""
OURS = {
    "batches/report": "its own database",
    "core/speech/audio": "sound that we wrote",
    "machine/cache_folder": "digests of the kernels that we built",
    "live/pcm": "samples, of which all bytes are right",
    "reading/positions": "keys that were parsed before",
    "face/skin/wrinkle_regions": "the bytes of its own table",
    "ports/page/html": "bytes that it writes",
    "ports/curves/npz": "writes",
    "ports/video/encoder": "memory that both processes map",
    "ports/video/worker": "messages from us",
    "ports/speech/wav": "sound that we wrote",
    "speech/engines/espeak": "answers of our worker",
    "speech/engines/piper": "sound of a program that the user names",
    "speech/recordings/film_sound": "answers of our decoder",
    "studio/project/exports": "writes",
}
"""Modules that parse what only Risorius wrote, or what is trusted."""
_PARSES = re.compile(
    r"\b(json\.loads?|tomllib\.loads?|csv\.reader|wave\.open|ZipFile|np\.load|b64decode|Image\.open"
    r"|soundfile\.(?:SoundFile|read)|av\.open|ElementTree|ParserCreate|frombuffer)\b"
)
_TABLE_READER = re.compile(r"\b(?:(?:load|parse)(?:_file|_folder|_rows)?|build)\(([A-Z][a-z]\w+)")


def test_every_format_has_a_fuzzed_reader() -> None:
    read = {suffix for name in FORMATS for suffix in FORMATS.get(name).read_suffixes}
    assert not {*read, *SCRIPTS, *TRANSCRIPT_SUFFIXES} - READERS.keys()


def test_every_recording_and_message_has_a_fuzzed_reader() -> None:
    decoded = {".m4v", ".3gp", ".opus"}  # containers of other names
    assert not set(RECORDING_SUFFIXES) - READERS.keys() - decoded
    live = "".join(READERS[".client"].samples()[0].decode())
    assert all(f'"do": "{kind}"' in live for kind in KINDS)
    page = "".join(sample.decode() for kind in (".page", ".message") for sample in READERS[kind].samples())
    assert all(f'"{verb}"' in page for verb in (*VERBS, *EDITS))


def test_every_module_that_parses_is_fuzzed_or_reads_what_is_ours() -> None:
    folder = Path(risorius.__path__[0])
    parsing = {
        path.relative_to(folder).with_suffix("").as_posix()
        for path in folder.rglob("*.py")
        if _PARSES.search(path.read_text())
    }
    assert parsing == PARSERS.keys() | OURS.keys()
    assert {kind for kinds in PARSERS.values() for kind in kinds.split()} <= READERS.keys()


def test_every_table_has_a_fuzzed_reader() -> None:
    tables = {name for path in PACKAGE.rglob("*.py") for name in _tables(path)}
    fuzzed = {table for reader in READERS.values() for table in reader.tables}
    assert tables == fuzzed | PACKAGE_TABLES


def _tables(path: Path) -> set[str]:
    """Return the names of the classes that a module reads tables as."""
    return set(_TABLE_READER.findall(path.read_text())) - {"Path"}


@pytest.mark.filterwarnings("ignore:.*left out:risorius.errors.RisoriusWarning")  # of what is not words
@pytest.mark.parametrize("suffix", READERS)
def test_a_right_file_is_read(suffix: str, tmp_path: Path) -> None:
    for number, data in enumerate(READERS[suffix].samples()):
        path = tmp_path / f"{number}{suffix}"
        path.write_bytes(data)
        READERS[suffix].read(path)


@pytest.mark.filterwarnings("ignore::risorius.errors.RisoriusWarning")
@pytest.mark.parametrize("suffix", READERS)
def test_a_spoilt_file_is_read_or_refused(suffix: str, tmp_path: Path) -> None:
    reader, path = READERS[suffix], tmp_path / f"spoilt{suffix}"

    @settings(
        max_examples=_cases(CASES, reader),
        suppress_health_check=list(HealthCheck),
        deadline=None,
        database=None,
    )
    @given(data=mutated(reader.samples()))
    def read(data: bytes) -> None:
        path.write_bytes(data)
        with one_line_or_done():
            reader.read(path)

    read()


@pytest.mark.filterwarnings("ignore::risorius.errors.RisoriusWarning")
@pytest.mark.parametrize("suffix", READERS)
def test_counted_spoilt_files_are_read_or_refused(suffix: str, tmp_path: Path) -> None:
    reader, path = READERS[suffix], tmp_path / f"spoilt{suffix}"
    for number in range(_cases(COUNTED, reader)):
        path.write_bytes(spoilt(suffix, number))
        try:
            with one_line_or_done():
                reader.read(path)
        except (pytest.fail.Exception, AssertionError) as error:
            raise AssertionError(f"spoilt({suffix!r}, {number}): {error}") from error


def _cases(most: int, reader: FuzzedReader) -> int:
    return max(1, round(most * samples(1.0, reader.share)))


NOT_NUMBERS = (float("inf"), float("-inf"), float("nan"), True, "1", None, [], {})
TORTURE = (0, -1, 2**63, 10**400, 1e308, -1e308, 5e-324, *NOT_NUMBERS)


def _schemas() -> dict[str, type]:
    """Return the dataclasses of all modules."""
    schemas: dict[str, type] = {}
    for module in pkgutil.walk_packages(risorius.__path__, "risorius."):
        if not module.name.endswith("__main__"):
            schemas |= _declared(importlib.import_module(module.name))
    return schemas


def _declared(module: ModuleType) -> dict[str, type]:
    held = vars(module).values()
    classes = [item for item in held if isinstance(item, type) and item.__module__ == module.__name__]
    return {f"{c.__module__}.{c.__name__}": c for c in classes if dataclasses.is_dataclass(c)}


def test_every_field_of_every_schema_takes_torture() -> None:
    """Whatever stands in a field: a value of its type, or a message."""
    tried = 0
    for name, schema in _schemas().items():
        for field, hint in _hints(schema).items():
            try:
                read = converter(hint)
            except (KeyError, TypeError, AttributeError, ValueError, NameError, RecursionError):
                continue  # not a type that files hold
            with bounded():
                for value in (*TORTURE, *([value] for value in TORTURE)):
                    tried += 1
                    assert not _fault(read, value), f"{name}.{field} = {str(value)[:40]}"
    assert tried > 3000


def _fault(read: Callable[[object], object], value: object) -> str:
    """Return what reading a value raised that is neither a message nor the want of one."""
    try:
        read(value)
    except (MisfitError, RisoriusError):
        return ""
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return ""


ODD = (10**5000, -(10**5000), "", "x" * 5000, "\ud800", "9" * 5000, "1e400", ";", ":", b"x", object(), int)


def test_every_setting_takes_torture() -> None:
    """Whatever a setting is given, alone, in a list or by name: it is taken, or refused in one line."""
    with all_cases() as case:
        for name in rows(Settings):
            for number, value in enumerate((*TORTURE, *ODD)):
                with case(f"{name} = value {number}, {type(value).__name__}"):
                    _torture(name, value)


def _torture(name: str, value: object) -> None:
    members = [{value: 1.0}] if isinstance(value, int | str) else []
    for choice in (value, [value], (value, value), {"x": value}, {"nose_width": value}, *members):
        with one_line_or_done():
            settings_of({name: choice})


def _hints(schema: type) -> dict[str, typing.Any]:
    try:
        return typing.get_type_hints(schema, vars(sys.modules[schema.__module__]), include_extras=True)
    except (NameError, TypeError):
        return {}  # names that only type checkers know
