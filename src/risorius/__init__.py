"""Risorius: from a script or a recorded line to a performing face.

>>> import risorius
>>> take = risorius.speak("Hello.", emotion={"happiness": 0.7})  # doctest: +SKIP
>>> take.write("hello.mp4")  # doctest: +SKIP
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .errors import RisoriusError as RisoriusError
    from .pipeline import align as align
    from .pipeline import load as load
    from .pipeline import mix as mix
    from .pipeline import play as play
    from .pipeline import pose as pose
    from .pipeline import speak as speak
    from .settings import Settings as Settings
    from .take import Take as Take

__version__ = "0.1.0"
__all__ = ["RisoriusError", "Settings", "Take", "align", "load", "mix", "play", "pose", "speak"]

_HOMES = {
    "RisoriusError": "errors",
    "Settings": "settings",
    "Take": "take",
    "align": "pipeline",
    "load": "pipeline",
    "mix": "pipeline",
    "play": "pipeline",
    "pose": "pipeline",
    "speak": "pipeline",
}


def __getattr__(name: str) -> Any:
    # Loaded when first used: the command line's help must not wait for numpy.
    if name not in _HOMES:
        raise AttributeError(f"module 'risorius' has no attribute '{name}'")
    from importlib import import_module

    return getattr(import_module(f".{_HOMES[name]}", __name__), name)
