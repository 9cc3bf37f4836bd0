"""The example notebooks run from their first cell to their last, and show what a notebook can show."""

from __future__ import annotations

import ast
import json
from pathlib import Path
from types import CodeType
from typing import Any

import pytest

import risorius

FOLDER = Path(__file__).parent.parent / "examples/notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def cells(path: Path) -> list[dict[str, Any]]:
    document: dict[str, Any] = json.loads(path.read_text("utf-8"))
    assert (document["nbformat"], document["nbformat_minor"]) == (4, 5)
    found: list[dict[str, Any]] = document["cells"]
    return found


def divided(source: str, name: str) -> tuple[CodeType, CodeType | None]:
    """Return a cell's statements, and its last expression, which a notebook shows."""
    tree = ast.parse(source)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    shown = compile(ast.Expression(last.value), name, "eval") if isinstance(last, ast.Expr) else None
    return compile(tree, name, "exec"), shown


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.name)
def test_notebooks_are_kept_as_they_are_to_be_opened(path: Path) -> None:
    found = cells(path)
    assert found[0]["cell_type"] == "markdown"
    assert len({cell["id"] for cell in found}) == len(found)
    # What was shown where it was written is not kept: it would be stale.
    assert [cell for cell in found if cell.get("outputs") or cell.get("execution_count")] == []
    for cell in found:
        if cell["cell_type"] == "code":
            divided("".join(cell["source"]), cell["id"])


@pytest.mark.full
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.name)
def test_notebooks_run(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    matplotlib.use("agg")
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {"__name__": "__main__"}
    for cell in cells(path):
        if cell["cell_type"] == "code":
            done, shown = divided("".join(cell["source"]), f"{path.name} {cell['id']}")
            exec(done, names)
            if shown is not None:
                _show(eval(shown, names))


def _show(value: Any) -> None:
    if isinstance(value, risorius.Take):
        assert "<img" in value._repr_html_()
    assert repr(value)
