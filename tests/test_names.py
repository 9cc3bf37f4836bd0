"""One name, one thing: a public type name is defined once in the package."""

import ast
import re
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import risorius

ROOT = Path(risorius.__file__).parent
TYPE_NAME = re.compile(r"[A-Z][A-Za-z0-9]*[a-z][A-Za-z0-9]*")  # a constant has capitals alone
# Names that still mean several things. The list may only shrink.
TO_MEND = {
    "Dial",
    "Edit",
    "Json",
    "Line",
    "Part",
    "Pause",
    "Phone",
    "Progress",
    "Row",
    "Send",
    "Sent",
    "Word",
}


def _assigned(node: ast.stmt) -> Iterator[str]:
    targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", None)]
    yield from (target.id for target in targets if isinstance(target, ast.Name))


def _public_types(path: Path) -> Iterator[str]:
    """Yield the classes, aliases and new types that a module defines at its top level."""
    for node in ast.parse(path.read_text()).body:
        names = [node.name] if isinstance(node, ast.ClassDef) else list(_assigned(node))
        yield from (name for name in names if TYPE_NAME.fullmatch(name))


def _homonyms() -> dict[str, list[str]]:
    places: dict[str, list[str]] = defaultdict(list)
    for path in sorted(ROOT.rglob("*.py")):
        for name in _public_types(path):
            places[name].append(str(path.relative_to(ROOT)))
    return {name: where for name, where in places.items() if len(where) > 1}


def test_a_public_type_name_is_defined_once() -> None:
    new = {name: where for name, where in _homonyms().items() if name not in TO_MEND}
    assert not new, "\n".join(f"{name} is defined in {' and '.join(where)}" for name, where in new.items())


def test_the_list_holds_no_name_that_is_mended() -> None:
    mended = TO_MEND - _homonyms().keys()
    assert not mended, f"defined once or not at all: {', '.join(sorted(mended))}"
