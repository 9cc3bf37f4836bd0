from pathlib import Path

import pytest

from risorius.core.registry import Registration, Registry, registrations
from risorius.errors import ParameterError


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('register("a", 1)\nprint("b")', "expected nothing but register"),
        ('register("a", order=later)', "malformed"),
        ("register(later)", "malformed"),
    ],
)
def test_lines_that_cannot_be_read_as_text_are_refused(text: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text(f"import later\n\n{text}\n")
    with pytest.raises(ValueError, match=message):
        list(registrations(tmp_path, "mine", 1))


def test_lines_that_register_are_found_without_importing_them(tmp_path: Path) -> None:
    (tmp_path / "inner").mkdir()
    (tmp_path / "inner" / "b.py").write_text(
        'raise ImportError\n\nregister("b", function,\n    order=3)\nregister("c")\n'
    )
    (tmp_path / "a.py").write_text("def register() -> None:\n    pass\n")
    assert list(registrations(tmp_path, "mine", 1)) == [
        Registration("mine.inner.b", ("b", None), {"order": 3}),
        Registration("mine.inner.b", ("c",), {}),
    ]


def test_names_are_registered_once_and_found() -> None:
    registry: Registry[int] = Registry("number")
    registry.register("one")(1)
    assert registry.get("one") == 1
    assert "one" in registry
    assert list(registry) == ["one"]
    with pytest.raises(ValueError, match="registered twice"):
        registry.register("one")(2)
    with pytest.raises(ParameterError, match="did you mean 'one'"):
        registry.get("one ")


def test_a_plug_in_that_is_forgotten_is_unknown() -> None:
    registry: Registry[int] = Registry("number")
    registry.register("one")(1)
    assert registry.forget("one") == 1
    assert "one" not in registry
    with pytest.raises(ParameterError, match="unknown number 'one'"):
        registry.forget("one")
