"""The tables of both papers' rules name rules and tests that exist."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from risorius.channels import emotion, gaze, head, manipulators
from risorius.rules.rule import RULED_CHANNELS
from risorius.rules.rule_set import shipped

ROOT = Path(__file__).parent


def rows_of(page: str) -> list[list[str]]:
    lines = (ROOT.parent / "docs" / page).read_text(encoding="utf-8").splitlines()
    return [line.strip("|").split(" | ") for line in lines if line.startswith("| ")][1:]


ROWS = rows_of("paper-b.md")
ROWS_OF_A = rows_of("paper-a.md")
HABITS = {
    emotion.POSTURE, gaze.AVERSION, gaze.SCAN, gaze.REST, head.NOISE, head.MELODY, head.POSTURE,
    manipulators.NATURAL, manipulators.ITTI, manipulators.PELACHAUD,
}  # fmt: skip
ID = re.compile(rf"`((?:{'|'.join(RULED_CHANNELS)})\.[\w.]+)`")
TEST = re.compile(r"`([\w/]+\.py)::(\w+)`")


def test_all_sections_with_rules_are_there() -> None:
    sections = {row[0].strip() for row in ROWS}
    assert sections >= {"2.1", "3.1", "3.2", "3.2.1", "4.1", "4.2", "4.3", "4.4", "5.1", "5.2", "6.3", "6.4"}
    assert len(ROWS) > 50
    assert {row[0].strip() for row in ROWS_OF_A} >= {"1", "2", "3", "4", "5.1", "5.2", "6", "7"}


@pytest.mark.parametrize("row", [*ROWS, *ROWS_OF_A], ids=lambda row: row[1][:50])
def test_rules_and_tests_of_a_row_exist(row: list[str]) -> None:
    _, _, kept, held = row
    assert kept.strip()
    for name in ID.findall(kept):
        assert name in shipped().entries or name in HABITS, name
    tests = TEST.findall(held)
    assert tests
    for path, name in tests:
        assert f"def {name}(" in (ROOT / path).read_text(), f"{path}::{name}"
