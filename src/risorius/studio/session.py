"""A session: one project, its takes, and what a page may ask of it. Every verb is a method of its name."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter

from ..core.edits import identified
from ..errors import InputError
from ..pipeline import perform
from ..take import Progress, Take
from . import describe, wire
from .performer import Performed, Performer


@dataclass(slots=True)
class Live:
    """A take with its number and what the page was told of it."""

    number: int
    take: Take
    performed: Performed
    blocks: dict[str, wire.Block] = field(default_factory=dict)
    curves: dict[str, str] = field(default_factory=dict)
    milliseconds: dict[str, float] = field(default_factory=dict)


class Session:
    """One project. Its methods run on one thread at a time."""

    def __init__(self, name: str, folder: Path) -> None:
        self.name, self.folder = name, folder
        self.takes: dict[int, Live] = {}
        self.current: Live | None = None
        self.view: dict[str, object] = {}
        self._performer = Performer(folder)
        self._number = 0

    def open(self, asked: wire.Open, progress: Progress) -> wire.State:
        """Return the session as it stands."""
        take = None if self.current is None else self.described(self.current)
        return wire.State(self.name, take, (), self.view)

    def perform(self, asked: wire.Perform, progress: Progress) -> wire.TakeView:
        """Perform a script anew."""
        made = wire.Made(asked.source, asked.choices, asked.emotions)
        performed = self._performer.perform(made, progress)
        self.current = self._live(performed)
        return self.described(self.current)

    def live(self, number: int) -> Live:
        """Return a take by its number; raise InputError if it is not kept any more."""
        if number not in self.takes:
            raise InputError(f"there is no take {number}; expected one of {sorted(self.takes)}")
        return self.takes[number]

    def _live(self, performed: Performed) -> Live:
        begun = perf_counter()
        take = perform(identified(performed.score), performed.settings, performed.utterance)
        self._number += 1
        live = Live(self._number, take, performed)
        live.blocks = describe.blocks(take.score)
        live.curves = describe.curves(take.performance.values)
        live.milliseconds = {**performed.milliseconds, "blend": 1e3 * (perf_counter() - begun)}
        self.takes[live.number] = live
        return live

    def described(self, live: Live) -> wire.TakeView:
        """Return a take whole."""
        take = live.take
        sound = f"/api/session/{self.name}/take/{live.number}/sound.wav"
        return wire.TakeView(
            take=live.number,
            duration=take.duration,
            fps=str(take.performance.fps),
            frames=len(take.performance.values),
            speech=None if take.utterance is None else describe.spoken(take.utterance, sound),
            blocks=tuple(live.blocks.values()),
            drawn=describe.drawn(take.score),
            curves=live.curves,
            made=live.performed.made,
            warnings=live.performed.warnings,
            milliseconds=live.milliseconds,
        )
