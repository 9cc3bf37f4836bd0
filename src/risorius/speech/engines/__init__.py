"""Speech engines. A new one is a module here that registers itself, and its name in the line below."""

from . import espeak, piper, program

__all__ = ["espeak", "piper", "program"]
