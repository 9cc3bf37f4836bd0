"""Perform one line as `risorius speak` does, with the same calls and bytes; workers run this."""

from __future__ import annotations

import contextlib
import os
import tempfile
import time
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import DiskFullError, RisoriusError, warnings_to
from ..machine.worker_pool import resident
from .jobs import BatchJob
from .outcome import Outcome
from .places import is_remote, make_folder, read_bytes, upload

if TYPE_CHECKING:
    from ..speech.alignment.confidence import AlignmentConfidence
    from ..take import HeadCache, Take

SHEET_SIZE, SHEET_FRAMES = (112, 112), 6
LONGEST_SHOWN = 240  # characters of a line's text


def perform_line(job: BatchJob, run: str = "") -> Outcome:
    """Perform a line and write its files; an error goes into the outcome. `run` names temporary files."""
    from ..machine.atomic import temporaries_of
    from ..speech.alignment.confidence import receive_confidence

    start = time.process_time()
    warnings: list[str] = []
    doubts: list[AlignmentConfidence] = []
    try:
        with warnings_to(warnings.append), receive_confidence(doubts.append), temporaries_of(run):
            take = _perform_and_write(job)
    except DiskFullError as error:
        return Outcome(error=str(error), stops=True)
    except RisoriusError as error:
        return Outcome(error=str(error), warnings=tuple(warnings))
    except MemoryError:
        return Outcome(error="out of memory; expected a smaller size or a shorter text")
    except Exception as error:  # the other lines go on
        return Outcome(error=f"unexpected {type(error).__name__}: {' '.join(str(error).split())}")
    doubt = doubts[-1] if doubts else None
    return Outcome(
        duration=round(take.duration, 3),
        words=len(take.utterance.words) if take.utterance else 0,
        cpu=round(time.process_time() - start, 4),
        memory=resident(os.getpid()),
        outputs=_sizes(job),
        doubt=0.0 if doubt is None else round(doubt.worst, 1),
        doubtful=() if doubt is None else doubt.words,
        warnings=tuple(warnings),
        text=_shortened(take.utterance.text) if take.utterance else "",
        sound=_sound(job),
        sheet=job.sheet or "",
    )


def _shortened(text: str) -> str:
    text = " ".join(text.split())
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]}…"


def _sound(job: BatchJob) -> str:
    """Return the file in which a line is heard: an output, or else its recording."""
    outputs = [name for suffix in (".wav", ".mp4", ".webm") for name in job.outputs if name.endswith(suffix)]
    return next(iter(outputs), str(job.given.audio or ""))


def _perform_and_write(job: BatchJob) -> Take:
    with tempfile.TemporaryDirectory(prefix="risorius-") as folder, _local(job, Path(folder)) as local:
        take = replace(perform(local), cache=_cache())
        for name in job.outputs:
            make_folder(name)
        take.write(*local.outputs)
        if job.sheet is not None:
            make_folder(job.sheet)
            write_sheet(take, job.sheet)
    return take


def perform(job: BatchJob) -> Take:
    """Return the take of a job whose files are all here."""
    from ..api import perform_input, speak

    if job.is_score:
        return speak(job.given.script, emotion=job.emotions, settings=job.settings)
    return perform_input(job.given, job.emotions, job.settings)


def write_sheet(take: Take, path: str) -> None:
    """Write a strip of small pictures, evenly spaced over a take, as PNG; raises OutputError."""
    import numpy as np
    from PIL import Image

    from ..machine.atomic import replacing

    camera = "close-up" if take.settings.look.camera == "portrait" else take.settings.look.camera
    look = replace(take.settings.look, quality="draft", overlay=(), camera=camera)
    frames = len(take.performance.values)
    indices = sorted({frames * (2 * k + 1) // (2 * SHEET_FRAMES) for k in range(SHEET_FRAMES)})
    shown = replace(take, settings=replace(take.settings, look=look))
    strip = np.concatenate([picture.copy() for picture in shown.pictures(SHEET_SIZE, indices)], axis=1)
    with replacing(Path(path)) as file, file.open("wb") as target:
        Image.fromarray(strip).save(target, "PNG")


@contextlib.contextmanager
def _local(job: BatchJob, folder: Path) -> Iterator[BatchJob]:
    """Yield the job with files from elsewhere in a folder; when the block ends well, outputs go elsewhere."""
    source, content = job.given, _content(job)
    audio, transcript = (
        _fetched(source.audio, folder / "audio"),
        _fetched(source.transcript, folder / "words"),
    )
    source = replace(source, audio=audio, transcript=transcript, content=content)
    if not source.text and content is None:
        source = replace(source, script=_fetched(source.script, folder / "script"))
    outputs = [_output(name, folder / str(number)) for number, name in enumerate(job.outputs)]
    try:
        yield replace(job, given=source, outputs=tuple(map(str, outputs)))
    except RisoriusError as error:
        raise _named_as_given(error, job, folder) from None
    for name, path in zip(job.outputs, outputs, strict=True):
        if is_remote(name):
            upload(path, name)


def _content(job: BatchJob) -> str | None:
    """Return the text of a script elsewhere, so that its marks have its own name; None for other inputs."""
    from ..script.files import decode
    from ..script.read import READERS

    script = job.given.script
    if script is None or job.given.text or not is_remote(script):
        return None
    return decode(read_bytes(script), script) if Path(script).suffix.lower() in READERS else None


def _fetched(name: object, folder: Path) -> str | None:
    """Return the name of a file that is here: a copy in a folder if it is elsewhere."""
    if name is None:
        return None
    text = str(name)
    if not is_remote(text):
        return text
    folder.mkdir()
    path = folder / text.rsplit("/", 1)[-1]
    path.write_bytes(read_bytes(text))
    return str(path)


def _output(name: str, folder: Path) -> Path:
    if not is_remote(name):
        return Path(name)
    folder.mkdir()
    return folder / name.rsplit("/", 1)[-1]


def _named_as_given(error: RisoriusError, job: BatchJob, folder: Path) -> RisoriusError:
    """Return an error with the names of files elsewhere in place of those of their copies."""
    message = str(error)
    for part, name in (("audio", job.given.audio), ("script", job.given.script)):
        if name is not None and is_remote(str(name)):
            message = message.replace(str(folder / part / str(name).rsplit("/", 1)[-1]), str(name))
    return type(error)(message) if message != str(error) else error


def _sizes(job: BatchJob) -> dict[str, int]:
    from .places import size_of

    names = (*job.outputs, job.sheet) if job.sheet else job.outputs
    return {name: size_of(name) or 0 for name in names}


@cache
def _cache() -> HeadCache:
    from ..take import HeadCache

    return HeadCache()
