"""The errors that Risorius raises. Only the command line turns them into an exit code."""

from __future__ import annotations

import difflib
import inspect
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from numbers import Real

LONGEST_LINE = 300  # characters of what the command line prints of an error
LONGEST_MESSAGE = 280  # of an error with its place
_LONGEST_PLACE = 140
_LONGEST_NAME = 60  # of a name that is shown
_SHORTEST_PART = 3  # letters by which a name is found that contains them
_receiver: ContextVar[Callable[[str], None] | None] = ContextVar("receiver of warnings", default=None)


@dataclass(frozen=True, slots=True)
class Place:
    """A place in a source: file name, line and column counted from 1."""

    file: str
    line: int | None = None
    column: int | None = None

    def __str__(self) -> str:
        parts = [self.file, *(str(n) for n in (self.line, self.column) if n is not None)]
        return ":".join(parts)


def printable(text: str) -> str:
    """Return text on one line: users' names may hold line ends and control characters."""
    return "".join(c if c.isprintable() else "\ufffd" for c in " ".join(text.split()))


def shortened(text: str, longest: int, kept: float = 0.6) -> str:
    """Return text of at most `longest` characters, cut in the middle: a share `kept` is its beginning.

    >>> shortened("size 'xxxxxxxxxxxxxxxxxxxx' is not a size", 24)
    "size 'xxxxxxxx…ot a size"
    """
    if len(text) <= longest:
        return text
    first = round((longest - 1) * kept)
    return f"{text[:first]}…{text[len(text) - (longest - 1 - first) :]}"


class RisoriusError(Exception):
    """A fault that a user can mend: one line saying where it is, what is wrong and what was expected.

    The line is at most `LONGEST_MESSAGE` characters long, all of them printable.
    """

    def __init__(self, message: str, place: Place | None = None) -> None:
        self.place = place
        where = "" if place is None else f"{shortened(printable(str(place)), _LONGEST_PLACE, 0.3)}: "
        self.message = shortened(printable(message), LONGEST_MESSAGE - len(where))
        super().__init__(where + self.message)

    def __reduce__(self) -> tuple[type[RisoriusError], tuple[object, ...]]:
        """Return the arguments that make the same error in another process."""
        return type(self), (self.message, self.place)

    def at(self, place: Place) -> RisoriusError:
        """Return the same error with its place, unless it has one already."""
        return self if self.place is not None else type(self)(self.message, place)


class RisoriusWarning(UserWarning):
    """Something was done differently than asked, or left out; one line names it and its place."""


class SpeechWarning(RisoriusWarning):
    """Something was spoken or read from a recording, but not known exactly."""


class InputError(RisoriusError):
    """The text, markup, score or option that the user gave cannot be used."""


class UnusedSettingError(InputError):
    """Settings were given that nothing reads: `names`, and the `reason` with what is expected instead."""

    def __init__(self, names: Sequence[str], reason: str, place: Place | None = None) -> None:
        self.names, self.reason = tuple(names), reason
        verb = "has" if len(self.names) == 1 else "have"
        super().__init__(f"{', '.join(self.names)} {verb} no effect: {reason}", place)

    def __reduce__(self) -> tuple[type[RisoriusError], tuple[object, ...]]:
        """Return the arguments that make the same error in another process."""
        return UnusedSettingError, (self.names, self.reason, self.place)

    def at(self, place: Place) -> UnusedSettingError:
        """Return the same error with its place, unless it has one already."""
        return self if self.place is not None else UnusedSettingError(self.names, self.reason, place)

    def spelled(self, spell: Callable[[str], str]) -> UnusedSettingError:
        """Return the same error with its names as the command line spells them."""
        return UnusedSettingError([spell(name) for name in self.names], self.reason, self.place)


class ParameterError(InputError):
    """A muscle, action unit, emotion or other name is unknown, or its value is out of range."""


class SpeechError(RisoriusError):
    """The speech engine failed or does not know the voice or language asked for."""


class HeadError(RisoriusError):
    """A head's folder is incomplete or its arrays do not fit together."""


class OutputError(RisoriusError):
    """An output cannot be written: unknown suffix, missing or unwritable folder, full disk."""


class DiskFullError(OutputError):
    """There is no space left for an output."""


def warn(message: str, category: type[RisoriusWarning] = RisoriusWarning) -> None:
    """Warn the caller of the run: by `warnings_to`, or else as Python does, at the caller's own line."""
    line = shortened(printable(message), LONGEST_MESSAGE)
    receive = _receiver.get()
    if receive is None:
        warnings.warn(line, category, stacklevel=_frames_of_ours())
    else:
        receive(line)


@contextmanager
def warnings_to(receive: Callable[[str], None]) -> Iterator[None]:
    """Call `receive` with each warning of the block, one line, instead of issuing it through Python.

    Only this thread, or this task of an event loop, is concerned: runs beside it have their own receivers.
    """
    token = _receiver.set(receive)
    try:
        yield
    finally:
        _receiver.reset(token)


def check_number(name: str, value: object) -> None:
    """Raise InputError, with what it is called, for a value that is not a number."""
    if not isinstance(value, Real):
        raise InputError(f"{name} = {value!r} is not a number")


def _frames_of_ours() -> int:
    """Return the `stacklevel` of the package's caller, as seen from the caller of this function."""
    frame, level = inspect.currentframe(), 0
    while frame is not None and frame.f_globals.get("__name__", "").partition(".")[0] == "risorius":
        frame, level = frame.f_back, level + 1
    return level


def unknown(kind: str, name: str, known: Iterable[str]) -> str:
    """Return the message for an unknown name, with the nearest known one.

    >>> unknown("emotion", "hapiness", ["happiness", "anger"])
    "unknown emotion 'hapiness'; did you mean 'happiness'?"
    """
    name = name if len(name) <= _LONGEST_NAME else f"{name[:_LONGEST_NAME]}…"
    choices = list(known)
    near = nearest(name, choices)
    if near is not None:
        return f"unknown {kind} '{name}'; did you mean '{near}'?"
    shown = ", ".join(choices[:12]) + (", …" if len(choices) > 12 else "")
    return f"unknown {kind} '{name}'; expected one of {shown}"


def nearest(name: str, known: Iterable[str]) -> str | None:
    """Return the known name that is most alike, or else the first that contains `name`; None if none is near.

    >>> nearest("zygomatic", ["masseter", "zygomatic_major"])
    'zygomatic_major'
    """
    lowered = {choice.lower(): choice for choice in reversed(list(known))}
    lowercase = name.lower()
    near = difflib.get_close_matches(lowercase, list(lowered), n=1, cutoff=0.6)
    if not near and len(lowercase) >= _SHORTEST_PART:
        near = sorted((choice for choice in lowered if lowercase in choice), key=len)[:1]
    return lowered[near[0]] if near else None
