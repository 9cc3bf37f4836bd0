"""The pages on both papers have all sections with rules, and name rules that exist."""

from __future__ import annotations

import re
from pathlib import Path

from risorius.channels import emotion, gaze, head, manipulators
from risorius.rules.rule import RULED_CHANNELS
from risorius.rules.rule_set import shipped

from .collected import all_cases

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


def test_all_sections_with_rules_are_there() -> None:
    sections = {row[1].strip() for row in ROWS}
    assert sections >= {"2.1", "3.1", "3.2", "3.2.1", "4.1", "4.2", "4.3", "4.4", "5.1", "5.2", "6.3", "6.4"}
    assert len(ROWS) > 50
    assert {row[1].strip() for row in ROWS_OF_A} >= {"1", "2", "3", "4", "5.1", "5.2", "6", "7"}


def test_rules_of_a_row_exist() -> None:
    with all_cases() as case:
        for _, _, says, kept in (*ROWS, *ROWS_OF_A):
            with case(says[:50]):
                assert kept.strip()
                assert [name for name in ID.findall(kept) if name not in {*shipped().entries} | HABITS] == []
