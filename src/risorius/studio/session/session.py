"""A session: one project, its takes, and the requests that change it, a method for each."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

import numpy as np

from ...core.edits import Edit
from ...core.performance import frame_count
from ...core.progress import Progress, quiet
from ...errors import InputError, RisoriusError
from ...pipeline import combine
from ...speech.structure.edges_moved import edge_of
from ...take import Take
from .. import limits
from ..wire import answers, requests, shared, takes
from ..wire.views import PageView
from . import describe
from .history import History
from .performer import Performer
from .prefetch import Prefetch, worth_it
from .rebase_edits import rebase, restore
from .revision import LostEdit, Revision, lanes_worded, worded
from .session_files import SessionFiles

# Seconds after a change for which the skin still moves otherwise: 9 times as long as it takes to forget.
SETTLING = 0.5
# The name of opening a project in the history.
OPENED = "open the project"


@dataclass(slots=True)
class SessionTake:
    """A take with its number, and the state of it that the page has."""

    number: int
    take: Take
    version: Revision
    blocks: describe.Blocks
    curves: dict[str, str]


class Session:
    """One project. Its methods run on one thread at a time."""

    def __init__(self, name: str, folder: Path) -> None:
        self.name, self.folder = name, folder
        self.files = SessionFiles(folder)
        self.takes: OrderedDict[int, SessionTake] = OrderedDict()
        self.history: History[Revision] = History(limits.UNDO)
        self.current: SessionTake | None = None
        self.view = PageView()
        self.notes: tuple[str, ...] = ()
        self.draft: shared.TakeInputs | None = None
        self._performer = Performer(self.files)
        self._number = 0
        self._prefetch: Prefetch | None = None

    def open(self, request: requests.Open, progress: Progress) -> takes.State:
        """Return the state of the session."""
        take = None if self.current is None else self.described(self.current)
        files = self.files
        return takes.State(
            self.name,
            take,
            files.recordings(),
            tuple(files.emotions()),
            files.poses(),
            self.view,
            self.notes,
            self.draft,
        )

    def perform(self, request: requests.Perform, progress: Progress) -> takes.TakeView:
        """Perform a script; if it is the same as before, its edits are applied again."""
        inputs = self._performer.adopted(shared.TakeInputs(request.source, request.choices, request.emotions))
        return self._planned(inputs, "perform", progress)

    def prepare(self, request: requests.Prepare, progress: Progress) -> answers.Done:
        """Prepare the answer to `perform` with the same fields if the text is short."""
        inputs = shared.TakeInputs(request.source, request.choices, request.emotions)
        if worth_it(inputs.source) and not self._prefetched(inputs):
            # An error is reported once the text is performed.
            with suppress(RisoriusError):
                version = self._performer.perform(inputs, quiet)
                self._prefetch = Prefetch(inputs, version, self._performed(version))
        return answers.Done()

    def save_draft(self, request: requests.SaveDraft, progress: Progress) -> answers.Done:
        """Save the written text, unless it has been performed."""
        draft = shared.TakeInputs(request.source, request.choices, request.emotions)
        performed = self.history.present
        self.draft = None if performed is not None and performed.inputs == draft else draft
        return answers.Done()

    def forget_prefetch(self) -> None:
        """Forget prepared takes: a name in them may mean something else now."""
        self._prefetch = None

    def choose(self, request: requests.Choose, progress: Progress) -> takes.TakeView:
        """Perform the same script with other choices."""
        inputs = self._inputs(request.choices, request.emotions)
        return self._planned(inputs, "change the settings", progress)

    def relabel(self, request: requests.Relabel, progress: Progress) -> takes.TakeView:
        """Perform the same line with a phone that begins elsewhere."""
        inputs, utterance = self.version().inputs, self.version().utterance
        source = inputs.source
        if utterance is None or source.format == "score":
            raise InputError("only phones of spoken or recorded lines can be moved")
        edge = edge_of(utterance, request.phone, 0.0)
        shifts = {replace(other, shift=0.0): other.shift for other in source.edges}
        shift = shifts.pop(edge, 0.0)
        if request.start is not None:
            shifts[edge] = shift + request.start - utterance.phones[request.phone].start
        edges = tuple(replace(edge, shift=shift) for edge, shift in shifts.items())
        description = f"move the edge of {edge.symbol or 'the silence'} in “{edge.word}”"
        return self._planned(replace(inputs, source=replace(source, edges=edges)), description, progress)

    def compare(self, request: requests.Compare, progress: Progress) -> takes.TakeView:
        """Perform the same script with other choices and the same edits, as a second take."""
        version = self._performer.perform(self._inputs(request.choices, request.emotions), progress)
        return self.described(self._live(rebase(self.version(), version), progress))

    def edit(self, edit: Edit, progress: Progress) -> takes.TakeChange:
        """Make an edit."""
        before = self.version()
        version = before.changed(edit)
        self.history.push(version, worded(version.edits[-1], before.score))
        return self._changed(version)

    def set_markers(self, request: requests.SetMarkers, progress: Progress) -> takes.TakeChange:
        """Set the markers."""
        before = self.version()
        late = [marker for marker in request.markers if marker.time > before.score.duration]
        if late:
            raise InputError(f"a marker at {late[0].time:g} s; expected up to {before.score.duration:g} s")
        after = before.annotated(markers=request.markers)
        self.history.push(after, "change the markers")
        return self._changed(after)

    def set_lanes(self, request: requests.SetLanes, progress: Progress) -> takes.TakeChange:
        """Mute, solo and lock lanes."""
        before = self.version()
        after = before.annotated(lanes=request.lanes)
        self.history.push(after, lanes_worded(before.lanes, request.lanes))
        return self._changed(after)

    def bring_back(self, request: requests.BringBack, progress: Progress) -> takes.TakeChange:
        """Make something again that was lost when the text changed."""
        version, entry = self._lost(request.number)
        after = restore(version, request.number)
        self.history.push(after, f"bring back: {entry.text}")
        return self._changed(after)

    def let_go(self, request: requests.LetGo, progress: Progress) -> takes.TakeChange:
        """Forget the changes that were lost when the text changed."""
        after = replace(self.version(), lost=(), warnings=())
        self.history.push(after, "forget what did not fit")
        return self._changed(after)

    def edit_all(self, request: requests.EditAll, progress: Progress) -> takes.TakeChange:
        """Make several edits as one change."""
        before, version = self.version(), self._edited(request.edits)
        what = worded(version.edits[-1], before.score)
        others = len(request.edits) - 1
        self.history.push(version, f"{what} and {others} more" if others else what)
        return self._changed(version)

    def _edited(self, edits: Sequence[Edit]) -> Revision:
        """Return the version after several edits; raise InputError if one does not fit."""
        if not 0 < len(edits) <= limits.EDITS:
            raise InputError(f"{len(edits)} edits at once; expected 1 to {limits.EDITS}")
        version = self.version()
        for edit in edits:
            version = version.changed(edit)
        return version

    def preview(self, *edits: Edit) -> tuple[Take, takes.Previewed]:
        """Return the take that edits would make, and which curves they would change; nothing is changed."""
        version, live = self._edited(edits), self.current
        assert live is not None
        take = combine(version.audible, version.settings, version.utterance, live.take)
        changed = describe.changed_curves(live.curves, describe.curves(take.performance.values))
        return take, takes.Previewed(live.number, changed)

    def undo(self, request: requests.Undo, progress: Progress) -> takes.TakeChange:
        """Undo the last change."""
        undone = self.history.undo_before(OPENED) if request.opened else self.history.undo()
        return self._changed(undone)

    def redo(self, request: requests.Redo, progress: Progress) -> takes.TakeChange:
        """Redo the change that was undone last."""
        return self._changed(self.history.redo())

    def save_view(self, request: requests.SaveView, progress: Progress) -> answers.Done:
        """Save the view of the page."""
        self.view = request.view
        return answers.Done()

    def live(self, number: int) -> SessionTake:
        """Return a take by its number; raise InputError if it is no longer in memory."""
        if number not in self.takes:
            raise InputError(f"there is no take {number}; expected one of {sorted(self.takes)}")
        return self.takes[number]

    @property
    def last_number(self) -> int:
        """The number of the last take; numbers are never used twice."""
        return self._number

    def restore(self, version: Revision, view: PageView, number: int = 0) -> None:
        """Restore a saved version; each of its edits can be undone. Takes are numbered from `number` on."""
        self._number = max(self._number, number)
        self._take_up(version, History(limits.UNDO), "perform")
        self.view = view

    def open_version(self, version: Revision, view: PageView) -> None:
        """Show the version of another project; undo leads through its edits to the earlier state."""
        self._take_up(version, self.history.copy(), OPENED)
        self.view = view

    def _take_up(self, version: Revision, history: History[Revision], what: str) -> None:
        """Go on with a version; on an error, nothing changes."""
        step = replace(version, score=version.base, edits=())
        # The edits of the opened version must not push older states out of the history.
        at_once = max(0, len(version.edits) - limits.UNDO // 2)
        for edit in version.edits[:at_once]:
            step = step.changed(edit)
        history.push(step, what)
        for edit in version.edits[at_once:]:
            description = worded(edit, step.score)
            step = step.changed(edit)
            history.push(step, description)
        self.forget_prefetch()
        self.current = self._live(step)
        self.history = history

    def version(self) -> Revision:
        """Return the present version; raise InputError before the first."""
        version = self.history.present
        if version is None:
            raise InputError("nothing is performed yet; expected 'perform' first")
        return version

    def _lost(self, number: int) -> tuple[Revision, LostEdit]:
        version = self.version()
        lost = version.lost_made
        if number >= len(lost):
            raise InputError(f"{len(lost)} changes did not fit; there is no number {number}")
        return version, lost[number]

    def _inputs(
        self, choices: shared.Choices | None, emotions: tuple[shared.EmotionSpan, ...] | None
    ) -> shared.TakeInputs:
        inputs = self.version().inputs
        return shared.TakeInputs(
            inputs.source,
            inputs.choices if choices is None else choices,
            inputs.emotions if emotions is None else emotions,
        )

    def _planned(self, inputs: shared.TakeInputs, what: str, progress: Progress) -> takes.TakeView:
        before = self.history.present
        ready = self._prefetched(inputs)
        version = ready.version if ready else self._performer.perform(inputs, progress)
        if before is not None:
            version = rebase(before, version)
        live = self._live(version, progress)
        self.history.push(version, what)
        self.current = live
        if self.draft == inputs:
            self.draft = None
        return self.described(live)

    def _changed(self, version: Revision) -> takes.TakeChange:
        before = self.current
        self.current = after = self._live(version)
        assert before is not None
        return self._difference(before, after)

    def _live(self, version: Revision, progress: Progress = quiet) -> SessionTake:
        """Return the take of a version, the existing one if there is one."""
        for live in self.takes.values():
            if live.version is version:
                self.takes.move_to_end(live.number)
                return live
        ready = self._prefetched(version.inputs)
        take = ready.take if ready and ready.version is version else self._performed(version, progress)
        self._prefetch = None
        self._number += 1
        like = None if self.current is None else (self.current.version.score, self.current.blocks)
        live = SessionTake(
            self._number,
            take,
            version,
            describe.blocks(version.score, like),
            describe.curves(take.performance.values),
        )
        self.takes[live.number] = live
        while len(self.takes) > limits.TAKES:
            oldest = next(n for n, live_take in self.takes.items() if live_take is not self.current)
            del self.takes[oldest]
        return live

    def _performed(self, version: Revision, progress: Progress = quiet) -> Take:
        frames = frame_count(version.score.duration, version.settings.fps)
        if frames > limits.FRAMES:
            raise InputError(f"the take would have {frames} frames; expected up to {limits.FRAMES}")
        progress("Combining …")
        begun = perf_counter()
        like = None if self.current is None else self.current.take
        take = combine(version.audible, version.settings, version.utterance, like)
        version.milliseconds["blend"] = 1e3 * (perf_counter() - begun)
        return take

    def _prefetched(self, inputs: shared.TakeInputs) -> Prefetch | None:
        prefetch = self._prefetch
        return prefetch if prefetch is not None and prefetch.inputs == inputs else None

    def described(self, live: SessionTake) -> takes.TakeView:
        """Return all of a take for the page."""
        take, version = live.take, live.version
        sound = f"/api/session/{self.name}/take/{live.number}/sound.wav"
        return takes.TakeView(
            take=live.number,
            duration=take.duration,
            fps=str(take.performance.fps),
            frames=len(take.performance.values),
            speech=None if take.utterance is None else describe.spoken(take.utterance, sound),
            blocks=tuple(live.blocks.values()),
            drawn=describe.drawn(version.score),
            curves=live.curves,
            made=version.inputs,
            undoes=self.history.undoes,
            redoes=self.history.redoes,
            warnings=version.warnings,
            lost=_lost_texts(version),
            markers=version.markers,
            lanes=version.lanes,
            milliseconds=version.milliseconds,
        )

    def _difference(self, before: SessionTake, after: SessionTake) -> takes.TakeChange:
        whole = None if _alike(before, after) else self.described(after)
        first, last = (0, 0) if whole else _frames_changed(before.take, after.take)
        blocks = () if whole else _changed_blocks(before.blocks, after.blocks)
        return takes.TakeChange(
            take=after.number,
            before=before.number,
            blocks=blocks,
            gone=() if whole else tuple(n for n in before.blocks if n not in after.blocks),
            drawn=describe.drawn(after.version.score),
            curves={} if whole else describe.changed_curves(before.curves, after.curves),
            from_frame=first,
            to_frame=last,
            made=after.version.inputs,
            undoes=self.history.undoes,
            redoes=self.history.redoes,
            whole=whole,
            warnings=after.version.warnings,
            lost=_lost_texts(after.version),
            markers=after.version.markers,
            lanes=after.version.lanes,
        )


def _lost_texts(version: Revision) -> tuple[str, ...]:
    return tuple(entry.text for entry in version.lost_made)


def _changed_blocks(before: describe.Blocks, after: describe.Blocks) -> tuple[takes.Block, ...]:
    # Most are the same object; to compare them by their parts takes long in a long take.
    return tuple(b for n, b in after.items() if (earlier := before.get(n)) is not b and earlier != b)


def _alike(a: SessionTake, b: SessionTake) -> bool:
    """Whether two takes have the same speech, frames and head, and differ in blocks and curves only."""
    one, two = a.version, b.version
    if a.take.duration != b.take.duration or one.utterance is not two.utterance:
        return False
    return all(getattr(one.settings, name) == getattr(two.settings, name) for name in _LOOKS)


_LOOKS = ("fps", "head", "age", "shape", "look", "dynamics", "wrinkles")


def _frames_changed(a: Take, b: Take) -> tuple[int, int]:
    """Return the frames [from, to) whose faces are other, the skin's settling included."""
    other = np.flatnonzero((a.performance.values != b.performance.values).any(axis=1))
    if not len(other):
        return 0, 0
    lag = round(SETTLING * b.performance.fps)
    return int(other[0]), min(int(other[-1]) + 1 + lag, len(b.performance.values))
