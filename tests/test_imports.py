"""Imports go one way, between packages and between files (DESIGN, section 1).

Every import counts, wherever it stands: at the top of a file, in a function, or under TYPE_CHECKING. So does
a text that names what is imported later, as "package.module:attribute".
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator, Mapping
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import risorius

ROOT = Path(risorius.__file__).parent
GROUND = {"errors"}
FIELD = {"reading", "core"}
BASE = FIELD | {"machine"}
WORDS = BASE | {"languages", "rules", "script", "speech"}
TAKE = WORDS | {"channels", "blend", "face", "looks", "render", "ports", "settings"}
PIPELINE = TAKE | {"unused_settings", "solvers", "take"}
LIBRARY = PIPELINE | {"pipeline", "api", "live", "batches"}

# From the ground up: each package, or module of the top level, and what it may import beside itself and the
# ground. A row names only what stands above it.
MAY_IMPORT: Mapping[str, set[str]] = {
    "errors": set(),
    "heads": set(),
    "reading": set(),
    "core": {"reading"},
    "machine": FIELD,
    "browser": set(),
    "languages": BASE,
    "rules": BASE | {"languages"},
    "script": BASE | {"languages", "rules"},
    "speech": BASE | {"languages", "rules", "script"},
    "channels": WORDS - {"machine"},
    "blend": FIELD,
    "face": BASE,
    "settings": BASE | {"rules", "speech", "blend", "face"},
    "looks": BASE | {"face", "settings"},
    "render": BASE | {"face", "settings", "looks"},
    "ports": BASE | {"browser", "languages", "script", "face", "looks", "render"},
    "unused_settings": BASE | {"speech", "ports", "settings"},
    "notebook": BASE | {"render"},
    "solvers": BASE | {"rules", "face", "settings", "unused_settings"},
    "take": TAKE | {"notebook", "solvers"},
    "pipeline": PIPELINE - {"face", "looks", "render", "ports", "unused_settings"},
    "api": PIPELINE | {"pipeline"},
    "speaking": PIPELINE | {"api"},
    "live": PIPELINE | {"pipeline", "api", "browser"},
    "batches": PIPELINE | {"pipeline", "api"},
    "__init__": LIBRARY,
    "studio": LIBRARY | {"__init__", "browser"},
    "cli": LIBRARY | {"__init__", "speaking", "studio"},
    "__main__": {"cli"},
}
# What a package may not see of one that it imports: the face knows curves alone, whatever they come from.
UNSEEN: Mapping[str, set[str]] = {
    "face": {f"risorius.core.{name}" for name in ("movement", "score", "utterance", "edits")},
}
# The program that starts with every film, and what it may load that is not the standard library's.
ENCODER = "risorius.ports.video.worker"
LIGHT = {"av", "numpy"}
NAMED = re.compile(r"([a-z_]+(?:\.[a-z_]+)+):\w+")
# Where modules are imported by a name that is not a literal there: one that a test sees elsewhere, or that of
# a file of the same package, or those of all kernels.
BY_NAME = {
    "__init__.py",
    "channels/registry.py",
    "core/names.py",
    "languages/load.py",
    "machine/kernels/build.py",
    "machine/kernels/compile.py",
    "machine/optional.py",
    "machine/worker.py",
    "ports/formats.py",
    "render/protocol.py",
}


@cache
def _modules() -> dict[str, Path]:
    """Return the file of every module by its dotted name."""
    modules = {}
    for path in sorted(ROOT.rglob("*.py")):
        parts = path.relative_to(ROOT.parent).with_suffix("").parts
        modules[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return modules


@cache
def _imported(module: str) -> frozenset[str]:
    """Return all that a module of ours imports: our modules by their full names, others by their first."""
    path = _modules()[module]
    return frozenset(_targets(module, ast.walk(ast.parse(path.read_text(encoding="utf-8")))))


def _targets(module: str, nodes: Iterator[ast.AST]) -> Iterator[str]:
    package = module.split(".") if _modules()[module].name == "__init__.py" else module.split(".")[:-1]
    for node in nodes:
        if isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else []
            source = ".".join((*base, *((node.module,) if node.module else ())))
            names = [f"{source}.{alias.name}" for alias in node.names]
            yield from (name if name in _modules() else source for name in names)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            named = NAMED.fullmatch(node.value)
            names = {named[1], f"risorius.{named[1]}"} if named else set()
            yield from names & _modules().keys()


def _of_ours(module: str) -> set[str]:
    return {name for name in _imported(module) if name in _modules()} - {module}


def _unit(module: str) -> str:
    """Return the package or the module of the top level that a module belongs to."""
    return module.split(".")[1] if "." in module else "__init__"


def test_rows_name_only_what_stands_above_them() -> None:
    above: set[str] = set()
    for unit, may in MAY_IMPORT.items():
        assert may <= above, f"{unit}: {sorted(may - above)}"
        above.add(unit)


def test_everything_has_a_row() -> None:
    assert {_unit(module) for module in _modules()} <= set(MAY_IMPORT)


def test_a_package_imports_only_what_lies_below_it() -> None:
    wrong = []
    for module in _modules():
        unit = _unit(module)
        may = MAY_IMPORT[unit] | {unit} | (set() if unit in GROUND else GROUND)
        wrong += [
            f"{module} imports {name}"
            for name in sorted(_of_ours(module))
            if _unit(name) not in may or name in UNSEEN.get(unit, ())
        ]
    assert not wrong, "\n".join(wrong)


def test_files_of_a_package_do_not_import_each_other_in_a_circle() -> None:
    circles = []
    for unit in sorted(MAY_IMPORT):
        files = {m: {n for n in _of_ours(m) if _unit(n) == unit} for m in _modules() if _unit(m) == unit}
        try:
            TopologicalSorter(files).prepare()
        except CycleError as circle:
            circles.append(" → ".join(circle.args[1]))
    assert not circles, "\n".join(circles)


def _room(module: str, unit: str) -> str:
    """Return the folder or the file, below its package, that a module stands in."""
    below = module.split(".")[2:]
    return below[0] if below else unit


def test_rooms_of_a_package_do_not_import_each_other_in_a_circle() -> None:
    circles = []
    # A renderer is found in its folder by the protocol that it implements; limits of the mouth read channels,
    # which read the lips.
    for unit in sorted(set(MAY_IMPORT) - {"render", "blend"}):
        rooms: dict[str, set[str]] = {}
        for module in (m for m in _modules() if _unit(m) == unit):
            others = {_room(n, unit) for n in _of_ours(module) if _unit(n) == unit}
            rooms.setdefault(_room(module, unit), set()).update(others - {_room(module, unit)})
        try:
            TopologicalSorter(rooms).prepare()
        except CycleError as circle:
            circles.append(f"{unit}: {' → '.join(circle.args[1])}")
    assert not circles, "\n".join(circles)


def test_modules_are_imported_by_name_where_it_is_known_what_they_are() -> None:
    by_name = {
        path.relative_to(ROOT).as_posix()
        for path in _modules().values()
        if re.search(r"import_module\(|__import__\(", path.read_text(encoding="utf-8"))
    }
    assert by_name == BY_NAME


def test_the_encoder_starts_without_what_is_heavy() -> None:
    loaded: set[str] = set()
    waiting = _and_parents(ENCODER)
    while waiting:
        name = waiting.pop()
        loaded.add(name)
        if name in _modules():
            waiting |= {part for found in _loaded_with(name) for part in _and_parents(found)} - loaded
    foreign = {name for name in loaded if name.split(".")[0] not in sys.stdlib_module_names | {"risorius"}}
    assert foreign <= LIGHT, sorted(loaded)


def _loaded_with(module: str) -> Iterator[str]:
    """Yield what is imported as soon as a module is."""
    tree = ast.parse(_modules()[module].read_text(encoding="utf-8"))
    types = [
        node for node in tree.body if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test)
    ]
    now = [node for node in tree.body if node not in types]
    yield from _targets(module, iter(now))


def _and_parents(name: str) -> set[str]:
    """Return a module and the packages that are loaded before it; of others the first alone."""
    parts = name.split(".")
    if parts[0] != "risorius":
        return {parts[0]}
    return {".".join(parts[:count]) for count in range(1, len(parts) + 1)} & set(_modules())


def test_the_page_on_architecture_has_the_packages_in_their_order() -> None:
    page = (ROOT.parent.parent / "docs" / "architecture.md").read_text(encoding="utf-8")
    table = page.partition("## The packages")[2].partition("## ")[0]
    drawn = re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE)
    units = {_unit(module) for module in _modules()} - {"__init__", "__main__"}
    assert drawn == [unit for unit in MAY_IMPORT if unit in units]
