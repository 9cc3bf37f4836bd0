"""Spoilt files of every kind: read, or refused in one line, within bounds of time and memory.

Every day 300 of each, a few of them hypothesis's; under `--full` it tries 20,000, and others in each run;
RISORIUS_FUZZ sets another number. `python -m tests.fuzz` reads many more in the same time.
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
from hypothesis import strategies as st

import risorius
from risorius.core.schema import MisfitError, converter
from risorius.errors import RisoriusError
from risorius.ports.formats import FORMATS
from risorius.script.read import READERS as SCRIPTS

from ..profiles import samples
from .cases import spoilt
from .guard import bounded, one_line_or_done
from .mutation import mutated
from .readers import PACKAGE, READERS

CASES = int(os.environ.get("RISORIUS_FUZZ", samples(20_000, 12)))
COUNTED = samples(2000, 288)
PACKAGE_TABLES = {
    "Articulation", "Attitude", "BmlTable", "Bulge", "EdgeTable", "Expression", "FuzzyTable", "MarkupTable",
    "Priors", "ProsodyRules", "RegionRow", "Saccade", "SsmlTable", "Synchrony", "Tradeoffs", "Viseme",
    "VoiceEmotions",
}  # fmt: skip
"""Tables that only the package's own files hold."""
_TABLE_READER = re.compile(r"\b(?:(?:load|parse)(?:_file|_folder|_rows)?|build)\(([A-Z][a-z]\w+)")


def test_every_format_has_a_fuzzed_reader() -> None:
    read = {suffix for name in FORMATS for suffix in FORMATS.get(name).read_suffixes}
    assert not {*read, *SCRIPTS} - READERS.keys()


def test_every_table_has_a_fuzzed_reader() -> None:
    tables = {name for path in PACKAGE.rglob("*.py") for name in _tables(path)}
    fuzzed = {table for reader in READERS.values() for table in reader.tables}
    assert tables == fuzzed | PACKAGE_TABLES


def _tables(path: Path) -> set[str]:
    """Return the names of the classes that a module reads tables as."""
    return set(_TABLE_READER.findall(path.read_text())) - {"Path"}


@pytest.mark.parametrize("suffix", READERS)
def test_a_right_file_is_read(suffix: str, tmp_path: Path) -> None:
    for number, data in enumerate(READERS[suffix].samples()):
        path = tmp_path / f"{number}{suffix}"
        path.write_bytes(data)
        READERS[suffix].read(path)


@pytest.mark.filterwarnings("ignore::risorius.errors.RisoriusWarning")
@pytest.mark.parametrize("suffix", READERS)
@settings(max_examples=CASES, suppress_health_check=list(HealthCheck), deadline=None)
@given(data=st.data())
def test_a_spoilt_file_is_read_or_refused(
    suffix: str, data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
) -> None:
    reader = READERS[suffix]
    path = tmp_path_factory.getbasetemp() / f"spoilt{suffix}"
    path.write_bytes(data.draw(mutated(reader.samples())))
    with one_line_or_done():
        reader.read(path)


@pytest.mark.filterwarnings("ignore::risorius.errors.RisoriusWarning")
@pytest.mark.parametrize("suffix", READERS)
def test_counted_spoilt_files_are_read_or_refused(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"spoilt{suffix}"
    for number in range(COUNTED):
        path.write_bytes(spoilt(suffix, number))
        try:
            with one_line_or_done():
                READERS[suffix].read(path)
        except (pytest.fail.Exception, AssertionError) as error:
            raise AssertionError(f"spoilt({suffix!r}, {number}): {error}") from error


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
            except (KeyError, TypeError, AttributeError, ValueError, NameError):
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


def _hints(schema: type) -> dict[str, typing.Any]:
    try:
        return typing.get_type_hints(schema, vars(sys.modules[schema.__module__]), include_extras=True)
    except (NameError, TypeError):
        return {}  # names that only type checkers know
