"""What stands beside the code for those who install it or take part: the image, pages, completion."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = ["CODE_OF_CONDUCT.md", "CONTRIBUTING.md", "SECURITY.md", "README.md"]


def test_the_image_copies_what_is_there_and_what_it_is_sent() -> None:
    image = (ROOT / "Dockerfile").read_text()
    sent = [line[1:] for line in (ROOT / ".dockerignore").read_text().splitlines() if line.startswith("!")]
    copied = [
        word for line in re.findall(r"^COPY (?!--)(.*) \S+$", image, re.MULTILINE) for word in line.split()
    ]
    assert sorted(copied) == sorted(sent)
    assert all((ROOT / name).exists() for name in copied)


def test_the_image_runs_as_a_user_who_is_not_root_and_installs_by_digest() -> None:
    last = (ROOT / "Dockerfile").read_text().rpartition("FROM")[2]
    assert re.search(r"^USER risorius$", last, re.MULTILINE)
    assert "--require-hashes -r requirements/run.txt" in (ROOT / "Dockerfile").read_text()


@pytest.mark.parametrize("page", PAGES)
def test_links_of_the_pages_lead_somewhere(page: str) -> None:
    for target in re.findall(r"\]\(([^)#]+)[^)]*\)", (ROOT / page).read_text()):
        assert (ROOT / target).exists(), target


def test_completion_is_made_for_every_shell_that_the_page_names() -> None:
    page = (ROOT / "docs/completion.md").read_text()
    for shell in ("bash", "zsh", "fish"):
        assert f"_RISORIUS_COMPLETE={shell}_source risorius" in page


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_the_program_prints_its_completion(shell: str) -> None:
    environment = {**os.environ, "_RISORIUS_COMPLETE": f"{shell}_source"}
    command = [sys.executable, "-m", "risorius"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert "_RISORIUS_COMPLETE" in done.stdout
