"""A take: a performance that can be looked at, explained and written."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import astuple, dataclass, field, fields, replace
from functools import cached_property
from itertools import repeat
from numbers import Integral
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from .core.arrays import Array, ByteArray
from .core.lips.articulators import ARTICULATORS
from .core.lips.lip_rig import LipRig
from .core.parameters import INDEX, MUSCLES, NAMES, parameters_named
from .core.performance import Performance
from .core.progress import Progress, quiet
from .core.score import Score
from .core.speech.audio import Audio
from .core.speech.utterance import Utterance
from .errors import InputError, check_number
from .rules.profiles import profile_of
from .settings import Settings, parse_size
from .solvers import SolverCache

if TYPE_CHECKING:
    from .blend import Explanation, Plan, Tally, Trace
    from .core.look import Size
    from .face.fit.arkit_track import ArkitTrack
    from .face.fit.measure import Gauge
    from .face.frame import FaceFrame
    from .face.head.head import Head
    from .face.solve import FaceSolver
    from .render import Renderer, RendererSetup

_MUSCLES = frozenset(p.name for p in MUSCLES)


@dataclass(repr=False)
class Take:
    """The result of `speak`, `mix` and `pose`.

    `utterance` is None if nothing is said; `sound`, if given, is heard in place of the voice. Faces
    and pictures are made when they are asked for, one frame at a time. `planned` is the plan that the
    performance was made by, if it is still there; `felt` are the parameters that the emotions of a pose alone
    set, as its score does not tell. Takes that share a `cache` solve faces one after the
    other, with solvers that are made once.
    """

    performance: Performance
    settings: Settings = field(default_factory=Settings)
    utterance: Utterance | None = None
    sound: Audio | None = None
    planned: Plan | None = field(default=None, repr=False, compare=False)
    cache: HeadCache = field(default_factory=lambda: HeadCache(), repr=False, compare=False)
    felt: Mapping[str, float] = field(default_factory=dict, compare=False)

    def __repr__(self) -> str:
        """Return one line: its duration and its text."""
        text = "" if self.utterance is None else f", {textwrap.shorten(self.utterance.text, 60)!r}"
        return f"<Take of {self.duration:.2f} s, {len(self.times)} frames{text}>"

    def __getstate__(self) -> dict[str, Any]:
        """Return the state to pickle: the plan, the head and their results are made again when needed."""
        state = {part.name: getattr(self, part.name) for part in fields(self)}
        return {**state, "planned": None, "cache": HeadCache()}

    @property
    def score(self) -> Score:
        """All movements with their causes."""
        return self.performance.score

    @property
    def duration(self) -> float:
        """Seconds."""
        return self.performance.duration

    @property
    def times(self) -> Array:
        """Frame times in seconds, shape (frames,)."""
        return self.performance.times

    @property
    def curves(self) -> dict[str, Array]:
        """One curve per parameter by name, each of shape (frames,)."""
        return self.performance.curves

    def explain(self, time: float, parameter: str | None = None) -> tuple[Explanation, ...]:
        """Say why parameters have their values at a time in seconds: winner, losers and reasons.

        `parameter` is a name with or without its side; if it is None, all that moves at `time`. Raises
        ParameterError for an unknown name, InputError for a time outside the performance.
        """
        from .blend import explain

        check_number("time", time)
        names = NAMES if parameter is None else [p.name for p in parameters_named(parameter)]
        explanations = (explain(self._plan, time, name) for name in names)
        return tuple(e for e in explanations if parameter is not None or e.is_seen)

    def reasons(self, time: float) -> tuple[str, ...]:
        """Return the explanation of all that moves at a time in seconds, in lines of words."""
        from .blend.narrate import narrate

        return tuple(narrate(self.explain(time), time))

    def traces(self, parameter: str) -> tuple[Trace, ...]:
        """Return each channel's request for a parameter, and the part applied, at every frame.

        `parameter` is a name with its side. Raises ParameterError for an unknown name.
        """
        from .blend import traces

        return traces(self._plan, parameter, self.times)

    def summary(self) -> dict[str, Tally]:
        """Say how often each channel won, was inhibited or was limited over the whole clip."""
        from .blend import summarize

        return summarize(self._plan, self.performance.fps)

    def write(self, *paths: str | PathLike[str], progress: Progress = quiet) -> None:
        """Write files, each in the format of its suffix; all appear when the last is complete.

        Raises OutputError if a file cannot be written; then none is.
        """
        from .ports.export_source import WriteOptions
        from .ports.output_files import check_targets, write_targets

        chosen = self.settings
        transparent = chosen.look.transparent
        draft = chosen.look.quality == "draft"
        pictured = chosen.size, chosen.at, chosen.every
        options = WriteOptions(*pictured, chosen.names, transparent, draft, progress=progress)
        write_targets(self, check_targets(paths), options)

    def faces(
        self,
        indices: Sequence[int] | None = None,
        *,
        lead_in: float | None = None,
        solver: FaceSolver | None = None,
        reuse: bool = False,
        progress: Progress = quiet,
    ) -> Iterator[FaceFrame]:
        """Yield the face of every frame, or of the frames in `indices`, one at a time.

        A frame is the same whichever others are asked for: with a skin of springs, those before it are
        computed too, or only those in the last `lead_in` seconds before the first (1 s: equal to 1e-6 mm).
        `solver` is one that the caller keeps warm, made as `make_solver` does. With `reuse` each frame is
        valid until the next is asked for, and no array is made for it.
        """
        from .face.motion import animate

        if indices is not None:
            self._check_frames(indices)
        moving, drive = self.settings.dynamics != "static", self._curves_between_frames
        solver = solver or self._solver
        buffers = solver.buffers() if reuse else None
        faces = animate(self.performance, solver, moving, drive, indices, lead_in, buffers)
        total = len(self.performance.values if indices is None else indices)
        return faces if progress is quiet else _counted(faces, total, progress)

    def _check_frames(self, indices: Sequence[int]) -> None:
        frames = len(self.performance.values)
        for index in indices:
            if not isinstance(index, Integral) or not 0 <= index < frames:
                raise InputError(f"frame {index!r} is not in the performance; expected 0 to {frames - 1}")

    def _curves_between_frames(self, times: Array) -> Array:
        """Return the curves (n, 46) at ascending times (n,); beyond the end they stay.

        Parameters that move no point of the skin between frames are at rest.
        """
        end = self.performance.times[-1]
        before = int(np.searchsorted(times, end))
        values = self._plan.at(np.minimum(times[: before + 1], end), _MUSCLES | self.head.fields.keys())
        return values[np.minimum(np.arange(len(times)), before)]

    def pictures(
        self, size: Size | str | None = None, indices: Sequence[int] | None = None, progress: Progress = quiet
    ) -> Iterator[ByteArray]:
        """Yield pictures as the settings' look wants them, of all frames or of those in `indices`.

        Each is an array of its own: RGB, uint8 (height, width, 3), or with a transparent background RGBA with
        straight alpha. `size` is width and height, by default the settings'.
        """
        from .render import PictureInput, RendererSetup
        from .render.overlay import Overlays, Subject

        chosen = range(len(self.performance.values)) if indices is None else indices
        self._check_frames(chosen)
        size = parse_size(size) if isinstance(size, str) else size
        look = self.settings.look
        subject = Subject(self.performance, self.utterance)
        overlays = Overlays(look.overlay, subject, size or self.settings.size)
        suppression = self._suppression(chosen) if look.style == "muscles" else repeat(None)
        setup = RendererSetup(self.head, overlays.picture_size, look, lambda: next(self.faces([0])), progress)
        with self.cache.renderer(setup) as renderer:
            inputs = map(PictureInput, self.faces(chosen, reuse=True), suppression)
            for done, (frame, picture) in enumerate(zip(chosen, renderer.draw(inputs), strict=True)):
                drawn = overlays.draw(picture, frame)
                yield drawn.copy() if drawn is picture else drawn
                progress("Drawing", done + 1, len(chosen))

    def to_pandas(self) -> Any:
        """Return a `pandas.DataFrame`: a row a frame, indexed by `time_s`, and a column for each parameter.

        Raises RisoriusError if pandas is not installed.
        """
        from .notebook.table import data_frame

        return data_frame(self.performance)

    def plot(self, *parameters: str) -> Any:
        """Return a `matplotlib` figure: sound and words, curves, head and gaze, channels, over one time.

        `parameters` are those to draw, with or without their sides; without any, those that move most. Raises
        RisoriusError if matplotlib is not installed, ParameterError for an unknown name.
        """
        from .notebook.figure import plotted

        return plotted(self, parameters)

    def _repr_html_(self) -> str:
        """Return a picture, the sound and the curves, which notebooks show."""
        from .notebook.page import html

        return html(self, self._repr_png_())

    def _repr_png_(self) -> bytes:
        """Return the middle frame as a small PNG."""
        from io import BytesIO

        from PIL import Image

        (picture,) = self.pictures((320, 320), [len(self.performance.values) // 2])
        data = BytesIO()
        Image.fromarray(picture).save(data, format="PNG")
        return data.getvalue()

    def _suppression(self, indices: Sequence[int]) -> Array:
        from .blend import suppression

        return suppression(self._plan, self.performance.times[indices])

    @cached_property
    def _plan(self) -> Plan:
        from .blend import Plan

        return self.planned or Plan(self.score, lip_rig(self.score, self.settings.head))

    @property
    def audio(self) -> Audio | None:
        """The audible sound: `sound`, or else the voice; None if there is neither."""
        return self.sound or (self.utterance.audio if self.utterance else None)

    def measures(self, frame: FaceFrame) -> list[float]:
        """Return distances in mm, angles in degrees and the 68 landmarks in mm of a face, in one list.

        They are the columns of `.landmarks.csv` after `time_s`, in that order.
        """
        measures = astuple(self._gauge.measure(frame))
        return [*measures, *self._gauge.landmarks(frame).ravel().tolist()]

    @cached_property
    def _gauge(self) -> Gauge:
        from .face.fit.measure import Gauge

        return Gauge(self.head)

    @cached_property
    def shown_head(self) -> Head:
        """The head that performs, with the looks that the settings choose."""
        from .looks.apply_look import apply_look

        looks = apply_look(self.head.identity.looks, self.settings.look)
        return replace(self.head, identity=replace(self.head.identity, looks=looks))

    @property
    def head_lips(self) -> LipRig:
        """The fit of the head's lips: how far apart muscles bring them."""
        from .face.fit.lip_file import load_lip_rig

        return load_lip_rig(self.settings.head)

    @cached_property
    def arkit(self) -> ArkitTrack:
        """The performance as weights of ARKit's 52 shapes, with the distances that they leave, in mm.

        Raises HeadError if the head has no such shapes.
        """
        from .face.fit.arkit_fit import ArkitFit

        track = ArkitFit.of(self.head).track(self.faces(reuse=True))
        return replace(track, times=self.times)

    def emotion_curves(self) -> Array:
        """Return the muscles of every frame (frames, 46) as emotions alone would move them.

        A performance whose score has no movements of emotions, such as a captured one, has none.
        """
        from .blend import emotion_curves

        curves = emotion_curves(self.score, self.times)
        for name, value in self.felt.items():
            curves[:, INDEX[name]] = value
        return curves

    def fit_arkit(self, progress: Progress = quiet) -> ArkitTrack:
        """Return `arkit`; when it is fitted for the first time, report the remaining distances."""
        fitted = "arkit" in vars(self)
        rms, worst = self.arkit.residual
        if not fitted:
            progress(
                f"ARKit weights differ from the face by {rms:.2f} mm root mean square, {worst:.1f} mm at most"
            )
        return self.arkit

    @cached_property
    def head(self) -> Head:
        """The head that performs; raises HeadError if it cannot be loaded."""
        from .face.head.head import head_of

        return head_of(self.settings)

    @cached_property
    def _solver(self) -> FaceSolver:
        return self.cache.solver(self.settings)


