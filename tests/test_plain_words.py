"""Docstrings, messages and the pages' comments open with their subject, and say "not a" and "if"."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import risorius

ROOT = Path(risorius.__file__).parent
OPENINGS = re.compile(r"(Who|Whose|Whom|What|Where|Which|Of|Be)\b")
RIDDLES = {
    "there is none, or not a …": r"(?<!there )\b(is|are|was|were) none\b",
    "not a …": r"\b(that|what|which|it) (is|are) no (?!longer|more|less|fewer)",
    "a number by name, or a share": r"\bso (many|much)\b(?! (as|that)\b)",
    "nothing, it goes without saying": r"; expected none$",
    "as if": r"\bas though\b",
    "possibly …": r"\bbe it\b",
    "if it is …": r"\bif so\b",
    "the thing by its noun": r"\b[Ww]hoever\b",
}
# Files that are being replaced; their sentences go with them.
LATER = {
    "ports/page/page_modules.py",
}


def _texts(node: ast.AST) -> Iterator[str]:
    """Yield the texts of several words in a module, docstrings and formatted texts among them."""
    if isinstance(node, ast.JoinedStr):
        yield "".join(str(part.value) if isinstance(part, ast.Constant) else "…" for part in node.values)
        return
    if isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value:
        yield node.value
    for child in ast.iter_child_nodes(node):
        yield from _texts(child)


def _docstrings(tree: ast.Module) -> Iterator[str]:
    """Yield the docstrings of a module, its classes, functions and attributes."""
    for node in ast.walk(tree):
        for part in getattr(node, "body", ()) if not isinstance(node, ast.IfExp | ast.Lambda) else ():
            if isinstance(part, ast.Expr) and isinstance(part.value, ast.Constant):
                yield str(part.value.value)


def _faults(source: str) -> list[str]:
    tree = ast.parse(source)
    opened = [
        f"{text.splitlines()[0]!r} opens with a question"
        for text in _docstrings(tree)
        if OPENINGS.match(text)
    ]
    riddles = (
        f"{' '.join(text.split())[:110]!r}: say {better}"
        for text in _texts(tree)
        for better, pattern in RIDDLES.items()
        if re.search(pattern, " ".join(text.split()))
    )
    return [*opened, *riddles]


def _comments(script: str) -> Iterator[str]:
    """Yield the documentation comments of a page's module, and runs of its line comments."""
    for block in re.findall(r"/\*\*(.*?)\*/", script, re.DOTALL):
        yield " ".join(re.sub(r"^\s*\* ?", "", line).strip() for line in block.splitlines()).strip()
    for run in re.findall(r"^\s*//.*(?:\n\s*//.*)*", script, re.MULTILINE):
        yield " ".join(line.strip().removeprefix("//").strip() for line in run.splitlines())


def _faults_of_script(script: str) -> list[str]:
    texts = list(_comments(script))
    opened = [f"{text[:110]!r} opens with a question" for text in texts if OPENINGS.match(text)]
    riddles = (
        f"{text[:110]!r}: say {better}"
        for text in texts
        for better, pattern in RIDDLES.items()
        if re.search(pattern, text)
    )
    return [*opened, *riddles]


def test_comments_of_the_pages_are_plain() -> None:
    pages = ROOT / "browser"
    faults = [
        f"{path.relative_to(ROOT)}: {fault}"
        for path in sorted(pages.rglob("*.js"))
        if "vendor" not in path.parts
        for fault in _faults_of_script(path.read_text(encoding="utf-8"))
    ]
    assert not faults, "\n".join(faults)


@pytest.mark.parametrize(
    "script",
    [
        "/** What is drawn. */\nlet a;",
        "/**\n * Where the heads stand.\n * @param {number} a\n */",
        "// A list, as\n// though it were full\n",
    ],
)
def test_riddles_in_scripts_are_found(script: str) -> None:
    assert _faults_of_script(script)


def test_docstrings_and_messages_are_plain() -> None:
    faults = [
        f"{path.relative_to(ROOT)}: {fault}"
        for path in sorted(ROOT.rglob("*.py"))
        if path.relative_to(ROOT).as_posix() not in LATER
        for fault in _faults(path.read_text(encoding="utf-8"))
    ]
    assert not faults, "\n".join(faults)


@pytest.mark.parametrize(
    "source",
    [
        '"""Who is sent something, and how."""',
        '"""Return the shard; raise InputError if it is none."""',
        'MOST = 3\n"""Seconds that a turn lasts, at most so many."""',
        'raise InputError(f"{count} problems; expected none")',
        'def f():\n    """Return what is no text."""',
    ],
)
def test_riddles_are_found(source: str) -> None:
    assert _faults(source)


@pytest.mark.parametrize(
    "source",
    [
        '"""The receiver of a stream."""',
        '"""Return the shard; raise InputError for any other text, None if there is none."""',
        'raise InputError("the line is no longer in memory")',
    ],
)
def test_plain_words_pass(source: str) -> None:
    assert not _faults(source)
