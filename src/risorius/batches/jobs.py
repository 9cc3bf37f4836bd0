"""Make a job of a row of a manifest: its input, its settings and its output files, all checked."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..api import displays_of
from ..errors import InputError, Place, RisoriusError, UnusedSettingError
from ..machine.paths import is_utf8
from ..ports.output_files import OutputFile, check_alpha
from ..rules.emotions import Displays
from ..rules.profiles import attitude
from ..rules.rule_set import emotions_of, rule_set_of
from ..script import Script
from ..script.plain import TextForm
from ..settings import Settings, settings_of
from ..speech import Input, read
from ..speech.input import TRANSCRIPT_SUFFIXES
from ..take import with_profile
from ..unused_settings import SCORE, reject, reject_unused, reject_unwritten
from .columns import check_columns, normal, setting_columns
from .manifest import ManifestRow
from .patterns import OutputPattern, checked_part
from .places import is_remote, local_path, state_of

SCORE_SUFFIX = ".json"


@dataclass(frozen=True, slots=True)
class BatchJob:
    """A line to be performed: its `id`, the `place` of its row, and the names of its `outputs`.

    `sheet`: the picture for the report's contact sheet, None if none is asked for.
    """

    id: str
    place: Place
    given: Input
    emotions: Displays
    settings: Settings
    outputs: tuple[str, ...]
    sheet: str | None = None

    @property
    def is_score(self) -> bool:
        """Whether the line is a score, which is combined and not planned."""
        script = self.given.script
        return script is not None and not self.given.text and script.lower().endswith(SCORE_SUFFIX)


@dataclass(frozen=True)
class JobMaker:
    """The options that all rows share: the `patterns` of outputs, the `folder` that relative file names start
    from, settings and emotions for rows that give none, and columns to `ignore`.
    """

    patterns: Sequence[OutputPattern]
    folder: Path = Path()
    settings: Settings = field(default_factory=Settings)
    emotions: Displays = ()
    ignore: Collection[str] = ()
    sheets: Path | None = None

    def job(self, row: ManifestRow) -> BatchJob:
        """Return the job of a row; raises RisoriusError, with its place, if it cannot be performed."""
        with at_row(row.place):
            return self._job(row)

    def _job(self, row: ManifestRow) -> BatchJob:
        cells = row.cells
        elsewhere = {*self.ignore, *(name for pattern in self.patterns for name in pattern.columns)}
        check_columns(cells.keys(), elsewhere, row.place)
        for column, cell in cells.items():
            if not is_utf8(cell):
                raise InputError(
                    f"{column} '{cell[:60]}' is not UTF-8; expected a text that can be written down"
                )
        if "id" not in cells:
            raise InputError("has no id; expected one")
        name = checked_part("id", cells["id"].strip())
        settings = settings_of(self._settings(cells), self.settings)
        of_row = "emotion" in cells
        emotions = displays_of(_several(cells["emotion"]), settings) if of_row else self.emotions
        outputs = tuple(pattern.name(cells) for pattern in self.patterns)
        reject_unwritten(settings, [pattern.format for pattern in self.patterns])
        if settings.look.transparent:
            check_alpha(OutputFile(local_path(pattern.text), pattern.format) for pattern in self.patterns)
        sheet = None if self.sheets is None else str(self.sheets / f"{name}.png")
        form = TextForm(settings.format, settings.keep_tags)
        given = replace(self._input(cells), language=settings.language, form=form)
        return BatchJob(name, row.place, given, emotions, settings, outputs, sheet)

    def _settings(self, cells: Mapping[str, str]) -> dict[str, str]:
        """Return the settings that a row chooses, as texts by name."""
        columns = setting_columns()
        chosen: dict[str, str] = {}
        for name, cell in cells.items():
            column = columns.get(normal(name))
            if column is not None and name not in self.ignore:
                if column.row.name in chosen:
                    raise InputError(f"chooses {column.row.name} in two columns; expected one")
                chosen[column.row.name] = column.text(cell.strip())
        return chosen

    def _input(self, cells: Mapping[str, str]) -> Input:
        text, script = cells.get("text"), cells.get("script")
        audio, transcript = self._file(cells.get("audio")), cells.get("transcript")
        if text is not None and script is not None:
            raise InputError("has both a text and a script; expected one of them")
        if text is None and script is None and audio is None:
            raise InputError(
                "has nothing to perform; expected a text, a script, or an audio and its transcript"
            )
        if audio is not None and text is None and script is None and transcript is None:
            raise InputError("has an audio without words; expected its transcript, a text or a script")
        if transcript is not None and _names_a_file(transcript):
            transcript = self._file(transcript)
        named = text if text is not None else self._file(script)
        return Input(named, audio, transcript, text is not None)

    def _file(self, name: str | None) -> str | None:
        """Return a row's file as seen from the current folder; raises InputError if it is missing."""
        if name is None:
            return None
        name = name.strip()
        path = name if is_remote(name) else str(self.folder / name)
        if state_of(path) is None:
            raise InputError("there is no such file", Place(path))
        return path


@contextmanager
def at_row(place: Place) -> Iterator[None]:
    """Prefix errors of the block with their row of the manifest."""
    try:
        yield
    except RisoriusError as error:
        kind = InputError if isinstance(error, UnusedSettingError) else type(error)
        message = error.message if error.place is None else f"{error.place}: {error.message}"
        raise kind(message, place) from None


def check_job(job: BatchJob) -> None:
    """Raise RisoriusError for any fault that can be found before a line is performed."""
    with at_row(job.place):
        _check_job(job)


def _check_job(job: BatchJob) -> None:
    settings = job.settings
    if job.is_score:
        reject(settings, SCORE, Place(str(job.given.script)), emotion=job.emotions, audio=job.given.audio)
        return
    with_profile(settings)
    rule_set_of(settings.rules)
    for name in settings.attitudes:
        attitude(name)
    if not any(map(is_remote, filter(None, (job.given.script, job.given.transcript)))):
        with emotions_of(settings.rules, settings.expression, settings.overwhelmed):
            source = read(job.given)
        reject_unused(source, settings)
        if isinstance(source, Script) and not source.lines and not source.marks:
            raise InputError("says and shows nothing; expected words or marks")


def _several(cell: str) -> list[str]:
    return [part.strip() for part in cell.split(";") if part.strip()]


def _names_a_file(transcript: str) -> bool:
    return transcript.strip().lower().endswith(TRANSCRIPT_SUFFIXES)
