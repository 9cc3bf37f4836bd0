import pytest

from risorius.core.registry import Registry
from risorius.errors import ParameterError


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
