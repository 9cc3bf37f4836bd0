"""The states of a session in order, one of them the present one, for undo and redo."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, TypeVar

from ...errors import InputError

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Step(Generic[T]):
    """A state, and a description of the change that led to it."""

    state: T
    what: str


class History(Generic[T]):
    """States in order; a change after an undo replaces the states that were undone."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._steps: list[Step[T]] = []
        self._at = -1

    @property
    def present(self) -> T | None:
        """The present state, None before the first."""
        return self._steps[self._at].state if self._steps else None

    @property
    def undoes(self) -> str:
        """The name of the change that an undo would reverse, "" for none."""
        return self._steps[self._at].what if self._at > 0 else ""

    @property
    def redoes(self) -> str:
        """The name of the change that a redo would restore, "" for none."""
        return self._steps[self._at + 1].what if self._at + 1 < len(self._steps) else ""

    def copy(self) -> History[T]:
        """Return a history with the same states, which goes on by itself."""
        other: History[T] = History(self._most)
        other._steps, other._at = self._steps, self._at
        return other

    def push(self, state: T, what: str) -> None:
        """Make `state` the present; undone states are forgotten, and the oldest if there are too many."""
        self._steps = [*self._steps[: self._at + 1], Step(state, what)][-self._most - 1 :]
        self._at = len(self._steps) - 1

    def undo(self) -> T:
        """Return the previous state and make it the present one; raise InputError at the first."""
        if self._at <= 0:
            raise InputError("there is nothing to undo")
        self._at -= 1
        return self._steps[self._at].state

    def undo_before(self, what: str) -> T:
        """Return the state before the last change called `what` and make it the present one."""
        at = next((k for k in range(self._at, 0, -1) if self._steps[k].what == what), 0)
        if at == 0:
            raise InputError("there is nothing to go back to")
        self._at = at - 1
        return self._steps[self._at].state

    def redo(self) -> T:
        """Return the state that was undone last and restore it; raise InputError if nothing was undone."""
        if self._at + 1 >= len(self._steps):
            raise InputError("there is nothing to redo")
        self._at += 1
        return self._steps[self._at].state
