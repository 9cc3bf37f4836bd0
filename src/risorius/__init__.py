"""Risorius: from a script or a recorded line to a performing face.

>>> import risorius
>>> take = risorius.speak("Hello.", emotion={"happiness": 0.7})  # doctest: +SKIP
>>> take.write("hello.mp4")  # doctest: +SKIP
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .api import align as align
    from .api import load as load
    from .api import mix as mix
    from .api import play as play
    from .api import pose as pose
    from .api import rig as rig
    from .api import speak as speak
    from .batches.library import batch as batch
    from .batches.library import pipe as pipe
    from .batches.outcome import LineResult as LineResult
    from .blend import Explanation as Explanation
    from .blend import Tally as Tally
    from .blend import Trace as Trace
    from .core.movement import Cause as Cause
    from .core.movement import Movement as Movement
    from .core.performance import Performance as Performance
    from .core.score import Score as Score
    from .core.speech.audio import Audio as Audio
    from .core.speech.utterance import Utterance as Utterance
    from .errors import HeadError as HeadError
    from .errors import InputError as InputError
    from .errors import OutputError as OutputError
    from .errors import ParameterError as ParameterError
    from .errors import RisoriusError as RisoriusError
    from .errors import RisoriusWarning as RisoriusWarning
    from .errors import SpeechError as SpeechError
    from .errors import SpeechWarning as SpeechWarning
    from .errors import UnusedSettingError as UnusedSettingError
    from .errors import warnings_to as warnings_to
    from .face.fit.arkit_track import ArkitTrack as ArkitTrack
    from .face.frame import FaceFrame as FaceFrame
    from .face.head.head import Head as Head
    from .live.frame import LiveFrame as LiveFrame
    from .live.session import Live as Live
    from .ports.mesh.rig import MuscleCoverage as MuscleCoverage
    from .ports.mesh.rig import Rig as Rig
    from .rules.emotions import Display as Display
    from .settings import BlendChoices as BlendChoices
    from .settings import Look as Look
    from .settings import Settings as Settings
    from .settings.presets import load_settings as load_settings
    from .take import Take as Take

__version__ = "0.1.0"
__all__ = [
    "ArkitTrack",
    "Audio",
    "BlendChoices",
    "Cause",
    "Display",
    "Explanation",
    "FaceFrame",
    "Head",
    "HeadError",
    "InputError",
    "LineResult",
    "Live",
    "LiveFrame",
    "Look",
    "Movement",
    "OutputError",
    "ParameterError",
    "Performance",
    "Rig",
    "RisoriusError",
    "RisoriusWarning",
    "Score",
    "Settings",
    "MuscleCoverage",
    "SpeechError",
    "SpeechWarning",
    "Take",
    "Tally",
    "Trace",
    "UnusedSettingError",
    "Utterance",
    "align",
    "batch",
    "load",
    "load_settings",
    "mix",
    "pipe",
    "play",
    "pose",
    "rig",
    "speak",
    "stream",
    "warnings_to",
]

_MODULES = {
    "api": ("align", "load", "mix", "play", "pose", "rig", "speak"),
    "batches.library": ("batch", "pipe"),
    "batches.outcome": ("LineResult",),
    "blend": ("Explanation", "Tally", "Trace"),
    "core.speech.audio": ("Audio",),
    "core.movement": ("Cause", "Movement"),
    "core.performance": ("Performance",),
    "core.score": ("Score",),
    "core.speech.utterance": ("Utterance",),
    "errors": (
        "HeadError",
        "InputError",
        "OutputError",
        "ParameterError",
        "RisoriusError",
        "RisoriusWarning",
        "SpeechError",
        "SpeechWarning",
        "UnusedSettingError",
        "warnings_to",
    ),
    "face.fit.arkit_track": ("ArkitTrack",),
    "face.frame": ("FaceFrame",),
    "face.head.head": ("Head",),
    "live.frame": ("LiveFrame",),
    "live.session": ("Live",),
    "ports.mesh.rig": ("Rig", "MuscleCoverage"),
    "settings.presets": ("load_settings",),
    "rules.emotions": ("Display",),
    "settings": ("BlendChoices", "Look", "Settings"),
    "take": ("Take",),
}
_HOMES = {name: module for module, names in _MODULES.items() for name in names}


def __dir__() -> list[str]:
    return sorted({*__all__, "__all__", "__doc__", "__name__", "__version__"})


def __getattr__(name: str) -> Any:
    # Loaded when first used: the command line's help must not wait for numpy.
    from importlib import import_module

    if name == "stream":
        return import_module(".live.stream", __name__)
    if name not in _HOMES:
        raise AttributeError(f"module 'risorius' has no attribute '{name}'")
    return getattr(import_module(f".{_HOMES[name]}", __name__), name)
