"""The check of the pins for known vulnerabilities, without a network."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[2]
ADVISORY = {"id": "GHSA-1", "aliases": ["CVE-2026-1"], "fixed_in": ["2.0.1"], "withdrawn": None}


@pytest.fixture(scope="module")
def tool() -> ModuleType:
    spec = importlib.util.spec_from_file_location("vulnerable", ROOT / "tools/vulnerable.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    pinned = "# Written.\n{}==2.0 \\\n    --hash=sha256:00\n"
    (tmp_path / "run.txt").write_text(pinned.format("one") + pinned.format("two-three"))
    return tmp_path


def answering(*vulnerabilities: dict[str, object]):
    return lambda address: json.dumps(
        {"vulnerabilities": list(vulnerabilities) if "/one/2.0/" in address else []}
    ).encode()


def test_an_advisory_is_named_with_what_mends_it(tool, folder, capsys) -> None:
    assert tool.main(answering(ADVISORY), folder) == 1
    said = capsys.readouterr().out
    assert "one 2.0: GHSA-1 CVE-2026-1; mended by 2.0.1\n" in said
    assert "1 known vulnerabilities in 2 packages" in said


def test_one_that_was_withdrawn_does_not_count(tool, folder, capsys) -> None:
    assert tool.main(answering({**ADVISORY, "withdrawn": "2026-01-01T00:00:00Z"}), folder) == 0


@pytest.mark.parametrize("answer", [b"<html>", b"{}", OSError("HTTP Error 404: Not Found")])
def test_an_index_that_has_none_is_said_and_no_fault(tool, folder, capsys, answer) -> None:
    def fetch(address: str) -> bytes:
        if isinstance(answer, OSError):
            raise answer
        return bytes(answer)

    assert tool.main(fetch, folder) == 0
    assert "not checked: 2 of 2 packages" in capsys.readouterr().out


def test_all_pins_are_found(tool) -> None:
    found = tool.pins()
    assert {"numpy", "scipy", "click", "pytest"} <= found.keys()
    text = "".join(path.read_text() for path in (ROOT / "requirements").glob("*.txt"))
    assert len(found) == len({line.split("==")[0] for line in text.splitlines() if "==" in line})
