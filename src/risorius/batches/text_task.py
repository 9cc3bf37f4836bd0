"""One text, performed to a take that goes to another process: what workers run for `risorius.pipe`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .. import errors
from ..errors import Place, RisoriusError

if TYPE_CHECKING:
    from ..rules.emotions import Displays
    from ..settings import Settings
    from ..take import Take


@dataclass(frozen=True, slots=True)
class Refusal:
    """An error on its way between processes."""

    kind: str
    message: str
    place: Place | None

    def error(self) -> RisoriusError:
        """Return the error."""
        kind: type[RisoriusError] = getattr(errors, self.kind, RisoriusError)
        return kind(self.message, self.place)


def perform_text(text: str, displays: Displays, settings: Settings) -> Take | Refusal:
    """Perform a text; the error if it cannot be performed."""
    from ..api import speak

    try:
        return speak(text, text=True, emotion=displays, settings=settings)
    except RisoriusError as error:
        kind = "InputError" if isinstance(error, errors.UnusedSettingError) else type(error).__name__
        return Refusal(kind, error.message, error.place)