class HeadCache:
    """Solvers that are made once for a head as settings shape it, the latest `most` of them.

    A solver has a workspace: takes that share a cache must solve their faces one after the other.
    """

    def __init__(self, most: int = 3) -> None:
        self._solvers = SolverCache(most)
        self._prepared: tuple[RendererSetup, Renderer] | None = None

    def solver(self, settings: Settings) -> FaceSolver:
        """Return a solver as `make_solver` does, which stays here as the newest."""
        return self._solvers.shared(settings)

    def renderer(self, setup: RendererSetup) -> Renderer:
        """Return the renderer that was prepared, if it draws the same pictures, or else open one."""
        from .render import open_renderer

        prepared, self._prepared = self._prepared, None
        if prepared is None:
            return open_renderer(setup)
        drawn_with, renderer = prepared
        if drawn_with.head is setup.head and (drawn_with.size, drawn_with.look) == (setup.size, setup.look):
            return renderer
        renderer.close()
        return open_renderer(setup)

    def prepare_renderer(self, setup: RendererSetup) -> None:
        """Open a renderer ahead for the next take that draws the same pictures. Raises as `Take.pictures`."""
        from .render import open_renderer

        self._prepared = setup, open_renderer(setup)


def _counted(faces: Iterator[FaceFrame], total: int, progress: Progress) -> Iterator[FaceFrame]:
    """Yield faces, and report each when it is done with."""
    for done, face in enumerate(faces, 1):
        yield face
        progress("Solving", done, total)


def lip_rig(score: Score, head: str) -> LipRig | None:
    """Return the lip rig of the head of that name for a score; None if the score needs none.

    It is fitted once per head, at the age and shape that the head has of itself: `--age` and `--shape` do not
    enter, though lips are performed in millimetres.
    """
    from .face.fit.lip_file import load_lip_rig

    articulated = any(name in ARTICULATORS for s in score.lips for name in s.targets)
    return load_lip_rig(head) if articulated else None


def with_profile(settings: Settings) -> Settings:
    """Return settings with the age and the wrinkles of their profile if they choose none."""
    profile = profile_of(settings.profile)
    age = profile.age if settings.age is None else settings.age
    return replace(settings, age=age, wrinkles={**profile.wrinkles, **settings.wrinkles})
