"""Imports go one way (DESIGN, section 1)."""

import ast
from pathlib import Path

import risorius

ROOT = Path(risorius.__file__).parent
ALLOWED: dict[str, set[str]] = {
    "errors": set(),
    "registry": {"errors"},
    "core": {"errors", "registry"},
    "rules": {"core"},
    "script": {"core", "rules"},
    "speech": {"core", "rules", "script"},
    "channels": {"core", "rules", "script", "speech"},
    "blend": {"core"},
    "face": {"core"},
    "heads": set(),
    "render": {"core", "face"},
    "ports": {"core", "face", "render"},
}
BASE = {"errors", "registry", "compile_cache", "kept", "workers"}


def _packages_imported(path: Path) -> set[str]:
    package = ("risorius", *path.relative_to(ROOT).parent.parts)
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text())):
        names: list[str] = []
        if isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else ()
            module = (*base, *(node.module or "").split(".")) if node.module else base
            names = [".".join((*module, alias.name)) for alias in node.names]
        elif isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        found |= {name.split(".")[1] for name in names if name.startswith("risorius.")}
    return found


def test_every_package_imports_only_what_lies_below_it() -> None:
    wrong = []
    for path in sorted(ROOT.rglob("*.py")):
        unit = path.relative_to(ROOT).parts[0].removesuffix(".py")
        if unit in ALLOWED:
            extra = _packages_imported(path) - ALLOWED[unit] - BASE - {unit}
            wrong += [f"{path.relative_to(ROOT)} imports {name}" for name in sorted(extra)]
    assert not wrong, "\n".join(wrong)
