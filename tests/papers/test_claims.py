"""Every claim of both papers has tests that exist, and a row of its page."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

import pytest

from .claims import CLAIMS

TESTS = Path(__file__).parent.parent
PAGES = {"A": "paper-a.md", "B": "paper-b.md"}
COUNT = {"A": 31, "B": 36}


@cache
def functions(file: str) -> frozenset[str]:
    """Return the tests in a file, those of classes among them."""
    tree = ast.parse((TESTS / f"{file}.py").read_text(encoding="utf-8"))
    return frozenset(node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef))


def test_all_67_claims_are_there() -> None:
    wanted = [f"{paper}{number}" for paper, count in COUNT.items() for number in range(1, count + 1)]
    assert list(CLAIMS) == wanted
    assert len(CLAIMS) == 67


@pytest.mark.parametrize("name", CLAIMS)
def test_a_claim_s_tests_exist(name: str) -> None:
    assert CLAIMS[name].tests
    for test in CLAIMS[name].tests:
        file, _, function = test.partition("::")
        assert f"test_{function}" in functions(file), test


@pytest.mark.parametrize("paper", PAGES)
def test_a_page_has_every_claim_of_its_paper(paper: str) -> None:
    page = (TESTS.parent / "docs" / PAGES[paper]).read_text(encoding="utf-8")
    rows = [line.strip("| ").split(" | ")[0] for line in page.splitlines() if line.startswith("| ")]
    found = {claim for row in rows for claim in re.findall(rf"\b{paper}\d+\b", row)}
    assert found == {claim for claim in CLAIMS if claim.startswith(paper)}
